"""Plots of curves over one x axis, on pyqtgraph, with crosshair, playhead, zoom and pan.

`Canvas` is the base of all views of pyqtgraph, `CanvasItem` that of layers that paint themselves.
`Crosshair`, `MovableLine`, `Cursors` and `Navigation` are parts of `Plot`.
"""

from bisect import bisect_left, bisect_right
from functools import partial
from math import floor, log10
from typing import Any, ClassVar, Literal

import numpy as np
import pyqtgraph
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, QSize, Qt, Signal

from skinsource.design.design import Design
from skinsource_gui.plots.axis import PlotViewBox, Stack
from skinsource_gui.plots.curves import (
    Curves,
    PlotContent,
    PlotLayout,
    PlotTexts,
    curve_points,
    laid_out,
    least_size,
    visible_range,
)
from skinsource_gui.plots.ranges import (
    EDGE,
    Range,
    SteadyRange,
    ValueScale,
    ValueUnit,
    XAxis,
    XWindow,
    row_count,
    value_unit,
    within,
    x_window,
    zoomed,
)
from skinsource_gui.qt.frames import paint_focus_frame
from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.layouts import Policy
from skinsource_gui.qt.theme import PAPER_DOTS, UNIT_PX, current_theme, scaled, tabular
from skinsource_gui.qt.wheel import ScrollGesture


class Canvas(pyqtgraph.GraphicsView):
    """A view with a frame while it has the focus, and with keys of its own.

    Attributes
    ----------
    key_place
        Place in the table of keys that lists its keys.
    scrolling_on
        Tells when the wheel scrolls what is around the view.
    """

    key_place: ClassVar[str] = ""

    def __init__(self, parent: QtWidgets.QWidget | None = None, **options: Any) -> None:
        # No move of the mouse may be skipped: the last one is where it stopped.
        pyqtgraph.setConfigOption("mouseRateLimit", 0)
        super().__init__(parent, **options)
        self.scrolling_on = ScrollGesture(self)

    def update_style(self) -> None:
        """Use the present colours and font, also in items that cache a picture."""
        self.setBackground(QtGui.QColor(current_theme().base))
        for item in self.scene().items():
            item.update()

    def claims(self, event: QtGui.QKeyEvent) -> bool:
        """Return whether the view handles this key, before any shortcut of the window."""
        return bool(meaning_of(self.key_place, event))

    def lay_out(self) -> None:
        """Lay out everything in the present size."""

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self.claims) or super().event(event)

    def viewportEvent(self, event: QEvent) -> bool:
        if isinstance(event, QtGui.QWheelEvent) and self.scrolling_on.passes(event):
            event.ignore()
            return False
        return super().viewportEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        # pyqtgraph's constructor changes the palette, before there is a scene.
        if event.type() in (QEvent.Type.StyleChange, QEvent.Type.FontChange):
            self.update_style()

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        super().showEvent(event)
        self.scrolling_on.watch()

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusInEvent(event)
        self.viewport().update()

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.viewport().update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        super().paintEvent(event)
        if self.hasFocus():
            painter = QtGui.QPainter(self.viewport())
            paint_focus_frame(painter, QRectF(self.rect()), current_theme())

    def resizeEvent(self, event: QtGui.QResizeEvent | None) -> None:
        super().resizeEvent(event)
        # pyqtgraph's constructor calls this too, without an event.
        if event is not None:
            self.lay_out()


class CanvasItem(pyqtgraph.GraphicsObject):
    """One layer of a canvas, with its rectangle and font."""

    def __init__(self) -> None:
        super().__init__()
        self._font = QtGui.QFont()
        self._rect = QRectF(0, 0, 1, 1)

    def show_font(self, font: QtGui.QFont) -> None:
        """Take over a font."""
        self._font = font
        self.update()

    def boundingRect(self) -> QRectF:
        return self._rect

    def _set_rect(self, rect: QRectF) -> bool:
        """Take over a rectangle; return whether it is another one."""
        changed = rect != self._rect
        if changed:
            self.prepareGeometryChange()
            self._rect = rect
        return changed


