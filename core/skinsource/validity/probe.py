"""How fast a probe moves whose acceleration is known."""

from collections.abc import Iterable

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.arguments import finite_array, positive_number
from skinsource.limb import BAND_HZ, Band, Limb
from skinsource.scaling.response_scaling import Scaling

# What is slower than the band is faded out over an octave, which rings for so many periods.
_RINGS_PERIODS = 10.0
# Even where a band begins lower still: a velocity from there on would need minutes of room.
_LEAST_HZ = 1.0


def are_probe_accelerations(limb: Limb, scaling: Scaling, *, actuated: bool) -> bool:
    """Whether drives are accelerations of a probe, m/s².

    Not where actuators move in its place, nor where a lab's own responses answer a drive: nobody
    says in which unit that was.
    """
    return scaling == "probe" and not actuated and not limb.per_unit_drive


def probe_velocity(
    acceleration: ArrayLike, sample_rate_hz: float, lowest_hz: float = BAND_HZ[0]
) -> float:
    """Return the largest velocity of a probe, m/s, from its acceleration.

    By division of the spectrum; what is slower than the measured band is faded out over the octave
    below it (a raised cosine, from 12.5 to 25 Hz of the published limbs), because it would drift.

    Parameters
    ----------
    acceleration : (n_times,)
        m/s², silent before and after.
    sample_rate_hz
        Its rate.
    lowest_hz
        Where the measured band begins.
    """
    data = finite_array("acceleration", acceleration, "(n_times,)")
    rate = positive_number("sample_rate_hz", sample_rate_hz)
    if data.ndim != 1 or not data.any():
        return 0.0
    room = round(_RINGS_PERIODS / lowest_hz * rate)
    n_fft = scipy.fft.next_fast_len(data.size + room, real=True)
    frequency_hz = np.arange(n_fft // 2 + 1) * (rate / n_fft)
    part = np.clip(2.0 * frequency_hz / lowest_hz - 1.0, 0.0, 1.0)
    weight = 0.5 - 0.5 * np.cos(np.pi * part)
    divisor = np.where(weight > 0.0, 2.0 * np.pi * frequency_hz, 1.0)
    spectrum = scipy.fft.rfft(data, n_fft) * (weight / (1j * divisor))
    return float(np.abs(scipy.fft.irfft(spectrum, n_fft)).max())


def fastest_probe(
    drives: Iterable[ArrayLike], sample_rate_hz: float, band_hz: Band | None = BAND_HZ
) -> float:
    """Return the largest velocity of any of the probes that are driven so, m/s; 0: none is."""
    lowest_hz = lowest_hz_of(band_hz)
    return max((probe_velocity(one, sample_rate_hz, lowest_hz) for one in drives), default=0.0)


def lowest_hz_of(band_hz: Band | None) -> float:
    """Below it no velocity is told: accelerations were not measured there, or nobody says."""
    low_hz = 0.0 if band_hz is None else band_hz[0]
    return max(low_hz, _LEAST_HZ) if low_hz > 0.0 else BAND_HZ[0]
