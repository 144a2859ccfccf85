"""Transfer functions from an input location to outputs, and where they are more than noise."""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.base.conventions import BAND_HZ, Band, Floats

#: Power is averaged over this width before it is compared with the noise.
AVERAGED_HZ = 25.0
#: Least coherence: where the response is twice the noise, it has three quarters of the power.
LEAST_COHERENCE = 0.75


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Transfer:
    """Magnitudes of transfer functions.

    Attributes
    ----------
    frequency_hz : (n_bins,)
        From 0 to half the rate.
    magnitude : (n_outputs, n_bins)
        Length of the vector of the axes.
    noise : (n_outputs, n_bins)
        RMS of noise alone; 0 where there is none.
    coherence : (n_outputs, n_bins)
        Share of the power around a frequency that is not noise, from 0 to 1.  A single response
        has no coherence of its own: it is estimated from the noise before the pulse.
    usable_hz : (n_outputs, 2)
        The widest part of the measured band with a coherence of 0.75 or more; NaN: none.
    band_hz
        The measured band; None: it is not known, and all frequencies count.
    """

    frequency_hz: Floats
    magnitude: Floats
    noise: Floats
    coherence: Floats
    usable_hz: Floats
    band_hz: Band | None = BAND_HZ


def transfer_function(
    response: Floats,
    sample_rate_hz: float,
    noise: Floats,
    gain: Floats | None = None,
    *,
    band_hz: Band | None = BAND_HZ,
) -> Transfer:
    """Return the transfer functions that responses are the inverse transforms of.

    Parameters
    ----------
    response : (n_outputs, n_axes, n_taps)
        Responses of the chosen axes.
    sample_rate_hz
        Their rate.
    noise : (n_outputs, n_axes)
        RMS of their noise, white, before any division by the pulse; see `noise_rms`.
    gain : (n_taps // 2 + 1,)
        Factors of the responses at each frequency; default: ones.
    band_hz
        Band in which they were measured; None: not known.
    """
    rate, n_taps = sample_rate_hz, response.shape[-1]
    frequency_hz = np.arange(n_taps // 2 + 1) * (rate / n_taps)
    factor = np.ones(frequency_hz.size) if gain is None else gain
    power = np.sum(np.square(np.abs(scipy.fft.rfft(response, axis=-1))), axis=1)
    # The transform of white noise has the same expected power at every frequency.
    floor = n_taps * np.square(noise).sum(axis=1)[:, None] * np.square(factor)
    width = max(round(AVERAGED_HZ * n_taps / rate), 1)
    around = scipy.ndimage.uniform_filter1d(power, width, axis=-1, mode="nearest")
    floor_around = scipy.ndimage.uniform_filter1d(floor, width, axis=-1, mode="nearest")
    share = np.divide(floor_around, around, out=np.ones_like(around), where=around > 0.0)
    coherence = np.clip(1.0 - share, 0.0, 1.0)
    return Transfer(
        frequency_hz=frequency_hz,
        magnitude=np.sqrt(power),
        noise=np.sqrt(floor),
        coherence=coherence,
        usable_hz=np.array(
            [_widest(frequency_hz, output, band_hz or (0.0, rate / 2.0)) for output in coherence]
        ).reshape(-1, 2),
        band_hz=band_hz,
    )


def _widest(frequency_hz: Floats, coherence: Floats, band_hz: Band) -> tuple[float, float]:
    """Return the ends of the longest run of usable bins inside a band."""
    inside = (frequency_hz >= band_hz[0]) & (frequency_hz <= band_hz[1])
    usable = np.concatenate([[False], inside & (coherence >= LEAST_COHERENCE), [False]])
    edges = np.flatnonzero(usable[1:] != usable[:-1])
    begins, ends = edges[::2], edges[1::2]
    if not begins.size:
        return np.nan, np.nan
    longest = int(np.argmax(ends - begins))
    return float(frequency_hz[begins[longest]]), float(frequency_hz[ends[longest] - 1])
