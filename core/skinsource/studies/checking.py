"""Checks of designs: linearity, superposition, agreement with recordings, and a report in HTML.

A linear model predicts output in proportion to input, and the sum of what inputs cause alone.
Both are checked in the prediction of one design, and in designs that are snapshots of each other.
Predictions are compared with recordings as in Fig. 4 of the SkinSource paper; recorded responses
are read from files of other programs.
"""

import math
import os
from collections import defaultdict
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from html import escape
from itertools import pairwise, permutations, product
from math import ceil, floor, log10, prod
from pathlib import Path
from typing import Any, Literal

import numpy as np
import scipy

from skinsource.base.conventions import N_AXES, N_OUTPUTS, Axes, Band, Booleans, Floats
from skinsource.base.errors import InvalidInputError, RecordingError, counted, printable, quoted
from skinsource.base.files import path_text
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.base.run_limited import run_limited
from skinsource.design.comparing import same_but_rounding
from skinsource.design.design import Design, Input, View, audible_inputs, louder, played_clips
from skinsource.design.labels import AXES, label_of, limb_label
from skinsource.design.waveforms import Tone
from skinsource.engine.analysis_rules import place_noise
from skinsource.engine.quantities import new_graph, sources
from skinsource.export.exported_design import describe_played, output_file
from skinsource.limbs.limb import Limb
from skinsource.limbs.own_limbs import facts_of
from skinsource.perception.validity import findings_lines
from skinsource.readers import limits
from skinsource.readers.reader import Found, Series
from skinsource.readers.reading_process import ReadingProcess
from skinsource.readers.timestamps import sample_clock
from skinsource.signals.analysis.noise import QUIET_SHARE, quiet_rms
from skinsource.signals.analysis.statistics import BIN_HZ, band_rms, dominant_frequency
from skinsource.signals.resampling import resample
from skinsource.version import __version__

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
        error, amplitude, correlation = (
            float(np.median(values)) if values.size else np.nan
            for values in (_figure_values(self, figure) for figure in range(len(FIGURES)))
        )
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
    return np.sqrt(np.mean(np.square(field), axis=-1))


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
    from_hz = stated_hz or rate_hz or sample_rate_hz
    if abs(from_hz - sample_rate_hz) <= _SAME_HZ:
        return field
    rates = [round(from_hz), round(sample_rate_hz)]
    if max(abs(rates[0] - from_hz), abs(rates[1] - sample_rate_hz)) > _SAME_HZ:
        raise _recording_error(
            file,
            f"{from_hz:g} Hz, expected a whole number of hertz, or the rate of the limb, "
            f"{sample_rate_hz:g} Hz. Resample it before",
        )
    return resample(field, *rates)


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


def _recording_error(file: Path, reason: str) -> RecordingError:
    return RecordingError(f"{path_text(Path(file.name))}: {reason.rstrip('.')}.")


_STYLE = (
    "body{font:15px/1.5 sans-serif;max-width:60em;margin:2em auto;color:#1b1f24}"
    "table{border-collapse:collapse}td,th{padding:.2em .8em;text-align:right;"
    "border-bottom:1px solid #d2d6dc}td:first-child,th:first-child{text-align:left}"
    "svg{display:block;margin:1em 0}.note{color:#57606a}"
)
_WIDTH, _HEIGHT, _LEFT, _FOOT = 620.0, 220.0, 64.0, 40.0
# Least number of steps of an axis; part of a step by which a limit may lie beyond a tick.
_LEAST_STEPS, _ROUNDING = 3.0, 1e-9
#: Titles of the figures of agreement, their units, and the values in the paper.
FIGURES = (
    ("Normalised mean absolute error", "", "near the noise"),
    ("Difference in amplitude", "%", "below 30 %"),
    ("Pearson's r over time", "", "above 0.5"),
)