class Crosshair(QObject):
    """Reads each curve of a plot at one of its samples.

    Attributes
    ----------
    index
        Index of the sample, or None.
    """

    #: The crosshair reads another sample, and is drawn there.
    moved = Signal()

    def __init__(self, plot: "Plot") -> None:
        super().__init__(plot)
        self._plot = plot
        self.index: int | None = None

    @property
    def position(self) -> float | None:
        """Position on the x axis; None outside of the visible part."""
        plot = self._plot
        if plot.curves is None or self.index is None:
            return None
        x = float(plot.curves.x[self.index])
        if plot.x_window.axis.log and x <= 0:
            return None
        position = plot.x_window.axis.position(x)
        return position if 0 <= plot.x_window.part(position) <= 1 else None

    def put(self, index: int | None) -> None:
        """Read sample ``index``, or nothing."""
        if index != self.index:
            self.index = index
            self.draw()
            self.moved.emit()

    def follow(self, curves: Curves) -> None:
        """Stay at the same x when ``curves`` replace those that are shown."""
        if self._plot.curves is not None and self.index is not None:
            self.index = curves.nearest(float(self._plot.curves.x[self.index]))

    def draw(self) -> None:
        """Draw the crosshair over the curves."""
        plot, position = self._plot, self.position
        if plot.curves is None or position is None:
            plot.stack.show_crosshair(None, ())
            return
        n_drawn = plot.curves.n_drawn(len(plot.stack.rows), stacked=plot.stacked)
        heights = plot.value_scale.heights(plot.curves.y[:n_drawn, self.index])
        plot.stack.show_crosshair(position, heights.tolist())


_HANDLE_PX = 10.0


#: Colour and style of a line.
LineStyle = tuple[Literal["error", "accent"], Qt.PenStyle]
_PLAYHEAD: LineStyle = ("error", Qt.PenStyle.SolidLine)
_CURSOR: LineStyle = ("accent", Qt.PenStyle.DashLine)


class UprightLine(pyqtgraph.InfiniteLine):
    """An upright line with a handle at its top, in one row."""

    def __init__(self, style: LineStyle) -> None:
        super().__init__(angle=90, movable=True)
        self._style = style
        # The handle makes the line as wide to catch as it is itself.
        self.addMarker("v", position=1.0, size=_HANDLE_PX)
        self.setZValue(20)
        self.setCursor(Qt.CursorShape.SizeHorCursor)

    def update_colours(self) -> None:
        """Use the present colours."""
        theme, (colour, dashes) = current_theme(), self._style
        self.setPen(QtGui.QPen(QtGui.QColor(getattr(theme, colour)), 0, dashes))
        self.setHoverPen(QtGui.QPen(QtGui.QColor(theme.text), 0))


class MovableLine(QObject):
    """A playhead or a cursor of a plot: one line in each row, which can be dragged.

    Attributes
    ----------
    position
        On the x axis; of a playhead its time, s.  None: there is no line.
    """

    #: The position to which the user drags it.
    dragged_to = Signal(float)

    def __init__(self, style: LineStyle, parent: QObject) -> None:
        super().__init__(parent)
        self.position: float | None = None
        self._style = style
        self._lines: list[UprightLine] = []
        # The line that is dragged, and its position before.
        self._drag: tuple[UprightLine, float] | None = None

    def watch(self, view: PlotViewBox) -> None:
        """Show the line in a further row."""
        line = UprightLine(self._style)
        line.update_colours()
        line.setVisible(self.position is not None)
        if self.position is not None:
            line.setPos(QPointF(self.position, 0.0))
        line.sigDragged.connect(self._move)
        line.sigPositionChangeFinished.connect(self._end_drag)
        view.addItem(line, ignoreBounds=True)
        self._lines.append(line)

    def update_colours(self) -> None:
        """Use the present colours."""
        for line in self._lines:
            line.update_colours()

    def show_at(self, position: float | None) -> None:
        """Move the lines without a signal, or hide them; nothing else is painted again."""
        if position == self.position:
            return
        seen, self.position = self.position is not None, position
        for line in self._lines:
            if position is not None:
                line.setPos(QPointF(position, 0.0))
            if seen != (position is not None):
                line.setVisible(position is not None)

    def cancel(self) -> bool:
        """Cancel a drag; return whether there was one."""
        drag, self._drag = self._drag, None
        if drag is None:
            return False
        line, before = drag
        # pyqtgraph would move the line until the button goes up.
        line.moving = False
        self.dragged_to.emit(before)
        return True

    def _move(self, line: UprightLine) -> None:
        if self._drag is None:
            self._drag = (line, self.position or 0.0)
        before, self.position = self.position or 0.0, None
        pixel = float(line.getViewBox().viewPixelSize()[0])
        self.dragged_to.emit(round_time(float(line.value()), pixel))
        # The line is under the pointer: unless a slot has placed it, it goes back.
        if self.position is None:
            self.show_at(before)

    def _end_drag(self, line: UprightLine) -> None:
        self._drag = None


