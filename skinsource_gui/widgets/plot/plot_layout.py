"""Where everything around the curves goes, and what it says."""

from dataclasses import dataclass
from math import ceil

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QFontMetricsF

from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.plot.axis_spec import ValueUnit
from skinsource_gui.widgets.plot.ticks import Tick, linear_ticks, readable_ticks
from skinsource_gui.widgets.plot.value_scale import ValueScale

# The left margin grows at once, and shrinks only by more than this.
_MARGIN_SLACK_PX = 12.0
_LEAST_MARGIN_PX = 28.0
# Distances of ticks, in lines of text: preferred, and in rows that would have none otherwise.
_AIRY, _DENSE = 1.8, 1.0
_SYNTHETIC = "SYNTHETIC"


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
    """Everything the layout depends on.

    Attributes
    ----------
    width, height
        Of the widget, px.
    n_rows, scale
        How many rows there are, and where values lie in each.
    stacked
        Whether each curve has a row of its own.
    unit, level
        How values are written; what levels are, or empty where values are none.
    matched
        By how much they are louder or softer than they were stored, or "".
    n_curves, scaling
        How many curves there are, drawn or not; what their height means, longest first.
    words
        Words around the curves.
    """

    width: float
    height: float
    n_rows: int
    scale: ValueScale
    stacked: bool
    unit: ValueUnit
    level: str
    matched: str
    n_curves: int
    scaling: tuple[str, ...]
    words: Words


@dataclass(frozen=True, slots=True, kw_only=True)
class Header:
    """The line above a plot.

    Attributes
    ----------
    unit, scaling
        Above the y axis: the unit, and what heights mean; of these words, longest first, those
        that leave room for a note.
    notes
        Beside them, longest first; the first that fits is written.
    mark, badge
        In the upper right corner: passing and lasting.
    """

    unit: str = ""
    scaling: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    mark: str = ""
    badge: str = ""

    @property
    def whole(self) -> str:
        """All that could be said, for where there is no room to say it."""
        return "\n".join(texts[0] for texts in (self.scaling, self.notes) if texts)

    def said(self, metrics: QFontMetricsF, room_px: float) -> tuple[str, str]:
        """Unit with as many words as fit into ``room_px``, and the note beside it."""
        gap = 2 * UNIT_PX
        # A note is a warning, and goes before the longer words.
        scaling = self.scaling[-1:] if self.notes else self.scaling
        least = min((metrics.horizontalAdvance(note) + gap for note in self.notes), default=0.0)
        units = (*(f"{self.unit} · {words}" for words in scaling), self.unit)
        unit = fitting(units, metrics, room_px - least) or self.unit
        start = metrics.horizontalAdvance(unit) + gap
        return unit, fitting(self.notes, metrics, room_px - start)


@dataclass(frozen=True, slots=True, kw_only=True)
class PlotLayout:
    """Places in pixels of the widget.

    Attributes
    ----------
    width, height
        Of the widget.
    left, top, right, bottom
        Edges of the curves' area.
    n_rows
        Equally high rows in it.
    y_ticks
        Heights in a row (0 to 1) and their labels, the same for each row.
    header
        What is said above.
    """

    width: float
    height: float
    left: float
    top: float
    right: float
    bottom: float
    n_rows: int
    y_ticks: tuple[Tick, ...] = ()
    header: Header = Header()

    @property
    def area(self) -> QRectF:
        """Where the curves are."""
        return QRectF(self.left, self.top, self.right - self.left, self.bottom - self.top)

    def row(self, rank: int) -> QRectF:
        """Where row ``rank``, counted from the top, is."""
        height = (self.bottom - self.top) / self.n_rows
        return QRectF(self.left, self.top + rank * height, self.right - self.left, height)


