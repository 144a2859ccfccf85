"""What an equaliser changes, over frequency."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators import Actuator
from skinsource.arguments import finite_array
from skinsource.arrays import Floats
from skinsource.decibels import decibels
from skinsource.equalising.equaliser import Equaliser, mean_gain
from skinsource.limb import BAND_HZ, Band


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EqualiserCurves:
    """Gains in dB, (n,) each.

    Attributes
    ----------
    frequency_hz
        Of the points.
    before_db
        Acceleration for each volt, re its geometric mean in the band.
    filter_db
        Voltage for each m/s² of the drive, re the voltage that the mean needs.
    after_db
        Acceleration over the drive.
    """

    frequency_hz: Floats
    before_db: Floats
    filter_db: Floats
    after_db: Floats


def curves(
    equaliser: Equaliser, actuator: Actuator, frequency_hz: ArrayLike, band_hz: Band = BAND_HZ
) -> EqualiserCurves:
    """Gains before, of, and after the filter for a band, at frequencies above 0, (n,)."""
    found_hz = finite_array("frequency_hz", frequency_hz, "frequencies in Hz, (n,)")
    mean = mean_gain(actuator, band_hz)
    response = actuator.response(found_hz)
    passed = equaliser.filter(actuator, found_hz, band_hz)
    return EqualiserCurves(
        frequency_hz=found_hz,
        before_db=decibels(np.abs(response) / mean),
        filter_db=decibels(np.abs(passed) * mean),
        after_db=decibels(np.abs(response * passed)),
    )
