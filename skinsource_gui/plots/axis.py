"""The scene of a plot: pyqtgraph's axes and view boxes, adapted, and the rows made of them."""

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any, Literal, TypeVar

import pyqtgraph
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPointF, QRectF, Qt, Signal

from skinsource_gui.plots.curves import (
    CurveName,
    CurvePoints,
    HeaderLine,
    Message,
    PlotLayout,
    RowNumber,
    SignalCurve,
    fitting,
)
from skinsource_gui.plots.ranges import Range, Tick, XWindow
from skinsource_gui.qt.theme import UNIT_PX, current_theme, translucent
from skinsource_gui.qt.wheel import NOTCH, PAN_PER_NOTCH, ZOOM_PER_NOTCH

_GAP_PX = 4.0
_CENTRED = Qt.AlignmentFlag.AlignCenter
_AT_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter

#: Returns the ticks between two positions of a view that are so many px apart.
TickRule = Callable[[float, float, float], Sequence[Tick]]


class Axis(pyqtgraph.AxisItem):
    """An axis on the left of one view, or below several of equal width.

    It draws the grid of these views, behind them, and their frames if it is on the left.  Its
    picture is cached until range, ticks, titles or size change.

    Attributes
    ----------
    titles
        Versions of the title, longest first; the first that fits is written.
    band
        Positions outside of which the views are shaded, or None.
    """

    def __init__(self, orientation: Literal["left", "bottom"], rule: TickRule) -> None:
        super().__init__(orientation)
        self.enableAutoSIPrefix(False)
        self.setCacheMode(self.CacheMode.DeviceCoordinateCache)
        self.titles: tuple[str, ...] = ()
        self.band: Range | None = None
        self._rule = rule
        self._font = QtGui.QFont()
        self._views: tuple[pyqtgraph.ViewBox, ...] = ()
        # Behind curves; the shading of the lower axis lies under the grid of the left one.
        self.setZValue(-1000 if orientation == "left" else -1001)

    def set_views(self, *views: pyqtgraph.ViewBox) -> None:
        """Follow the range of the first view, and draw the grid of all."""
        if self._views[:1] != views[:1]:
            if self._views:
                self.unlinkFromView()
            self.linkToView(views[0])
        self._views = views
        self.refresh()

    def show_font(self, font: QtGui.QFont) -> None:
        """Use ``font`` and the present colours."""
        self._font = font
        self.refresh()

    def say(self, titles: tuple[str, ...], band: Range | None = None) -> None:
        """Write the longest of ``titles`` that fits, and shade all but ``band``."""
        if (titles, band) != (self.titles, self.band):
            self.titles, self.band = titles, band
            self.refresh()

    def refresh(self) -> None:
        """Draw again."""
        self.prepareGeometryChange()
        self.update()

    def ticks(self) -> list[tuple[float, str]]:
        """Return the places of the ticks in this item, px, and their labels."""
        if not self._views:
            return []
        across = self.orientation == "bottom"
        rect = self._view_rect(self._views[0])
        start, length = (rect.left(), rect.width()) if across else (rect.bottom(), -rect.height())
        low, high = self.range
        if length == 0 or not low < high:
            return []
        return [
            (start + length * (tick.value - low) / (high - low), tick.label)
            for tick in self._rule(low, high, abs(length))
        ]

    def shaded(self) -> list[QRectF]:
        """Return the areas outside the band, in coordinates of this item, px."""
        low, high = self.range
        if self.band is None or not low < high:
            return []
        parts = []
        for rect in map(self._view_rect, self._views):
            start, end = (
                rect.left() + rect.width() * min(max((value - low) / (high - low), 0.0), 1.0)
                for value in self.band
            )
            for left, right in ((rect.left(), start), (end, rect.right())):
                parts.append(QRectF(left, rect.top(), right - left, rect.height()))
        return [part for part in parts if part.width() > 0]

    def boundingRect(self) -> QRectF:
        bounds = self.rect()
        for view in self._views:
            bounds = bounds.united(self._view_rect(view))
        # Frames reach half a pixel outside, and labels at the ends half of their height.
        above = QtGui.QFontMetricsF(self._font).height() / 2 if self.orientation == "left" else 1
        return bounds.adjusted(-1, -above, 1, above)

    def labels(self) -> list[tuple[QRectF, str]]:
        """Return the labels that have room, and their places."""
        metrics, below = QtGui.QFontMetricsF(self._font), self.orientation == "bottom"
        place = self._below if below else self._beside
        labels, free_from = [], 0.0
        for at, text in self.ticks():
            room = place(at, metrics.horizontalAdvance(text) + 2, metrics.height())
            if text and not (below and room.left() < free_from):
                labels.append((room, text))
                free_from = room.right() + _GAP_PX
        return labels

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
        # Without pyqtgraph's QPicture, which would lose the tabular digits of the font.
        below, theme = self.orientation == "bottom", current_theme()
        painter.setFont(self._font)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing, False)
        for outside in self.shaded():
            painter.fillRect(outside, QtGui.QColor(theme.window))
        rects = [self._view_rect(view) for view in self._views]
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.grid), 1))
        for rect, (at, _) in product(rects, self.ticks()):
            if below:
                painter.drawLine(QPointF(at, rect.top()), QPointF(at, rect.bottom()))
            else:
                painter.drawLine(QPointF(rect.left(), at), QPointF(rect.right(), at))
        if not below:
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.border), 1))
            painter.drawRects(rects)
        painter.setPen(QtGui.QColor(theme.dim))
        for room, text in self.labels():
            painter.drawText(room, _CENTRED if below else _AT_RIGHT, text)
        self._write_title(painter)

    def _view_rect(self, view: pyqtgraph.ViewBox) -> QRectF:
        return self.mapRectFromItem(view, view.rect())

    def _below(self, at: float, width: float, line: float) -> QRectF:
        left = at - width / 2
        start = self._view_rect(self._views[0]).left()
        if left < start <= at:
            # The label must not stand below the lowest label of the left axis.
            left = start
        return QRectF(min(max(left, 0.0), self.rect().width() - width), 2, width, line)

    def _beside(self, at: float, width: float, line: float) -> QRectF:
        return QRectF(0, at - line / 2, self.rect().width() - _GAP_PX, line)

    def _write_title(self, painter: QtGui.QPainter) -> None:
        if not self.titles or not self._views:
            return
        metrics, room = QtGui.QFontMetricsF(self._font), self.rect()
        title = fitting(self.titles, metrics, room.width() - UNIT_PX)
        width = metrics.horizontalAdvance(title) + 2
        middle = self._view_rect(self._views[0]).center().x()
        left = min(max(middle - width / 2, _GAP_PX), room.width() - width - _GAP_PX)
        painter.setPen(QtGui.QColor(current_theme().text))
        line = metrics.height()
        painter.drawText(QRectF(left, 2 + line, width, line), _CENTRED, title)


