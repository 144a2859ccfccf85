"""Spectra of the responses of limbs that scripts use, in bounded memory, for all threads."""

from collections import OrderedDict
from collections.abc import Sequence
from functools import partial
from math import prod
from threading import Lock
from weakref import WeakKeyDictionary

from skinsource.arrays import Complexes, Floats
from skinsource.limb import Limb
from skinsource.prediction.second_thread import helped
from skinsource.rendering.budgets import PREDICT_BYTES
from skinsource.rendering.large_pages import room_for
from skinsource.rendering.response_spectra import Norms, ResponseSpectrum, scaled_taps
from skinsource.rendering.sums import OUTPUTS_AT_ONCE
from skinsource.rendering.transforms import forward_in_parts
from skinsource.scaling.response_scaling import Scaling
from skinsource.work import tally


class _Places:
    """Spectra at one length, in one piece of memory for so many places."""

    def __init__(self, limb: Limb, n_fft: int, most_places: int) -> None:
        self.n_fft = n_fft
        self._shape = limb.n_outputs, limb.n_axes, n_fft // 2 + 1
        self._values = room_for((most_places, *self._shape))
        self.known: dict[int, ResponseSpectrum] = {}

    @property
    def held_bytes(self) -> int:
        return len(self.known) * 16 * prod(self._shape)

    def add(self, taps: dict[int, Floats]) -> dict[int, ResponseSpectrum]:
        """Transform responses by place; they are remembered as far as there is room."""
        first = len(self.known)
        rooms = list(self._values[first : first + len(taps)])
        rooms += [room_for(self._shape) for _ in range(len(taps) - len(rooms))]
        pairs = zip(taps.values(), rooms, strict=True)
        found = helped([partial(_response, *pair, self.n_fft) for pair in pairs])
        tally(forward_transforms=len(taps) * prod(self._shape[:2]))
        made = dict(zip(taps, found, strict=True))
        self.known |= dict(list(made.items())[: len(self._values) - first])
        return made


def _response(taps: Floats, values: Complexes, n_fft: int) -> ResponseSpectrum:
    # Some outputs at a time: their spectra stay in a core's own cache.
    for part, spectra in forward_in_parts(taps, n_fft, OUTPUTS_AT_ONCE):
        values[part] = spectra
    return ResponseSpectrum(taps, values, n_fft, Norms.of(taps))


# Far more than are asked for in turn.
_MOST_ASKED = 10_000
# Length, and whether calibrated.
_Key = tuple[int, bool]
_Lengths = OrderedDict[_Key, _Places]


class SpectraOfLimbs:
    """What is remembered of a limb goes with it; of the rest, the least recently used goes first.

    Parameters
    ----------
    budget_bytes
        What all spectra together may take.
    """

    def __init__(self, budget_bytes: int = PREDICT_BYTES) -> None:
        self._budget_bytes = budget_bytes
        self._lock = Lock()
        # The latest last, limbs and lengths.
        self._known: WeakKeyDictionary[Limb, _Lengths] = WeakKeyDictionary()
        self._asked: WeakKeyDictionary[Limb, set[tuple[int, _Key]]] = WeakKeyDictionary()

    @property
    def held_bytes(self) -> int:
        """What the spectra take in memory."""
        with self._lock:
            return self._sum()

    def of(
        self, limb: Limb, places: Sequence[int], scaling: Scaling, n_fft: int
    ) -> list[ResponseSpectrum]:
        """Responses to each of ``places``, transformed where they are not remembered."""
        key = n_fft, scaling == "probe"
        with self._lock:
            lengths = self._known.pop(limb, None)
            self._known[limb] = lengths = OrderedDict() if lengths is None else lengths
            if key not in lengths:
                lengths[key] = _Places(limb, n_fft, self._most_places(limb, n_fft))
            lengths.move_to_end(key)
            known = lengths[key].known
            new = [place for place in dict.fromkeys(places) if place not in known]
            taps = {place: scaled_taps(limb, place, scaling) for place in new}
            made = lengths[key].add(taps) if new else {}
            self._forget()
            return [made[place] if place in made else known[place] for place in places]

    def of_one(
        self, limb: Limb, place: int, scaling: Scaling, n_fft: int
    ) -> ResponseSpectrum | None:
        """Responses to ``place``; None where they are asked for the first time.

        Whoever predicts once does not pay for what is kept.
        """
        with self._lock:
            asked = self._asked.setdefault(limb, set())
            key = n_fft, scaling == "probe"
            lengths = self._known.get(limb)
            held = lengths is not None and key in lengths and place in lengths[key].known
            if not held and (place, key) not in asked:
                if len(asked) >= _MOST_ASKED:
                    asked.clear()
                asked.add((place, key))
                return None
        return self.of(limb, [place], scaling, n_fft)[0]

    def _most_places(self, limb: Limb, n_fft: int) -> int:
        each = 16 * limb.n_outputs * limb.n_axes * (n_fft // 2 + 1)
        return min(limb.n_inputs, self._budget_bytes // each)

    def _forget(self) -> None:
        excess = self._sum() - self._budget_bytes
        for lengths in list(self._known.values()):
            while lengths and excess > 0:
                _, oldest = lengths.popitem(last=False)
                excess -= oldest.held_bytes

    def _sum(self) -> int:
        known = list(self._known.values())
        return sum(one.held_bytes for lengths in known for one in lengths.values())
