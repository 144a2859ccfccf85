"""The mouse wheel: scroll areas around a widget, and zooming and panning of a drawing."""

from collections.abc import Callable, Iterator, Mapping
from time import monotonic

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QPoint, QPointF, QRectF, Qt, Signal

from skinsource.base.conventions import Floats
from skinsource_gui.qt.frames import Frame


def areas_around(widget: QtWidgets.QWidget) -> Iterator[QtWidgets.QScrollArea]:
    """Yield the scroll areas around a widget, the innermost first."""
    parent = widget.parentWidget()
    while parent is not None:
        if isinstance(parent, QtWidgets.QScrollArea):
            yield parent
        parent = parent.parentWidget()


def scroll_to(widget: QtWidgets.QWidget) -> None:
    """Scroll the areas around a widget until it is visible."""
    for area in areas_around(widget):
        area.ensureWidgetVisible(widget)


#: Turn of the wheel at each notch, in Qt's eighths of a degree.
NOTCH = 120.0
#: Factor of the zoom of a plot or a map for each notch.
ZOOM_PER_NOTCH = 1.2
#: Pan along an axis for each notch, as a part of the visible range.
PAN_PER_NOTCH = 0.1
#: A pause of this length ends a turn of the wheel, s.
PAUSE_S = 0.5
# A hand that turns the wheel moves the pointer a little.
_STILL_PX = 4


class ScrollGesture(QObject):
    """Tells when the wheel goes on scrolling the areas around a widget.

    Scrolling moves widgets that use the wheel themselves under a pointer at rest: they ignore the
    wheel until the pointer moves or the wheel rests.

    Parameters
    ----------
    widget
        Widget inside of scroll areas; also the parent.
    clock
        Returns seconds.
    """

    def __init__(self, widget: QtWidgets.QWidget, clock: Callable[[], float] = monotonic) -> None:
        super().__init__(widget)
        self._widget, self._clock = widget, clock
        self._bars: list[QtWidgets.QScrollBar] = []
        self._last_s, self._pointer = -PAUSE_S, QPoint()
        self._used_s = -PAUSE_S

    def watch(self) -> None:
        """Watch the present scroll areas around the widget."""
        for area in areas_around(self._widget):
            for bar in (area.verticalScrollBar(), area.horizontalScrollBar()):
                if not any(bar is other for other in self._bars):
                    self._bars.append(bar)
                    bar.valueChanged.connect(self._note)

    def passes(self, event: QtGui.QWheelEvent) -> bool:
        """Return whether this turn of the wheel is for the areas around the widget."""
        # With a modifier it is a new gesture.
        moved = (QtGui.QCursor.pos() - self._pointer).manhattanLength() > _STILL_PX
        rested = self._clock() - self._last_s >= PAUSE_S
        if moved or rested or event.modifiers().value:
            return False
        # The gesture goes on at the end of the scroll range, too.
        self._note()
        return True

    def take(self) -> None:
        """Note that the widget has used this turn of the wheel."""
        self._used_s = self._clock()

    def was_used(self) -> bool:
        """Return whether the widget has used the present turn of the wheel so far."""
        recent = self._clock() - self._used_s < PAUSE_S
        if recent:
            self.take()
        return recent

    def _note(self, _value: int = 0) -> None:
        self._last_s, self._pointer = self._clock(), QtGui.QCursor.pos()


#: The fit that shows everything, and the name for a free zoom.
WHOLE, FREE = "whole", "free"

_LARGEST_ZOOM = 25.0
_ZOOM_PER_KEY = 1.25
_PAN_PER_NOTCH_PX = 48.0
# A revealed point is at least this far from the edge, px.
_EDGE_PX = 20.0
_KEY_FACTORS = {"zoom_in": _ZOOM_PER_KEY, "zoom_out": 1 / _ZOOM_PER_KEY}