_SHIFT = Qt.KeyboardModifier.ShiftModifier


class PlotViewBox(pyqtgraph.ViewBox):
    """A view box whose gestures ask for another range instead of setting it.

    Several views and panels show the same range, so it is decided in one place.  Wheel: zoom at
    the pointer; Shift+wheel, wheel to the side, middle button, Shift+left button: pan; left
    button: zoom to the covered part.  Positions are those of the x axis.
    """

    #: Position that stays in place, and the factor of the zoom.
    zoom_requested = Signal(float, float)
    #: By how much the range is to move.
    pan_requested = Signal(float)
    #: Position where the button went down, position of the pointer, whether it went up again.
    covered = Signal(float, float, bool)

    def __init__(self) -> None:
        super().__init__(enableMenu=False, defaultPadding=0.0)
        # Ranges are decided once for each update.
        self.disableAutoRange()
        self.setYRange(0.0, 1.0, padding=0)

    def position(self, scene_at: QPointF) -> float:
        """Return the position at a point of the scene."""
        return float(self.mapSceneToView(scene_at).x())

    def shape(self) -> QtGui.QPainterPath:
        # Half of the lines on the lower and the right edge lies beyond it.
        path = QtGui.QPainterPath()
        path.addRect(QRectF(self.rect()).adjusted(0, 0, 1, 1))
        return path

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
        """Paint nothing: the axis beside draws the frame."""

    def wheelEvent(self, event: Any, axis: int | None = None) -> None:
        turns = event.delta() / NOTCH
        sideways = event.orientation() == Qt.Orientation.Horizontal
        if sideways or event.modifiers() & _SHIFT:
            low, high = self.viewRange()[0]
            self.pan_requested.emit(-turns * PAN_PER_NOTCH * (high - low))
        else:
            self.zoom_requested.emit(self.position(event.scenePos()), ZOOM_PER_NOTCH**turns)
        event.accept()

    def mouseDragEvent(self, event: Any, axis: int | None = None) -> None:
        now = self.position(event.scenePos())
        button = event.button()
        pans = event.modifiers() & _SHIFT or button == Qt.MouseButton.MiddleButton
        if button == Qt.MouseButton.RightButton:
            event.ignore()
            return
        event.accept()
        if pans:
            self.pan_requested.emit(self.position(event.lastScenePos()) - now)
        else:
            down = self.position(event.buttonDownScenePos(button))
            self.covered.emit(down, now, event.isFinish())


