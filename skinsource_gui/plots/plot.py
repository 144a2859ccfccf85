"""What all our views of pyqtgraph have in common."""

from bisect import bisect_left, bisect_right
from math import floor, log10
from typing import Any, ClassVar, Protocol

import numpy as np
import pyqtgraph
from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QFocusEvent,
    QFontMetricsF,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
    QShowEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

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
    CachedColumns,
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
from skinsource_gui.qt.theme import PAPER_DOTS, current_theme, scaled, tabular
from skinsource_gui.qt.wheel import ScrollingOn


class Canvas(pyqtgraph.GraphicsView):
    """A view with a frame while it has the keyboard, and with keys of its own.

    Attributes
    ----------
    key_place
        Where in the table of keys its own stand.
    scrolling_on
        Knows when the wheel is for what is around it.
    """

    key_place: ClassVar[str] = ""

    def __init__(self, parent: QWidget | None = None, **options: Any) -> None:
        # Each move of the mouse counts, however quick: the last one is where it stopped.
        pyqtgraph.setConfigOption("mouseRateLimit", 0)
        super().__init__(parent, **options)
        self.scrolling_on = ScrollingOn(self)

    def take_look(self) -> None:
        """Take over colours and font, also where a picture of an item is kept."""
        self.setBackground(QColor(current_theme().base))
        for item in self.scene().items():
            item.update()

    def claims(self, event: QKeyEvent) -> bool:
        """Whether it wants this key for itself, whatever the window's actions are."""
        return bool(meaning_of(self.key_place, event))

    def lay_out(self) -> None:
        """Put everything where it belongs in the size that there is now."""

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self.claims) or super().event(event)

    def viewportEvent(self, event: QEvent) -> bool:
        if isinstance(event, QWheelEvent) and self.scrolling_on.passes(event):
            event.ignore()
            return False
        return super().viewportEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        # pyqtgraph's constructor changes the palette, before there is a scene.
        if event.type() in (QEvent.Type.StyleChange, QEvent.Type.FontChange):
            self.take_look()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.scrolling_on.watch()

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self.viewport().update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.viewport().update()

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        if self.hasFocus():
            painter = QPainter(self.viewport())
            paint_focus_frame(painter, QRectF(self.rect()), current_theme())
            painter.end()

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        super().resizeEvent(event)
        # pyqtgraph's constructor calls this too, without an event.
        if event is not None:
            self.lay_out()


# What a plot reads, and where.


class Readable(Protocol):
    """What a crosshair asks of a plot."""

    curves: Curves | None
    x_window: XWindow
    value_scale: ValueScale
    stacked: bool
    stack: Stack


class Crosshair(QObject):
    """Reads each curve of a plot at one of its samples.

    Attributes
    ----------
    index
        Of the sample, or ``None``.
    """

    #: It reads another sample, and is drawn there.
    moved = Signal()

    def __init__(self, plot: Readable, parent: QObject) -> None:
        super().__init__(parent)
        self._plot = plot
        self.index: int | None = None

    @property
    def position(self) -> float | None:
        """Where it is on the x axis; ``None`` where there is none in the visible part."""
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
        """Stay where it is when ``curves`` take the place of those that are shown."""
        if self._plot.curves is not None and self.index is not None:
            self.index = curves.nearest(float(self._plot.curves.x[self.index]))

    def forget(self) -> None:
        """Read nothing: the curves are gone."""
        self.index = None

    def draw(self) -> None:
        """Draw it over what is shown."""
        plot, position = self._plot, self.position
        if plot.curves is None or position is None:
            plot.stack.show_crosshair(None, ())
            return
        n_drawn = plot.curves.n_drawn(len(plot.stack.rows), stacked=plot.stacked)
        heights = plot.value_scale.heights(plot.curves.y[:n_drawn, self.index])
        plot.stack.show_crosshair(position, heights.tolist())


# The playhead in a plot over time.

_HANDLE_PX = 10.0


