"""Wanted waveforms on the skin, several at once, and what moves along it: their drives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.actuators.equalising import followed_band
from skinsource.base.arguments import checking, finite_array, integer, positive_number
from skinsource.base.conventions import Axes, Complexes, Floats, axis_numbers
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.design.design import Design
from skinsource.design.signal_path import LARGEST
from skinsource.engine.prediction import predict
from skinsource.inverse.drives_in_time import Cost, played
from skinsource.inverse.focusing import checked_beta, quiet_of
from skinsource.inverse.responses import (
    Responses,
    bins_of,
    gram_of,
    loading,
    power_db,
    responses_of,
    spectra_of,
)
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import Limb, LimbFacts
from skinsource.limbs.scaling import pulse_spectrum
from skinsource.signals.generators import sample_count, window

# Outside the band drives cost so many times the mean diagonal; of its edges, where that holds.
_OUTSIDE, _RAMP = 10.0, (0.6, 1.05)
# Room of drives beyond what is wanted.
_ROOM_S = 0.1
# Samples that the measuring pulse rings to both sides.
_PULSE_SAMPLES = 32


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Reproduction:
    """Drives that make wanted waveforms on the skin.

    Drives are in units of the measuring pulse, those of own limbs in the unit of their drive.

    Attributes
    ----------
    limb
        Whose responses were used.
    waveforms : (limb.n_inputs, n_times)
        Drives; 0 for inputs not in use.
    delay_s
        Time at which what is wanted begins on the skin, after the drives have begun.
    nmse_db
        Of each wanted output: energy of the error over that of what is wanted, over the whole
        response.  NaN where silence is wanted.
    centroid_error_mm
        Of a movement: RMS distance from where it should be to the centroid of the energy at the
        outputs of its path, in tenths of its time; else NaN.
    """

    limb: LimbFacts
    waveforms: Floats
    delay_s: float
    nmse_db: dict[int, float]
    centroid_error_mm: float = np.nan

    def __repr__(self) -> str:
        return f"<Reproduction on {self.limb.name}: outputs {', '.join(map(str, self.nmse_db))}>"

    def design(self) -> Design:
        """Return a design that plays the drives, as probe acceleration; it begins 25 ms later."""
        drives, limb = self.waveforms, self.limb
        if not limb.per_unit_drive:
            drives = np.pad(drives, ((0, 0), (_PULSE_SAMPLES, _PULSE_SAMPLES)))
            n_fft = scipy.fft.next_fast_len(drives.shape[1], real=True)
            at_hz = bins_of(n_fft, limb.sample_rate_hz)
            spectra = scipy.fft.rfft(drives, n_fft) * pulse_spectrum(at_hz, limb.sample_rate_hz)
            drives = scipy.fft.irfft(spectra, n_fft)[:, : drives.shape[1]]
        return played(limb, range(1, limb.n_inputs + 1), drives, "Wanted on the skin")


@checking
def reproduce(
    limb: Limb | str,
    wanted: Mapping[int, ArrayLike],
    *,
    axes: Axes = "z",
    quiet: Sequence[int] | None = None,
    inputs: Sequence[int] | None = None,
    length_s: float = 0.3,
    beta: float = 0.1,
    peak: float | None = None,
    exact: bool = True,
) -> Reproduction:
    """Return the drives whose responses are wanted waveforms, others being quiet.

    They minimise the mean energy of the error at wanted outputs, plus that at quiet ones, plus λ =
    β tr(R) / n times their own.

    Parameters
    ----------
    limb
        From `load_limb`, or its name.
    wanted
        Samples of each wanted output, (n_times,), at the rate of the limb, m/s².
    axes
        Along which outputs count; a waveform is wanted along the direction in which its output
        answers most, its other directions are free.
    quiet
        Outputs; None: all others on the hand, of own limbs all that are 6 dB above their noise.
    inputs
        Places in use; None: the 15 perpendicular ones, of own limbs all.
    length_s
        Of the drives: that of the waveforms and 0.1 s more.
    beta
        From 1e-6, exact, to 1e9, with little drive.
    peak
        Most that a drive may reach, in units of the measuring pulse; None: there is no limit.
    exact
        Whether drives are the best of their length; else they are solved by frequency and cut,
        which costs up to 1 % more.

    Raises
    ------
    InvalidInputError
        There is no such place or output, a waveform does not fit in, or its output is mostly noise.

    Examples
    --------
    >>> import skinsource as ss
    >>> burst = ss.sinusoid(100.0, 0.1, window_name="hanning")
    >>> found = ss.inverse.reproduce("synthetic-1", {30: burst}, quiet=[1, 10, 19])
    >>> print(found.waveforms.shape, found.nmse_db[30] < -10.0)
    (20, 390) True
    """
    limb, peak = limb_of(limb), None if peak is None else positive_number("peak", peak)
    n_times = sample_count(positive_number("length_s", length_s), limb.sample_rate_hz)
    signals = [_checked_signal(each, n_times) for each in wanted.values()]
    if not signals:
        raise InvalidInputError("wanted names no output. Name one.")
    n_fft = scipy.fft.next_fast_len(n_times + limb.n_taps - 1, real=True)
    delay = int(limb.pre_trigger_delay_s * limb.sample_rate_hz)
    delay += (n_times - max(each.size for each in signals)) // 2
    delayed = np.stack([np.pad(each, (delay, n_fft - delay - each.size)) for each in signals])
    # Whether an output can be a target is judged within the band.
    within = responses_of(limb, axes=axes, inputs=inputs)
    outputs = [within.check_target(output) for output in wanted]
    silent = quiet_of(within, outputs, quiet)
    at_hz = bins_of(n_fft, limb.sample_rate_hz)
    low, high = followed_band(limb.band_hz, limb.sample_rate_hz)
    # How far each frequency is outside the band: 0 to 1.
    edges = [_RAMP[0] * low, low, high, _RAMP[1] * high]
    outside = np.interp(at_hz, edges, [1.0, 0.0, 0.0, 1.0])
    driven = outside < 1.0
    responses = spectra_of(limb, axes, within.inputs, at_hz[driven])
    rows = np.stack([_row_along(responses, output) for output in outputs], axis=1)
    # Few wanted outputs count as much as many quiet ones.
    weight = max(len(silent) / len(outputs), 1.0)
    gram = weight * gram_of(rows) + gram_of(responses.rows(silent))
    trace = np.zeros(at_hz.size)
    trace[driven] = loading(gram)
    load = checked_beta(beta) * trace + _OUTSIDE * trace[driven].mean() * outside
    normal = np.eye(gram.shape[-1], dtype=np.complex128) * load[:, None, None]
    normal[driven] += gram
    b = np.zeros(normal.shape[:2], complex)
    spectra = scipy.fft.rfft(delayed)[:, driven]
    b[driven] = weight * np.einsum("fri,rf->fi", rows.conj(), spectra)
    cost = Cost(normal=normal, n_fft=n_fft, n_times=n_times)
    drives = cost.exact(b) if exact else cost.fast(b)
    if peak is not None and np.abs(drives).max() > peak:
        drives = cost.within(peak, cost.cut(b), drives)
    reached = np.zeros((len(outputs), at_hz.size), complex)
    of_drives = scipy.fft.rfft(drives, n_fft)[:, driven]
    reached[:, driven] = np.einsum("fri,if->rf", rows, of_drives)
    error = scipy.fft.irfft(reached, n_fft) - delayed
    waveforms = np.zeros((limb.n_inputs, n_times))
    waveforms[np.array(within.inputs) - 1] = drives
    nmse_db = power_db(np.square(error).sum(axis=1), np.square(delayed).sum(axis=1))
    return Reproduction(
        limb=within.limb,
        waveforms=waveforms,
        delay_s=delay / limb.sample_rate_hz,
        nmse_db=dict(zip(outputs, nmse_db.tolist(), strict=True)),
    )


def _checked_signal(samples: ArrayLike, n_times: int) -> Floats:
    signal = finite_array("wanted", samples, "finite numbers in m/s², (n_times,)", LARGEST)
    if signal.ndim != 1 or not 0 < signal.size <= n_times:
        raise InvalidInputError(
            f"wanted has the shape {signal.shape}, expected (n_times,) with at most {n_times} "
            "samples. Make length_s longer."
        )
    return signal


def _row_along(responses: Responses, output: int) -> Complexes:
    """Return the responses of an output, (n_bins, n_used), along the direction of most energy."""
    rows = responses.values[:, output - 1]
    moments = np.einsum("fai,fbi->ab", rows, rows.conj()).real
    direction = np.linalg.eigh(moments).eigenvectors[:, -1]
    return np.einsum("a,fai->fi", np.copysign(1.0, direction[-1]) * direction, rows)


# Windows of the centroid of a movement: a tenth of it.
_WINDOWS = 10


@checking
def move(
    limb: Limb | str,
    path: Sequence[int],
    duration_s: float,
    carrier_hz: float,
    *,
    axes: Axes = "z",
    beta: float = 0.1,
) -> Reproduction:
    """Return the drives with which a vibration moves from output to output, at one speed.

    Parameters
    ----------
    limb, axes, beta
        As of `reproduce`.
    path
        Outputs in their order, two or more, each with a place on the map.
    duration_s
        From the first to the last.
    carrier_hz
        Frequency of the vibration.

    Raises
    ------
    InvalidInputError
        There is no such output, one has no place, comes twice, or is mostly noise.

    Examples
    --------
    >>> import skinsource as ss
    >>> moved = ss.inverse.move("synthetic-1", [33, 30, 28], 0.2, 100.0)
    >>> print(moved.centroid_error_mm < 30.0)
    True
    """
    limb = limb_of(limb)
    along = [integer("path", output, 1, limb.n_outputs) for output in path]
    points = limb.output_positions_mm[np.array(along, dtype=int) - 1]
    if len(set(along)) < max(len(along), 2) or np.isnan(points).any():
        raise InvalidInputError(
            f"path is {quoted(path)}, expected two outputs or more, each once, with a place on "
            "the map. Choose others."
        )
    rate_hz = limb.sample_rate_hz
    count = sample_count(positive_number("duration_s", duration_s), rate_hz)
    time_s = np.arange(count) / rate_hz
    gone = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    where = np.linspace(0.0, gone[-1], count)
    # Between two outputs, one fades out as the other fades in.
    fades = [np.interp(where, gone, row) for row in np.eye(len(along))]
    ends = window("tukey", count)
    carrier = ends * np.sin(2.0 * np.pi * positive_number("carrier_hz", carrier_hz) * time_s)
    wanted = {
        output: np.sin(0.5 * np.pi * fade) * carrier
        for output, fade in zip(along, fades, strict=True)
    }
    moved = reproduce(limb, wanted, axes=axes, length_s=duration_s + _ROOM_S, beta=beta)
    vibration = predict(limb, moved.waveforms, range(1, limb.n_inputs + 1), scaling="relative")
    first = round(moved.delay_s * rate_hz)
    seen = vibration[np.array(along) - 1][:, axis_numbers(axes, limb.axes), first : first + count]
    energy = np.square(seen).sum(axis=1)
    pieces = np.array_split(np.arange(count), _WINDOWS)
    sums = np.stack([energy[:, piece].sum(axis=1) for piece in pieces])
    centroids = sums @ points / sums.sum(axis=1, keepdims=True)
    wished = np.stack([np.interp(where, gone, each) for each in points.T], axis=1)
    wished = np.stack([wished[piece].mean(axis=0) for piece in pieces])
    error_mm = np.sqrt(np.square(centroids - wished).sum(axis=1).mean())
    return replace(moved, centroid_error_mm=float(error_mm))
