"""Scaling: what an input of amplitude 1 means, and responses per unit of probe acceleration."""

from typing import Literal, get_args

import numpy as np
import scipy

from skinsource.base.arguments import one_of
from skinsource.base.conventions import Floats

#: Mean peak of the probe's acceleration during the measuring pulse, m/s² (SkinSource, 2024).
PULSE_PEAK_M_PER_S2 = 22.9
#: Full width at half maximum of the pulse, a rectangle in the ideal (SkinSource, 2024).
PULSE_WIDTH_S = 1e-3

_REGULARISATION = 1e-6


def per_probe_acceleration(response: Floats, sample_rate_hz: float) -> Floats:
    """Turn pulse responses into responses per m/s² of probe acceleration.

    The published responses answer a rectangular pulse of the probe, 1 ms wide and 22.9 m/s² high
    on average, low-passed at 600 Hz.  Divided by the pulse's spectrum they answer any probe
    acceleration.  The division is regularised; the measured probe signals are not public, so the
    result is uncertain by about 3 dB.

    Parameters
    ----------
    response : (..., n_taps)
        Responses to the measuring pulse, m/s².
    sample_rate_hz
        Their sample rate.

    Returns
    -------
    (..., n_taps), (m/s²) per (m/s²): a convolution with sampled probe acceleration gives m/s².
    """
    n_taps = response.shape[-1]
    # The inverse pulse has a short tail on both sides; room for it keeps it from wrapping round.
    n_fft = scipy.fft.next_fast_len(2 * n_taps, real=True)
    pulse = pulse_spectrum(np.arange(n_fft // 2 + 1) * sample_rate_hz / n_fft, sample_rate_hz)
    inverse = pulse / (pulse**2 + _REGULARISATION * pulse[0] ** 2)
    padded = scipy.fft.irfft(scipy.fft.rfft(response, n_fft) * inverse, n_fft)
    # A view would keep the padding, too, for as long as somebody keeps the responses.
    return padded[..., :n_taps].copy()


def pulse_spectrum(frequency_hz: Floats, sample_rate_hz: float) -> Floats:
    """Return the sum of the samples of the measuring pulse at frequencies, m/s²; it is real."""
    area = PULSE_PEAK_M_PER_S2 * PULSE_WIDTH_S * sample_rate_hz
    return area * np.sinc(frequency_hz * PULSE_WIDTH_S)


Scaling = Literal["upstream", "relative", "probe"]
SCALINGS: tuple[Scaling, ...] = get_args(Scaling)


def check_scaling(scaling: str) -> None:
    """Raise `InvalidInputError` unless ``scaling`` is one of `SCALINGS`."""
    one_of("scaling", scaling, SCALINGS)