class PlayheadLine(pyqtgraph.InfiniteLine):
    """An upright line with a handle at its top, in one row."""

    def __init__(self) -> None:
        super().__init__(angle=90, movable=True)
        # The handle makes the line as wide to catch as it is itself.
        self.addMarker("v", position=1.0, size=_HANDLE_PX)
        self.setZValue(20)
        self.setCursor(Qt.CursorShape.SizeHorCursor)

    def take_colours(self) -> None:
        """Take over the colours in use."""
        theme = current_theme()
        self.setPen(QPen(QColor(theme.error), 0))
        self.setHoverPen(QPen(QColor(theme.accent), 0))

    def let_go(self) -> None:
        """Stay where it is, whatever the mouse does until its button goes up."""
        self.moving = False


class Playhead(QObject):
    """One line in each row of a plot, all at the same time; dragged, it tells where to.

    Attributes
    ----------
    time_s
        Where it is; None: there is none.
    moved
        How often lines were moved.
    """

    #: The time to which it shall go, s.
    wanted = Signal(float)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.time_s: float | None = None
        self.moved = 0
        self._lines: list[PlayheadLine] = []
        # Which line is dragged, and where it was before.
        self._held: tuple[PlayheadLine, float] | None = None

    def watch(self, view: PlotViewBox) -> None:
        """Show it in one more row."""
        line = PlayheadLine()
        line.take_colours()
        line.setVisible(self.time_s is not None)
        if self.time_s is not None:
            line.setPos(QPointF(self.time_s, 0.0))
        line.sigDragged.connect(self._drag)
        line.sigPositionChangeFinished.connect(self._let_go)
        view.addItem(line, ignoreBounds=True)
        self._lines.append(line)

    def take_colours(self) -> None:
        """Take over the colours in use."""
        for line in self._lines:
            line.take_colours()

    def show_at(self, time_s: float) -> None:
        """Put it there, and tell nobody; nothing but the lines is painted again."""
        if time_s == self.time_s:
            return
        appears, self.time_s = self.time_s is None, time_s
        self.moved += 1
        for line in self._lines:
            line.setPos(QPointF(time_s, 0.0))
            if appears:
                line.show()

    def cancel(self) -> bool:
        """Give up a drag; whether there was one."""
        held, self._held = self._held, None
        if held is None:
            return False
        line, before_s = held
        line.let_go()
        self.wanted.emit(before_s)
        return True

    def _drag(self, line: PlayheadLine) -> None:
        if self._held is None:
            self._held = (line, self.time_s or 0.0)
        before_s, self.time_s = self.time_s or 0.0, None
        pixel_s = float(line.getViewBox().viewPixelSize()[0])
        self.wanted.emit(round_time(float(line.value()), pixel_s))
        # The line is under the pointer: it goes where it was told to, or back.
        if self.time_s is None:
            self.show_at(before_s)

    def _let_go(self, line: PlayheadLine) -> None:
        self._held = None


def round_time(time_s: float, pixel_s: float) -> float:
    """A time that is not before 0, with no more digits than a pixel tells apart."""
    if not pixel_s > 0.0:
        return max(time_s, 0.0)
    digits = -floor(log10(pixel_s))
    return max(round(time_s, digits), 0.0)


# Zoom, pan and crosshair by mouse and keys.

_KEY_ZOOM = 1.5
_LEAP = 10
# No closer than so many samples.
_FEWEST_SAMPLES = 4
_STEPS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}
_ZOOMS = {"zoom_in": _KEY_ZOOM, "zoom_out": 1 / _KEY_ZOOM}


class Navigable(Protocol):
    """What navigation asks of a plot."""

    curves: Curves | None
    x_window: XWindow
    places: PlotLayout
    crosshair: Crosshair

    def show_band(self, covered: Range | None) -> None:
        """Show what a drag covers, positions, or nothing."""


