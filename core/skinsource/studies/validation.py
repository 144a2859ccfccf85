"""Comparison of predictions with recordings, as in Fig. 4 of the SkinSource paper.

It has the figures of agreement, the fits that a linear model rests on, and a reader of recorded
responses from files of other programs.
"""

import os
from contextlib import ExitStack
from dataclasses import dataclass
from itertools import permutations, product
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from skinsource.base.arrays import Booleans, Floats
from skinsource.base.errors import InvalidInputError, RecordingError, counted
from skinsource.base.files import path_text
from skinsource.base.job import Stop, never
from skinsource.base.run_limited import run_limited
from skinsource.readers import limits
from skinsource.readers.reader import Found, Series
from skinsource.readers.reading_process import ReadingProcess
from skinsource.readers.timestamps import sample_clock
from skinsource.signals.resampling import resample

_EXPECTED = "a table of numbers, NPY, NPZ, MATLAB or HDF5"

#: A channel counts if its measured RMS is at least so many times that of the noise.
LEAST_OVER_NOISE = 2.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Agreement:
    """Figures of each channel; NaN where it does not count.

    Attributes
    ----------
    counted : (n_outputs, n_axes) of bool
        Channels whose measured RMS is twice the noise or more.
    error : (n_outputs, n_axes)
        Mean over time of the magnitude of the difference, both divided by their own mean RMS.
    amplitude_percent : (n_outputs, n_axes)
        100 |RMS predicted - RMS measured| / RMS measured, of those same divided signals.
    correlation : (n_outputs, n_axes)
        Pearson's r over time.
    """

    counted: Booleans
    error: Floats
    amplitude_percent: Floats
    correlation: Floats

    @property
    def counted_text(self) -> str:
        """Number of the channels that count, and of all, as text."""
        return f"{int(self.counted.sum())} of {self.counted.size}"

    @property
    def medians(self) -> tuple[float, float, float]:
        """Medians of error, amplitude and correlation over the channels that count, or NaN.

        A channel with a silent prediction counts, but has no correlation.
        """
        parts = (self.error, self.amplitude_percent, self.correlation)
        error, amplitude, correlation = (_median(figure[self.counted]) for figure in parts)
        return error, amplitude, correlation


def agreement(predicted: Floats, measured: Floats, noise_rms: Floats | float) -> Agreement:
    """Return the agreement of two fields, channel by channel.

    Each field is divided by the mean RMS of its channels first, as in the paper: the comparison is
    about shape and distribution, not about the strength of the actuator.

    Parameters
    ----------
    predicted, measured : (n_outputs, n_axes, n_times)
        At the same rate and from the same instant, see `aligned`.
    noise_rms : (n_outputs, n_axes) or a number
        RMS of the noise of the measurement, in its unit.

    Raises
    ------
    InvalidInputError
        A field is silent.
    """
    measured_rms = _rms(measured)
    counted = (measured_rms >= LEAST_OVER_NOISE * noise_rms) & (measured_rms > 0.0)
    ours, theirs = _normalised("predicted", predicted), _normalised("measured", measured)
    ours_rms, theirs_rms = _rms(ours), _rms(theirs)
    amplitude = np.full(counted.shape, np.nan)
    np.divide(100.0 * np.abs(ours_rms - theirs_rms), theirs_rms, out=amplitude, where=counted)
    error = np.where(counted, np.abs(ours - theirs).mean(axis=-1), np.nan)
    return Agreement(
        counted=counted,
        error=error,
        amplitude_percent=amplitude,
        correlation=np.where(counted, pearson(ours, theirs), np.nan),
    )


def _median(values: Floats) -> float:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if known.size else np.nan


def pearson(left: Floats, right: Floats) -> Floats:
    """Return Pearson's r over the last axis; NaN where a signal does not change."""
    a, b = (x - x.mean(axis=-1, keepdims=True) for x in (left, right))
    size = np.sqrt(np.sum(a * a, axis=-1) * np.sum(b * b, axis=-1))
    r = np.full(size.shape, np.nan)
    np.divide(np.sum(a * b, axis=-1), size, out=r, where=size > 0.0)
    return r


