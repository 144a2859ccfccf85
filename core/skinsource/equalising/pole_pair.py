"""Another resonance in place of that of the actuator."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from skinsource import fields
from skinsource.actuators import Actuator, VoiceCoil
from skinsource.arguments import finite_array
from skinsource.arrays import Complexes, Floats
from skinsource.equalising.equaliser import Equaliser, gain_in_band, in_band_hz, mean_of
from skinsource.fields import NumberSpec
from skinsource.limb import BAND_HZ, Band

RESONANCE = NumberSpec(
    label="Resonance",
    unit="Hz",
    minimum=1.0,
    maximum=2000.0,
    step=0.01,
    logarithmic=True,
    hint="That of the actuator, which is taken out",
)
QUALITY = NumberSpec(
    label="Quality",
    minimum=0.3,
    maximum=10_000.0,
    step=0.02,
    logarithmic=True,
    hint="That of the actuator",
)
NEW_QUALITY = NumberSpec(
    label="New quality",
    minimum=0.3,
    maximum=10.0,
    step=0.02,
    logarithmic=True,
    hint="What takes its place; 0.7 rings no longer than it must",
)


@dataclass(frozen=True, slots=True)
class PolePairReplacement(Equaliser):
    """(s² + s w / Q + w²) / (s² + s w / Q' + w²): a resonance is taken out, a damped one put in.

    All else of the actuator stays as it is: below its resonance it still moves little.  One
    factor makes the geometric mean of the gain in the band that of the drive.

    Attributes
    ----------
    resonance_hz, quality
        w / 2 pi, 1 to 2000 Hz, and Q, 0.3 to 10 000, as of the actuator (`resonance_of` tells).
    new_quality
        Q', 0.3 to 10.
    """

    title: ClassVar[str] = "Pole-pair replacement"

    resonance_hz: float = fields.number(170.0, RESONANCE)
    quality: float = fields.number(10.0, QUALITY)
    new_quality: float = fields.number(0.7, NEW_QUALITY)

    def __post_init__(self) -> None:
        fields.check(self)

    def filter(
        self, actuator: Actuator, frequency_hz: ArrayLike, band_hz: Band = BAND_HZ
    ) -> Complexes:
        """Voltage for each m/s² of the drive, in V per m/s²."""
        wanted_hz = finite_array("frequency_hz", frequency_hz, "frequencies in Hz")
        gain = gain_in_band(actuator, band_hz) * np.abs(self._replaced(in_band_hz(band_hz)))
        return self._replaced(wanted_hz) / mean_of(gain)

    def _replaced(self, frequency_hz: Floats) -> Complexes:
        ratio = frequency_hz / self.resonance_hz
        still = 1.0 - ratio**2
        found = (still + 1j * ratio / self.quality) / (still + 1j * ratio / self.new_quality)
        return found.astype(np.complex128)


def resonance_of(actuator: Actuator) -> tuple[float, float]:
    """Resonance of an actuator, in Hz, and its quality, as `PolePairReplacement` takes them.

    Of a voice coil they follow from its parameters: sqrt(k / m) / 2 pi and
    sqrt(k m) / (c + Bl² / R).  Of others the response tells: displacement, acceleration over the
    square of the frequency, lags by a quarter of a turn at the resonance, and its phase passes
    there with a slope of 2 Q over the logarithm of the frequency.
    """
    if isinstance(actuator, VoiceCoil):
        stiffness = actuator.stiffness_n_per_m + actuator.skin_stiffness_n_per_m
        damping = actuator.damping_n_s_per_m + actuator.skin_damping_n_s_per_m
        resonance_hz = np.sqrt(stiffness / actuator.moving_mass_kg) / (2.0 * np.pi)
        with np.errstate(all="ignore"):
            damping += np.square(actuator.force_factor_n_per_a) / actuator.resistance_ohm
            quality = np.sqrt(stiffness * actuator.moving_mass_kg) / damping
    else:
        resonance_hz, quality = _shown_by(actuator)
    return _within(RESONANCE, resonance_hz), _within(QUALITY, np.nan_to_num(quality))


def _within(spec: NumberSpec, value: float) -> float:
    return float(np.clip(value, spec.minimum, spec.maximum))


def _shown_by(actuator: Actuator) -> tuple[float, float]:
    frequency_hz = np.geomspace(5.0, 2000.0, 20_001)
    phase_rad = np.unwrap(np.angle(-actuator.response(frequency_hz)))
    late = phase_rad - phase_rad[0] + 0.5 * np.pi
    found = int(np.argmax(late <= 0.0)) if (late <= 0.0).any() else int(np.abs(late).argmin())
    place = min(max(found, 1), frequency_hz.size - 2)
    step = np.log(frequency_hz[place + 1] / frequency_hz[place - 1])
    slope = (phase_rad[place + 1] - phase_rad[place - 1]) / step
    return float(frequency_hz[place]), float(-0.5 * slope)