class Navigation(QObject):
    """Turns gestures and keys into a crosshair, and into requests for a part of the x axis.

    Wheel: zoom at the pointer.  Drag: zoom to what is covered.  Middle button or Shift: pan.
    Double click: everything.  Keys: as the table of keys says.
    """

    #: Part of the x axis the user wants to see, SI; None: everything.
    zoom_requested = Signal(object)

    def __init__(self, plot: Navigable, parent: QObject) -> None:
        super().__init__(parent)
        self._plot = plot
        self._pinned = False
        # Where the pointer rests on the plot, px.
        self._pointer: QPointF | None = None
        self._covering = False
        self._given_up = False

    def watch(self, view: PlotViewBox) -> None:
        """Follow the gestures on ``view``."""
        view.zoom_wanted.connect(self._zoom)
        view.pan_wanted.connect(self._pan)
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
        """Read what is under a pointer that rests: another part of the x axis is seen."""
        if self._pointer is not None and not self._pinned:
            self.follow_mouse(self._pointer)

    def leave(self) -> None:
        """Read nothing, unless keys put the crosshair where it is."""
        self._pointer = None
        if not self._pinned:
            self._plot.crosshair.put(None)

    def bring(self, value: float) -> None:
        """Ask for a part of the x axis in which a value is."""
        position, (low, high) = self._plot.x_window.axis.position(value), self._plot.x_window.shown
        self._pan(min(position - low, 0.0) + max(position - high, 0.0))

    def press(self, event: QKeyEvent) -> None:
        """Do what a key means, or leave it to others."""
        plot, key, wanted = self._plot, Qt.Key(event.key()), meaning_of("plot", event)
        if plot.curves is None or not wanted:
            event.ignore()
        elif wanted == "give_up":
            self._escape(event)
        elif wanted == "whole":
            self.show_everything()
        elif wanted in _ZOOMS:
            anchor = plot.crosshair.position
            # Keys zoom at the crosshair if it is in sight.
            self._zoom(sum(plot.x_window.shown) / 2 if anchor is None else anchor, _ZOOMS[wanted])
        elif wanted == "step":
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
        ends = sorted(min(max(place, low), high) for place in (start, end))
        covered = (ends[0], ends[1])
        self._covering = not (finished or self._given_up)
        self._plot.show_band(covered if self._covering else None)
        if finished and not self._given_up and covered[0] < covered[1]:
            self._request(covered)
        self._given_up = self._given_up and not finished

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

    def _escape(self, event: QKeyEvent) -> None:
        if self._covering:
            self._covering, self._given_up = False, True
            self._plot.show_band(None)
        elif self._plot.crosshair.index is not None:
            self._pinned, self._pointer = False, None
            self._plot.crosshair.put(None)
        else:
            event.ignore()


# What keys do to the playhead, wherever there is one.

#: Where these keys stand in the table of keys.
PLAYHEAD = "playhead"
#: How far a key moves it, s; with Shift so many times as far.
STEP_S, _PLAYHEAD_MOVES_LEAP = 0.001, 10
_BACK = (Qt.Key.Key_Left, Qt.Key.Key_PageUp)


def moved_playhead(event: QKeyEvent, design: Design, playhead_s: float) -> float | None:
    """Where a key puts the playhead, s; None where it means nothing to it."""
    wanted, back = meaning_of(PLAYHEAD, event), Qt.Key(event.key()) in _BACK
    if wanted == "step":
        leap = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
        by_s = STEP_S * (_PLAYHEAD_MOVES_LEAP if leap else 1)
        # Sums of decimal steps shall be short to read.
        return max(round(playhead_s + (-by_s if back else by_s), 9), 0.0)
    if wanted != "stop":
        return None
    stops = stops_of(design)
    if back:
        return stops[max(bisect_left(stops, playhead_s) - 1, 0)]
    return stops[min(bisect_right(stops, playhead_s), len(stops) - 1)]


def stops_of(design: Design) -> tuple[float, ...]:
    """Rising times at which something is: the start, ends of clips and of the loop, markers, s."""
    times_s = {0.0, *(marker.time_s for marker in design.markers), *(design.loop_s or ())}
    for clip in design.clips:
        times_s.update((clip.onset_s, clip.end_s))
    return tuple(sorted(times_s))


