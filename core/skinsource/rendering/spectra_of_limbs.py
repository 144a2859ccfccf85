"""Spectra of the responses of limbs that scripts use, in bounded memory, for all threads.

They are kept as the transform gives them: whoever predicts once pays for nothing else.
"""

from collections import OrderedDict
from collections.abc import Sequence
from threading import Lock
from weakref import WeakKeyDictionary

from skinsource.limb import Limb
from skinsource.rendering.budgets import PREDICT_BYTES
from skinsource.rendering.response_spectra import ResponseSpectrum, scaled_taps
from skinsource.rendering.side_by_side import side_by_side
from skinsource.rendering.transforms import forward
from skinsource.scaling.response_scaling import Scaling

# Place, length, and whether calibrated.
_Key = tuple[int, int, bool]
_Spectra = OrderedDict[_Key, ResponseSpectrum]


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
        # The latest last, limbs and spectra.
        self._known: WeakKeyDictionary[Limb, _Spectra] = WeakKeyDictionary()

    @property
    def held_bytes(self) -> int:
        """What the spectra take in memory."""
        with self._lock:
            return self._sum()

    def of(
        self,
        limb: Limb,
        places: Sequence[int],
        scaling: Scaling,
        n_fft: int,
        *,
        bounded: bool = False,
    ) -> list[ResponseSpectrum]:
        """Responses to each of ``places``, transformed where they are not remembered.

        ``bounded``: what bounds of samples need is wanted too.
        """
        calibrated = scaling == "probe"
        with self._lock:
            spectra = self._known.pop(limb, None)
            self._known[limb] = spectra = OrderedDict() if spectra is None else spectra
            made = []
            for place in dict.fromkeys(places):
                key = place, n_fft, calibrated
                if key not in spectra:
                    taps = scaled_taps(limb, place, scaling)
                    spectra[key] = ResponseSpectrum(taps, forward(taps, n_fft), n_fft)
                    made.append(spectra[key])
                spectra.move_to_end(key)
            if bounded:
                _prepare_bounds(made)
            found = [spectra[place, n_fft, calibrated] for place in places]
            self._forget()
            return found

    def _forget(self) -> None:
        excess = self._sum() - self._budget_bytes
        for spectra in list(self._known.values()):
            while spectra and excess > 0:
                _, oldest = spectra.popitem(last=False)
                excess -= oldest.values.nbytes

    def _sum(self) -> int:
        known = list(self._known.values())
        return sum(one.values.nbytes for spectra in known for one in spectra.values())


def _prepare_bounds(responses: list[ResponseSpectrum]) -> None:
    def prepare(some: list[ResponseSpectrum]) -> None:
        for response in some:
            response.prepare_bounds()

    if len(responses) > 1:
        half = len(responses) // 2
        side_by_side(lambda: prepare(responses[:half]), lambda: prepare(responses[half:]))
