"""What accelerations do between two times: peak, RMS, velocity and displacement."""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.base.conventions import Floats
from skinsource.signals.resampling import peaks_between

# The fade below the band, over an octave, rings for so many periods of the band's lower end.
_RINGS_PERIODS = 10.0


def integrated(
    acceleration: Floats, sample_rate_hz: float, lowest_hz: float, times: int = 1
) -> Floats:
    """Return velocities (once) or displacements (twice) of accelerations, by their spectra.

    What is slower than ``lowest_hz`` is faded out over the octave below it (a raised cosine),
    because it would drift.

    Parameters
    ----------
    acceleration : (..., n_times)
        m/s², silent before and after.
    sample_rate_hz, lowest_hz
        Their rate; where the measured band begins.
    times
        1: m/s; 2: m.

    Returns
    -------
    integral : (..., n_times + n_rest)
        The fade rings on after the last sample.

    Examples
    --------
    >>> import skinsource as ss
    >>> velocity = integrated(ss.sinusoid(130.0, duration_s=1.0), 1300.0, 25.0)
    >>> print(f"{1e3 * velocity[650:780].max():.2f} mm/s")
    1.22 mm/s
    """
    room = round(_RINGS_PERIODS / lowest_hz * sample_rate_hz)
    n_fft = scipy.fft.next_fast_len(acceleration.shape[-1] + room, real=True)
    frequency_hz = np.arange(n_fft // 2 + 1) * (sample_rate_hz / n_fft)
    part = np.clip(2.0 * frequency_hz / lowest_hz - 1.0, 0.0, 1.0)
    weight = 0.5 - 0.5 * np.cos(np.pi * part)
    divisor = np.where(weight > 0.0, 2.0 * np.pi * frequency_hz, 1.0)
    spectra = scipy.fft.rfft(acceleration, n_fft) * (weight / (1j * divisor) ** times)
    return scipy.fft.irfft(spectra, n_fft)


@dataclass(frozen=True, slots=True, eq=False)
class Interval:
    """What accelerations do between two times.

    Attributes
    ----------
    peak, rms : (n_signals,)
        m/s².
    velocity, displacement : (n_signals,)
        Their peaks, m/s and m.
    """

    peak: Floats
    rms: Floats
    velocity: Floats
    displacement: Floats


def interval_of(
    acceleration: Floats,
    time_s: Floats,
    between_s: tuple[float, float],
    lowest_hz: float,
    waves: Floats | None = None,
) -> Interval:
    """Return what accelerations do from one time to another; peaks are those between samples too.

    Parameters
    ----------
    acceleration : (n_signals, n_times)
        m/s².
    time_s : (n_times,)
        Rising in equal steps.
    between_s
        First time, and that before which the samples end; at least one sample is taken.
    lowest_hz
        Velocity and displacement have nothing slower, see `integrated`.
    waves : (n_signals, n_axes, n_times), optional
        The axes of magnitudes, m/s²: magnitudes themselves have no values between samples, and no
        integral.
    """
    first, last = np.searchsorted(time_s, between_s)
    first = min(first, time_s.size - 1)
    last = max(last, first)
    ends = first, max(last, first + 1)
    rate = (time_s.size - 1) / (time_s[-1] - time_s[0])
    # The length of a velocity is no integral of the length of an acceleration.
    moving = acceleration if waves is None else waves
    velocity, displacement = (
        peaks_between(integrated(moving, rate, lowest_hz, times), *ends) for times in (1, 2)
    )
    samples = acceleration[:, slice(*ends)]
    return Interval(
        peak=peaks_between(moving, *ends),
        rms=np.sqrt(np.mean(np.square(samples), axis=-1)),
        velocity=velocity,
        displacement=displacement,
    )