class Cursors(QObject):
    """Two cursors of a plot, between which curves are measured.

    Attributes
    ----------
    at
        Where the user put them, SI; None: there are none.
    """

    #: Where the user wants them, SI.
    moved_to = Signal(object)

    def __init__(self, plot: "Plot") -> None:
        super().__init__(plot)
        self._plot = plot
        self.at: Range | None = None
        self.lines = (MovableLine(_CURSOR, self), MovableLine(_CURSOR, self))
        for rank, line in enumerate(self.lines):
            line.dragged_to.connect(partial(self._move, rank))

    @property
    def held(self) -> Range | None:
        """Where they stand: at an end of the curves if the user put them beyond it."""
        curves = self._plot.curves
        if self.at is None or curves is None:
            return self.at
        first, second = np.clip(self.at, *curves.x_range).tolist()
        return first, second

    def watch(self, view: PlotViewBox) -> None:
        """Show the cursors in a further row."""
        for line in self.lines:
            line.watch(view)

    def show_at(self, at: Range | None) -> None:
        """Put the cursors somewhere, or take them away."""
        self.at = at
        self.place()

    def place(self) -> None:
        """Put the lines where the x axis has the cursors now."""
        axis, at = self._plot.x_window.axis, self.held
        for rank, line in enumerate(self.lines):
            hidden = at is None or (axis.log and at[rank] <= 0)
            line.show_at(None if hidden or at is None else axis.position(at[rank]))

    def put(self, rank: int, value: float) -> None:
        """Ask for the first (0) or the second cursor (1) at a value; the other one makes room."""
        curves = self._plot.curves
        if curves is None or curves.x.size < 2:
            return
        first, second = self.at or self._plot.x_window.values(self._plot.x_window.shown)
        start, end = curves.x_range
        sample = float(curves.x[1] - curves.x[0])
        if rank == 0:
            first = min(max(value, start), end - sample)
            second = max(second, first + sample)
        else:
            second = max(min(value, end), start + sample)
            first = min(first, second - sample)
        self.moved_to.emit((first, second))

    def _move(self, rank: int, position: float) -> None:
        self.put(rank, self._plot.x_window.axis.value(position))


def round_time(time_s: float, pixel_s: float) -> float:
    """Return a time of at least 0, with no more digits than a pixel can show."""
    if not pixel_s > 0.0:
        return max(time_s, 0.0)
    digits = -floor(log10(pixel_s))
    return max(round(time_s, digits), 0.0)


_KEY_ZOOM = 1.5
# With Shift a key goes so many times as far.
_LEAP = 10
# A zoom shows at least so many samples.
_FEWEST_SAMPLES = 4
_STEPS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}
_CURSOR_KEYS = ("first_cursor", "second_cursor")
_ZOOMS = {"zoom_in": _KEY_ZOOM, "zoom_out": 1 / _KEY_ZOOM}


