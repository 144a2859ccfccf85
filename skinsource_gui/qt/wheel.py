"""Parts of what scrolls are brought where they can be seen."""

from collections.abc import Callable, Iterator, Mapping
from time import monotonic

import numpy as np
from PySide6.QtCore import QObject, QPoint, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QCursor, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QScrollArea, QScrollBar, QWidget

from skinsource.base.arrays import Floats
from skinsource_gui.qt.frames import Frame


def areas_around(widget: QWidget) -> Iterator[QScrollArea]:
    """Areas that scroll a widget, the innermost first."""
    parent = widget.parentWidget()
    while parent is not None:
        if isinstance(parent, QScrollArea):
            yield parent
        parent = parent.parentWidget()


def bars_px(widget: QWidget) -> int:
    """Width that scroll bars around a widget have taken."""
    return sum(
        max(area.maximumViewportSize().width() - area.viewport().width(), 0)
        for area in areas_around(widget)
    )


def bring_into_sight(widget: QWidget) -> None:
    """Scroll what is around a widget until it is seen."""
    for area in areas_around(widget):
        area.ensureWidgetVisible(widget)


# What a notch of the mouse wheel does, the same in plots, maps and numbers.

#: How far Qt says the wheel has turned at each notch: eighths of a degree.
NOTCH = 120.0
#: How many times larger a plot or a map becomes with each notch.
ZOOM_PER_NOTCH = 1.2
#: How far each notch goes along an axis, as a part of what is shown.
PAN_PER_NOTCH = 0.1
#: After a pause so long the wheel begins anew, s.
PAUSE_S = 0.5
# A hand that turns the wheel moves the pointer a little.
_STILL_PX = 4


class ScrollingOn(QObject):
    """Tells that the wheel goes on scrolling what is around a widget.

    What scrolls under a pointer at rest brings widgets there that take the wheel for themselves:
    they let it pass until the pointer moves, or the wheel rests.

    Parameters
    ----------
    widget
        It may stand in areas that scroll; also the parent.
    clock
        Seconds, from any start.
    """

    def __init__(self, widget: QWidget, clock: Callable[[], float] = monotonic) -> None:
        super().__init__(widget)
        self._widget, self._clock = widget, clock
        self._bars: list[QScrollBar] = []
        self._last_s, self._pointer = -PAUSE_S, QPoint()
        self._taken_s = -PAUSE_S

    def watch(self) -> None:
        """Notice when the areas scroll that are around it now."""
        for area in areas_around(self._widget):
            for bar in (area.verticalScrollBar(), area.horizontalScrollBar()):
                if not any(bar is other for other in self._bars):
                    self._bars.append(bar)
                    bar.valueChanged.connect(self._note)

    def passes(self, event: QWheelEvent) -> bool:
        """Whether this turn of the wheel is for what is around the widget."""
        # With a key held it is meant otherwise than the turns before.
        moved = (QCursor.pos() - self._pointer).manhattanLength() > _STILL_PX
        rested = self._clock() - self._last_s >= PAUSE_S
        if moved or rested or event.modifiers().value:
            return False
        # At the end of what scrolls, too, one turn is one movement.
        self._note()
        return True

    def take(self) -> None:
        """Note that the widget took this turn of the wheel for itself."""
        self._taken_s = self._clock()

    def was_taken(self) -> bool:
        """Whether the turn that goes on was the widget's own, and still is."""
        recent = self._clock() - self._taken_s < PAUSE_S
        if recent:
            self.take()
        return recent

    def _note(self, _value: int = 0) -> None:
        self._last_s, self._pointer = self._clock(), QCursor.pos()


# Zooming and panning of a drawing that is fitted into its widget.

#: The fit that shows all, and what stands for none of the fits.
WHOLE, FREE = "whole", "free"

_LARGEST_ZOOM = 25.0
_ZOOM_PER_KEY = 1.25
_PAN_PER_NOTCH_PX = 48.0
# Something brought into sight stays this far from the edge, px.
_EDGE_PX = 20.0
_KEY_FACTORS = {"zoom_in": _ZOOM_PER_KEY, "zoom_out": 1 / _ZOOM_PER_KEY}