def aligned(measured: Floats, predicted: Floats, most: int) -> tuple[Floats, int]:
    """Return the measured field aligned with the predicted one, and the shift in samples.

    The shift is the lag at which the sum of the cross-correlations of all channels is largest.
    Missing samples are silence, surplus samples are cut off.

    Parameters
    ----------
    measured, predicted : (n_outputs, n_axes, n_times)
        Lengths in time may differ.
    most
        Largest shift in samples, to either side.

    Returns
    -------
    (n_outputs, n_axes, n_times of the predicted), and the shift; positive: the recording is early.
    """
    n_times = predicted.shape[-1]
    n_fft = scipy.fft.next_fast_len(n_times + measured.shape[-1], real=True)
    cross = scipy.fft.rfft(predicted, n_fft) * np.conj(scipy.fft.rfft(measured, n_fft))
    sums = scipy.fft.irfft(cross.sum(axis=(0, 1)), n_fft)
    # At larger lags the two do not overlap.
    lags = np.arange(-min(most, measured.shape[-1] - 1), min(most, n_times - 1) + 1)
    shift = int(lags[np.argmax(sums[lags])])
    shifted = np.zeros(predicted.shape)
    first = max(-shift, 0)
    piece = measured[..., first : first + n_times - max(shift, 0)]
    shifted[..., max(shift, 0) : max(shift, 0) + piece.shape[-1]] = piece
    return shifted, shift


def _rms(field: Floats) -> Floats:
    rms: Floats = np.sqrt(np.mean(np.square(field), axis=-1))
    return rms


def _normalised(name: str, field: Floats) -> Floats:
    mean = float(_rms(field).mean())
    if mean == 0.0:
        raise InvalidInputError(f"{name} is silent throughout; choose another")
    return field / mean


def straight_lines(x: Floats, y: Floats) -> tuple[Floats, Floats, Floats]:
    """Return slopes, offsets and adjusted R² of lines over the first axis, by least squares.

    Parameters
    ----------
    x, y : (n, ...)
        Shapes that broadcast, with three levels or more; ``y`` has the broadcast shape.

    Returns
    -------
    (...,) each; R² is NaN where ``y`` does not change.
    """
    n = len(x)
    away, rest = x - x.mean(axis=0), y - y.mean(axis=0)
    slope = np.sum(away * rest, axis=0) / np.sum(away**2, axis=0)
    residual = np.sum(np.square(rest - slope * away), axis=0)
    total = np.sum(np.square(rest), axis=0)
    # The mean of equal levels may be rounded: the rest is then no change.
    rounding = n * np.square(np.finfo(np.float64).eps * np.abs(y).max(axis=0))
    share = np.divide(residual, total, out=np.full(total.shape, np.nan), where=total > rounding)
    return slope, y.mean(axis=0) - slope * x.mean(axis=0), 1.0 - share * (n - 1) / (n - 2)


# Rates that differ by less are the same.
_SAME_HZ = 1e-3
# Time, outputs and axes of an array of three dimensions, the usual order first.
_ORDERS = tuple(map("".join, permutations("toa")))


def open_recorded(
    path: str | os.PathLike[str],
    n_outputs: int,
    n_axes: int,
    sample_rate_hz: float,
    *,
    rate_hz: float | None = None,
    process: ReadingProcess | None = None,
    stop: Stop = never,
) -> Floats:
    """Return the responses of a CSV, NPZ, MATLAB or HDF5 file, (n_outputs, n_axes, n_times).

    They are an array of times, outputs and axes, in whichever order; or columns: output 1 along
    each axis, then output 2, and so on, beside a column of times or without one.  Of an array of
    times and channels, in either order, those are the channels of which there are as many as
    outputs and axes.  Those at another rate are resampled.  The file is read in a process of its
    own.

    Parameters
    ----------
    path
        The file.
    n_outputs, n_axes
        Expected outputs and axes; with a single column for each output ``n_axes`` is 1.
    sample_rate_hz
        Rate of the returned responses.
    rate_hz
        Rate of a file that states none; ``sample_rate_hz`` unless given.
    process
        Reads the file; a new one unless given.
    stop
        Asked now and then whether to give up.

    Raises
    ------
    RecordingError
        It holds another number of signals, numbers that are not finite, or a rate that cannot be
        resampled.
    StorageError
        It cannot be read.
    Stopped
        ``stop`` said so.
    """
    file = Path(path)
    with ExitStack() as stack:
        reader = process or stack.enter_context(ReadingProcess())
        field, stated_hz = _read_responses(reader, file, n_outputs, n_axes, stop)
    if not np.isfinite(field).all():
        raise _recording_error(file, "it holds values that are not finite numbers, expected m/s²")
    return _resampled(file, field, stated_hz or rate_hz or sample_rate_hz, sample_rate_hz)


