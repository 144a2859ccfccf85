"""Checks of designs: linearity, superposition, agreement with recordings, and a report in HTML.

A linear model predicts output in proportion to input, and the sum of what inputs cause alone.
Both are checked in the prediction of one design, and in designs that are snapshots of each other.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from html import escape
from itertools import pairwise
from math import ceil, floor, log10
from pathlib import Path
from typing import Any, Literal

import numpy as np
import scipy

from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError, RecordingError, printable, quoted
from skinsource.base.files import path_text
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.base.measurement_conditions import N_AXES, N_OUTPUTS, Axes, Band
from skinsource.design.comparing import same_but_rounding
from skinsource.design.design import Design, Input, View, audible_inputs, louder
from skinsource.design.labels import AXES, label_of, limb_label
from skinsource.design.waveforms import Tone
from skinsource.engine.analysis_rules import place_noise
from skinsource.engine.quantities import new_graph, sources
from skinsource.export.exported_design import describe_played, output_file
from skinsource.limbs.limb import Limb
from skinsource.limbs.own_limbs import facts_of
from skinsource.perception.validity import findings_lines
from skinsource.readers.reading_process import ReadingProcess
from skinsource.signals.analysis.noise import QUIET_SHARE, quiet_rms
from skinsource.signals.analysis.statistics import band_rms, dominant_frequency
from skinsource.studies.validation import (
    Agreement,
    agreement,
    aligned,
    open_recorded,
    pearson,
    straight_lines,
)
from skinsource.version import __version__

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
    measured = [condition for condition in conditions if condition.agreement is not None]
    groups = []
    for frequency in sorted({round(condition.frequency_hz, 1) for condition in measured}):
        values = [
            _figure_values(condition.agreement, figure)
            for condition in measured
            if round(condition.frequency_hz, 1) == frequency
        ]
        all_values = np.concatenate(values)
        groups.append((f"{frequency:g}", all_values[np.isfinite(all_values)]))
    return groups


def _plots(measured: Sequence[Condition]) -> list[str]:
    """Return a box plot of each figure, with a box for each frequency."""
    parts = []
    for k, (title, unit, reported) in enumerate(FIGURES):
        of_unit = f" ({unit})" if unit else ""
        parts.append(f"<h2>{title}{of_unit}</h2><p class='note'>The paper reports: {reported}.</p>")
        parts.append(_box_plot(by_frequency(measured, k)))
    return parts


def _figure_values(agreement: Agreement | None, k: int) -> Floats:
    if agreement is None:
        return np.zeros(0)
    chosen = (agreement.error, agreement.amplitude_percent, agreement.correlation)[k]
    return chosen[agreement.counted]


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
        A file of responses, see `skinsource.studies.validation.open_recorded`.
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
    basis = _evaluate(design, view, stop, "limb_data", "response_samples", "stimulus_start_s")
    limb = basis["limb_data"]
    _check_length(name, limb, len(chosen), basis["response_samples"])
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
    shifted, shift = aligned(measured, field, round(_MOST_SHIFT_S * limb.sample_rate_hz))
    until_s = basis["stimulus_start_s"] + QUIET_SHARE * limb.pre_trigger_delay_s
    quiet = measured[..., : max(round(until_s * limb.sample_rate_hz) - shift, 0)]
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


def _check_length(name: str, limb: Limb, n_axes: int, n_times: int) -> None:
    most = _MOST_VALUES // (limb.n_outputs * n_axes)
    if n_times > most:
        raise InvalidInputError(
            f"{quoted(name)} is {n_times / limb.sample_rate_hz:.1f} s long, expected at most "
            f"{most / limb.sample_rate_hz:.1f} s: all channels are compared"
        )


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
    clips = [clip for track in audible_inputs(design.inputs) for clip in track.clips]
    frequencies_hz = {
        clip.waveform.frequency_hz if isinstance(clip.waveform, Tone) and not clip.effects else None
        for clip in clips
        if not clip.muted
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
    strengths: Sequence[float], responses: Floats, sample_rate_hz: float, band_hz: Band | None
) -> Proportion:
    """Compare responses, (n_strengths, n_channels, n_times), with the strengths of the input."""
    order = np.argsort(strengths, kind="stable")
    x, y = np.asarray(strengths, float)[order], responses[order]
    divided = y / x[:, None, None]
    rms = np.sqrt(np.mean(np.square(y), axis=-1))
    slope, offset, _ = straight_lines(x[:, None], rms)
    transforms = scipy.fft.rfft(y)
    frequency_hz, in_bands = band_rms(transforms, y.shape[-1], sample_rate_hz, band_hz)
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