class PanZoom(QObject):
    """Keeps what part of a drawing is seen; used by whatever draws one.

    The wheel zooms at the pointer, with Shift it pans, and so does a drag with the middle button;
    one that began to scroll what is around the widget goes on with that, and one that turns out of
    the whole drawing begins it.
    The drawing is never smaller than its whole fit, nor out of sight.

    Parameters
    ----------
    widget
        Where it is drawn; its cursor changes during a drag.

    Attributes
    ----------
    frame
        Where the drawing lies; ``None`` before there is one.
    fit
        Name of the fit that is shown, or `FREE` after zooming or panning.
    scrolling_on
        Knows when the wheel is for what is around it.
    """

    #: Another frame.
    changed = Signal()

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        self._widget = widget
        self._fits: Mapping[str, Frame] = {}
        self._outline: Floats = np.zeros((0, 2))
        self._room = QRectF()
        self._grip: QPointF | None = None
        self.frame: Frame | None = None
        self.fit = WHOLE
        self.scrolling_on = ScrollingOn(widget)

    def arrange(self, fits: Mapping[str, Frame], outline: Floats, room: QRectF) -> None:
        """Fit a drawing into a room; what is magnified keeps its middle.

        Parameters
        ----------
        fits
            Frames by name, `WHOLE` among them; none at all where there is nothing to draw.
        outline : (n, 2)
            Of the drawing, in its own units; some of its inside stays in sight.
        room
            Of the widget, px.
        """
        # It has a size, and so a place in what scrolls.
        self.scrolling_on.watch()
        before, was, self._room = self.frame, self._room, room
        self._fits, self._outline = fits, outline
        if not fits:
            self.frame = None
        elif self.fit == FREE and before is not None and before.scale > fits[WHOLE].scale:
            moved = room.center() - was.center()
            frame = before.moved(moved.x(), moved.y())
            if room != was:
                frame = frame.moved(*self._into_new_room(before, frame, was))
            self.frame = self._kept(frame)
        elif self.fit == FREE:
            # In the new room it would be smaller than all of it.
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
        """Shift the drawing by screen pixels, as far as it stays in sight."""
        if self.frame is not None and self.fit != WHOLE:
            self._go_to(self.frame.moved(dx, dy))

    def reveal(self, at: QPointF) -> None:
        """Bring a screen point of the drawing into sight."""
        room = self._room.adjusted(_EDGE_PX, _EDGE_PX, -_EDGE_PX, -_EDGE_PX)
        dx = min(max(at.x(), room.left()), room.right()) - at.x()
        dy = min(max(at.y(), room.top()), room.bottom()) - at.y()
        if dx or dy:
            self.pan(dx, dy)

    def wheel(self, event: QWheelEvent) -> None:
        """The wheel turns over the drawing."""
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

    def press(self, event: QMouseEvent) -> None:
        """A button goes down; the middle one grips the drawing."""
        if event.button() == Qt.MouseButton.MiddleButton:
            self._grip = event.position()
            self._widget.setCursor(Qt.CursorShape.ClosedHandCursor)

    def move(self, event: QMouseEvent) -> None:
        """The mouse moves, whether or not the drawing is gripped."""
        if self._grip is not None:
            by = event.position() - self._grip
            self._grip = event.position()
            self.pan(by.x(), by.y())

    def release(self, event: QMouseEvent) -> None:
        """A button goes up."""
        if event.button() == Qt.MouseButton.MiddleButton and self._grip is not None:
            self._grip = None
            self._widget.unsetCursor()

    def step(self, name: str) -> bool:
        """Zoom by a key, as the table of keys calls it; return whether it was one for this."""
        factor = _KEY_FACTORS.get(name)
        if factor is not None:
            self.zoom(factor, self._room.center())
        return factor is not None

    def _leaves(self, event: QWheelEvent) -> bool:
        """Whether the wheel turns out of what is seen as a whole, and did not begin by zooming."""
        turned, modifiers = event.angleDelta(), event.modifiers().value
        out = turned.y() < 0 and not turned.x() and not modifiers
        return out and self.fit == WHOLE and not self.scrolling_on.was_taken()

    def _go_to(self, frame: Frame) -> None:
        self.fit = FREE
        self.frame = self._kept(frame)
        self.changed.emit()

    def _into_new_room(self, before: Frame, frame: Frame, was: QRectF) -> tuple[float, float]:
        """How far to shift it, so that the new room gets no emptier than it was before.

        At each edge it leaves free what the whole drawing would, or what it left free before.
        """
        whole, drawn, left = (
            _box(shown_frame.to_screen(self._outline))
            for shown_frame in (self._fits[WHOLE], frame, before)
        )
        room = self._room
        return (
            _shift(
                (drawn.left(), drawn.right()),
                max(whole.left(), room.left() + left.left() - was.left()),
                min(whole.right(), room.right() + left.right() - was.right()),
            ),
            _shift(
                (drawn.top(), drawn.bottom()),
                max(whole.top(), room.top() + left.top() - was.top()),
                min(whole.bottom(), room.bottom() + left.bottom() - was.bottom()),
            ),
        )

    def _kept(self, frame: Frame) -> Frame:
        return frame.kept_in_sight(self._outline, self._room)


def _box(places: Floats) -> QRectF:
    return QRectF(QPointF(*places.min(axis=0)), QPointF(*places.max(axis=0)))


def _shift(drawn: tuple[float, float], low: float, high: float) -> float:
    """How far to shift what is drawn from one end to the other, so that it covers the rest."""
    return min(low - drawn[0], 0.0) + max(high - drawn[1], 0.0)
