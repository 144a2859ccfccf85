"""Frequencies a tenth of an octave wide, over which spectra are added up."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from skinsource.arrays import Floats, Indices

_POINTS = 240
# A point takes in a twentieth of an octave to either side, and at least three frequencies.
_HALF_WIDTH = 2.0 ** (1.0 / 20.0)


@dataclass(frozen=True, slots=True, eq=False)
class Bands:
    """240 frequencies, evenly over their logarithm, and what is added up around each.

    Attributes
    ----------
    centre_hz, first, last : (n_bands,)
        The frequencies, and the first and last number of a spectrum that each takes in.
    """

    centre_hz: Floats
    first: Indices
    last: Indices

    @classmethod
    def between(cls, band_hz: tuple[float, float], step_hz: float, n: int) -> "Bands":
        """Bands of spectra of ``n`` frequencies that are ``step_hz`` apart."""
        centre_hz = np.geomspace(*band_hz, _POINTS)
        middle = np.rint(centre_hz / step_hz).astype(np.intp)
        first = np.ceil(centre_hz / _HALF_WIDTH / step_hz).astype(np.intp)
        last = np.floor(centre_hz * _HALF_WIDTH / step_hz).astype(np.intp)
        return cls(
            centre_hz,
            np.minimum(first, middle - 1).clip(1),
            np.maximum(last, middle + 1).clip(max=n - 1),
        )

    @property
    def counts(self) -> Floats:
        """How many frequencies each takes in, (n_bands,)."""
        found: Floats = (self.last + 1 - self.first).astype(np.float64)
        return found

    def sums(self, spectrum: Any) -> Any:
        """Sums of spectra, (..., n_frequencies), over each, (..., n_bands)."""
        rising = np.cumsum(spectrum, axis=-1)
        return rising[..., self.last] - rising[..., self.first - 1]
