"""Where everything around the curves goes."""

from dataclasses import dataclass
from math import ceil

from PySide6.QtGui import QFontMetricsF

from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.plot.plot_axis import Tick, ValueUnit, linear_ticks, log_ticks
from skinsource_gui.widgets.plot.plot_frame import Frame, Mark
from skinsource_gui.widgets.plot.plot_rows import Rows
from skinsource_gui.widgets.plot.x_window import XWindow

_X_TICK_PX = 60.0
# The left margin grows at once, and shrinks only by more than this.
_MARGIN_SLACK_PX = 12.0
_LEAST_MARGIN_PX = 28.0
# Distances of ticks, in lines of text: preferred, and in rows that would have none otherwise.
_AIRY, _DENSE = 1.8, 1.0
_SYNTHETIC = "SYNTHETIC"
_NOTHING_HERE = "Nothing to see in this part. Press 0 to show everything."


@dataclass(frozen=True, slots=True, kw_only=True)
class Words:
    """Words around the curves.

    Attributes
    ----------
    synthetic
        Whether the curves are of a limb that was not measured.
    notes
        What should be known, longest first.
    stale
        Whether the curves belong to an older design.
    """

    synthetic: bool = False
    notes: tuple[str, ...] = ()
    stale: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Content:
    """Everything the frame depends on.

    Attributes
    ----------
    width, height
        Of the canvas, px.
    window
        Visible part of the x axis.
    rows, stacked
        Rows, and whether each curve has its own.
    unit, level
        How values are written; whether they are levels.
    numbers
        Output number of each curve.
    words
        Words around the curves.
    """

    width: float
    height: float
    window: XWindow
    rows: Rows
    stacked: bool
    unit: ValueUnit
    level: bool
    numbers: tuple[int, ...]
    words: Words


def laid_out(content: Content, metrics: QFontMetricsF, old_left_px: float) -> Frame:
    """Frame for ``content``; the left margin stays ``old_left_px`` if that is about right."""
    line, words = metrics.height(), content.words
    top, bottom = ceil(line) + 4, content.height - 2 * ceil(line) - 5
    height = max(bottom - top, 1)
    row = height / content.rows.count
    ticks = _y_ticks(content, row, line)
    left = _left_margin(ticks, metrics, old_left_px)
    right = metrics.horizontalAdvance("72") + UNIT_PX if content.stacked else 1.5 * UNIT_PX
    width = max(content.width - left - ceil(right), 1)
    plot = (left, float(top), width, float(height))
    unread = content.rows.count > 1 and not any(tick.label for tick in ticks)
    hidden = len(content.numbers) - content.rows.count if content.stacked else 0
    passing = ("updating…" if words.stale else "", f"+{hidden} more" if hidden else "")
    return Frame(
        width=content.width,
        height=content.height,
        plot=plot,
        x_marks=_x_marks(content.window, left, width),
        y_marks=_y_marks(content.rows, ticks, plot),
        row_edges=tuple(top + k * row for k in range(1, content.rows.count)),
        row_numbers=_row_numbers(content, top, row),
        shaded=_shaded(content.window, left, width),
        unit=_unit_words(content, unread=unread),
        notes=words.notes,
        titles=content.window.axis.titles,
        mark=" · ".join(word for word in passing if word),
        badge=_SYNTHETIC if words.synthetic else "",
        hint="" if _overlap(content.window) else _NOTHING_HERE,
    )


def _y_ticks(content: Content, row_px: float, line_px: float) -> tuple[Tick, ...]:
    low, high = content.rows.values
    airy = linear_ticks(low, high, row_px / (_AIRY * line_px), content.unit.factor)
    if content.rows.count == 1:
        return airy
    dense = linear_ticks(low, high, row_px / (_DENSE * line_px), content.unit.factor)
    for ticks in (airy, dense):
        # Labels of neighbouring rows must not touch.
        fit = tuple(
            tick
            for tick in ticks
            if min(tick.value - low, high - tick.value) / (high - low) * row_px >= 0.4 * line_px
        )
        if len(fit) > 1:
            return fit
    return ()


def _y_marks(
    rows: Rows, ticks: tuple[Tick, ...], plot: tuple[float, float, float, float]
) -> tuple[Mark, ...]:
    _, top, _, height = plot
    if not ticks and rows.values[0] < 0 < rows.values[1]:
        ticks = (Tick(value=0.0, label=""),)
    return tuple(
        Mark(at=top + height * (1 - rows.height(tick.value, row) / rows.count), text=tick.label)
        for row in range(rows.count)
        for tick in ticks
    )


def _left_margin(ticks: tuple[Tick, ...], metrics: QFontMetricsF, old_px: float) -> float:
    widest = max((metrics.horizontalAdvance(tick.label) for tick in ticks), default=0.0)
    wanted = max(float(ceil(widest + UNIT_PX)), _LEAST_MARGIN_PX)
    return old_px if wanted <= old_px <= wanted + _MARGIN_SLACK_PX else wanted


def _x_marks(window: XWindow, left: float, width: float) -> tuple[Mark, ...]:
    low, high = window.values(window.shown)
    most = max(width / _X_TICK_PX, 2)
    if window.axis.log:
        ticks = log_ticks(low, high, most)
    else:
        ticks = linear_ticks(low, high, most, window.axis.factor)
    return tuple(
        Mark(at=left + width * window.part(window.axis.position(tick.value)), text=tick.label)
        for tick in ticks
    )


def _row_numbers(content: Content, top: float, row: float) -> tuple[Mark, ...]:
    if not content.stacked:
        return ()
    return tuple(
        Mark(at=top + (k + 0.5) * row, text=str(content.numbers[k]))
        for k in range(content.rows.count)
    )


def _shaded(window: XWindow, left: float, width: float) -> tuple[tuple[float, float], ...]:
    if window.axis.band is None:
        return ()
    start, end = (
        left + width * min(max(window.part(window.axis.position(value)), 0.0), 1.0)
        for value in window.axis.band
    )
    parts = ((left, start - left), (end, left + width - end))
    return tuple(part for part in parts if part[1] > 0)


def _unit_words(content: Content, *, unread: bool) -> str:
    symbol = "dB re 1 m/s²" if content.level else content.unit.symbol
    if not unread:
        return symbol
    # Too thin for ticks: the range is said in words.
    low, high = (value * content.unit.factor for value in content.rows.values)
    span = f"±{high:.4g}" if low == -high else f"{low:.4g} to {high:.4g}"
    return f"{symbol}, each row {span}".replace("-", "\u2212")


def _overlap(window: XWindow) -> bool:
    return window.shown[0] < window.extent[1] and window.extent[0] < window.shown[1]