class Navigation(QObject):
    """Turns gestures and keys into a crosshair, and into requests for a part of the x axis.

    Wheel: zoom at the pointer.  Drag: zoom to the covered part.  Middle button or Shift: pan.
    Double click: show everything.  Keys: see the table of keys.
    """

    #: Part of the x axis the user wants to see, SI; None: everything.
    zoom_requested = Signal(object)

    def __init__(self, plot: "Plot") -> None:
        super().__init__(plot)
        self._plot = plot
        # Keys have put the crosshair where it is.
        self._pinned = False
        # Where the pointer rests on the plot, px.
        self._pointer: QPointF | None = None
        self._covering = self._cancelled = False

    def watch(self, view: PlotViewBox) -> None:
        """Follow the gestures on ``view``."""
        view.zoom_requested.connect(self._zoom)
        view.pan_requested.connect(self._pan)
        view.covered.connect(self._cover)

    def show_everything(self) -> None:
        """Ask for the whole x axis."""
        self.zoom_requested.emit(None)

    def follow_mouse(self, at: QPointF) -> None:
        """Read what is under the pointer."""
        plot = self._plot
        if plot.curves is None:
            return
        self._pinned, self._pointer = False, at
        if not plot.places.area.contains(at):
            plot.crosshair.put(None)
            return
        part = (at.x() - plot.places.left) / plot.places.area.width()
        plot.crosshair.put(
            plot.curves.nearest(plot.x_window.axis.value(plot.x_window.position(part)))
        )

    def follow_view(self) -> None:
        """Read what is under a pointer at rest: another part of the x axis is visible."""
        if self._pointer is not None and not self._pinned:
            self.follow_mouse(self._pointer)

    def leave(self) -> None:
        """Read nothing, unless the crosshair is pinned."""
        self._pointer = None
        if not self._pinned:
            self._plot.crosshair.put(None)

    def bring(self, value: float) -> None:
        """Ask for a part of the x axis that contains a value."""
        position, (low, high) = self._plot.x_window.axis.position(value), self._plot.x_window.shown
        self._pan(min(position - low, 0.0) + max(position - high, 0.0))

    def press(self, event: QtGui.QKeyEvent) -> None:
        """Do what a key means, or ignore the event."""
        plot, key, meaning = self._plot, Qt.Key(event.key()), meaning_of("plot", event)
        if plot.curves is None or not meaning:
            event.ignore()
        elif meaning == "give_up":
            self._escape(event)
        elif meaning == "whole":
            self.show_everything()
        elif meaning in _ZOOMS:
            anchor = plot.crosshair.position
            # Keys zoom at the crosshair if it is visible.
            self._zoom(sum(plot.x_window.shown) / 2 if anchor is None else anchor, _ZOOMS[meaning])
        elif meaning in _CURSOR_KEYS:
            if plot.crosshair.index is not None:
                plot.cursors.put(
                    _CURSOR_KEYS.index(meaning), float(plot.curves.x[plot.crosshair.index])
                )
        elif meaning == "step":
            leap = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            self._step(plot.curves, _STEPS[key] * (_LEAP if leap else 1))
        else:
            self._pin(plot.curves, 0 if key == Qt.Key.Key_Home else plot.curves.x.size - 1)

    def _zoom(self, anchor: float, factor: float) -> None:
        self._request(zoomed(self._plot.x_window.shown, anchor, factor))

    def _pan(self, moved: float) -> None:
        if moved:
            low, high = self._plot.x_window.shown
            self._request((low + moved, high + moved))

    def _cover(self, start: float, end: float, finished: bool) -> None:
        if self._plot.curves is None:
            return
        low, high = self._plot.x_window.shown
        ends = sorted(min(max(position, low), high) for position in (start, end))
        covered = (ends[0], ends[1])
        self._covering = not (finished or self._cancelled)
        self._plot.show_band(covered if self._covering else None)
        if finished and not self._cancelled and covered[0] < covered[1]:
            self._request(covered)
        self._cancelled = self._cancelled and not finished

    def _request(self, shown: Range) -> None:
        plot = self._plot
        if plot.curves is None:
            return
        extent, n_points = plot.x_window.extent, plot.curves.x.size
        shortest = (extent[1] - extent[0]) * min(_FEWEST_SAMPLES / n_points, 1.0)
        part = within(shown, extent, shortest)
        self.zoom_requested.emit(None if part is None else plot.x_window.values(part))

    def _step(self, curves: Curves, samples: int) -> None:
        window, cursor = self._plot.x_window, self._plot.crosshair.index
        if cursor is None:
            self._pin(curves, curves.nearest(window.axis.value(sum(window.shown) / 2)))
        else:
            self._pin(curves, min(max(cursor + samples, 0), curves.x.size - 1))

    def _pin(self, curves: Curves, index: int) -> None:
        # The crosshair stays until Esc, and pulls the visible part with it.
        window = self._plot.x_window
        if window.axis.log:
            index = max(index, curves.nearest(window.axis.value(window.extent[0])))
        self._pinned = True
        self._plot.crosshair.put(index)
        self.bring(float(curves.x[index]))

    def _escape(self, event: QtGui.QKeyEvent) -> None:
        if self._covering:
            self._covering, self._cancelled = False, True
            self._plot.show_band(None)
        elif self._plot.crosshair.index is not None:
            self._pinned, self._pointer = False, None
            self._plot.crosshair.put(None)
        else:
            event.ignore()


