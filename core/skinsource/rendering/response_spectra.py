"""Spectra of impulse responses, by place and length, in bounded memory."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skinsource.calibration import per_probe_acceleration
from skinsource.errors import InvalidInputError
from skinsource.limb import Limb
from skinsource.rendering.drives import LARGEST, first_unusable
from skinsource.rendering.memory import Memory
from skinsource.rendering.transforms import Complexes, Floats, forward
from skinsource.response_scaling import Scaling

#: Responses of twenty places for stimuli of one to two seconds.
BUDGET_BYTES = 192 * 2**20


@dataclass(frozen=True, eq=False)
class ResponseSpectrum:
    """Responses to one place, in time and in frequency.

    Attributes
    ----------
    taps : (72 outputs, 3 axes, 522)
        m/s².
    values : (72 outputs, 3 axes, n_fft // 2 + 1)
        Their spectra.
    """

    taps: Floats
    values: Complexes
    n_fft: int

    @cached_property
    def weighted_magnitudes(self) -> NDArray[np.float32]:
        """Magnitudes over n_fft, doubled but for the ends, (216, n_bins): sums bound samples.

        Half the precision is enough for a bound, and twice as fast to read.
        """
        flat = self.values.reshape(-1, self.values.shape[-1])
        magnitudes = np.sqrt(np.square(flat.real) + np.square(flat.imag))
        magnitudes *= 2.0 / self.n_fft
        magnitudes[:, [0, -1]] *= 0.5
        return magnitudes.astype(np.float32)

    @cached_property
    def energies(self) -> Floats:
        """Root of the sum of squares of each response, (216,)."""
        return np.linalg.norm(self.taps.reshape(-1, self.taps.shape[-1]), axis=-1)

    @cached_property
    def absolute_sums(self) -> Floats:
        """Sum of magnitudes of each response, (216,)."""
        return np.abs(self.taps.reshape(-1, self.taps.shape[-1])).sum(axis=-1)


class ResponseSpectra:
    """Spectra by limb, place, scaling and length."""

    def __init__(self, budget_bytes: int = BUDGET_BYTES) -> None:
        # The magnitudes, made when first needed, are a quarter as large as the values.
        self._memory = Memory[ResponseSpectrum](
            budget_bytes, lambda one: one.values.nbytes * 5 // 4
        )

    @property
    def held_bytes(self) -> int:
        """What the spectra take in memory."""
        return self._memory.held_bytes

    def of(self, limb: Limb, location: int, scaling: Scaling, n_fft: int) -> ResponseSpectrum:
        """Responses to ``location``; under ``"probe"`` scaling the calibrated ones."""

        def compute() -> ResponseSpectrum:
            taps = _usable(limb, location)
            if scaling == "probe":
                taps = per_probe_acceleration(taps, limb.sample_rate_hz)
            return ResponseSpectrum(taps, forward(taps, n_fft), n_fft)

        # A limb is the object, not the name: after a reinstall the name means other data.
        return self._memory.get((limb, location, scaling == "probe", n_fft), compute)


def _usable(limb: Limb, location: int) -> Floats:
    """Responses to ``location``, refused where a tap is not a usable number."""
    taps = limb.response_to(location)
    bad = first_unusable(taps)
    if bad is not None:
        output, axis, tap = bad
        raise InvalidInputError(
            f"{limb.name}: in the response to input location {location}, output {output + 1}, axis "
            f"{'xyz'[axis]}, tap {tap} is {taps[bad]}, expected a finite number of at most "
            f"{LARGEST:g}. Install or load the limb again."
        )
    return taps
