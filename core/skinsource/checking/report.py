"""A report on agreement and checks as one HTML page, with box plots drawn in it."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from html import escape
from math import ceil, floor, log10
from pathlib import Path
from typing import Literal

import numpy as np

from skinsource.arrays import Floats
from skinsource.choice_words import limb_word
from skinsource.export.output_file import output_file
from skinsource.job import never
from skinsource.validation.agreement import Agreement
from skinsource.version import __version__

_STYLE = (
    "body{font:15px/1.5 sans-serif;max-width:60em;margin:2em auto;color:#1b1f24}"
    "table{border-collapse:collapse}td,th{padding:.2em .8em;text-align:right;"
    "border-bottom:1px solid #d2d6dc}td:first-child,th:first-child{text-align:left}"
    "svg{display:block;margin:1em 0}.note{color:#57606a}"
)
_WIDTH, _HEIGHT, _LEFT, _FOOT = 620.0, 220.0, 64.0, 40.0
# An axis has so many steps at least; what is so much of a step beyond a tick is on it.
_LEAST_STEPS, _ROUNDING = 3.0, 1e-9
#: Titles of the figures, their units, and what the paper reports.
FIGURES = (
    ("Normalised mean absolute error", "", "near the noise"),
    ("Difference in amplitude", "%", "below 30 %"),
    ("Pearson's r over time", "", "above 0.5"),
)


#: Whose noise tells which channels count.
NoiseOf = Literal["recording", "limb", "nothing"]
_NOISE_WORDS: dict[NoiseOf, str] = {
    "recording": "noise from before the response in the recording",
    "limb": "noise of the sensors of the limb, as the recording has none before its response",
    "nothing": "noise not known, so every channel counts",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """One design.

    Attributes
    ----------
    name, frequency_hz
        Its file, and its main frequency; NaN: silent.
    linear, superposed
        Smallest adjusted R² over levels of the prediction, and smallest Pearson's r between the
        sum of its inputs and all together; NaN where there is nothing to check.
    agreement, shift_samples
        With its measurement, and by how much that was shifted; None: nothing was measured.
    noise_of
        What told the noise that channels are held against.
    details
        Lines on what was checked: recording, limb, scaling, inputs, cautions.
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
    def noise_words(self) -> str:
        """What told the noise, in words."""
        return _NOISE_WORDS[self.noise_of]


def html_of(conditions: Sequence[Condition], limbs: Iterable[str]) -> str:
    """Return the report on some designs on these limbs, as one HTML page.

    Parameters
    ----------
    conditions
        In the order of the table.
    limbs
        Names of the limbs that the designs are on.
    """
    titles = ", ".join(limb_word(limb).title for limb in sorted(set(limbs)))
    written = f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC"
    about = f"skinsource {__version__}; limb: {titles}; written on {written}"
    measured = [one for one in conditions if one.agreement is not None]
    parts = [
        "<!doctype html><html lang='en'><head><meta charset='utf-8'>",
        f"<title>SkinSource: check</title><style>{_STYLE}</style></head><body>",
        "<h1>Predictions, checked</h1>",
        f"<p class='note'>{escape(about)}</p>",
        _table(conditions),
        *([f"<p class='note'>{escape(_DEFINED)}</p>"] if measured else []),
        *(_plots(measured) if measured else ["<p>No measurement was given.</p>"]),
        *_details(conditions),
        "</body></html>",
    ]
    return "\n".join(parts) + "\n"