_DOT_PX = 5.0


class PlotRow:
    """One row of a plot: a view box of the height 0 to 1, the axis on its left, and its number.

    Attributes
    ----------
    curves
        Items of the view; the first ``n_curves`` are in use.
    line, dots
        The crosshair, and its dot on each curve.
    """

    def __init__(self, scene: pyqtgraph.GraphicsScene) -> None:
        self.view = PlotViewBox()
        self.axis = Axis("left", lambda *_: self._y_ticks)
        self.number = RowNumber()
        for item in (self.view, self.axis, self.number):
            scene.addItem(item)
        self.axis.set_views(self.view)
        self.curves: list[SignalCurve] = []
        self.n_curves = 0
        self.line = pyqtgraph.InfiniteLine(angle=90, movable=False)
        self.dots = pyqtgraph.ScatterPlotItem(size=_DOT_PX + 1, antialias=True)
        for rank, item in enumerate((self.line, self.dots)):
            item.setZValue(10 + rank)
            item.hide()
            self.view.addItem(item, ignoreBounds=True)
        self._y_ticks: tuple[Tick, ...] = ()
        self._shown: Range | None = None

    def place(self, layout: PlotLayout, rank: int) -> None:
        """Move everything to the place of row ``rank`` in ``layout``."""
        room = layout.row(rank)
        self.view.setGeometry(room)
        self.axis.setWidth(room.left())
        self.axis.setGeometry(QRectF(0, room.top(), room.left(), room.height()))
        number = QRectF(room.right(), room.top(), layout.width - room.right(), room.height())
        self.number.setGeometry(number)
        if layout.y_ticks != self._y_ticks:
            self._y_ticks = layout.y_ticks
            self.axis.refresh()

    def set_visible(self, visible: bool) -> None:
        """Show or hide the row."""
        for item in (self.view, self.axis, self.number):
            item.setVisible(visible)

    def show_font(self, font: QtGui.QFont) -> None:
        """Use ``font`` and the present colours."""
        theme = current_theme()
        self.axis.show_font(font)
        self.line.setPen(QtGui.QPen(QtGui.QColor(theme.dim), 0))
        self.dots.setPen(pyqtgraph.mkPen(QtGui.QColor(theme.base), width=1))

    def show_range(self, shown: Range) -> None:
        """Show this part of the x axis."""
        if shown != self._shown:
            self._shown = shown
            self.view.setXRange(*shown, padding=0)

    def show_points(self, points: Sequence[CurvePoints]) -> None:
        """Draw one curve for each of ``points``."""
        while len(self.curves) < len(points):
            curve = SignalCurve()
            self.curves.append(curve)
            self.view.addItem(curve, ignoreBounds=True)
        for curve, of_curve in zip(self.curves, points, strict=False):
            curve.show_points(of_curve)
        if self.n_curves != len(points):
            self.n_curves = len(points)
            for rank, curve in enumerate(self.curves):
                curve.setVisible(rank < self.n_curves)

    def show_pens(self, pens: Sequence[QtGui.QPen], *, stale: bool) -> None:
        """Give each curve its pen; pale where it is stale."""
        for curve, pen in zip(self.curves, pens, strict=False):
            curve.set_look(pen, stale=stale)

    def show_crosshair(
        self, position: float | None, heights: Sequence[float], colours: Sequence[QtGui.QColor]
    ) -> None:
        """Draw the crosshair at ``position``; None hides it."""
        visible = position is not None
        self.line.setVisible(visible)
        self.dots.setVisible(visible)
        if position is not None:
            self.line.setPos(QPointF(position, 0.0))
            self.dots.setData(x=[position] * len(heights), y=heights, brush=colours)


