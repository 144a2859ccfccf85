"""How far the vibrations of a sweep reach."""

from collections.abc import Sequence

import numpy as np

from skinsource.analysis.extent import distances_mm, spread
from skinsource.arrays import Floats
from skinsource.limb import Limb
from skinsource.sweeps.prepared import Prepared

OF_EXTENT = (
    "mean_distance_mm",
    "d90_mm",
    "share_above_12_db",
    "share_above_20_db",
    "participation",
)
# Sets of places whose distances are remembered.
_MOST = 1000
_Key = tuple[str, tuple[int, ...]]


class Extents:
    """Says how far vibrations reach; remembers where places lie."""

    def __init__(self) -> None:
        self._known: dict[_Key, Floats] = {}

    def of(
        self, rms: Sequence[Floats], stimuli: Sequence[Prepared | None]
    ) -> list[dict[str, float]]:
        """What `skinsource.extent` says, by name, of each stimulus; NaN where there is none.

        Parameters
        ----------
        rms : (n_outputs,) each
            Of the outputs.
        """
        found = [dict.fromkeys(OF_EXTENT, np.nan) for _ in stimuli]
        alike: dict[_Key, list[int]] = {}
        for which, one in enumerate(stimuli):
            if one is None:
                continue
            key = one.limb.name, tuple(dict.fromkeys(each.voice.location for each in one.moving))
            distance_mm = self._distances_mm(one.limb, key)
            if rms[which][np.isfinite(distance_mm)].any():
                alike.setdefault(key, []).append(which)
        for key, numbers in alike.items():
            made = spread(np.array([rms[which] for which in numbers]), self._known[key])
            for row, which in enumerate(numbers):
                found[which] = {name: float(made[name][row]) for name in OF_EXTENT}
        return found

    def _distances_mm(self, limb: Limb, key: _Key) -> Floats:
        """Distance of each output from the nearest place, mm; NaN where nothing plays."""
        if key not in self._known:
            if len(self._known) >= _MOST:
                self._known.clear()
            places = key[1]
            self._known[key] = (
                distances_mm(limb, places) if places else np.full(limb.n_outputs, np.nan)
            )
        return self._known[key]
