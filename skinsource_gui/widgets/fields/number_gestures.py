"""Numbers made by dragging, by the wheel and by keys."""

from dataclasses import dataclass
from fractions import Fraction

from PySide6.QtCore import QObject, QPoint, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QWheelEvent

from skinsource_gui.widgets.fields.burst import Burst
from skinsource_gui.widgets.fields.gesture import new_gesture
from skinsource_gui.widgets.fields.round_numbers import COARSE, FINE, PLAIN, Ladder, stepped
from skinsource_gui.widgets.fields.shown_number import ShownNumber
from skinsource_gui.widgets.keys import meaning_of
from skinsource_gui.widgets.wheel import NOTCH

#: Way of the mouse that makes one step, and way after which a press is a drag.
PIXELS_PER_STEP = 4
DRAG_BEGINS_PX = 3

_DIRECTIONS = {
    Qt.Key.Key_Up: 1,
    Qt.Key.Key_Down: -1,
    Qt.Key.Key_PageUp: 1,
    Qt.Key.Key_PageDown: -1,
}


@dataclass(slots=True, kw_only=True)
class _Drag:
    """A press that may become a drag.

    Attributes
    ----------
    last
        Where the mouse was.
    gesture
        Number shared by all edits, or None as long as the press is no drag yet.
    start_si
        Value before the drag.
    ladder, position
        Values that the drag goes through, and where on it the drag is.
    travel_px
        The way that is not yet a step.
    """

    last: QPoint
    gesture: int | None = None
    start_si: float
    ladder: Ladder | None = None
    position: int = 0
    travel_px: int = 0


class NumberGestures(QObject):
    """Turns drags, notches of the wheel and arrow keys into round numbers.

    Ctrl makes steps fine, Shift coarse.  All values of one drag share one gesture, and so do
    steps that follow each other quickly.
    """

    #: The new value in SI units, number of its gesture.
    stepped = Signal(float, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._drag: _Drag | None = None
        self._burst = Burst(self)
        self._wheel_travel = 0.0

    @property
    def in_burst(self) -> bool:
        """Whether the next step belongs to the same gesture as the last."""
        return self._burst.active

    @property
    def dragging(self) -> bool:
        """Whether the button is held."""
        return self._drag is not None

    @staticmethod
    def knows(event: QKeyEvent) -> bool:
        """Whether a key makes steps."""
        return meaning_of("number", event) in ("step", "page")

    def notches(self, event: QWheelEvent) -> int:
        """Whole notches that the wheel has turned since the last one."""
        # Shift and Alt turn a vertical wheel into a horizontal one on some systems.
        self._wheel_travel += event.angleDelta().y() or event.angleDelta().x()
        notches = int(self._wheel_travel / NOTCH)
        self._wheel_travel -= notches * NOTCH
        return notches

    def turn(self, notches: int, number: ShownNumber, event: QWheelEvent) -> None:
        """Go some steps with the wheel."""
        size = _size(event.modifiers())
        self._go(Ladder(number.value_si, number.spec, size).value_si(notches), number)

    def press_key(self, event: QKeyEvent, number: ShownNumber) -> None:
        """Go one step with a key."""
        size = COARSE if meaning_of("number", event) == "page" else _size(event.modifiers())
        direction = _DIRECTIONS[Qt.Key(event.key())]
        self._go(stepped(number.value_si, direction, number.spec, size), number)

    def start_anew(self) -> None:
        """Somebody else changed the value: what follows starts from there, as a new gesture."""
        self._burst.end()
        if self._drag is not None:
            self._drag.ladder = None

    def press(self, event: QMouseEvent, number: ShownNumber) -> None:
        """The button goes down on the number."""
        here = event.globalPosition().toPoint()
        self._drag = _Drag(last=here, start_si=number.value_si)

    def move(self, event: QMouseEvent, number: ShownNumber) -> None:
        """The mouse moves while the button is held."""
        drag, here = self._drag, event.globalPosition().toPoint()
        if drag is None:
            return
        way = here - drag.last
        if drag.gesture is None:
            if way.manhattanLength() < DRAG_BEGINS_PX:
                return
            drag.gesture = new_gesture()
        drag.last = here
        drag.travel_px += way.x() - way.y()
        self._follow(drag, number, _size(event.modifiers()))

    def release(self) -> None:
        """The button goes up, or the press became something else."""
        self._drag = None

    def give_up(self, number: ShownNumber) -> None:
        """End the drag as if it had not begun."""
        drag, self._drag = self._drag, None
        if drag is not None and number.value_si != drag.start_si:
            self.stepped.emit(drag.start_si, drag.gesture)

    def _follow(self, drag: _Drag, number: ShownNumber, size: Fraction) -> None:
        if drag.ladder is None or drag.ladder.size != size:
            drag.ladder, drag.position = Ladder(number.value_si, number.spec, size), 0
        steps = int(drag.travel_px / PIXELS_PER_STEP)
        drag.travel_px -= steps * PIXELS_PER_STEP
        drag.position += steps
        # Counted from the start, so that the way back leads to the same number.
        value_si = drag.ladder.value_si(drag.position)
        if value_si in (number.spec.minimum, number.spec.maximum):
            # At its end the number waits; turning back moves it at once.
            drag.ladder, drag.position = Ladder(value_si, number.spec, size), 0
        if value_si != number.value_si:
            self.stepped.emit(value_si, drag.gesture)

    def _go(self, value_si: float, number: ShownNumber) -> None:
        if value_si != number.value_si:
            self.stepped.emit(value_si, self._burst.gesture())


def _size(modifiers: Qt.KeyboardModifier) -> Fraction:
    if modifiers & Qt.KeyboardModifier.ControlModifier:
        return FINE
    return COARSE if modifiers & Qt.KeyboardModifier.ShiftModifier else PLAIN