# Curves over one x axis, on pyqtgraph: no toolbar, no legend.

_NOT_FINITE = "The response has values that are not finite numbers."
# A drag shorter than this is a click.
_DRAG_PX = 5
_TEXT = 0.9


class Plot(Canvas):
    """Curves in one row or in one row each, with a crosshair.

    Ranges are decided once for each update; what is around the curves is kept as pictures.

    Parameters
    ----------
    on_paper
        Whether it is drawn for a page, as finely as printers print, not for the screen.

    Attributes
    ----------
    curves
        What is drawn, or ``None``.
    stack
        What is in the scene.
    held
        Decides the range of values, by those of curves before.
    value_scale, unit
        Where values lie in a row; how they are written.
    x_window, zoom, stacked, fitted
        Visible part of the x axis; the rest as `set_view` was told.
    words, words_font
        What is said around the curves, and how it is written.
    places
        Where everything is, px.
    columns
        Where samples fall among columns of pixels.
    crosshair
        What is read.
    navigation
        What mouse and keys ask for.
    playhead
        Where the playhead is, for plots over time.
    """

    key_place = "plot"

    #: The crosshair reads something else: `crosshair` and what is drawn are up to date.
    reading_changed = Signal()
    #: Where on the screen the menu is wanted.
    menu_wanted = Signal(object)
    #: What a key wants of the playhead, see `playhead_keys`.
    playhead_key = Signal(object)

    def __init__(self, parent: QWidget | None = None, *, on_paper: bool = False) -> None:
        super().__init__(parent)
        self._on_paper = on_paper
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setCursor(Qt.CursorShape.CrossCursor)
        self.scene().setMoveDistance(_DRAG_PX)
        self.curves: Curves | None = None
        self.value_scale = ValueScale(values=(0.0, 1.0))
        self.unit: ValueUnit = value_unit("amplitude", 0.0, 1.0)
        self.x_window: XWindow = x_window(XAxis(titles=("",), unit=""), (0.0, 1.0), None)
        self.places = PlotLayout(width=1, height=1, left=0, top=0, right=1, bottom=1, n_rows=1)
        self.words_font = scaled(tabular(self.font()), _TEXT)
        self.zoom: Range | None = None
        self.stacked = self.fitted = False
        self.words, self.held = PlotTexts(), SteadyRange()
        self.columns = CachedColumns()
        self._content: tuple[PlotContent, XWindow] | None = None
        self.crosshair = Crosshair(self, self)
        self.crosshair.moved.connect(self.reading_changed)
        self.navigation = Navigation(self, self)
        self.playhead = Playhead(self)
        watch = (self.navigation.watch, self.playhead.watch)
        self.stack = Stack(self.scene(), self.words_font, watch)
        self.scene().sigMouseMoved.connect(self.navigation.follow_mouse)
        self.take_look()

    @property
    def message(self) -> str:
        """What is said in place of curves."""
        return self.stack.message.text

    def sizeHint(self) -> QSize:
        return QSize(256, 192)

    def minimumSizeHint(self) -> QSize:
        return least_size(QFontMetricsF(self.words_font))

    def take_look(self) -> None:
        super().take_look()
        self.words_font = scaled(tabular(self.font()), _TEXT)
        self.updateGeometry()
        self.stack.show_fonts(self.words_font, self.font())
        self.playhead.take_colours()
        self._colour()

    def set_view(
        self, axis: XAxis, zoom: Range | None, *, stacked: bool, fitted: bool = False
    ) -> None:
        """X axis, its visible part in SI (``None``: all), one row for each curve or one.

        Values are ``fitted`` to that part, or to all of it.
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

    def set_words(self, words: PlotTexts) -> None:
        """Words around the curves."""
        if words != self.words:
            self.words = words
            self._place()
            self._colour()

    def begin_anew(self) -> None:
        """Decide the range of the next curves without a look at those before."""
        self.held.let_go()

    def show_curves(self, curves: Curves) -> None:
        """Draw ``curves`` in place of those before; zoom and crosshair stay."""
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
        """Empty the picture and say ``message`` in its middle."""
        if self.curves is None and message == self.message:
            return
        self.curves, self._content = None, None
        self.crosshair.forget()
        self.stack.say(message)
        # While there were curves, the plot may have got another size.
        self._place()
        self.reading_changed.emit()

    def show_band(self, covered: Range | None) -> None:
        """Show what a drag covers, positions, or nothing."""
        if covered is None:
            self.stack.show_band(None)
            return
        area = self.places.area
        start, end = (area.left() + area.width() * self.x_window.part(at) for at in covered)
        self.stack.show_band(QRectF(start, area.top(), end - start, area.height()))

    def claims(self, event: QKeyEvent) -> bool:
        return self.curves is not None and (super().claims(event) or self._moves_playhead(event))

    def viewportEvent(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            QToolTip.showText(event.globalPos(), self._hint_at(event.y()), self)
            return True
        return super().viewportEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.playhead.cancel():
            return
        if self._moves_playhead(event):
            self.playhead_key.emit(event)
        else:
            self.navigation.press(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        # The right button opens the menu, which takes its release: the scene need not know.
        if event.button() == Qt.MouseButton.RightButton:
            event.accept()
        else:
            super().mousePressEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.RightButton:
            super().mouseReleaseEvent(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.navigation.show_everything()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        self.menu_wanted.emit(event.globalPos())

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.navigation.leave()

    def _moves_playhead(self, event: QKeyEvent) -> bool:
        return self.playhead.time_s is not None and bool(meaning_of(PLAYHEAD, event))

    def _hint_at(self, y_px: float) -> str:
        # What the words above and below the plot say when there is room for them.
        if self.curves is None or self.places.top <= y_px <= self.places.bottom:
            return ""
        return self.places.header.whole if y_px < self.places.top else self.x_window.axis.titles[0]

    def lay_out(self) -> None:
        other_rows = self._place()
        if self.curves is None:
            return
        places = self.places
        each = self.curves.each
        n_drawn = self.curves.n_drawn(places.n_rows, stacked=self.stacked)
        rows = [places.row(rank // each if self.stacked else 0) for rank in range(n_drawn)]
        ratio = PAPER_DOTS if self._on_paper else self.devicePixelRatioF()
        seen = visible_range(self.curves, self.x_window, n_drawn, rows[0], ratio, self.columns)
        fitted = self.fitted and self.zoom is not None
        if values := seen.extremes if fitted else seen.beyond(self.value_scale.values):
            self._fit(self.curves, values)
            self._place()
        self.stack.show_points(curve_points(seen, self.value_scale, rows, ratio))
        if other_rows:  # only now has each row its curves
            self._colour()
        self.crosshair.draw()

    def _fit(self, curves: Curves, extremes: Range) -> None:
        """Have room for values that were found."""
        values = self.held.follow(*extremes, curves.kind)
        self.value_scale = ValueScale(values=values, edge=self.value_scale.edge)
        self.unit = value_unit(curves.kind, *values)

    def _place(self) -> bool:  # whether there are more or fewer rows than before
        curves = self.curves
        if curves is None:
            self.stack.place_message(QRectF(self.rect()))
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
            level=curves.level_words if curves.kind == "level" else "",
            matched=curves.matched,
            n_curves=len(curves.names),
            scaling=curves.scaling,
            words=self.words,
        )
        other_rows = self._content is None or self._content[0].n_rows != count
        if (content, self.x_window) != self._content:
            self._content = (content, self.x_window)
            self.places = laid_out(content, QFontMetricsF(self.words_font), self.places.left)
            self.stack.place(self.places, self.x_window)
        return other_rows

    def _colour(self) -> None:
        names = () if self.curves is None or not self.stacked else self.curves.names
        n_axes = 0 if self.curves is None else len(self.curves.axes)
        numbers = [name.number for name in names]
        self.stack.show_colours(numbers, stale=self.words.stale, n_axes=n_axes)