def _read_responses(
    reader: ReadingProcess, file: Path, n_outputs: int, n_axes: int, stop: Stop
) -> tuple[Floats, float | None]:
    """Return the responses, and their rate; None: the file states none."""
    (offered,) = run_limited(
        "skinsource.limbs.limb_layout:arrays_of",
        file,
        expected=_EXPECTED,
        process=reader,
        stop=stop,
    )
    arrays = [array for array in offered["arrays"] if len(array["shape"]) == 3]
    for array, order in product(arrays, _ORDERS):
        n_in_order = dict(zip(order, array["shape"], strict=True))
        if n_in_order["o"] == n_outputs and n_in_order["a"] == n_axes:
            rate_hz = array["rate_hz"] or offered["rate_hz"]
            field = _from_array(reader, file, array, order, stop)
            return field, None if rate_hz is None else float(rate_hz)
    shapes = ", ".join(" × ".join(map(str, array["shape"])) for array in arrays[:5])
    try:
        contents = reader.look(file, stop=stop)
    except RecordingError:
        if not shapes:
            raise
        raise _recording_error(
            file,
            f"its arrays are {shapes}, expected times × {counted(n_outputs, 'output')} × "
            f"{counted(n_axes, 'axis', 'axes')}",
        ) from None
    return _from_columns(reader, file, contents, n_outputs, n_axes, stop)


def _from_array(
    reader: ReadingProcess, file: Path, array: dict[str, Any], order: str, stop: Stop
) -> Floats:
    shape = [int(n) for n in array["shape"]]
    if prod(shape) * 8 > limits.MOST_BYTES:
        raise _recording_error(
            file, f"{prod(shape)} samples are too many, expected at most {limits.MOST_BYTES // 8}"
        )
    # One axis after another, as the responses of a limb come: input by input.
    along_each = list(
        run_limited(
            "skinsource.limbs.limb_layout:response_blocks",
            file,
            expected=_EXPECTED,
            process=reader,
            stop=stop,
            array=array["name"],
            order=order.replace("a", "i"),
        )
    )
    if len(along_each) != shape[order.index("a")]:
        raise _recording_error(file, "it ends too early, expected all axes")
    return np.stack(along_each, axis=1)


def _from_columns(
    reader: ReadingProcess, file: Path, contents: Found, n_outputs: int, n_axes: int, stop: Stop
) -> tuple[Floats, float | None]:
    signals = [series for series in contents.series if not series.is_time]
    expected = n_outputs * n_axes
    # Each signal may be an instant, which holds a value of every channel.
    by_instant = len(signals) != expected and {signal.shape for signal in signals} in (
        {(len(signals), expected)},
        {(expected, len(signals))},
    )
    one_length = len({signal.n_samples for signal in signals}) == 1
    if not by_instant and not (len(signals) == expected and one_length):
        one_axis = f", or choose one axis (x, y or z), which takes {counted(n_outputs, 'signal')}"
        advice = one_axis if n_axes > 1 else ""
        raise _recording_error(
            file,
            f"{counted(len(signals), 'signal')}, expected {expected} of one length: "
            f"{counted(n_outputs, 'output')} along {counted(n_axes, 'axis', 'axes')}, output "
            f"by output. Save the responses as an array of times by outputs by axes{advice}",
        )
    keys, n_values = [signal.key for signal in signals], signals[0].n_samples
    values = reader.read(file, keys, 0, n_values, stop=stop).astype(np.float64)
    time = contents.time_of(signals[0])
    if by_instant:
        values = values.T
        times = (series for series in contents.series if series.is_time)
        time = next((series for series in times if series.n_samples == len(signals)), None)
    rate_hz = contents.rate_of(signals[0])
    if rate_hz is None:
        rate_hz = _rate_of_times(reader, file, time, stop)
    return values.reshape(n_outputs, n_axes, -1), rate_hz


def _rate_of_times(
    reader: ReadingProcess, file: Path, times: Series | None, stop: Stop
) -> float | None:
    if times is None:
        return None
    timestamps = reader.read(file, [times.key], 0, times.n_samples, stop=stop)[0]
    try:
        clock = sample_clock(timestamps.astype(np.float64) * times.time_unit_s)
    except InvalidInputError as error:
        raise _recording_error(file, str(error)) from error
    if not clock.steady:
        raise _recording_error(
            file,
            "its time stamps are not steady, expected steps of one length. Resample it before",
        )
    return float(clock.rate_hz)


def _resampled(file: Path, field: Floats, from_hz: float, to_hz: float) -> Floats:
    if abs(from_hz - to_hz) <= _SAME_HZ:
        return field
    rates = [round(from_hz), round(to_hz)]
    if max(abs(rates[0] - from_hz), abs(rates[1] - to_hz)) > _SAME_HZ:
        raise _recording_error(
            file,
            f"{from_hz:g} Hz, expected a whole number of hertz, or the rate of the limb, "
            f"{to_hz:g} Hz. Resample it before",
        )
    return resample(field, *rates)


def _recording_error(file: Path, reason: str) -> RecordingError:
    return RecordingError(f"{path_text(Path(file.name))}: {reason.rstrip('.')}.")