def write_report(path: Path, conditions: Sequence[Condition], limbs: Iterable[str]) -> None:
    """Write the report; a file that is there is replaced once all of it is written.

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
    for one in conditions:
        said = f"{one.name}: {_hertz(one.frequency_hz)}; linear: adjusted R² {_text(one.linear)}; "
        said += f"superposition: r {_text(one.superposed)}"
        if one.agreement is not None:
            error, amplitude, correlation = one.agreement.medians
            counted = f"{int(one.agreement.counted.sum())} of {one.agreement.counted.size}"
            said += (
                f"; measured: {counted} channels above twice the noise, error {_text(error)}, "
                f"amplitude {_text(amplitude)} %, r {_text(correlation)} ({one.noise_words})"
            )
        lines.append(said)
    return lines


def quartiles(values: Floats) -> tuple[float, float, float, float, float]:
    """Return whisker, quartile, median, quartile, whisker; these end at data within 1.5 boxes."""
    low, middle, high = (float(one) for one in np.percentile(values, (25, 50, 75)))
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
    # Of whole numbers of steps the digits that rounding adds are taken off again.
    digits = max(-floor(log10(step)), 0)
    return np.round(np.arange(first, last + 1) * step, digits)


_DEFINED = (
    "Error: mean over time of |p/P - m/M|, the normalised mean absolute error. Amplitude %: "
    "100 |RMS(p/P) - RMS(m/M)| / RMS(m/M). p: predicted, m: measured; P and M: their RMS, mean "
    "over all channels. Both are medians over the channels that count."
)


def _table(conditions: Sequence[Condition]) -> str:
    head = "<tr><th>Design</th><th>Hz</th><th>Linear, adj. R²</th><th>Superposition, r</th>"
    head += "<th>Channels</th><th>Error</th><th>Amplitude %</th><th>r</th><th>Shift</th></tr>"
    rows = []
    for one in conditions:
        cells = [_hertz(one.frequency_hz).removesuffix(" Hz"), _text(one.linear)]
        cells.append(_text(one.superposed))
        if one.agreement is None:
            cells += ["–"] * 5
        else:
            cells.append(f"{int(one.agreement.counted.sum())} of {one.agreement.counted.size}")
            cells += [_text(value) for value in one.agreement.medians]
            cells.append(str(one.shift_samples))
        inner = "".join(f"<td>{cell}</td>" for cell in cells)
        rows.append(f"<tr><td>{escape(one.name)}</td>{inner}</tr>")
    notes = ["Medians over the channels above twice the noise; shift in samples."]
    measured = [one for one in conditions if one.agreement is not None]
    for words in dict.fromkeys(one.noise_words for one in measured):
        names = ", ".join(one.name for one in measured if one.noise_words == words)
        notes.append(f"{names}: {words}.")
    said = "".join(f"<p class='note'>{escape(one)}</p>" for one in notes)
    return f"<table>{head}{''.join(rows)}</table>{said}"


def _details(conditions: Sequence[Condition]) -> list[str]:
    """What was checked, so that a report can be told from one on something else."""
    parts = []
    for one in conditions:
        if one.details:
            lines = "<br>".join(escape(line) for line in one.details)
            parts.append(f"<h2>{escape(one.name)}</h2><p class='note'>{lines}</p>")
    return parts


def by_frequency(conditions: Sequence[Condition], figure: int) -> list[tuple[str, Floats]]:
    """Return a figure of all channels that count, by the main frequency of their designs.

    Parameters
    ----------
    conditions
        Those without a measurement are left out.
    figure
        Number of the figure in `FIGURES`.

    Returns
    -------
    Frequency in Hz as text, and the values, (n,), for each frequency, ascending.
    """
    measured = [one for one in conditions if one.agreement is not None]
    groups = []
    for frequency in sorted({round(one.frequency_hz, 1) for one in measured}):
        values = [
            _figure(one.agreement, figure)
            for one in measured
            if round(one.frequency_hz, 1) == frequency
        ]
        together = np.concatenate(values)
        groups.append((f"{frequency:g}", together[np.isfinite(together)]))
    return groups


def _plots(measured: Sequence[Condition]) -> list[str]:
    """A box plot of each figure, a box for each frequency."""
    parts = []
    for k, (title, unit, reported) in enumerate(FIGURES):
        of_unit = f" ({unit})" if unit else ""
        parts.append(f"<h2>{title}{of_unit}</h2><p class='note'>The paper reports: {reported}.</p>")
        parts.append(_boxes(by_frequency(measured, k)))
    return parts


def _figure(found: Agreement | None, k: int) -> Floats:
    if found is None:
        return np.zeros(0)
    chosen = (found.error, found.amplitude_percent, found.correlation)[k]
    return chosen[found.counted]


def _boxes(groups: Sequence[tuple[str, Floats]]) -> str:
    """Box plots over frequency as SVG."""
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
        ends = quartiles(values)
        first, bottom, middle, top, last = (y(one) for one in ends)
        shapes.append(
            f"<line x1='{x:.1f}' x2='{x:.1f}' y1='{first:.1f}' y2='{last:.1f}' stroke='#57606a'/>"
            f"<rect x='{x - wide / 2:.1f}' y='{top:.1f}' width='{wide:.1f}' "
            f"height='{max(bottom - top, 0.5):.1f}' fill='#cfe3f7' stroke='#0a66c2'/>"
            f"<line x1='{x - wide / 2:.1f}' x2='{x + wide / 2:.1f}' y1='{middle:.1f}' "
            f"y2='{middle:.1f}' stroke='#0a66c2' stroke-width='2'/>"
        )
    shapes.append(
        f"<text x='{(_LEFT + _WIDTH) / 2}' y='{_HEIGHT - 3}' text-anchor='middle'>"
        "Main frequency (Hz)</text>"
    )
    return (
        f"<svg width='{_WIDTH:g}' height='{_HEIGHT:g}' font-size='12' font-family='sans-serif' "
        f"fill='#1b1f24'>{''.join(shapes)}</svg>{_beyond(known, drawn)}"
    )


def _beyond(known: Sequence[Floats], drawn: Floats) -> str:
    """What is not drawn: values beyond the whiskers, which would flatten the boxes."""
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


def _text(value: float) -> str:
    return f"{value:.3g}" if np.isfinite(value) else "–"


def _hertz(value: float) -> str:
    return f"{value:.1f} Hz" if np.isfinite(value) else "silent"
