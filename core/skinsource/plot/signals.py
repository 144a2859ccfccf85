"""Traces and spectra of outputs."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.choice_words import signal_words
from skinsource.design import Design
from skinsource.errors import InvalidInputError
from skinsource.evaluation import evaluate
from skinsource.own_limbs import facts_of
from skinsource.plot.paper import DIM, SYNTHETIC, axes_of, style
from skinsource.plot.rows import Row, common_size, draw_rows, say_scale
from skinsource.quoting import quoted
from skinsource.resampling import extremes_between, finer
from skinsource.spectra import mean_of_bins as moving_mean
from skinsource.view import View

_WIDTH_MM, _ROW_MM, _AROUND_MM = 130.0, 13.0, 26.0
_NEEDS = "response_time_s", "axis_traces", "selected_projection"
# Of more samples a page shows no single wave, but how far waves reach: in more columns than a page
# of two columns has dots of 600 in an inch.
_MOST_JOINED, _N_COLUMNS = 20_000, 4096


def traces(
    shown: Design | Sequence[Design],
    *,
    view: View | None = None,
    outputs: Sequence[int] | None = None,
    labels: Sequence[str] = (),
    normalised: bool = False,
    title: str = "",
    ax: Any = None,
) -> Any:
    """Draw what outputs do over time, a row for each.

    Up to 20 000 samples are joined by the band-limited wave through them, not by straight lines;
    of more, how far that wave reaches is drawn in 4096 columns.

    Parameters
    ----------
    shown
        A design, or several that are drawn over each other.
    view
        Axes, method, range of times, and whether the pre-trigger delay is removed.
    outputs
        Which outputs; those of the view unless given.
    labels
        Of the designs, for a legend.
    normalised
        Whether each row is scaled to its own peak; all have one scale otherwise.
    title
        Stands above.
    ax
        Axes to draw into; a figure of its own where none is given.

    Returns
    -------
    The figure.

    Raises
    ------
    InvalidInputError
        There is nothing to draw, or the limb does not have such outputs.
    MissingExtraError
        matplotlib is not installed.
    """
    designs, looked = _designs(shown, labels), _looked(view, outputs)
    found = [evaluate(one, *_NEEDS, view=looked) for one in designs]
    time_s, curves = _waves(found, looked.time_range_s)
    rows = _rows(1e3 * time_s, curves, looked.outputs, normalised)
    on, alone = axes_of(ax, _WIDTH_MM, _ROW_MM * len(rows) + _AROUND_MM)
    with style():
        draw_rows(on, rows, labels=labels, title=title, legend_apart=True)
        on.set_xlabel(_time_words(looked))
        say_scale(on, _scale_words(rows, normalised, looked))
        _finish(on, designs, alone)
    return on.figure


def spectra(
    shown: Design | Sequence[Design],
    *,
    view: View | None = None,
    outputs: Sequence[int] | None = None,
    labels: Sequence[str] = (),
    normalised: bool = False,
    mean_of_bins: int = 1,
    title: str = "",
    ax: Any = None,
) -> Any:
    """Draw magnitude spectra of outputs in the band of the limb, a row for each.

    Parameters
    ----------
    mean_of_bins
        How many bins of the spectrum are averaged, 1: none.
    shown, view, outputs, labels, normalised, title, ax
        As of `traces`.

    Returns
    -------
    The figure.

    Raises
    ------
    InvalidInputError
        There is nothing to draw, or the limb does not have such outputs.
    MissingExtraError
        matplotlib is not installed.
    """
    designs, looked = _designs(shown, labels), _looked(view, outputs)
    found = [evaluate(one, "selected_spectra", view=looked)["selected_spectra"] for one in designs]
    if len({frequency.size for frequency, _ in found}) > 1:
        raise InvalidInputError(
            "the designs differ in length, so their spectra have other frequencies; draw each in "
            "axes of its own"
        )
    frequency = found[0][0]
    low_hz, high_hz = facts_of(designs[0].limb).band_hz or (0.0, np.inf)
    within = (frequency >= low_hz) & (frequency <= high_hz)
    curves = [moving_mean(magnitude, mean_of_bins)[:, within] for _, magnitude in found]
    rows = _rows(frequency[within], curves, looked.outputs, normalised)
    on, alone = axes_of(ax, _WIDTH_MM, _ROW_MM * len(rows) + _AROUND_MM)
    with style():
        draw_rows(on, rows, labels=labels, title=title, from_zero=True, legend_apart=True)
        on.set_xlabel("Frequency (Hz)")
        words = _scale_words(rows, normalised, looked)
        say_scale(on, f"{words}; mean of {mean_of_bins} bins" if mean_of_bins > 1 else words)
        _finish(on, designs, alone)
    return on.figure


def _designs(shown: Design | Sequence[Design], labels: Sequence[str]) -> list[Design]:
    designs = [shown] if isinstance(shown, Design) else list(shown)
    if not designs or not all(isinstance(one, Design) for one in designs):
        raise InvalidInputError(f"shown is {quoted(shown)}, expected a Design, or several")
    if labels and len(labels) != len(designs):
        raise InvalidInputError(f"{len(labels)} labels for {len(designs)} designs: one for each")
    return designs


def _looked(view: View | None, outputs: Sequence[int] | None) -> View:
    looked = View() if view is None else view
    looked = looked if outputs is None else replace(looked, outputs=tuple(outputs))
    if not looked.outputs:
        raise InvalidInputError("no output is selected; name some: outputs=(19, 21)")
    return looked


def _filled(traces: Floats, n_times: int) -> Floats:
    """Shorter responses are silent at the end."""
    return np.pad(traces, ((0, 0), (0, 0), (0, n_times - traces.shape[-1])))


def _waves(
    found: Sequence[Mapping[str, Any]], range_s: tuple[float, float] | None
) -> tuple[Floats, list[Floats]]:
    """Instants in a range, all unless given, and projected signals of designs at them.

    The wave runs along the axes: a magnitude is its length.
    """
    time_s = max(found, key=lambda one: one["response_time_s"].size)["response_time_s"]
    low, high = range_s or (float(time_s[0]), float(time_s[-1]))
    within = np.flatnonzero((time_s >= low) & (time_s <= high))
    if not within.size:
        raise InvalidInputError(
            f"view.time_range_s is {quoted(range_s)}, but the response lies between "
            f"{time_s[0]:g} and {time_s[-1]:g} s"
        )
    first, end = int(within[0]), int(within[-1]) + 1
    drawn = _joined if end - first <= _MOST_JOINED else _reached
    each = [drawn(one, time_s, first, end) for one in found]
    return each[0][0], [curves for _, curves in each]


def _joined(one: Mapping[str, Any], time_s: Floats, first: int, end: int) -> tuple[Floats, Floats]:
    """Points of the waves between samples."""
    axes = _filled(one["axis_traces"], time_s.size)
    instants, axes = finer(time_s, axes, first, end)
    return instants, one["selected_projection"].signals(axes)


def _reached(one: Mapping[str, Any], time_s: Floats, first: int, end: int) -> tuple[Floats, Floats]:
    """Lowest and highest value of the waves in columns, in turn."""
    axes, projection = _filled(one["axis_traces"], time_s.size), one["selected_projection"]
    # A magnitude is the length of the wave along the axes.
    waves = axes if projection.directions is None else projection.signals(axes)
    starts = np.arange(_N_COLUMNS) * (end - first) // _N_COLUMNS
    low, high = extremes_between(waves, first, end).of_columns(starts)
    curves = np.stack((low, high), axis=-1).reshape(len(low), -1)
    return np.repeat(time_s[first + starts], 2), curves


def _rows(
    x: Floats, curves: Sequence[Floats], outputs: Sequence[int], normalised: bool
) -> list[Row]:
    size = None if normalised else common_size(curves)
    return [
        Row(
            label=f"Output {number}",
            x=x,
            curves=np.stack([one[rank] for one in curves]),
            unit_size=size,
        )
        for rank, number in enumerate(outputs)
    ]


def _time_words(view: View) -> str:
    return "Time (ms), pre-trigger delay removed" if view.delay_removed else "Time (ms)"


def _scale_words(rows: Sequence[Row], normalised: bool, view: View) -> str:
    what = signal_words(view.axes, view.method)
    if normalised:
        return f"{what}; each row relative to its peak"
    return f"{what}; a row is {rows[0].size:.3g} m/s² high"


def _finish(ax: Any, designs: Sequence[Design], alone: bool) -> None:
    if not alone:
        return
    if any(facts_of(one.limb).synthetic for one in designs):
        ax.figure.text(0.99, 0.01, SYNTHETIC, ha="right", color=DIM, fontsize=6)
    ax.figure.subplots_adjust(left=0.14, right=0.97, bottom=0.17, top=0.88)