def laid_out(content: Content, metrics: QFontMetricsF, old_left_px: float) -> PlotLayout:
    """Layout for ``content``; the left margin stays ``old_left_px`` if that is about right."""
    line, words = metrics.height(), content.words
    top = ceil(line) + 4
    bottom = max(content.height - 2 * ceil(line) - 5, top + 1)
    ticks = _y_ticks(content, (bottom - top) / content.n_rows, line)
    left = _left_margin(ticks, metrics, old_left_px)
    margin = ceil(metrics.horizontalAdvance("72") + UNIT_PX if content.stacked else 1.5 * UNIT_PX)
    unread = content.n_rows > 1 and not any(tick.label for tick in ticks)
    hidden = content.n_curves - content.n_rows if content.stacked else 0
    passing = ("updating…" if words.stale else "", f"+{hidden} more" if hidden else "")
    return PlotLayout(
        width=content.width,
        height=content.height,
        left=left,
        top=float(top),
        right=max(content.width - margin, left + 1),
        bottom=float(bottom),
        n_rows=content.n_rows,
        y_ticks=ticks,
        header=Header(
            unit=_unit_words(content, unread=unread),
            scaling=content.scaling,
            notes=words.notes,
            mark=" · ".join(word for word in passing if word),
            badge=_SYNTHETIC if words.synthetic else "",
        ),
    )


def least_size(metrics: QFontMetricsF) -> QSize:
    """Room in which two ticks of each axis can be read."""
    line, number = ceil(metrics.height()), metrics.horizontalAdvance("\u2212100.0")
    around = line + 4 + 2 * line + 5
    return QSize(ceil(4 * number), around + ceil(2 * _AIRY * line))


def fitting(texts: tuple[str, ...], metrics: QFontMetricsF, room_px: float) -> str:
    """First of ``texts`` that fits, or nothing."""
    return next((text for text in texts if metrics.horizontalAdvance(text) <= room_px), "")


def _y_ticks(content: Content, row_px: float, line_px: float) -> tuple[Tick, ...]:
    low, high = content.scale.values
    if content.n_rows == 1:
        most, closest = row_px / (_AIRY * line_px), row_px / (_DENSE * line_px)
        ticks = readable_ticks(low, high, most, closest, content.unit.factor)
        return _in_row(content.scale, ticks)
    airy = linear_ticks(low, high, row_px / (_AIRY * line_px), content.unit.factor)
    dense = linear_ticks(low, high, row_px / (_DENSE * line_px), content.unit.factor)
    for ticks in (airy, dense):
        # Labels of neighbouring rows must not touch.
        fit = tuple(
            tick
            for tick in ticks
            if min(tick.value - low, high - tick.value) / (high - low) * row_px >= 0.4 * line_px
        )
        if len(fit) > 1:
            return _in_row(content.scale, fit)
    return _in_row(content.scale, (Tick(value=0.0, label=""),) if low < 0 < high else ())


def _in_row(scale: ValueScale, ticks: tuple[Tick, ...]) -> tuple[Tick, ...]:
    return tuple(Tick(value=scale.height(tick.value), label=tick.label) for tick in ticks)


def _left_margin(ticks: tuple[Tick, ...], metrics: QFontMetricsF, old_px: float) -> float:
    widest = max((metrics.horizontalAdvance(tick.label) for tick in ticks), default=0.0)
    wanted = max(float(ceil(widest + UNIT_PX)), _LEAST_MARGIN_PX)
    return old_px if wanted <= old_px <= wanted + _MARGIN_SLACK_PX else wanted


def _unit_words(content: Content, *, unread: bool) -> str:
    parts = content.level or content.unit.symbol, content.matched
    symbol = ", ".join(filter(None, parts))
    if not unread:
        return symbol
    # Too thin for ticks: the range is said in words.
    low, high = (value * content.unit.factor for value in content.scale.values)
    span = f"±{high:.4g}" if low == -high else f"{low:.4g} to {high:.4g}"
    return f"{symbol}, each row {span}".replace("-", "\u2212")
