"""The inverse of a response, as far as a boost may go."""

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, log2
from typing import ClassVar

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource import fields
from skinsource.actuators import Actuator
from skinsource.arguments import finite_array
from skinsource.arrays import Complexes, Floats
from skinsource.equalising.equaliser import Equaliser, largest_gain, target
from skinsource.fields import ChoiceSpec, NumberSpec
from skinsource.limb import BAND_HZ, Band

BOOST = NumberSpec(
    label="Boost",
    unit="dB",
    minimum=0.0,
    maximum=60.0,
    step=1.0,
    hint="How much more voltage than where it moves most the filter may ask for",
)
PHASE = ChoiceSpec(
    label="Phase",
    options=(("linear", "Linear"), ("minimum", "Minimum")),
    hint="Linear: nothing is delayed, and it begins to swing a little before; minimum: it does not",
)
# Grid on which the phase that belongs to a gain is found; what lies below the floor counts as it.
_LENGTH, _RATE_HZ, _FLOOR = 2**16, 48_000.0, 1e-5
# Its rate is so many times the end of the band at least; points lie no farther apart then.
_OF_BAND = 4.0


@dataclass(frozen=True, slots=True)
class RegularisedInverse(Equaliser):
    """W = T H* / (|H|² + beta max|H|²), beta such that |W| is at most the boost over 1 / max|H|.

    T is 1 in the band of the limb, 25 to 600 Hz of the published ones, H the response of the
    actuator, and max|H| its largest gain in that band.  |W| max|H| is largest, 1 / (2 sqrt(beta)),
    where |H| is sqrt(beta) max|H|.

    Attributes
    ----------
    boost_db
        0 to 60 dB.
    phase
        ``"linear"``: the filter undoes the phase of the actuator too, so that it moves as the
        drive says, nothing late, and rings a little before sharp starts; ``"minimum"``: the same
        gain with the least delay, nothing before a start.

    References
    ----------
    Kirkeby and Nelson, Digital filter design for inversion problems in sound reproduction,
    J. Audio Eng. Soc. 47(7/8), 1999.
    """

    title: ClassVar[str] = "Regularised inverse"

    boost_db: float = fields.number(20.0, BOOST)
    phase: str = fields.choice("linear", PHASE)

    def __post_init__(self) -> None:
        fields.check(self)

    def filter(
        self, actuator: Actuator, frequency_hz: ArrayLike, band_hz: Band = BAND_HZ
    ) -> Complexes:
        """Voltage for each m/s² of the drive, in V per m/s²."""
        wanted_hz = np.abs(finite_array("frequency_hz", frequency_hz, "frequencies in Hz"))
        if self.phase == "linear":
            return self._inverse(actuator, wanted_hz, band_hz)
        phase_hz, phase_rad = _least_phase(self, actuator, band_hz)
        angle = np.interp(wanted_hz, phase_hz, phase_rad)
        return np.abs(self._inverse(actuator, wanted_hz, band_hz)) * np.exp(1j * angle)

    def _inverse(self, actuator: Actuator, frequency_hz: Floats, band_hz: Band) -> Complexes:
        most = largest_gain(actuator, band_hz)
        # In parts of the largest gain, so that no square leaves the range of floats.
        response = actuator.response(frequency_hz) / most
        beta = 0.25 * 10.0 ** (-self.boost_db / 10.0)
        found = response.conj() / (np.abs(response) ** 2 + beta)
        return target(frequency_hz, band_hz) * found / most


@lru_cache(maxsize=16)
def _least_phase(
    equaliser: RegularisedInverse, actuator: Actuator, band_hz: Band
) -> tuple[Floats, Floats]:
    """Frequencies and the phase of the least delay that goes with the gain there."""
    higher = 2 ** max(ceil(log2(_OF_BAND * band_hz[1] / _RATE_HZ)), 0)
    length, rate_hz = higher * _LENGTH, higher * _RATE_HZ
    frequency_hz = np.arange(length // 2 + 1) * rate_hz / length
    gain = np.abs(equaliser._inverse(actuator, frequency_hz, band_hz))
    cepstrum = scipy.fft.irfft(np.log(np.maximum(gain, _FLOOR * gain.max())), length)
    cepstrum[1 : length // 2] *= 2.0
    cepstrum[length // 2 + 1 :] = 0.0
    return frequency_hz, scipy.fft.rfft(cepstrum).imag
