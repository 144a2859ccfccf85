"""A waveform at the target of a focus: filters, drives, and the design that plays them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
import scipy

from skinsource.base.arguments import one_of, positive_number
from skinsource.base.conventions import Band, Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.design import Design
from skinsource.design.waveform import Waveform
from skinsource.inverse.drives_in_time import Cost, played
from skinsource.inverse.responses import bins_of, gram_of, loading, n_fft_of
from skinsource.limbs.limb import LimbFacts
from skinsource.limbs.scaling import pulse_spectrum
from skinsource.signals.generators import window
from skinsource.signals.loudest_window import loudest_energy, window_samples
from skinsource.signals.spectra import share_outside_band

if TYPE_CHECKING:  # it makes designs
    from skinsource.inverse.focusing import Focus

Spectrum = Literal["as drawn", "natural"]
SPECTRA: tuple[Spectrum, ...] = get_args(Spectrum)
#: Where drives are, unless somebody says else.
DRIVEN_HZ: Band = (50.0, 300.0)
# Frequencies at which nothing is driven any more, in parts of the band's ends.
_RAMP = (0.8, 1.1)
# Share of the energy of a waveform within the band that suffices for a level.
_LEAST_INSIDE = 1e-3


def delay_of(limb: LimbFacts) -> float:
    """Return the time from the start of a design to that of its waveform on the skin, s."""
    return limb.pre_trigger_delay_s + _half(limb) / limb.sample_rate_hz


def designed(
    focus: Focus,
    waveform: Waveform,
    level: float | None,
    spectrum: Spectrum,
    peak: float | None,
    band_hz: Band,
) -> Design:
    """Return what `Focus.design` returns."""
    limb = focus.limb
    wave = waveform.samples(limb.sample_rate_hz)
    at_hz = bins_of(n_fft_of(limb.n_taps), limb.sample_rate_hz)
    # What is driven is the probe, which the measuring pulse moves in known ways.
    pulse = np.ones(at_hz.size)
    if not limb.per_unit_drive:
        pulse = pulse_spectrum(at_hz, limb.sample_rate_hz)
    row = _on_bins(focus, focus.row, -limb.pre_trigger_delay_s) / pulse[:, None]
    shape = _band(at_hz, band_hz)
    if one_of("spectrum", spectrum, SPECTRA) == "natural":
        energy = np.square(np.abs(_on_bins(focus, focus.row, 0.0))).sum(axis=1)
        shape = shape * energy / (shape * energy).max()
    spectra = _on_bins(focus, focus.used_drives, limb.pre_trigger_delay_s)
    filters = _filters(limb, spectra * (pulse * shape)[:, None])
    drives = scipy.signal.oaconvolve(wave[None], filters, axes=1)
    if level is not None:
        wanted = positive_number("level", level)
        inside = 1.0 - share_outside_band(wave, limb.sample_rate_hz, band_hz)
        if not wave.any() or inside < _LEAST_INSIDE:
            low, high = band_hz
            raise InvalidInputError(
                f"The waveform has nothing within {low:g} to {high:g} Hz and cannot reach a level. "
                "Choose another waveform, or another band_hz."
            )
        drives = drives * (wanted / _rms_at_target(limb, drives, row))
    if peak is not None and np.abs(drives).max() > positive_number("peak", peak):
        cost = cost_of(focus, pulse, _band(at_hz, band_hz), drives.shape[1])
        drives = cost.within(peak, cost.applied(drives), drives)
    name = f"Focus on output {focus.target} of {limb.name}"
    return played(limb, focus.inputs, drives, name)


def _half(limb: LimbFacts) -> int:
    """Return half the length of filters: 204 for responses of 522 taps."""
    return n_fft_of(limb.n_taps) // 5


def _on_bins(focus: Focus, values: Complexes, earlier_s: float) -> Complexes:
    """Return values at the bins of the transform, (n_bins, …), without their delay of so long.

    Between solved frequencies they are straight, beyond them as at the nearest one.
    """
    limb, solved_hz = focus.limb, focus.frequencies_hz
    at_hz = bins_of(n_fft_of(limb.n_taps), limb.sample_rate_hz)
    columns = values.reshape(len(solved_hz), -1).T * np.exp(-2j * np.pi * earlier_s * solved_hz)
    on_bins = np.stack([np.interp(at_hz, solved_hz, column) for column in columns], axis=1)
    return on_bins.reshape(at_hz.size, *values.shape[1:])


def _band(at_hz: Floats, band_hz: Band) -> Floats:
    """Return 1 within a band, and a smooth fall to 0 at both its sides."""
    low, high = band_hz
    if not 0.0 < low < high:
        raise InvalidInputError(
            f"band_hz is {low:g} to {high:g} Hz, expected two rising frequencies above 0"
        )
    inside = np.interp(at_hz, [_RAMP[0] * low, low, high, _RAMP[1] * high], [0.0, 1.0, 1.0, 0.0])
    return np.sin(0.5 * np.pi * inside) ** 2


def _filters(limb: LimbFacts, spectra: Complexes) -> Floats:
    """Return filters, (n_used, n), whose middle is time 0, for spectra at the bins."""
    half = _half(limb)
    around = np.roll(scipy.fft.irfft(spectra, n_fft_of(limb.n_taps), axis=0), half, axis=0)
    return around[: 2 * half + 1].T * window("tukey", 2 * half + 1)


def _rms_at_target(limb: LimbFacts, drives: Floats, row: Complexes) -> float:
    taps = scipy.fft.fftshift(scipy.fft.irfft(row, n_fft_of(limb.n_taps), axis=0), axes=0).T
    signal = scipy.signal.oaconvolve(drives, taps, axes=1).sum(axis=0)
    n_window = window_samples(limb.sample_rate_hz)
    return float(np.sqrt(loudest_energy(signal, n_window) / n_window))


def cost_of(focus: Focus, pulse: Floats, shape: Floats, n_times: int) -> Cost:
    """Return the cost whose least is the focus itself, for drives of ``n_times`` samples."""
    limb, n_used = focus.limb, len(focus.inputs)
    beta, unit = np.where(np.isinf(focus.beta), 1.0, focus.beta), loading(focus.gram)
    # The target counts as much as all that is quiet together.
    weight = n_used * unit / np.square(np.abs(focus.row)).sum(axis=1)
    of_target = weight[:, None, None] * gram_of(focus.row[:, None])
    solved = focus.gram + of_target + (beta * unit)[:, None, None] * np.eye(n_used)
    normal = _on_bins(focus, solved, 0.0) / np.square(pulse)[:, None, None]
    mean = np.trace(normal, axis1=1, axis2=2).real @ shape / shape.sum() / n_used
    normal = shape[:, None, None] * normal + ((1.0 - shape) * mean)[:, None, None] * np.eye(n_used)
    # Bins as fine as the length of the drives needs.
    n_bins = n_fft_of(limb.n_taps)
    n_fft = scipy.fft.next_fast_len(max(n_times + limb.n_taps - 1, n_bins), real=True)
    lags = scipy.fft.irfft(normal, n_bins, axis=0)
    half = n_bins // 2
    longer = np.zeros((n_fft, n_used, n_used))
    longer[:half], longer[-half:] = lags[:half], lags[-half:]
    return Cost(normal=scipy.fft.rfft(longer, axis=0), n_fft=n_fft, n_times=n_times)