class PanZoom(QObject):
    """Zoom and pan of a drawing that is fitted into its widget.

    The wheel zooms at the pointer; Shift and wheel, or a drag with the middle button, pan.  A turn
    of the wheel that began to scroll the areas around the widget goes on with that; zooming out of
    the whole drawing begins it.  The drawing is never smaller than its whole fit, nor out of sight.

    Parameters
    ----------
    widget
        Widget of the drawing; its cursor changes during a drag.

    Attributes
    ----------
    frame
        Place of the drawing; None without one.
    fit
        Name of the present fit, or `FREE` after zooming or panning.
    """

    #: There is another frame.
    changed = Signal()

    def __init__(self, widget: QtWidgets.QWidget) -> None:
        super().__init__(widget)
        self._widget = widget
        self._fits: Mapping[str, Frame] = {}
        self._outline: Floats = np.zeros((0, 2))
        self._room = QRectF()
        self._grip: QPointF | None = None
        self.frame: Frame | None = None
        self.fit = WHOLE
        self.scrolling_on = ScrollGesture(widget)

    def arrange(self, fits: Mapping[str, Frame], outline: Floats, room: QRectF) -> None:
        """Fit a drawing into a room; a magnified drawing keeps its middle.

        Parameters
        ----------
        fits
            Frames by name, `WHOLE` among them; none without a drawing.
        outline : (n, 2)
            Outline of the drawing, in its own units; some of its inside stays visible.
        room
            Area in the widget, px.
        """
        # The widget has a size now, and a place in its scroll areas.
        self.scrolling_on.watch()
        before, was, self._room = self.frame, self._room, room
        self._fits, self._outline = fits, outline
        if not fits:
            self.frame = None
        elif self.fit == FREE and before is not None and before.scale > fits[WHOLE].scale:
            moved = room.center() - was.center()
            self.frame = self._in_sight(before.moved(moved.x(), moved.y()))
        elif self.fit == FREE:
            # In the new room it would be smaller than the whole fit.
            self.fit, self.frame = WHOLE, fits[WHOLE]
        else:
            self.frame = fits[self.fit if self.fit in fits else WHOLE]
        self.changed.emit()

    def show(self, fit: str) -> None:
        """Show one of the fits."""
        self.fit = fit
        if self._fits:
            self.frame = self._fits[fit]
            self.changed.emit()

    def zoom(self, factor: float, about: QPointF) -> None:
        """Magnify around a point, no further out than the whole drawing."""
        if self.frame is None:
            return
        whole_scale = self._fits[WHOLE].scale
        scale = min(self.frame.scale * factor, _LARGEST_ZOOM * whole_scale)
        if scale <= whole_scale:
            self.show(WHOLE)
        else:
            self._go_to(self.frame.zoomed(scale / self.frame.scale, about))

    def pan(self, dx: float, dy: float) -> None:
        """Shift the drawing by screen pixels, as far as it stays visible."""
        if self.frame is not None and self.fit != WHOLE:
            self._go_to(self.frame.moved(dx, dy))

    def reveal(self, at: QPointF) -> None:
        """Pan until a screen point of the drawing is visible."""
        room = self._room.adjusted(_EDGE_PX, _EDGE_PX, -_EDGE_PX, -_EDGE_PX)
        dx = min(max(at.x(), room.left()), room.right()) - at.x()
        dy = min(max(at.y(), room.top()), room.bottom()) - at.y()
        if dx or dy:
            self.pan(dx, dy)

    def wheel(self, event: QtGui.QWheelEvent) -> None:
        """Handle a turn of the wheel."""
        if self.scrolling_on.passes(event) or self._leaves(event):
            event.ignore()
            return
        self.scrolling_on.take()
        right, up = event.angleDelta().x() / NOTCH, event.angleDelta().y() / NOTCH
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self.pan((right + up) * _PAN_PER_NOTCH_PX, 0)
        else:
            if up:
                self.zoom(ZOOM_PER_NOTCH**up, event.position())
            if right:
                self.pan(right * _PAN_PER_NOTCH_PX, 0)
        event.accept()

    def press(self, event: QtGui.QMouseEvent) -> None:
        """Handle a button that goes down: the middle one grips the drawing."""
        if event.button() == Qt.MouseButton.MiddleButton:
            self._grip = event.position()
            self._widget.setCursor(Qt.CursorShape.ClosedHandCursor)

    def move(self, event: QtGui.QMouseEvent) -> None:
        """Handle a move of the mouse, with or without a button."""
        if self._grip is not None:
            by = event.position() - self._grip
            self._grip = event.position()
            self.pan(by.x(), by.y())

    def release(self, event: QtGui.QMouseEvent) -> None:
        """Handle a button that goes up."""
        if event.button() == Qt.MouseButton.MiddleButton and self._grip is not None:
            self._grip = None
            self._widget.unsetCursor()

    def step(self, name: str) -> bool:
        """Zoom by a key of the table of keys; return whether it is a key for zooming."""
        factor = _KEY_FACTORS.get(name)
        if factor is not None:
            self.zoom(factor, self._room.center())
        return factor is not None

    def _leaves(self, event: QtGui.QWheelEvent) -> bool:
        """Return whether the wheel zooms out of the whole drawing, and did not begin by zooming."""
        turned, modifiers = event.angleDelta(), event.modifiers().value
        out = turned.y() < 0 and not turned.x() and not modifiers
        return out and self.fit == WHOLE and not self.scrolling_on.was_used()

    def _go_to(self, frame: Frame) -> None:
        self.fit = FREE
        self.frame = self._in_sight(frame)
        self.changed.emit()

    def _in_sight(self, frame: Frame) -> Frame:
        return frame.shifted_into_sight(self._outline, self._room)