_NOTHING_HERE = "Nothing to see in this part. Press 0 to show everything."
_BAND_ALPHA = 48

_Part = TypeVar("_Part")


class Stack:
    """Everything in the scene of a plot: equally high rows over one x axis, or a message.

    Attributes
    ----------
    rows
        The visible rows, from the top.
    header, x_axis
        The items above and below the rows.
    message, hint
        Texts in place of curves, and over them.
    band
        The part that a drag covers.
    """

    def __init__(
        self,
        scene: pyqtgraph.GraphicsScene,
        font: QtGui.QFont,
        watch: Sequence[Callable[[PlotViewBox], None]],
    ) -> None:
        self._scene, self._watch = scene, watch
        self._font = font
        self._message_font = font
        self._window: XWindow | None = None
        self._n_axes = 0
        self._pool: list[PlotRow] = []
        self.rows: list[PlotRow] = []
        self.header = HeaderLine()
        self.x_axis = Axis("bottom", self._x_ticks)
        self.message, self.hint = Message(), Message()
        self.band = QtWidgets.QGraphicsRectItem()
        self.band.setZValue(5)
        for item in (self.header, self.x_axis, self.message, self.hint, self.band):
            scene.addItem(item)
        self.say("")

    def show_fonts(self, font: QtGui.QFont, message_font: QtGui.QFont) -> None:
        """Use fonts for texts around the curves and for messages, and the present colours."""
        theme = current_theme()
        self._font, self._message_font = font, message_font
        self.header.show_font(font)
        self.x_axis.show_font(font)
        for row in self._pool:
            row.show_font(font)
        self.message.say(self.message.text, QtGui.QColor(theme.dim), message_font)
        self.hint.say(self.hint.text, QtGui.QColor(theme.dim), font)
        self.band.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 0))
        self.band.setBrush(translucent(theme.accent, _BAND_ALPHA))

    def say(self, message: str) -> None:
        """Remove the curves and show ``message`` in the middle."""
        for row in self._pool:
            row.show_points(())
            row.show_crosshair(None, (), ())
        self._show_rows(0)
        self.header.hide()
        self.x_axis.hide()
        self.band.hide()
        self.hint.say("", QtGui.QColor(), self._font)
        self.message.say(message, QtGui.QColor(current_theme().dim), self._message_font)

    def place(self, layout: PlotLayout, window: XWindow) -> None:
        """Show ``layout`` around ``window``, instead of a message."""
        new_window, self._window = window != self._window, window
        if self.message.text:
            self.message.say("", QtGui.QColor(), self._message_font)
        self._show_rows(layout.n_rows)
        self.header.setGeometry(QRectF(layout.left, 0, layout.right - layout.left, layout.top - 1))
        self.header.say(layout.header)
        for rank, row in enumerate(self.rows):
            row.place(layout, rank)
            row.show_range(window.shown)
        below = layout.height - layout.bottom
        self.x_axis.setHeight(below)
        self.x_axis.setGeometry(QRectF(0, layout.bottom, layout.width, below))
        self.x_axis.say(window.axis.titles, window.band)
        if new_window:
            self.x_axis.refresh()
        self.hint.setGeometry(layout.area)
        low, high = window.extent
        hint = "" if window.shown[0] < high and low < window.shown[1] else _NOTHING_HERE
        self.hint.say(hint, QtGui.QColor(current_theme().dim), self._font)

    def show_points(self, points: tuple[CurvePoints, ...]) -> None:
        """Draw curves: all in one row, or one in each row."""
        for row, of_row in zip(self.rows, self._by_row(points), strict=True):
            row.show_points(of_row)

    def show_colours(
        self, names: Sequence[CurveName], *, numbered: bool, stale: bool, n_axes: int = 0
    ) -> None:
        """Give curves the pens of their ranks, and stacked rows the numbers of their names.

        Where each row has curves along ``n_axes`` axes, these have the colours of axes.
        """
        self._n_axes = n_axes
        n_curves = sum(row.n_curves for row in self.rows)
        # One pixel of the screen: any wider line takes a hundred times as long.
        pens = [current_theme().output_pen(rank, 0.0) for rank in range(n_curves)]
        if n_axes:
            pens = [QtGui.QPen(colour, 0.0) for colour in self._colours(len(pens))]
        for rank, pen in enumerate(pens[: len(names) * max(n_axes, 1)]):
            pen.setColor(names[rank // max(n_axes, 1)].colour(pen.color()))
        for row, of_row in zip(self.rows, self._by_row(pens), strict=True):
            row.show_pens(of_row, stale=stale)
        for rank, row in enumerate(self.rows):
            text = str(names[rank].number or "") if numbered and names else ""
            row.number.say(text, current_theme().output_colour(rank), self._font)

    def show_crosshair(self, position: float | None, heights: Sequence[float]) -> None:
        """Draw the crosshair at ``position``; None hides it."""
        of_rows = zip(self._by_row(heights), self._by_row(self._colours(len(heights))), strict=True)
        for row, (of_row, of_dots) in zip(self.rows, of_rows, strict=True):
            row.show_crosshair(position, of_row, of_dots)

    def show_band(self, area: QRectF | None) -> None:
        """Show the part that a drag covers, or nothing."""
        self.band.setVisible(area is not None)
        if area is not None:
            self.band.setRect(area)

    def _by_row(self, parts: Sequence[_Part]) -> list[Sequence[_Part]]:
        if len(self.rows) == 1:
            return [parts]
        each = max(len(parts) // max(len(self.rows), 1), 1)
        return [parts[rank * each : (rank + 1) * each] for rank in range(len(self.rows))]

    def _colours(self, n_curves: int) -> list[QtGui.QColor]:
        if not self._n_axes:
            return [current_theme().output_colour(rank) for rank in range(n_curves)]
        return [current_theme().axis_colour(rank % self._n_axes) for rank in range(n_curves)]

    def _show_rows(self, count: int) -> None:
        if count == len(self.rows):
            return
        while len(self._pool) < count:
            row = PlotRow(self._scene)
            row.show_font(self._font)
            for follow in self._watch:
                follow(row.view)
            self._pool.append(row)
        for rank, row in enumerate(self._pool):
            row.set_visible(rank < count)
        self.rows = self._pool[:count]
        self.header.setVisible(count > 0)
        self.x_axis.setVisible(count > 0)
        if self.rows:
            self.x_axis.set_views(*(row.view for row in self.rows))

    def _x_ticks(self, low: float, high: float, width_px: float) -> tuple[Tick, ...]:
        return () if self._window is None else self._window.axis.ticks(low, high, width_px)
