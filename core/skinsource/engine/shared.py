"""Values that several graphs share: limbs, operators of their maps, drives, spectra and gains.

All graphs of the process read and transform the responses of a limb once.
`skinsource.engine.memory` states how much memory remembered values take at most; a limb with the
responses that were read stays as long as a graph holds it.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any
from weakref import WeakValueDictionary, ref

from skinsource.actuators.actuation import Actuation
from skinsource.base.assets import user_folder
from skinsource.base.job import Stop
from skinsource.engine.gains import EngineMemory
from skinsource.engine.memory import SURFACES_BYTES, Memory
from skinsource.engine.spectra import actuated_limb
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.limb import Limb, LimbFacts
from skinsource.limbs.own_limbs import facts_of
from skinsource.limbs.scaling import Scaling
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.limbs.surface.surface import cached_surface_operator

_Actuated = tuple[ref[Limb], Actuation, Scaling]
# Of all threads: what two of them open at once, both read.
_LIMBS: WeakValueDictionary[tuple[Path, LimbFacts, str], Limb] = WeakValueDictionary()
_ACTUATED: WeakValueDictionary[_Actuated, Limb] = WeakValueDictionary()


class Shared:
    """Values for several graphs of one thread.

    Methods that are rules are named after the quantity that they compute.
    """

    def __init__(self) -> None:
        self._remembered = EngineMemory()
        self._surfaces = Memory[SurfaceOperator](SURFACES_BYTES, _bytes_of)

    def rules(self) -> tuple[Callable[..., Any], ...]:
        """Return the methods that are rules."""
        return self.remembered, self.limb_data, self.driven_limb, self.surface

    def remembered(self) -> EngineMemory:
        """What rendering remembers."""
        return self._remembered

    def limb_data(self, limb: str, limb_digest: str, limb_mirrored: bool) -> Limb:
        """The limb, with its responses read when touched."""
        # A limb that no graph holds is opened anew: its name may mean other data by then.  The
        # facts say whether it is mirrored; the argument has this rule run again.
        key = user_folder(), facts_of(limb), limb_digest
        loaded = _LIMBS.get(key)
        if loaded is None:
            loaded = _LIMBS[key] = load_limb(limb, limb_digest)
        return loaded

    def driven_limb(self, limb_data: Limb, actuation: Actuation | None, scaling: Scaling) -> Limb:
        """The limb as drives meet it: through the actuators, where there are any."""
        if actuation is None:
            return limb_data
        key = ref(limb_data), actuation, scaling
        actuated = _ACTUATED.get(key)
        if actuated is None:
            actuated = _ACTUATED[key] = actuated_limb(limb_data, actuation, scaling)
        return actuated

    def surface(self, limb_data: Limb, stop: Stop) -> SurfaceOperator:
        """Operator from outputs to the pixels of the map."""
        return self._surfaces.get(
            ref(limb_data), lambda: cached_surface_operator(limb_data, stop=stop)
        )


def _bytes_of(operator: SurfaceOperator) -> int:
    weights = operator.weights
    return weights.data.nbytes + weights.indices.nbytes + weights.indptr.nbytes