#: Source of the noise that decides which channels count.
NoiseOf = Literal["recording", "limb", "nothing"]
_NOISE_TEXTS: dict[NoiseOf, str] = {
    "recording": "noise from before the response in the recording",
    "limb": "noise of the sensors of the limb, as the recording has none before its response",
    "nothing": "noise not known, so every channel counts",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """Results of the checks of one design.

    Attributes
    ----------
    name, frequency_hz
        Name of its file, and its main frequency; NaN: silent.
    linear, superposed
        Smallest adjusted R² over levels of the prediction, and smallest Pearson's r between the
        sum of the responses to its inputs and the response to all; NaN: there is nothing to check.
    agreement, shift_samples
        Agreement with its recording, None: there is none; samples that the recording was shifted.
    noise_of
        Source of the noise that decides which channels count.
    details
        Lines on recording, limb, scaling, inputs and cautions.
    """

    name: str
    frequency_hz: float
    linear: float
    superposed: float
    agreement: Agreement | None = None
    shift_samples: int = 0
    noise_of: NoiseOf = "nothing"
    details: tuple[str, ...] = ()

    @property
    def noise_text(self) -> str:
        """Source of the noise, as text."""
        return _NOISE_TEXTS[self.noise_of]


def html_of(conditions: Sequence[Condition], limbs: Iterable[str]) -> str:
    """Return the report on some designs on these limbs, as one HTML page.

    Parameters
    ----------
    conditions
        In the order of the table.
    limbs
        Names of the limbs of the designs.
    """
    titles = ", ".join(limb_label(limb).title for limb in sorted(set(limbs)))
    written = f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC"
    about = f"skinsource {__version__}; limb: {titles}; written on {written}"
    measured = [condition for condition in conditions if condition.agreement is not None]
    parts = [
        "<!doctype html><html lang='en'><head><meta charset='utf-8'>",
        f"<title>SkinSource: check</title><style>{_STYLE}</style></head><body>",
        "<h1>Predictions, checked</h1>",
        f"<p class='note'>{escape(about)}</p>",
        _table(conditions),
        *([f"<p class='note'>{escape(_DEFINITIONS)}</p>"] if measured else []),
        *(_plots(measured) if measured else ["<p>No measurement was given.</p>"]),
        *_details(conditions),
        "</body></html>",
    ]
    return "\n".join(parts) + "\n"


def write_report(path: Path, conditions: Sequence[Condition], limbs: Iterable[str]) -> None:
    """Write the report; an existing file is replaced once all of it is written.

    Raises
    ------
    StorageError
        It cannot be written.
    """
    with output_file(path, never) as file:
        file.write(html_of(conditions, limbs).encode())


def summary_lines(conditions: Sequence[Condition]) -> list[str]:
    """Return a line for each condition, for a terminal."""
    lines = []
    for condition in conditions:
        line = f"{condition.name}: {_frequency_text(condition.frequency_hz)}; "
        line += f"linear: adjusted R² {_number_text(condition.linear)}; "
        line += f"superposition: r {_number_text(condition.superposed)}"
        if condition.agreement is not None:
            error, amplitude, correlation = map(_number_text, condition.agreement.medians)
            line += (
                f"; measured: {condition.agreement.counted_text} channels above twice the noise, "
                f"error {error}, amplitude {amplitude} %, r {correlation} ({condition.noise_text})"
            )
        lines.append(line)
    return lines


def quartiles(values: Floats) -> tuple[float, float, float, float, float]:
    """Return whisker, quartile, median, quartile, whisker; whiskers end at data in 1.5 boxes."""
    low, middle, high = (float(quartile) for quartile in np.percentile(values, (25, 50, 75)))
    reach = 1.5 * (high - low)
    inside = values[(values >= low - reach) & (values <= high + reach)]
    return float(inside.min()), low, middle, high, float(inside.max())


def round_ticks(low: float, high: float) -> Floats:
    """Return round numbers at equal steps from ``low`` or just below to ``high`` or just above.

    Steps are 1, 2 or 5 times a power of 10; there are three to nine of them.
    """
    step = 10.0 ** floor(log10((high - low) / _LEAST_STEPS))
    step *= max(
        factor for factor in (1.0, 2.0, 5.0) if (high - low) / (factor * step) >= _LEAST_STEPS
    )
    first, last = floor(low / step + _ROUNDING), ceil(high / step - _ROUNDING)
    # Multiples of the step have digits that rounding added; these are removed.
    digits = max(-floor(log10(step)), 0)
    return np.round(np.arange(first, last + 1) * step, digits)


_DEFINITIONS = (
    "Error: mean over time of |p/P - m/M|, the normalised mean absolute error. Amplitude %: "
    "100 |RMS(p/P) - RMS(m/M)| / RMS(m/M). p: predicted, m: measured; P and M: their RMS, mean "
    "over all channels. Both are medians over the channels that count."
)


def _table(conditions: Sequence[Condition]) -> str:
    head = "<tr><th>Design</th><th>Hz</th><th>Linear, adj. R²</th><th>Superposition, r</th>"
    head += "<th>Channels</th><th>Error</th><th>Amplitude %</th><th>r</th><th>Shift</th></tr>"
    rows = []
    for condition in conditions:
        cells = [
            _frequency_text(condition.frequency_hz).removesuffix(" Hz"),
            _number_text(condition.linear),
        ]
        cells.append(_number_text(condition.superposed))
        if condition.agreement is None:
            cells += ["–"] * 5
        else:
            cells.append(condition.agreement.counted_text)
            cells += [_number_text(value) for value in condition.agreement.medians]
            cells.append(str(condition.shift_samples))
        inner = "".join(f"<td>{cell}</td>" for cell in cells)
        rows.append(f"<tr><td>{escape(condition.name)}</td>{inner}</tr>")
    notes = ["Medians over the channels above twice the noise; shift in samples."]
    measured = [condition for condition in conditions if condition.agreement is not None]
    for noise in dict.fromkeys(condition.noise_text for condition in measured):
        names = ", ".join(condition.name for condition in measured if condition.noise_text == noise)
        notes.append(f"{names}: {noise}.")
    paragraphs = "".join(f"<p class='note'>{escape(note)}</p>" for note in notes)
    return f"<table>{head}{''.join(rows)}</table>{paragraphs}"


def _details(conditions: Sequence[Condition]) -> list[str]:
    """Return a paragraph on the setup of each design, so that reports can be distinguished."""
    parts = []
    for condition in conditions:
        if condition.details:
            lines = "<br>".join(escape(line) for line in condition.details)
            parts.append(f"<h2>{escape(condition.name)}</h2><p class='note'>{lines}</p>")
    return parts


def by_frequency(conditions: Sequence[Condition], figure: int) -> list[tuple[str, Floats]]:
    """Return a figure of all channels that count, by the main frequency of their designs.

    Parameters
    ----------
    conditions
        Results; those without a recording are left out.
    figure
        Number of the figure in `FIGURES`.

    Returns
    -------
    Frequency in Hz as text, and the values, (n,), for each frequency, ascending.
    """
    groups = defaultdict[float, list[Floats]](list)
    for condition in conditions:
        if condition.agreement is not None:
            values = _figure_values(condition.agreement, figure)
            groups[round(condition.frequency_hz, 1)].append(values)
    return [(f"{hz:g}", np.concatenate(values)) for hz, values in sorted(groups.items())]


def _plots(measured: Sequence[Condition]) -> list[str]:
    """Return a box plot of each figure, with a box for each frequency."""
    parts = []
    for k, (title, unit, reported) in enumerate(FIGURES):
        of_unit = f" ({unit})" if unit else ""
        parts.append(f"<h2>{title}{of_unit}</h2><p class='note'>The paper reports: {reported}.</p>")
        parts.append(_box_plot(by_frequency(measured, k)))
    return parts


def _figure_values(agreement: Agreement, k: int) -> Floats:
    chosen = (agreement.error, agreement.amplitude_percent, agreement.correlation)[k]
    return chosen[agreement.counted & np.isfinite(chosen)]


def _box_plot(groups: Sequence[tuple[str, Floats]]) -> str:
    """Return a box plot over frequency as SVG."""
    known = [values for _, values in groups if values.size]
    if not known:
        return "<p>No channel is above twice the noise.</p>"
    drawn = np.array([quartiles(values) for values in known])
    ticks = round_ticks(min(float(drawn.min()), 0.0), max(float(drawn.max()), 1e-9))
    low, high = float(ticks[0]), float(ticks[-1])

    def y(value: float) -> float:
        return _HEIGHT - _FOOT - (value - low) / (high - low) * (_HEIGHT - _FOOT - 10.0)

    step = (_WIDTH - _LEFT - 10.0) / len(groups)
    shapes = [
        f"<text x='{_LEFT - 6}' y='{y(value) + 4:.1f}' text-anchor='end'>{value:g}</text>"
        f"<line x1='{_LEFT}' x2='{_WIDTH}' y1='{y(value):.1f}' y2='{y(value):.1f}' "
        "stroke='#e4e7eb'/>"
        for value in ticks.tolist()
    ]
    for rank, (label, values) in enumerate(groups):
        x = _LEFT + (rank + 0.5) * step
        wide = min(0.5 * step, 40.0)
        shapes.append(f"<text x='{x:.1f}' y='{_HEIGHT - 20}' text-anchor='middle'>{label}</text>")
        if not values.size:
            continue
        first, bottom, middle, top, last = map(y, quartiles(values))
        shapes.append(
            f"<line x1='{x:.1f}' x2='{x:.1f}' y1='{first:.1f}' y2='{last:.1f}' stroke='#57606a'/>"
            f"<rect x='{x - wide / 2:.1f}' y='{top:.1f}' width='{wide:.1f}' "
            f"height='{max(bottom - top, 0.5):.1f}' fill='#cfe3f7' stroke='#0a66c2'/>"
            f"<line x1='{x - wide / 2:.1f}' x2='{x + wide / 2:.1f}' y1='{middle:.1f}' "
            f"y2='{middle:.1f}' stroke='#0a66c2' stroke-width='2'/>"
        )
    shapes.append(
        f"<text x='{(_LEFT + _WIDTH) / 2}' y='{_HEIGHT - 3}' text-anchor='middle'>"
        "Peak frequency (Hz)</text>"
    )
    return (
        f"<svg width='{_WIDTH:g}' height='{_HEIGHT:g}' font-size='12' font-family='sans-serif' "
        f"fill='#1b1f24'>{''.join(shapes)}</svg>{_outlier_note(known, drawn)}"
    )


def _outlier_note(known: Sequence[Floats], drawn: Floats) -> str:
    """Return a note on values beyond the whiskers: drawn, they would flatten the boxes."""
    everything = np.concatenate(known)
    count = sum(
        int(((values < ends[0]) | (values > ends[-1])).sum())
        for values, ends in zip(known, drawn, strict=True)
    )
    if not count:
        return ""
    return (
        f"<p class='note'>{count} of {everything.size} channels lie beyond the whiskers and are "
        f"not drawn; all lie from {everything.min():.3g} to {everything.max():.3g}.</p>"
    )


def _number_text(value: float) -> str:
    return f"{value:.3g}" if np.isfinite(value) else "–"


def _frequency_text(value: float) -> str:
    return f"{value:.1f} Hz" if np.isfinite(value) else "silent"


_LEVELS = (0.25, 0.5, 1.0, 2.0)
# A recording may start this much earlier or later than the prediction.
_MOST_SHIFT_S = 0.2
# More values, 20 000 samples of a published limb, would take gigabytes: all channels are in memory,
# at several levels.
_MOST_VALUES = 20_000 * N_OUTPUTS * N_AXES


@dataclass(frozen=True, slots=True, kw_only=True)
class Recorded:
    """A file with a recording.

    Attributes
    ----------
    path
        A file of responses, see `skinsource.studies.checking.open_recorded`.
    rate_hz
        Rate of a file that states none; None: that of the limb.
    """

    path: Path
    rate_hz: float | None = None


def condition_of(
    design: Design,
    name: str,
    recorded: Recorded | None = None,
    *,
    axes: Axes | Literal[""] = "",
    process: ReadingProcess | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> Condition:
    """Check a design by itself, and against a recording.

    Parameters
    ----------
    design, name
        The design, and its name in the report.
    recorded
        Its recording; None: there is none.
    axes
        Axes that are checked, and recorded; empty: all axes of the limb.
    process
        Reads the recording; a new one unless given.
    progress, stop
        As those of a job.

    Raises
    ------
    InvalidInputError
        The limb has no such axes, or the design is too long for all channels to be compared.
    RecordingError, StorageError
        The recording does not fit, is silent, or cannot be read.
    Stopped
        ``stop`` said so.
    """
    chosen = axes or facts_of(design.limb).axes
    view = View(axes=chosen)
    progress(0, 3, f"Predicting {name}")
    # The recording is compared with the prediction of the studio's graph, which people use.
    wanted = "limb_data", "driven_limb", "response_samples", "stimulus_start_s"
    basis = _evaluate(design, view, stop, *wanted)
    limb = basis["limb_data"]
    n_times = basis["response_samples"]
    most = _MOST_VALUES // (limb.n_outputs * len(chosen))
    if n_times > most:
        raise InvalidInputError(
            f"{quoted(name)} is {n_times / limb.sample_rate_hz:.1f} s long, expected at most "
            f"{most / limb.sample_rate_hz:.1f} s: all channels are compared"
        )
    view = replace(view, outputs=tuple(range(1, limb.n_outputs + 1)))
    predicted = _evaluate(design, view, stop, "axis_traces", "validity")
    field = predicted["axis_traces"]
    progress(1, 3, f"Checking {name}")
    linear, superposed = _linearity_checks(design, view, field, limb.sample_rate_hz, stop)
    played = describe_played(design.limb, limb.note, design.scaling, design.inputs, design.actuated)
    source = "none" if recorded is None else printable(recorded.path.name)
    condition = Condition(
        name=name,
        frequency_hz=_played_frequency(design) or _main_frequency(field, limb.sample_rate_hz),
        linear=linear,
        superposed=superposed,
        details=(
            f"recording: {source}",
            *played,
            f"axes: {label_of(AXES, chosen).both}",
            *findings_lines(predicted["validity"]),
        ),
    )
    if recorded is None:
        return condition
    if not field.any():
        raise InvalidInputError(
            f"{name}: its prediction is silent throughout, so there is nothing to compare. Add an "
            "active input, or check it without a recording."
        )
    progress(2, 3, f"Reading {recorded.path.name}")
    measured = open_recorded(
        recorded.path,
        limb.n_outputs,
        len(chosen),
        limb.sample_rate_hz,
        rate_hz=recorded.rate_hz,
        process=process,
        stop=stop,
    )
    if not measured.any():
        # `agreement` would not name the file, which may be one of many.
        raise RecordingError(
            f"{path_text(Path(recorded.path.name))}: it is silent throughout, so there is nothing "
            "to compare. Choose another recording."
        )
    # A recording begins at about time 0; through actuators a prediction begins before.
    lead = basis["driven_limb"].lead_samples
    from_lead = np.pad(measured, ((0, 0), (0, 0), (lead, 0)))
    shifted, shift = aligned(from_lead, field, round(_MOST_SHIFT_S * limb.sample_rate_hz))
    until_s = basis["stimulus_start_s"] + QUIET_SHARE * limb.pre_trigger_delay_s
    quiet = measured[..., : max(round(until_s * limb.sample_rate_hz) - lead - shift, 0)]
    noise, noise_of = _noise_rms(quiet, design, limb, chosen)
    return replace(
        condition,
        agreement=agreement(field, shifted, noise),
        shift_samples=shift,
        noise_of=noise_of,
    )


def _noise_rms(
    quiet: Floats, design: Design, limb: Limb, axes: str
) -> tuple[Floats | float, NoiseOf]:
    """Return the RMS of the noise of a recording, (n_outputs, n_axes), and its source.

    It is the noise of the limb's measurement where too little of the recording is ``quiet``, and
    0 where neither is known.
    """
    rms = quiet_rms(quiet)
    if rms is not None:
        return rms, "recording"
    places = sorted({track.location for track in audible_inputs(design.inputs)})
    noises = [
        noise for noise in (place_noise(limb, place) for place in places) if noise is not None
    ]
    if not noises:
        return 0.0, "nothing"
    numbers = [limb.axes.index(axis) for axis in axes]
    noise: Floats = np.sqrt(np.mean(np.square(noises), axis=0))[:, numbers]
    return noise, "limb"


def _linearity_checks(
    design: Design, view: View, field: Floats, rate: float, stop: Stop
) -> tuple[float, float]:
    """Return the smallest adjusted R² over levels, and r between the sum of inputs and all."""
    if not field.any():
        return math.nan, math.nan
    in_bands = []
    for level in _LEVELS:
        traces = _evaluate(louder(design, level), view, stop, "axis_traces")["axis_traces"]
        transforms = scipy.fft.rfft(traces)
        band_hz = facts_of(design.limb).band_hz
        in_bands.append(band_rms(transforms, traces.shape[-1], rate, band_hz))
    fit = straightness(_LEVELS, in_bands).adjusted_r2
    audible = audible_inputs(design.inputs)
    if len(audible) < 2:
        return _smallest(fit), math.nan
    parts = []
    for track in audible:
        alone = tuple(
            replace(each, muted=each.id != track.id, solo=False) for each in design.inputs
        )
        trace = _evaluate(replace(design, inputs=alone), view, stop, "axis_traces")["axis_traces"]
        parts.append(trace.reshape(-1, trace.shape[-1]))
    joint = field.reshape(-1, field.shape[-1])
    return _smallest(fit), _smallest(superposition(parts, joint).correlation)


def _smallest(values: Floats) -> float:
    """Return the smallest finite value; NaN: there is none, as of a response without a bin."""
    known = values[np.isfinite(values)]
    return float(known.min()) if known.size else math.nan


def _played_frequency(design: Design) -> float | None:
    """Return the frequency of the tones that are played; None where anything else is."""
    frequencies_hz = {
        clip.waveform.frequency_hz if isinstance(clip.waveform, Tone) and not clip.effects else None
        for clip in played_clips(design)
    }
    return frequencies_hz.pop() if len(frequencies_hz) == 1 else None


def _main_frequency(field: Floats, rate: float) -> float:
    """Return the frequency with the most power over all channels; NaN for silence."""
    power = np.sum(np.square(np.abs(np.fft.rfft(field, axis=-1))), axis=(0, 1))
    return float(dominant_frequency(power, rate / field.shape[-1]))


def _evaluate(design: Design, view: View, stop: Stop, *names: str) -> dict[str, Any]:
    return new_graph().evaluate(names, sources(design, view), stop)


#: Two strengths always lie on a line.
LEAST_STRENGTHS = 3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Proportion:
    """Responses to the same stimulus at several strengths.

    Attributes
    ----------
    strengths : (n_strengths,)
        Amplitudes of the first input, ascending.
    divided : (n_strengths, n_channels, n_times)
        Responses divided by them.
    apart
        Largest difference of these, as a part of their peak; NaN: all are silent.
    rms, line : (n_strengths, n_channels)
        RMS of the responses, and the straight line through them by least squares.
    frequency_hz : (n_bins,)
        Middles of bands of 2 Hz.
    band_rms, band_line : (n_strengths, n_channels, n_bins)
        RMS of the responses in these bands, and the straight line through them.
    adjusted_r2 : (n_channels, n_bins)
        Adjusted R² of these lines; NaN: the band is silent.
    """

    strengths: Floats
    divided: Floats
    largest_difference: float
    rms: Floats
    line: Floats
    frequency_hz: Floats
    band_rms: Floats
    band_line: Floats
    adjusted_r2: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Straightness:
    """Straightness of all outputs over the strengths of an input.

    Attributes
    ----------
    frequency_hz : (n_bins,)
        Middles of bands of 2 Hz.
    adjusted_r2 : (n_outputs, n_axes, n_bins)
        Adjusted R² of straight lines by least squares; NaN: the band is silent.
    """

    frequency_hz: Floats
    adjusted_r2: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Superposition:
    """Responses to inputs alone, and to all of them.

    Attributes
    ----------
    separate, joint : (n_channels, n_times)
        Sum of the responses to each input, and the response to all.
    apart
        Largest difference of the two, as a part of the peak; NaN: all are silent.
    correlation : (n_channels,)
        Pearson's r of the two; NaN where a channel is silent.
    """

    separate: Floats
    joint: Floats
    largest_difference: float
    correlation: Floats


def strengths_of(designs: Sequence[Design]) -> tuple[float, ...]:
    """Return the amplitudes of the first input of designs that differ in strength alone.

    Three of them must be different, else the result is empty.  Titles, markers and loops do not
    matter.
    """
    plain = [_plain_design(design) for design in designs]
    if not plain or not all(design.inputs and design.inputs[0].amplitude > 0.0 for design in plain):
        return ()
    strengths = tuple(design.inputs[0].amplitude for design in plain)
    try:
        scaled = [louder(plain[0], strength / strengths[0]) for strength in strengths]
    except InvalidInputError:
        return ()
    if not all(
        same_but_rounding(design, other) for design, other in zip(scaled, plain, strict=True)
    ):
        return ()
    ordered = sorted(strengths)
    different = 1 + sum(
        not math.isclose(low, high, rel_tol=1e-9) for low, high in pairwise(ordered)
    )
    return strengths if different >= LEAST_STRENGTHS else ()


def joint_of(designs: Sequence[Design]) -> int | None:
    """Return the index of the design that plays the inputs of all others; None: none does."""
    if len(designs) < 3:
        return None
    plain = [_plain_design(design) for design in designs]
    # A design gives ids of its own to the same inputs.
    played = [[_plain_track(track) for track in each.inputs] for each in plain]
    if not all(played) or len({replace(design, inputs=()) for design in plain}) > 1:
        return None
    for k, tracks in enumerate(played):
        others = [track for n, each in enumerate(played) if n != k for track in each]
        if _same_tracks(others, tracks):
            return k
    return None


def proportion(
    strengths: Sequence[float],
    responses: Floats,
    sample_rate_hz: float,
    band_hz: Band | None,
    record_samples: int | None = None,
) -> Proportion:
    """Compare responses, (n_strengths, n_channels, n_times), with the strengths of the input.

    Each RMS is over ``record_samples``; None: over all.
    """
    order = np.argsort(strengths, kind="stable")
    x, y = np.asarray(strengths, float)[order], responses[order]
    divided = y / x[:, None, None]
    over_record = np.sqrt(y.shape[-1] / (record_samples or y.shape[-1]))
    rms = over_record * np.sqrt(np.mean(np.square(y), axis=-1))
    slope, offset, _ = straight_lines(x[:, None], rms)
    transforms = scipy.fft.rfft(y)
    frequency_hz, in_bands = band_rms(transforms, y.shape[-1], sample_rate_hz, band_hz)
    in_bands *= over_record
    levels = x[:, None, None]
    of_band, above, adjusted_r2 = straight_lines(levels, in_bands)
    return Proportion(
        strengths=x,
        divided=divided,
        largest_difference=_largest_difference(divided),
        rms=rms,
        line=offset + slope * x[:, None],
        frequency_hz=frequency_hz,
        band_rms=in_bands,
        band_line=above + of_band * levels,
        adjusted_r2=adjusted_r2,
    )


# Bands that are drawn one by one.
_SHOWN_HZ = (50.0, 100.0, 200.0, 400.0)


def bands_shown(result: Proportion, channel: int) -> list[int]:
    """Return the bands that are drawn one by one: at the frequencies of the figure, not silent."""
    gaps_hz = np.abs(result.frequency_hz - np.array(_SHOWN_HZ)[:, None])
    bands = [int(gap_hz.argmin()) for gap_hz in gaps_hz if gap_hz.size and gap_hz.min() <= BIN_HZ]
    drawn = np.stack((result.band_rms[:, channel], result.band_line[:, channel]))
    return [band for band in bands if drawn[..., band].min() > 0.0]


def straightness(
    strengths: Sequence[float], in_bands: Sequence[tuple[Floats, Floats]]
) -> Straightness:
    """Fit lines over strengths to the quantity ``output_band_rms`` of each strength."""
    frequency_hz = in_bands[0][0]
    y = np.stack([rms for _, rms in in_bands])
    x = np.asarray(strengths, float).reshape(-1, 1, 1, 1)
    return Straightness(frequency_hz=frequency_hz, adjusted_r2=straight_lines(x, y)[2])


def superposition(parts: Sequence[Floats], joint: Floats) -> Superposition:
    """Compare the sum of responses, (n_channels, n_times) each, with the response to all inputs.

    That one is the longest.
    """
    separate = np.zeros(joint.shape)
    for part in parts:
        # A response that ends sooner is silent after that.
        separate[:, : part.shape[-1]] += part
    return Superposition(
        separate=separate,
        joint=joint,
        largest_difference=_largest_difference(np.stack((separate, joint))),
        correlation=pearson(separate, joint),
    )


def _plain_design(design: Design) -> Design:
    """Return a design without its texts, markers, loop, colours and muted inputs."""
    inputs = tuple(_plain_track(track) for track in audible_inputs(design.inputs))
    return replace(
        design,
        title="",
        author="",
        notes="",
        licence="",
        markers=(),
        loop_s=None,
        inputs=inputs,
    )


def _plain_track(track: Input) -> Input:
    clips = tuple(replace(each, id=0) for each in track.clips)
    return replace(track, id=0, colour=0, solo=False, clips=clips)


def _same_tracks(some: Sequence[Input], others: Sequence[Input]) -> bool:
    """Return whether both hold the same inputs, in any order."""
    missing = list(others)
    for track in some:
        if track not in missing:
            return False
        missing.remove(track)
    return not missing


def _largest_difference(curves: Floats) -> float:
    peak = float(np.abs(curves).max())
    return float(np.ptp(curves, axis=0).max()) / peak if peak > 0.0 else math.nan