#: Place in the table of keys that lists the keys of the playhead.
PLAYHEAD = "playhead"
#: How far a key moves the playhead, s.
STEP_S = 0.001
_BACK = (Qt.Key.Key_Left, Qt.Key.Key_PageUp)


def moved_playhead(event: QtGui.QKeyEvent, design: Design, playhead_s: float) -> float | None:
    """Return where a key moves the playhead, s; None where the key does not move it."""
    meaning, back = meaning_of(PLAYHEAD, event), Qt.Key(event.key()) in _BACK
    if meaning == "step":
        leap = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
        by_s = STEP_S * (_LEAP if leap else 1)
        # Sums of decimal steps would have many digits.
        return max(round(playhead_s + (-by_s if back else by_s), 9), 0.0)
    if meaning != "stop":
        return None
    stops = stops_of(design)
    if back:
        return stops[max(bisect_left(stops, playhead_s) - 1, 0)]
    return stops[min(bisect_right(stops, playhead_s), len(stops) - 1)]


def stops_of(design: Design) -> tuple[float, ...]:
    """Return the start, markers, and the ends of clips and of the loop, rising, s."""
    times_s = {0.0, *(marker.time_s for marker in design.markers), *(design.loop_s or ())}
    for clip in design.clips:
        times_s.update((clip.onset_s, clip.end_s))
    return tuple(sorted(times_s))


_NOT_FINITE = "The response has values that are not finite numbers."
# A drag shorter than this is a click.
_DRAG_PX = 5
_TEXT = 0.9


