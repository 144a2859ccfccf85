"""From a drive in m/s² to the voltage that makes it."""

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.actuators import Actuator
from skinsource.arguments import finite_array, positive_number, real_number
from skinsource.arrays import Floats
from skinsource.equalising.band import followed_band
from skinsource.equalising.equaliser import Equaliser
from skinsource.equalising.velocity_of_drive import net_velocity
from skinsource.errors import InvalidInputError
from skinsource.limb import BAND_HZ, Band
from skinsource.resampling import PASSED_SHARE

# What a filter rings for before and after, at most.
_RINGING_S = 0.5


def equalised(
    drive: ArrayLike,
    sample_rate_hz: float,
    actuator: Actuator,
    equaliser: Equaliser,
    *,
    band_hz: Band | None = BAND_HZ,
    lead_s: float = 0.0,
    tail_s: float = 0.0,
) -> Floats:
    """Voltage that makes an actuator accelerate as a drive says.

    Parameters
    ----------
    drive : (n_times,) or (n_channels, n_times)
        Acceleration of the contactor in m/s²; silent before and after.
    sample_rate_hz
        High enough for the band: 1300 Hz at least for one that ends at 600 Hz.
    actuator, equaliser
        What is driven, and the filter that is made for it.
    band_hz
        In which the limb was measured, so that the drive is followed there; None: not known, and
        it is followed from 25 Hz to 12/13 of half the rate.
    lead_s, tail_s
        Time that is kept before the first sample and after the last, 0 to 0.5 s, where a filter
        rings; without it that is cut off.

    Returns
    -------
    (..., lead + n_times + tail), in V.

    Raises
    ------
    InvalidInputError
        A drive leaves a velocity, so that nothing can follow it; the reason is said.
    """
    rows = finite_array("drive", drive, "finite numbers in m/s², (n_times,)")
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    band = followed_band(None, rate_hz) if band_hz is None else band_hz
    _refuse_slower(rate_hz, band)
    kept = [
        int(rate_hz * real_number(name, value, "0 to 0.5 s", least=0.0, most=_RINGING_S))
        for name, value in (("lead_s", lead_s), ("tail_s", tail_s))
    ]
    if rows.ndim not in (1, 2):
        raise InvalidInputError(
            f"drive has the shape {rows.shape}, expected (n_times,) or (n_channels, n_times)"
        )
    for place, row in enumerate(np.atleast_2d(rows)):
        found = net_velocity(row, rate_hz, band[0])
        if not found.returns:
            where = f"channel {place}: " if rows.ndim == 2 else ""
            raise InvalidInputError(f"{where}{found.reason}")
    n, silence = rows.shape[-1], int(_RINGING_S * rate_hz)
    length = scipy.fft.next_fast_len(n + 2 * silence, real=True)
    frequency_hz = np.arange(length // 2 + 1) * rate_hz / length
    spectrum = scipy.fft.rfft(rows, length) * equaliser.filter(actuator, frequency_hz, band)
    around = np.roll(scipy.fft.irfft(spectrum, length), kept[0], axis=-1)
    voltage: Floats = around[..., : kept[0] + n + kept[1]]
    return voltage


def _refuse_slower(rate_hz: float, band_hz: Band) -> None:
    # 1300 Hz for 600 Hz.
    least_hz = 2.0 / PASSED_SHARE * band_hz[1]
    if rate_hz < least_hz * (1.0 - 1e-9):
        raise InvalidInputError(
            f"sample_rate_hz is {rate_hz:g}, expected at least {least_hz:g} Hz for a band that "
            f"ends at {band_hz[1]:g} Hz. Resample the drive, or end the band lower."
        )
