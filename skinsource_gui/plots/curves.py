"""Curves of a plot of signals, what of them is drawn, and the layout and texts around them."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np
import pyqtgraph
from pyqtgraph.functions import arrayToQPath, arrayToQPolygonF
from PySide6 import QtGui
from PySide6.QtCore import QRectF, QSize, Qt

from skinsource.base.conventions import Floats
from skinsource.limbs.locations import LocationNames, output_name
from skinsource.signals.resampling import Extremes
from skinsource_gui.plots.ranges import (
    Columns,
    Kind,
    Points,
    Range,
    Tick,
    ValueScale,
    ValueUnit,
    Wave,
    XWindow,
    columns_of,
    in_rows,
    linear_ticks,
    readable_ticks,
    significant,
    value_unit,
    without_notches,
)
from skinsource_gui.qt.theme import UNIT_PX, current_theme, is_on_paper

#: What levels are, unless curves say otherwise.
LEVEL_TEXT = "dB re 1 m/s²"


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveName:
    """Number and names of an output: ``29``, ``"II nail rad."``, ``"Digit II, ..."``.

    A curve that is not of an output has the number 0 and is told by its short name.  One that is
    ``noisy`` is less than 6 dB above the noise, and pale.
    """

    number: int
    short: str
    full: str
    noisy: bool = False

    def colour(self, usual: QtGui.QColor) -> QtGui.QColor:
        """Return the colour of the curve, given the usual one of its rank."""
        return current_theme().pale(usual) if self.noisy else usual


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured:
    """What lies between two cursors.

    Attributes
    ----------
    distance
        Where both stand, and from the first to the second: "8.0 to 20.0 ms, Δt 12.0 ms".
    meaning, readings : (n_curves,)
        What each curve does between them, in a few characters, and what these are.
    details : (n_curves,)
        The same with all numbers and units.
    """

    distance: str
    meaning: str
    readings: tuple[str, ...]
    details: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Curves:
    """Curves over one x axis: one for each name, or one for each name along each axis.

    Attributes
    ----------
    x : (n_points,)
        Rising, SI.
    y : (n_curves, n_points)
        m/s², levels in dB, or parts of the peak of each.
    names : (n_names,)
        Names of the curves; the rank of a name is its colour.
    axes
        Axes of the sensors along which each name has a curve, one after the other; their ranks are
        their colours; none: each name has one curve, of the axes that are chosen.
    span
        Lowest and highest value that shall be visible; None: all are.
    level_words
        What levels are, where ``y`` holds them.
    scaling
        What heights mean, beside their unit, longest first.
    columns : (n_curves,)
        Headers of the columns of a table; none: output and unit.
    about
        Returns lines for the head of a table.
    heading
        Parts of the heading of a picture.
    peaks : (n_names,)
        What the curves of each name were divided by, m/s², where they are relative to its peak;
        none elsewhere.
    matched
        By how much they are shown louder or softer to match a snapshot, or "".
    wave
        The wave through the points; None: nothing is known between them.
    measure
        Measures what lies between two positions, SI; None: nothing can be measured.
    """

    x: Floats
    y: Floats
    names: tuple[CurveName, ...]
    axes: tuple[str, ...] = ()
    kind: Kind = "amplitude"
    span: Range | None = None
    level_text: str = LEVEL_TEXT
    scaling: tuple[str, ...] = ()
    columns: tuple[str, ...] = ()
    about: Callable[[], tuple[str, ...]] = tuple
    heading: tuple[str, ...] = ()
    peaks: tuple[float, ...] = ()
    matched: str = ""
    wave: Wave | None = None
    measure: Callable[[Range], Measured] | None = None

    @property
    def reach(self) -> Range:
        """Lowest and highest value of all curves, and of the wave where it is known."""
        low, high = float(self.y.min()), float(self.y.max())
        finite = np.isfinite(low) and np.isfinite(high)
        extremes = None if self.wave is None or not finite else self.wave.extremes(0, self.x.size)
        if extremes is None:
            return low, high
        wave_low, wave_high = extremes.range
        return min(low, wave_low), max(high, wave_high)

    @property
    def x_range(self) -> Range:
        """First and last position, SI."""
        return (float(self.x[0]), float(self.x[-1]))

    @property
    def peak_texts(self) -> tuple[str, ...]:
        """Peak of each name, as digits in `peak_unit`; none where curves keep their height."""
        factor = self.peak_unit.factor
        return tuple(significant(peak * factor) for peak in self.peaks)

    @property
    def peak_unit(self) -> ValueUnit:
        """Unit in which the largest peak reads well."""
        return value_unit("amplitude", 0.0, max(self.peaks, default=0.0))

    @property
    def each(self) -> int:
        """How many curves each name has."""
        return max(len(self.axes), 1)

    def n_drawn(self, n_rows: int, *, stacked: bool) -> int:
        """Return how many curves are drawn: those of the first ``n_rows`` names, or all in one."""
        return (n_rows if stacked else len(self.names)) * self.each

    def nearest(self, x: float) -> int:
        """Return the index of the point nearest to ``x``."""
        right = int(np.clip(np.searchsorted(self.x, x), 1, max(self.x.size - 1, 1)))
        if right >= self.x.size:
            return 0
        return right - 1 if x - self.x[right - 1] <= self.x[right] - x else right


def output_names(outputs: tuple[int, ...], limb: str) -> tuple[CurveName, ...]:
    """Return the names of the curves of ``outputs`` of a limb."""
    locations = [output_name(output, limb) for output in outputs]
    return tuple(
        CurveName(number=location.number, short=_short_name(location), full=location.name)
        for location in locations
    )


def _short_name(location: LocationNames) -> str:
    """Return the short name of an output, or "" where a lab gave it none."""
    return "" if location.short_name == f"output {location.number}" else location.short_name


# Vertical strokes that are longer than this on average fill a block.
_BLOCK_PX = 4.0
# Above the first distance between points, in device pixels, the wave is drawn; above the second, in
# px, each point is marked.
_WAVE_PX, _DOTS_PX = 2.0, 8.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CurvePoints:
    """What is drawn of a curve.

    Attributes
    ----------
    x : (n_points,)
        Positions on the x axis.
    y : (n_points,)
        Heights in the row, 0 to 1.
    smooth
        Whether it is antialiased; in a block nobody would see that, and it takes twice as long.
    dots
        Positions and heights of marked points, (n_dots,) each; None: none are.
    """

    x: Floats
    y: Floats
    smooth: bool
    dots: tuple[Floats, Floats] | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class VisibleRange:
    """The visible part of curves, in their own unit.

    Attributes
    ----------
    line
        Points that are joined; x are positions on the x axis.
    wave
        Whether they show the wave through the points of the curves.
    dots
        The points of the curves, where each is marked.
    """

    line: Points
    wave: bool = False
    dots: Points | None = None

    @property
    def extremes(self) -> Range | None:
        """Lowest and highest value; None where nothing is visible."""
        y = self.line.y
        return (float(y.min()), float(y.max())) if y.size else None

    def beyond(self, values: Range) -> Range | None:
        """Return the extremes of a wave that exceeds ``values``, as it may between points."""
        extremes = self.extremes if self.wave else None
        return (
            extremes if extremes and (extremes[0] < values[0] or extremes[1] > values[1]) else None
        )


def visible_range(
    curves: Curves,
    window: XWindow,
    n_drawn: int,
    row: QRectF,
    ratio: float,
) -> VisibleRange:
    """Return the visible part of the first ``n_drawn`` curves.

    Straight lines between points would cut the peaks of the wave.  With two pixels or more for each
    point the wave itself is drawn, with fewer its extremes.

    Parameters
    ----------
    curves, window, n_drawn
        The curves, and the visible part of their x axis.
    row, ratio
        Area of a row, px, and device pixels per px.
    """
    x, y = window.axis.positions(curves.x), curves.y[:n_drawn]
    if window.axis.log:
        x, y = x[curves.x > 0], y[:, curves.x > 0]
    wave = None if curves.wave is None else _visible_wave(curves.wave, window, n_drawn)
    visible = columns_of(x, window.shown, int(row.width() * ratio))
    return visible_course(visible, y, wave, row.width(), ratio)


def _visible_wave(wave: Wave, window: XWindow, n_drawn: int) -> Wave:
    """Return the wave of the first curves, at positions of the axis."""

    def points(first: int, end: int) -> tuple[Floats, Floats]:
        x, y = wave.points(first, end)
        return window.axis.positions(x), y[:n_drawn]

    def extremes(first: int, end: int) -> Extremes | None:
        extremes_of_all = wave.extremes(first, end)
        return None if extremes_of_all is None else extremes_of_all.of_first(n_drawn)

    return Wave(points=points, extremes=extremes)


def visible_course(
    columns: Columns, y: Floats, wave: Wave | None, width_px: float, ratio: float
) -> VisibleRange:
    """Return the visible part of curves ``y``, (n_curves, n_points), of known ``columns``.

    Parameters
    ----------
    wave
        The wave through the points, in the unit of their axis; None: it is not known.
    width_px, ratio
        Visible width, px, and device pixels per px.
    """
    if wave is None:
        return VisibleRange(line=columns.points(y))
    part = columns.part.start, columns.part.stop
    apart_px = width_px / max(part[1] - part[0], 1)
    if columns.starts is not None or apart_px * ratio < _WAVE_PX:
        extremes = wave.extremes(*part)
        if extremes is None:
            return VisibleRange(line=columns.points(y))
        return VisibleRange(line=columns.reached(y, extremes), wave=True)
    instants, waves = wave.points(*part)
    dots = columns.points(y) if apart_px >= _DOTS_PX else None
    return VisibleRange(line=Points(x=instants, y=waves), wave=True, dots=dots)


def curve_points(
    visible: VisibleRange, scale: ValueScale, rows: list[QRectF], ratio: float
) -> tuple[CurvePoints, ...]:
    """Return what is drawn of each curve, in heights of its row.

    Parameters
    ----------
    visible, scale
        The visible part of the curves, and where values lie in a row.
    rows
        Area of the row of each curve, px.
    ratio
        Device pixels per px.
    """
    points = visible.line
    heights = scale.heights(points.y)
    blocks = np.zeros(len(rows), dtype=bool)
    if points.strokes:
        heights = without_notches(heights)
        row_px = np.array([row.height() for row in rows])
        strokes = np.abs(heights[:, 1::2] - heights[:, ::2]).mean(axis=1) * row_px
        blocks = strokes > _BLOCK_PX
        bottom = np.array([row.bottom() for row in rows])[blocks, np.newaxis]
        row_px = row_px[blocks, np.newaxis]
        heights[blocks] = (bottom - in_rows(bottom - row_px * heights[blocks], ratio)) / row_px
    dots = None if visible.dots is None else scale.heights(visible.dots.y)
    return tuple(
        CurvePoints(
            x=points.x,
            y=line,
            smooth=not block,
            dots=None if dots is None or visible.dots is None else (visible.dots.x, dots[rank]),
        )
        for rank, (line, block) in enumerate(zip(heights, blocks.tolist(), strict=True))
    )


_STALE_OPACITY = 0.5
_DOT_PX = 2.0
_PAPER_LINE_PX = 1.0


class SignalCurve(pyqtgraph.GraphicsObject):
    """One curve of a plot, of points that were already thinned out to what is visible.

    It is as large as its view, takes part in no range, and leaves the mouse to the view.
    (pyqtgraph's own curve measures itself at each change: half a millisecond for a dozen curves.)
    """

    def __init__(self) -> None:
        super().__init__()
        self.points: CurvePoints | None = None
        self.pen = QtGui.QPen()
        self.dots: QtGui.QPolygonF | None = None
        self._bounds = QRectF()
        self._line: QtGui.QPolygonF | None = None
        self._path: QtGui.QPainterPath | None = None

    def show_points(self, points: CurvePoints) -> None:
        """Draw ``points``."""
        self.points = points
        self.dots = None if points.dots is None else arrayToQPolygonF(*points.dots)
        if points.smooth:
            # A tenth quicker than a path.
            self._line, self._path = arrayToQPolygonF(points.x, points.y), None
        else:
            # As a path: Qt leaves gaps in a polyline of upright strokes.
            self._line = None
            self._path = arrayToQPath(points.x, points.y, finiteCheck=False)
        self.update()

    def set_look(self, pen: QtGui.QPen, *, stale: bool) -> None:
        """Set colour and strokes of the curve, and whether it is pale."""
        self.pen = pen
        self.setOpacity(_STALE_OPACITY if stale else 1.0)
        self.update()

    def boundingRect(self) -> QRectF:
        return self._bounds

    def shape(self) -> QtGui.QPainterPath:
        return QtGui.QPainterPath()

    def viewTransformChanged(self) -> None:
        # The bounds are those of the view; Qt asks for them three times for each picture.
        self.prepareGeometryChange()
        view = self.getViewBox()
        self._bounds = QRectF() if view is None else view.viewRect()

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
        painter.setPen(self.pen)
        if is_on_paper():
            with self._in_scene(painter) as to_scene:
                self._paint_wide(painter, to_scene)
        else:
            painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing, self._line is not None)
            if self._line is not None:
                painter.drawPolyline(self._line)
            elif self._path is not None:
                painter.drawPath(self._path)
        if self.dots is not None:
            with self._in_scene(painter) as to_scene:
                self._paint_dots(painter, to_scene.map(self.dots))

    @contextmanager
    def _in_scene(self, painter: QtGui.QPainter) -> Iterator[QtGui.QTransform]:
        """Paint in pixels of the scene: in the stretched view, dots would be strokes."""
        to_scene = self.sceneTransform()
        painter.save()
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.setWorldTransform(to_scene.inverted()[0] * painter.worldTransform())
        yield to_scene
        painter.restore()

    def _paint_wide(self, painter: QtGui.QPainter, to_scene: QtGui.QTransform) -> None:
        pen = QtGui.QPen(self.pen)
        pen.setWidthF(_PAPER_LINE_PX)
        painter.setPen(pen)
        if self._line is not None:
            painter.drawPolyline(to_scene.map(self._line))
        elif self._path is not None:
            painter.drawPath(to_scene.map(self._path))

    def _paint_dots(self, painter: QtGui.QPainter, dots: QtGui.QPolygonF) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self.pen.color())
        for dot in dots.toList():
            painter.drawEllipse(dot, _DOT_PX, _DOT_PX)


# The left margin grows at once, and shrinks only by more than this.
_MARGIN_SLACK_PX = 12.0
_LEAST_MARGIN_PX = 28.0
# Distances of ticks, in lines of text: preferred, and in rows that would otherwise have none.
_AIRY, _DENSE = 1.8, 1.0
_SYNTHETIC = "SYNTHETIC"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlotTexts:
    """Texts around the curves.

    Attributes
    ----------
    synthetic
        Whether the curves are of a limb that was not measured.
    notes
        Versions of a warning, longest first.
    stale
        Whether the curves belong to an older design.
    """

    synthetic: bool = False
    notes: tuple[str, ...] = ()
    stale: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class PlotContent:
    """Everything that the layout depends on.

    Attributes
    ----------
    width, height
        Size of the widget, px.
    scale
        Where values lie in each row.
    stacked
        Whether each curve has a row of its own.
    unit, level
        How values are written; what levels are, or "" for other values.
    matched
        By how much curves are louder or softer than stored, or "".
    n_curves, scaling
        Number of all curves, drawn or not; what their height means, longest first.
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
    texts: PlotTexts


@dataclass(frozen=True, slots=True, kw_only=True)
class Header:
    """The line above a plot.

    Attributes
    ----------
    unit, scaling
        Above the y axis: the unit, and what heights mean, longest first.
    notes
        Beside them, longest first; the first that fits is written.
    mark, badge
        In the upper right corner: a passing mark and a lasting one.
    """

    unit: str = ""
    scaling: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    mark: str = ""
    badge: str = ""

    @property
    def whole(self) -> str:
        """The longest texts, for a tooltip."""
        return "\n".join(texts[0] for texts in (self.scaling, self.notes) if texts)

    def fitted(self, metrics: QtGui.QFontMetricsF, room_px: float) -> tuple[str, str]:
        """Return the unit with the longest scaling that fits ``room_px``, and the note."""
        gap = 2 * UNIT_PX
        # A note is a warning: it has priority over the longer texts.
        scaling = self.scaling[-1:] if self.notes else self.scaling
        least = min((metrics.horizontalAdvance(note) + gap for note in self.notes), default=0.0)
        units = (*(f"{self.unit} · {text}" for text in scaling), self.unit)
        unit = fitting(units, metrics, room_px - least) or self.unit
        start = metrics.horizontalAdvance(unit) + gap
        return unit, fitting(self.notes, metrics, room_px - start)


@dataclass(frozen=True, slots=True, kw_only=True)
class PlotLayout:
    """Places in px of the widget.

    Attributes
    ----------
    width, height
        Size of the widget.
    left, top, right, bottom
        Edges of the area of the curves, which has ``n_rows`` equally high rows.
    y_ticks
        Heights in a row (0 to 1) and their labels, the same for each row.
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
        """Area of the curves."""
        return QRectF(self.left, self.top, self.right - self.left, self.bottom - self.top)

    def row(self, rank: int) -> QRectF:
        """Return the area of row ``rank``, counted from the top."""
        height = (self.bottom - self.top) / self.n_rows
        return QRectF(self.left, self.top + rank * height, self.right - self.left, height)


def laid_out(content: PlotContent, metrics: QtGui.QFontMetricsF, old_left_px: float) -> PlotLayout:
    """Return the layout for ``content``; the left margin stays ``old_left_px`` if it still fits."""
    line, texts = metrics.height(), content.texts
    top = ceil(line) + 4
    bottom = max(content.height - 2 * ceil(line) - 5, top + 1)
    ticks = _y_ticks(content, (bottom - top) / content.n_rows, line)
    left = _left_margin(ticks, metrics, old_left_px)
    margin = ceil(metrics.horizontalAdvance("72") + UNIT_PX if content.stacked else 1.5 * UNIT_PX)
    unread = content.n_rows > 1 and not any(tick.label for tick in ticks)
    hidden = content.n_curves - content.n_rows if content.stacked else 0
    passing = ("updating…" if texts.stale else "", f"+{hidden} more" if hidden else "")
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
            unit=_unit_text(content, unread=unread),
            scaling=content.scaling,
            notes=texts.notes,
            mark=" · ".join(word for word in passing if word),
            badge=_SYNTHETIC if texts.synthetic else "",
        ),
    )


def least_size(metrics: QtGui.QFontMetricsF) -> QSize:
    """Return the size in which two ticks of each axis can be read."""
    line, number = ceil(metrics.height()), metrics.horizontalAdvance("\u2212100.0")
    around_px = line + 4 + 2 * line + 5
    return QSize(ceil(4 * number), around_px + ceil(2 * _AIRY * line))


def fitting(texts: tuple[str, ...], metrics: QtGui.QFontMetricsF, room_px: float) -> str:
    """Return the first of ``texts`` that fits, or ""."""
    return next((text for text in texts if metrics.horizontalAdvance(text) <= room_px), "")


def _y_ticks(content: PlotContent, row_px: float, line_px: float) -> tuple[Tick, ...]:
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


def _left_margin(ticks: tuple[Tick, ...], metrics: QtGui.QFontMetricsF, old_px: float) -> float:
    widest = max((metrics.horizontalAdvance(tick.label) for tick in ticks), default=0.0)
    needed = max(float(ceil(widest + UNIT_PX)), _LEAST_MARGIN_PX)
    return old_px if needed <= old_px <= needed + _MARGIN_SLACK_PX else needed


def _unit_text(content: PlotContent, *, unread: bool) -> str:
    parts = content.level or content.unit.symbol, content.matched
    symbol = ", ".join(filter(None, parts))
    if not unread:
        return symbol
    # Rows are too thin for ticks: the range is written out.
    low, high = (value * content.unit.factor for value in content.scale.values)
    span = f"±{high:.4g}" if low == -high else f"{low:.4g} to {high:.4g}"
    return f"{symbol}, each row {span}".replace("-", "\u2212")


_CENTRED = Qt.AlignmentFlag.AlignCenter
_AT_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_AT_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_SMALLEST_FONT_PX = 7


class HeaderLine(pyqtgraph.GraphicsWidget):
    """The line above a plot: unit and notes on the left, marks on the right."""

    def __init__(self) -> None:
        super().__init__()
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        self.header = Header()
        self._font = QtGui.QFont()

    def show_font(self, font: QtGui.QFont) -> None:
        """Use ``font``."""
        self._font = font
        self.update()

    def say(self, header: Header) -> None:
        """Show ``header``."""
        if header != self.header:
            self.header = header
            self.update()

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
        header, theme, line = self.header, current_theme(), self.rect()
        painter.setFont(self._font)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing, False)
        metrics = QtGui.QFontMetricsF(self._font)
        right = line.right()
        if header.badge:
            badge_px = metrics.horizontalAdvance(header.badge) + UNIT_PX
            badge = QRectF(right - badge_px, line.top() + 1.5, badge_px - 1, line.height() - 3)
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.warning), 1))
            painter.drawRoundedRect(badge, 3, 3)
            painter.drawText(badge, _CENTRED, header.badge)
            right = badge.left() - UNIT_PX
        painter.setPen(QtGui.QColor(theme.dim))
        if header.mark:
            painter.drawText(QRectF(0, 0, right, line.height()), _AT_RIGHT, header.mark)
            right -= metrics.horizontalAdvance(header.mark) + UNIT_PX
        painter.setPen(QtGui.QColor(theme.text))
        unit, note = header.fitted(metrics, right)
        painter.drawText(QRectF(0, 0, right, line.height()), _AT_LEFT, unit)
        start = metrics.horizontalAdvance(unit) + 2 * UNIT_PX
        painter.setPen(QtGui.QColor(theme.warning))
        painter.drawText(QRectF(start, 0, max(right - start, 1), line.height()), _AT_LEFT, note)


class Message(pyqtgraph.GraphicsWidget):
    """A text in the middle of an empty plot."""

    def __init__(self) -> None:
        super().__init__()
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)
        self.setZValue(10)
        self.text = ""
        self._colour = QtGui.QColor()
        self._font = QtGui.QFont()

    def say(self, text: str, colour: QtGui.QColor, font: QtGui.QFont) -> None:
        """Show ``text``."""
        if (text, colour, font) != (self.text, self._colour, self._font):
            self.text, self._colour, self._font = text, colour, font
            self.update()
        self.setVisible(bool(text))

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
        painter.setFont(self._font)
        painter.setPen(self._colour)
        painter.drawText(self.rect(), _CENTRED | Qt.TextFlag.TextWordWrap, self.text)


class RowNumber(Message):
    """The number of an output beside its row, in the colour of its curve."""

    def __init__(self) -> None:
        super().__init__()
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
        font, height = QtGui.QFont(self._font), self.rect().height()
        if height < QtGui.QFontMetricsF(font).height():
            font.setPixelSize(max(_SMALLEST_FONT_PX, int(height * 0.85)))
        font.setBold(True)
        painter.setFont(font)
        painter.setPen(self._colour)
        painter.drawText(self.rect(), _CENTRED, self.text)
