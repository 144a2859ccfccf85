"""What a notch of the mouse wheel does, the same in plots, maps and numbers."""

from collections.abc import Callable
from time import monotonic

from PySide6.QtCore import QObject, QPoint
from PySide6.QtGui import QCursor, QWheelEvent
from PySide6.QtWidgets import QScrollBar, QWidget

from skinsource_gui.widgets.into_sight import areas_around

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
        taken = self._clock() - self._taken_s < PAUSE_S
        if taken:
            self.take()
        return taken

    def _note(self, _value: int = 0) -> None:
        self._last_s, self._pointer = self._clock(), QCursor.pos()
