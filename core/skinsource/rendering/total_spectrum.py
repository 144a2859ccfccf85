"""The spectrum of all voices together, where it is asked for."""

from dataclasses import dataclass, replace

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.rendering.response_spectra import ResponseSpectrum


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TotalSpectrum:
    """Sum of what the other voices and the edited one cause, made row by row.

    Attributes
    ----------
    shape
        Outputs, axes, and bins.
    n_fft
        Length of the transforms.
    others : (n_outputs, n_axes, n_bins) or None
        Vibration by the other voices; None: none of them moves anything.
    response, drive, weight
        Responses to the place of the edited voice, the spectrum of its drive, (n_bins,), onset
        included, and what stands before it; None where there is no such voice.
    """

    shape: tuple[int, int, int]
    n_fft: int
    others: Complexes | None
    response: ResponseSpectrum | None
    drive: Complexes | None
    weight: float

    def times(self, weights: Floats) -> "TotalSpectrum":
        """The same through a filter, of which ``weights``, (n_bins,), is the response."""
        return replace(
            self,
            others=None if self.others is None else self.others * weights,
            drive=None if self.drive is None else self.drive * weights,
        )

    def rows(self, outputs: np.ndarray, axes: tuple[int, ...]) -> Complexes:
        """Spectra of some outputs, counted from 0, and axes, (n, n_axes, n_bins)."""
        rows = np.ix_(outputs, np.array(axes))
        if self.others is None:
            total = np.zeros((len(outputs), len(axes), self.shape[-1]), np.complex128)
        else:
            total = self.others[rows]
        if self.response is not None and self.drive is not None and self.weight != 0.0:
            total += self.response.values[rows] * self.drive * self.weight
        return total