class Plot(Canvas):
    """Curves in one row or in one row each, with a crosshair; without toolbar and legend.

    Ranges are decided once for each update; items around the curves cache their pictures.

    Parameters
    ----------
    on_paper
        Whether it is drawn for a page, at the resolution of a printer.

    Attributes
    ----------
    stack
        The items of the scene.
    steady_range
        Decides the range of values, by those of earlier curves.
    value_scale, unit
        Where values lie in a row; how they are written.
    x_window, zoom, stacked, fitted
        Visible part of the x axis; the rest as in `set_view`.
    texts, text_font
        Texts around the curves, and their font.
    places
        The layout, px.
    playhead, cursors
        The playhead, for plots over time; two cursors, where the user wants them.
    """

    key_place = "plot"

    #: The crosshair reads something else: `crosshair` and the picture are up to date.
    reading_changed = Signal()
    #: The user asks for the menu at this place of the screen.
    menu_requested = Signal(object)
    #: A key event for the playhead, see `moved_playhead`.
    playhead_key = Signal(object)

    def __init__(self, parent: QtWidgets.QWidget | None = None, *, on_paper: bool = False) -> None:
        super().__init__(parent)
        self._on_paper = on_paper
        self.setSizePolicy(Policy.Expanding, Policy.Expanding)
        self.setCursor(Qt.CursorShape.CrossCursor)
        self.scene().setMoveDistance(_DRAG_PX)
        self.curves: Curves | None = None
        self.value_scale = ValueScale(values=(0.0, 1.0))
        self.unit: ValueUnit = value_unit("amplitude", 0.0, 1.0)
        self.x_window: XWindow = x_window(XAxis(titles=("",), unit=""), (0.0, 1.0), None)
        self.places = PlotLayout(width=1, height=1, left=0, top=0, right=1, bottom=1, n_rows=1)
        self.text_font = scaled(tabular(self.font()), _TEXT)
        self.zoom: Range | None = None
        self.stacked = self.fitted = False
        self.texts, self.steady_range = PlotTexts(), SteadyRange()
        self._content: tuple[PlotContent, XWindow] | None = None
        self.crosshair = Crosshair(self)
        self.crosshair.moved.connect(self.reading_changed)
        self.navigation = Navigation(self)
        self.playhead = MovableLine(_PLAYHEAD, self)
        self.cursors = Cursors(self)
        watch = (self.navigation.watch, self.playhead.watch, self.cursors.watch)
        self.stack = Stack(self.scene(), self.text_font, watch)
        self.scene().sigMouseMoved.connect(self.navigation.follow_mouse)
        self.update_style()

    @property
    def message(self) -> str:
        """The text in place of curves."""
        return self.stack.message.text

    def sizeHint(self) -> QSize:
        return QSize(256, 192)

    def minimumSizeHint(self) -> QSize:
        return least_size(QtGui.QFontMetricsF(self.text_font))

    def update_style(self) -> None:
        super().update_style()
        self.text_font = scaled(tabular(self.font()), _TEXT)
        self.updateGeometry()
        self.stack.show_fonts(self.text_font, self.font())
        for line in (self.playhead, *self.cursors.lines):
            line.update_colours()
        self._colour()

    def set_view(
        self, axis: XAxis, zoom: Range | None, *, stacked: bool, fitted: bool = False
    ) -> None:
        """Set the x axis, its visible part in SI (None: all), and one row for each curve or one.

        The range of values fits the visible part if ``fitted``, else all of it.
        """
        view = (self.x_window.axis, self.zoom, self.stacked, self.fitted)
        if (axis, zoom, stacked, fitted) != view:
            data = (0.0, 1.0) if self.curves is None else self.curves.x_range
            self.x_window = x_window(axis, data, zoom)
            fits_other = (fitted or self.fitted) and (fitted, zoom) != (self.fitted, self.zoom)
            self.zoom, self.stacked, self.fitted = zoom, stacked, fitted
            if self.curves is not None and fits_other:
                self._fit(self.curves, self.curves.span or self.curves.reach)
            self.lay_out()
            self.navigation.follow_view()
            self.reading_changed.emit()

    def set_texts(self, texts: PlotTexts) -> None:
        """Show ``texts`` around the curves."""
        if texts != self.texts:
            self.texts = texts
            self._place()
            self._colour()

    def reset_range(self) -> None:
        """Decide the range of the next curves by them alone."""
        self.steady_range.reset()

    def show_curves(self, curves: Curves) -> None:
        """Draw ``curves`` instead of those before; zoom and crosshair stay."""
        reach = curves.reach
        if not np.isfinite(reach).all():
            self.show_message(_NOT_FINITE)
            return
        self.crosshair.follow(curves)
        before, self.curves = self.curves, curves
        self._fit(curves, curves.span or reach)
        self.x_window = x_window(self.x_window.axis, curves.x_range, self.zoom)
        self.lay_out()
        if before is None or (before.names, before.axes) != (curves.names, curves.axes):
            self._colour()
        self.reading_changed.emit()

    def show_message(self, message: str) -> None:
        """Remove the curves and show ``message`` in the middle."""
        if self.curves is None and message == self.message:
            return
        self.curves, self._content = None, None
        self.crosshair.index = None
        self.stack.say(message)
        # The plot may have been resized while there were curves.
        self._place()
        self.reading_changed.emit()

    def show_band(self, covered: Range | None) -> None:
        """Show the part that a drag covers, positions, or nothing."""
        if covered is None:
            self.stack.show_band(None)
            return
        area = self.places.area
        start, end = (area.left() + area.width() * self.x_window.part(at) for at in covered)
        self.stack.show_band(QRectF(start, area.top(), end - start, area.height()))

    def claims(self, event: QtGui.QKeyEvent) -> bool:
        return self.curves is not None and (super().claims(event) or self._moves_playhead(event))

    def viewportEvent(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QtGui.QHelpEvent):
            QtWidgets.QToolTip.showText(event.globalPos(), self._hint_at(event.y()), self)
            return True
        return super().viewportEvent(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and any(
            line.cancel() for line in (self.playhead, *self.cursors.lines)
        ):
            return
        if self._moves_playhead(event):
            self.playhead_key.emit(event)
        else:
            self.navigation.press(event)

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        # The right button opens the menu, which gets its release: the scene must not see the press.
        if event.button() == Qt.MouseButton.RightButton:
            event.accept()
        else:
            super().mousePressEvent(event)

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.RightButton:
            super().mouseReleaseEvent(event)

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.navigation.show_everything()

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        self.menu_requested.emit(event.globalPos())

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.navigation.leave()

    def _moves_playhead(self, event: QtGui.QKeyEvent) -> bool:
        return self.playhead.position is not None and bool(meaning_of(PLAYHEAD, event))

    def _hint_at(self, y_px: float) -> str:
        # The longest texts above and below the plot.
        if self.curves is None or self.places.top <= y_px <= self.places.bottom:
            return ""
        if y_px < self.places.top:
            return self.places.header.whole
        axis = self.x_window.axis
        return "\n".join(filter(None, (axis.titles[0], axis.hint)))

    def lay_out(self) -> None:
        other_rows = self._place()
        if self.curves is None:
            return
        places = self.places
        each = self.curves.each
        n_drawn = self.curves.n_drawn(places.n_rows, stacked=self.stacked)
        rows = [places.row(rank // each if self.stacked else 0) for rank in range(n_drawn)]
        ratio = PAPER_DOTS if self._on_paper else self.devicePixelRatioF()
        visible = visible_range(self.curves, self.x_window, n_drawn, rows[0], ratio)
        fitted = self.fitted and self.zoom is not None
        if values := visible.extremes if fitted else visible.beyond(self.value_scale.values):
            self._fit(self.curves, values)
            self._place()
        self.stack.show_points(curve_points(visible, self.value_scale, rows, ratio))
        if other_rows:  # only now has each row its curves
            self._colour()
        self.crosshair.draw()
        self.cursors.place()

    def _fit(self, curves: Curves, extremes: Range) -> None:
        """Make room for values between these extremes."""
        values = self.steady_range.follow(*extremes, curves.kind)
        self.value_scale = ValueScale(values=values, edge=self.value_scale.edge)
        self.unit = value_unit(curves.kind, *values)

    def _place(self) -> bool:
        """Lay out rows and texts; return whether the number of rows has changed."""
        curves = self.curves
        if curves is None:
            room = QRectF(self.rect()).adjusted(2 * UNIT_PX, UNIT_PX, -2 * UNIT_PX, -UNIT_PX)
            self.stack.message.setGeometry(room)
            return False
        count = row_count(len(curves.names), stacked=self.stacked)
        self.value_scale = ValueScale(
            values=self.value_scale.values, edge=EDGE if count > 1 else 0.0
        )
        content = PlotContent(
            width=float(self.width()),
            height=float(self.height()),
            n_rows=count,
            scale=self.value_scale,
            stacked=self.stacked,
            unit=self.unit,
            level=curves.level_text if curves.kind == "level" else "",
            matched=curves.matched,
            n_curves=len(curves.names),
            scaling=curves.scaling,
            texts=self.texts,
        )
        other_rows = self._content is None or self._content[0].n_rows != count
        if (content, self.x_window) != self._content:
            self._content = (content, self.x_window)
            self.places = laid_out(content, QtGui.QFontMetricsF(self.text_font), self.places.left)
            self.stack.place(self.places, self.x_window)
        return other_rows

    def _colour(self) -> None:
        names, axes = ((), ()) if self.curves is None else (self.curves.names, self.curves.axes)
        stale = self.texts.stale
        self.stack.show_colours(names, numbered=self.stacked, stale=stale, n_axes=len(axes))
