"""Statistics of signals: RMS, peak, crest factor, dominant frequency, delay, RMS in bands."""

from dataclasses import dataclass

import numpy as np

from skinsource.base.conventions import BAND_HZ, Band, Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.signals.analysis.wave_speed import vertex

#: A signal begins when it first reaches this share of its peak.
BEGUN_SHARE = 0.1
#: Width of the bins in which outputs are compared with inputs (SkinSource, 2024, Section V).
BIN_HZ = 2.0
_ROUNDING = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Statistics:
    """Statistics of signals; crest, frequency and delay of a silent one are NaN.

    Attributes
    ----------
    rms, peak : (n_signals,)
        Unit of the signals; the peak is that of the magnitude, between samples too.
    crest : (n_signals,)
        Peak over RMS.
    dominant_hz : (n_signals,)
        See `dominant_frequency`.
    delay_s : (n_signals,)
        See `onset_time`.
    """

    rms: Floats
    peak: Floats
    crest: Floats
    dominant_hz: Floats
    delay_s: Floats


def crest_factor(peak: Floats, rms: Floats) -> Floats:
    """Return peak over RMS, same shape; NaN where the RMS is 0."""
    return np.divide(peak, rms, out=np.full(peak.shape, np.nan), where=rms > 0.0)


def dominant_frequency(power: Floats, step_hz: float) -> Floats:
    """Return the frequency of the largest power, 0 Hz left out, in hertz.

    It is the largest bin, moved by the vertex of the parabola through the logarithms of it and its
    neighbours, which finds a smooth peak between bins within a small part of a bin.

    Parameters
    ----------
    power : (..., n_bins)
        Power by frequency, from 0 Hz on.
    step_hz
        Distance of the bins.

    Returns
    -------
    (...,), NaN where there is no power.

    Raises
    ------
    InvalidInputError
        There is no bin above 0 Hz.
    """
    if power.shape[-1] < 2:
        raise InvalidInputError(f"power has shape {power.shape}, expected two bins or more")
    rows = power.reshape(-1, power.shape[-1])
    largest = 1 + np.argmax(rows[:, 1:], axis=-1)
    bins = np.where(rows[:, 1:].max(axis=-1, initial=0.0) > 0.0, largest.astype(np.float64), np.nan)
    for row, k in enumerate(largest):
        neighbours = rows[row, k - 1 : k + 2]
        # The bin at 0 Hz, the mean, is no neighbour.
        if k > 1 and neighbours.size == 3 and neighbours.min() > 0.0:
            bins[row] += vertex(np.log(neighbours))
    return (bins * step_hz).reshape(power.shape[:-1])


def onset_time(signals: Floats, time_s: Floats) -> Floats:
    """Return when each signal first reaches a tenth of its peak, either sign, in seconds.

    The magnitude is interpolated linearly between samples.

    Parameters
    ----------
    signals : (..., n_times)
        Any unit.
    time_s : (n_times,)
        Rising.

    Returns
    -------
    (...,), NaN for silence.
    """
    onset_s = np.full(signals.shape[:-1], np.nan)
    for index in np.ndindex(signals.shape[:-1]):
        # Signals are long: one by one they need less memory.
        size = np.abs(signals[index])
        least = BEGUN_SHARE * size.max()
        if least > 0.0:
            k = int(np.argmax(size >= least))
            onset_s[index] = time_s[k]
            if k:
                before, here = size[k - 1], size[k]
                back = (here - least) / (here - before)
                onset_s[index] -= back * (time_s[k] - time_s[k - 1])
    return onset_s


def band_rms(
    transforms: Complexes, n_times: int, sample_rate_hz: float, band_hz: Band | None = BAND_HZ
) -> tuple[Floats, Floats]:
    """Return the RMS of signals in each bin of 2 Hz, over their whole duration.

    Parameters
    ----------
    transforms : (..., n_times // 2 + 1)
        Of real signals of ``n_times`` samples.
    n_times, sample_rate_hz
        Number and rate of the samples.
    band_hz
        Band that is divided into whole bins; None: from 0 to half the rate.

    Returns
    -------
    frequency_hz : (n_bins,)
        Middles of the bins that hold a frequency of the transforms.
    rms : (..., n_bins)
        In the unit of the signals: the squares add up to that of the whole band.
    """
    power = np.square(np.abs(transforms / n_times))
    # Each frequency counts for its mirror image too, except 0 and half the rate.
    power[..., 1 : (n_times + 1) // 2] *= 2.0
    frequency_hz = np.arange(power.shape[-1]) * (sample_rate_hz / n_times)
    low_hz, high_hz = band_hz or (0.0, sample_rate_hz / 2.0)
    # Rounding must not move a frequency at an edge into the bin below.
    bins = np.floor((frequency_hz - low_hz) / BIN_HZ + _ROUNDING).astype(int)
    inside = (bins >= 0) & (bins < np.floor((high_hz - low_hz) / BIN_HZ + _ROUNDING))
    numbers, first = np.unique(bins[inside], return_index=True)
    energy = np.add.reduceat(power[..., inside], first, axis=-1)
    return low_hz + (numbers + 0.5) * BIN_HZ, np.sqrt(energy)
