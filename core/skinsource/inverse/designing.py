"""Drives that were found at each frequency, and the design that plays a waveform through them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, get_args

import numpy as np
import scipy

from skinsource.base.arguments import checking, one_of, positive_number
from skinsource.base.conventions import Band, Complexes, Floats, Integers
from skinsource.base.errors import InvalidInputError
from skinsource.design.design import Design
from skinsource.design.waveform import Waveform
from skinsource.inverse.drives_in_time import Cost, played
from skinsource.inverse.responses import bins_of, gram_of, loading, n_fft_of, power_db
from skinsource.limbs.limb import Limb, LimbFacts
from skinsource.limbs.scaling import pulse_spectrum
from skinsource.signals.generators import window
from skinsource.signals.loudest_window import loudest_energy, window_samples
from skinsource.signals.spectra import share_outside_band

Spectrum = Literal["as drawn", "natural"]
SPECTRA: tuple[Spectrum, ...] = get_args(Spectrum)
#: Where drives are, unless somebody says else.
DRIVEN_HZ: Band = (50.0, 300.0)
# Frequencies at which nothing is driven any more, in parts of the band's ends.
_RAMP = (0.8, 1.1)
# Share of the energy of a waveform within the band that suffices for a level.
_LEAST_INSIDE = 1e-3


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Focus:
    """Drives that make one place strong, at each frequency, and what is to be expected of them.

    Drives are in units of the measuring pulse, those of own limbs in the unit of their drive.

    Attributes
    ----------
    limb
        Whose responses were used.
    target
        Output, from 1; of several the first.
    inputs
        Places in use, from 1.
    frequencies_hz : (n_bins,)
        Where it was solved.
    used_drives : (n_bins, n_used)
        Of the inputs in use; with them the target's response is 1.
    beta : (n_bins,)
        Regularisation: much is strong, little is sharp.
    row : (n_bins, n_used)
        Responses of the target, along its strongest direction where there are several axes.
    gram : (n_bins, n_used, n_used)
        Sum of conj(G) G over the rows G of what is quiet.
    mean_contrast_db : (n_bins,)
        Energy at the target over the mean of the quiet outputs.
    loudest_other_db : (n_bins,)
        Energy at the target over that of the loudest other output.
    loudest_other : (n_bins,)
        That output, from 1.
    spread_db : (n_bins,)
        Energy of the strongest of several targets over that of the weakest.
    unseen
        Finds `unseen_contrast_db`, which takes as long as the drives.
    """

    limb: LimbFacts
    target: int
    inputs: tuple[int, ...]
    frequencies_hz: Floats
    used_drives: Complexes
    beta: Floats
    row: Complexes
    gram: Complexes
    mean_contrast_db: Floats
    loudest_other_db: Floats
    loudest_other: Integers
    spread_db: Floats
    unseen: Callable[[], Floats]

    def __repr__(self) -> str:
        f = self.frequencies_hz
        return f"<{self.title}, {f[0]:.4g} to {f[-1]:.4g} Hz>"

    @property
    def title(self) -> str:
        """What it does: "Focus on output 30 of synthetic-1"."""
        return f"Focus on output {self.target} of {self.limb.name}"

    @property
    def drives(self) -> Complexes:
        """Drives of all inputs, (n_bins, limb.n_inputs); 0 for those not in use."""
        drives = np.zeros((len(self.used_drives), self.limb.n_inputs), complex)
        drives[:, np.array(self.inputs) - 1] = self.used_drives
        return drives

    @cached_property
    def unseen_contrast_db(self) -> Floats:
        """`mean_contrast_db` at quiet outputs that the design never saw, each left out in turn."""
        return self.unseen()

    @property
    def effort_db(self) -> Floats:
        """Energy of the drives over the least that gives the same at the target, (n_bins,)."""
        energies = (np.square(np.abs(each)).sum(axis=1) for each in (self.used_drives, self.row))
        return power_db(np.prod(list(energies), axis=0))

    @property
    def contact_db(self) -> Floats:
        """Acceleration at the target over that of the strongest contact, (n_bins,).

        NaN for own limbs, whose drives have no known unit.
        """
        pulse = pulse_of(self.limb, self.frequencies_hz)
        if self.limb.per_unit_drive:
            pulse = np.full_like(pulse, np.nan)
        at_target = np.abs((self.row * self.used_drives).sum(axis=1))
        return power_db(at_target**2, np.square(np.abs(self.used_drives).max(axis=1) * pulse))

    @property
    def delay_s(self) -> float:
        """Time at which a waveform begins on the skin, after its design has begun."""
        return self.limb.pre_trigger_delay_s + _half(self.limb) / self.limb.sample_rate_hz

    @checking
    def design(
        self,
        waveform: Waveform,
        level: float | None = None,
        spectrum: Spectrum = "as drawn",
        peak: float | None = None,
        band_hz: Band = DRIVEN_HZ,
    ) -> Design:
        """Return a design that plays a waveform at the target, `delay_s` later.

        Its drives are probe acceleration, as an equaliser wants it; those of own limbs are in the
        unit of their drive.

        Parameters
        ----------
        waveform
            What the target does, m/s².
        level
            RMS of the target along its direction, over its loudest 100 ms, m/s²; None: as of the
            waveform.
        spectrum
            ``"as drawn"``, or ``"natural"``: times the energy of the responses, at most 1, so that
            little is spent where the skin answers little.
        peak
            Most that a drive may reach, m/s²; the best drives within it are then found, and the
            target may become less strong.  None: there is no limit.
        band_hz
            Nothing is driven outside.

        Raises
        ------
        InvalidInputError
            A level is asked of a waveform without anything in the band.

        Examples
        --------
        >>> import skinsource as ss
        >>> found = ss.inverse.focus("synthetic-1", 30)
        >>> design = found.design(ss.waveforms.Tone(frequency_hz=100.0), level=0.1)
        >>> levels_db = ss.evaluate(
        ...     design, "output_levels_db", view=ss.View(axes="z", span="loudest")
        ... )["output_levels_db"]
        >>> print(f"{levels_db[29]:.1f} dB")
        -20.0 dB
        """
        drives = self.drives_in_time(waveform, level, spectrum, peak, band_hz)
        return played(self.limb, self.inputs, drives, self.title)

    def drives_in_time(
        self,
        waveform: Waveform,
        level: float | None = None,
        spectrum: Spectrum = "as drawn",
        peak: float | None = None,
        band_hz: Band = DRIVEN_HZ,
    ) -> Floats:
        """Return what the inputs in use play in the design of `design`, (n_used, n_times)."""
        limb = self.limb
        wave = waveform.samples(limb.sample_rate_hz)
        at_hz = bins_of(n_fft_of(limb.n_taps), limb.sample_rate_hz)
        pulse = pulse_of(limb, at_hz)
        row = _on_bins(self, self.row, -limb.pre_trigger_delay_s) / pulse[:, None]
        shape = _band(at_hz, band_hz)
        if one_of("spectrum", spectrum, SPECTRA) == "natural":
            energy = np.square(np.abs(_on_bins(self, self.row, 0.0))).sum(axis=1)
            shape = shape * energy / (shape * energy).max()
        spectra = _on_bins(self, self.used_drives, limb.pre_trigger_delay_s)
        filters = _filters(limb, spectra * (pulse * shape)[:, None])
        drives = scipy.signal.oaconvolve(wave[None], filters, axes=1)
        if level is not None:
            wanted = positive_number("level", level)
            inside = 1.0 - share_outside_band(wave, limb.sample_rate_hz, band_hz)
            if not wave.any() or inside < _LEAST_INSIDE:
                low, high = band_hz
                raise InvalidInputError(
                    f"The waveform has nothing within {low:g} to {high:g} Hz and cannot reach a "
                    "level. Choose another waveform, or another band_hz."
                )
            drives = drives * (wanted / _rms_at_target(limb, drives, row))
        if peak is not None and np.abs(drives).max() > positive_number("peak", peak):
            cost = cost_of(self, pulse, _band(at_hz, band_hz), drives.shape[1])
            drives = cost.within(peak, cost.applied(drives), drives)
        return drives


def pulse_of(limb: Limb | LimbFacts, at_hz: Floats) -> Floats:
    """Return what a drive of 1 is in the unit of what is played, (n_bins,).

    What is driven is the probe, which the measuring pulse moves in known ways.
    """
    if limb.per_unit_drive:
        return np.ones_like(at_hz)
    return pulse_spectrum(at_hz, limb.sample_rate_hz)


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
