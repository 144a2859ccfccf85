"""Dispersive surface waves in soft skin, and the short pulse that starts them."""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.arrays import Complexes, Floats

# Rayleigh waves in an incompressible half-space run at this share of the shear speed.
_RAYLEIGH_SHARE = 0.955
# The pulse is made at this multiple of the sample rate, so that filters stay causal.
_OVERSAMPLING = 20


@dataclass(frozen=True, slots=True, kw_only=True)
class Skin:
    """Fractional Voigt skin: shear modulus mu0 + mu1 (i w / w0)^a.

    Attributes
    ----------
    static_shear_modulus_pa, rising_shear_modulus_pa
        mu0 and mu1.
    exponent, reference_frequency_hz
        a and w0 / 2 pi.
    density_kg_m3
        Mass per volume.
    """

    static_shear_modulus_pa: float
    rising_shear_modulus_pa: float
    exponent: float
    reference_frequency_hz: float
    density_kg_m3: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Pulse:
    """The short knock that starts a wave.

    Attributes
    ----------
    width_ms, delay_ms
        Width of the rectangle; time of its centre, before the filters delay it further.
    low_pass_hz, low_pass_order, high_pass_hz, high_pass_order
        Causal Butterworth filters.
    """

    width_ms: float
    delay_ms: float
    low_pass_hz: float
    low_pass_order: int
    high_pass_hz: float
    high_pass_order: int


def wavenumber(frequency_hz: Floats, skin: Skin) -> Complexes:
    """Complex wavenumber k of a surface wave, rad/m, same shape as ``frequency_hz``.

    With time dependence exp(+i w t) a wave is exp(-i k r); the imaginary part is negative, so
    waves decay.  k(w) = w / (0.955 sqrt(mu(w) / rho)), mu(w) a fractional Voigt modulus, whose
    fit to skin is described by Kearney et al. (2015).
    """
    ratio = 1j * np.asarray(frequency_hz) / skin.reference_frequency_hz
    modulus = skin.static_shear_modulus_pa + skin.rising_shear_modulus_pa * ratio**skin.exponent
    speed = _RAYLEIGH_SHARE * np.sqrt(modulus / skin.density_kg_m3)
    return np.asarray(2 * np.pi * np.asarray(frequency_hz) / speed)


def pulse_spectrum(pulse: Pulse, n_times: int, sample_rate_hz: float) -> Complexes:
    """One-sided spectrum of the sampled pulse, (n_times // 2 + 1,).

    The filters act on the continuous pulse and the result is then sampled, which keeps silence
    before the pulse; filtering forwards and backwards would ring before it.
    """
    n_fine = n_times * _OVERSAMPLING
    frequency = scipy.fft.rfftfreq(n_fine, 1 / (sample_rate_hz * _OVERSAMPLING))
    s: Complexes = np.asarray(1j * frequency, dtype=np.complex128)
    low = _butterworth(s / pulse.low_pass_hz, pulse.low_pass_order)
    # A high pass is a low pass of the inverse frequency; nothing passes at zero.
    high = np.zeros_like(low)
    high[1:] = _butterworth(pulse.high_pass_hz / s[1:], pulse.high_pass_order)
    width_s, delay_s = pulse.width_ms / 1e3, pulse.delay_ms / 1e3
    turn = np.exp(-2j * np.pi * frequency * delay_s)
    fine = scipy.fft.irfft(np.sinc(frequency * width_s) * low * high * turn, n_fine)
    return np.asarray(scipy.fft.rfft(fine[::_OVERSAMPLING]))


def _butterworth(s: Complexes, order: int) -> Complexes:
    """Analogue low-pass prototype with its edge at |s| = 1, same shape as ``s``."""
    angles = np.pi * (2 * np.arange(order) + 1) / (2 * order) + np.pi / 2
    denominator = np.ones_like(s)
    for pole in np.exp(1j * angles):
        denominator *= s - pole
    return 1 / denominator


def bending_boost(frequency_hz: Floats, mode_hz: Floats, gain: float, quality: float) -> Complexes:
    """Resonance added by a bending digit, (n_modes, n_frequencies).

    gain wm^2 / (wm^2 - w^2 + i w wm / Q), a damped oscillator: causal.
    """
    ratio = np.asarray(frequency_hz)[None, :] / np.asarray(mode_hz)[:, None]
    return np.asarray(gain / (1 - ratio**2 + 1j * ratio / quality))
