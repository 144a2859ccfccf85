"""A number with its unit, that can be typed, dragged, turned and stepped."""

from dataclasses import dataclass

from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from skinsource.fields import NumberSpec
from skinsource_gui.widgets.fields.burst import Burst
from skinsource_gui.widgets.fields.gesture import new_gesture
from skinsource_gui.widgets.fields.number_entry import WIDEST_UNIT, NumberEntry
from skinsource_gui.widgets.fields.number_steps import COARSE, FINE, PLAIN, stepped
from skinsource_gui.widgets.fields.units import display_unit

#: Way of the mouse that makes one step, and way after which a press is a drag.
PIXELS_PER_STEP = 4
DRAG_BEGINS_PX = 3

_WHEEL_NOTCH = 120
_STEPS_OF_KEY = {
    Qt.Key.Key_Up: 1,
    Qt.Key.Key_Down: -1,
    Qt.Key.Key_PageUp: 10,
    Qt.Key.Key_PageDown: -10,
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
    start_si, anchor_si
        Value before the drag; value from which ``tenths`` are counted.
    tenths, travel_px
        Tenths of steps made, and the way that is not yet a step.
    """

    last: QPoint
    gesture: int | None = None
    start_si: float
    anchor_si: float
    tenths: int = 0
    travel_px: int = 0


class NumberField(NumberEntry):
    """A `NumberEntry` whose number can also be dragged, turned by the wheel and stepped by keys.

    Ctrl makes steps fine, Shift coarse.  All edits of one drag share one gesture, and so do
    steps that follow each other quickly.  The wheel acts only while the field has the focus, so
    that scrolling a panel changes nothing.
    """

    def __init__(
        self, spec: NumberSpec, parent: QWidget | None = None, *, widest_unit: str = WIDEST_UNIT
    ) -> None:
        super().__init__(spec, parent, widest_unit=widest_unit)
        self._drag: _Drag | None = None
        self._burst = Burst(self)
        self._wheel_travel = 0
        self.setCursor(Qt.CursorShape.SizeHorCursor)
        self.setMinimumWidth(72)

    @property
    def in_burst(self) -> bool:
        """Whether the next step belongs to the same gesture as the last."""
        return self._burst.active

    def set_value(self, value_si: float) -> None:
        if value_si == self.value_si:
            return
        # Somebody else changed it: what follows starts from there, as a new gesture.
        self._burst.end()
        if self._drag is not None:
            self._drag.anchor_si, self._drag.tenths = value_si, 0
        super().set_value(value_si)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and (
            event.key() in _STEPS_OF_KEY
            or (event.key() == Qt.Key.Key_Escape and (self.editing or self._drag is not None))
        ):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in _STEPS_OF_KEY:
            if self.commit():
                tenths = _STEPS_OF_KEY[event.key()] * self._tenths(event.modifiers())
                self._step(tenths)
        elif event.key() == Qt.Key.Key_Escape and self._drag is not None:
            self._give_up_drag()
        else:
            super().keyPressEvent(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        if not self.hasFocus():
            event.ignore()
            return
        event.accept()
        # Shift and Alt turn a vertical wheel into a horizontal one on some systems.
        self._wheel_travel += event.angleDelta().y() or event.angleDelta().x()
        notches = int(self._wheel_travel / _WHEEL_NOTCH)
        self._wheel_travel -= notches * _WHEEL_NOTCH
        if notches and self.commit():
            self._step(notches * self._tenths(event.modifiers()))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if self.editing or event.button() != Qt.MouseButton.LeftButton:
            super().mousePressEvent(event)
            return
        self._drag = _Drag(
            last=event.globalPosition().toPoint(),
            start_si=self.value_si,
            anchor_si=self.value_si,
        )

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._drag is None:
            # Without a press this would only set the cursor of a text.
            if self.editing:
                super().mouseMoveEvent(event)
            return
        here = event.globalPosition().toPoint()
        way = here - self._drag.last
        if self._drag.gesture is None:
            if way.manhattanLength() < DRAG_BEGINS_PX:
                return
            self._drag.gesture = new_gesture()
        self._drag.last = here
        self._drag.travel_px += way.x() - way.y()
        self._follow_drag(event.modifiers())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._drag is None:
            super().mouseReleaseEvent(event)
        self._drag = None

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if self.editing:
            super().mouseDoubleClickEvent(event)
        elif event.button() == Qt.MouseButton.LeftButton:
            self._drag = None
            self.begin_editing()

    def _follow_drag(self, modifiers: Qt.KeyboardModifier) -> None:
        drag = self._drag
        steps = int(drag.travel_px / PIXELS_PER_STEP)
        drag.travel_px -= steps * PIXELS_PER_STEP
        drag.tenths += steps * self._tenths(modifiers)
        # Counted from the start, so that the way back leads to the same number.
        unit = display_unit(self.spec.unit)
        value_si = stepped(drag.anchor_si, drag.tenths, self.spec, unit)
        if value_si in (self.spec.minimum, self.spec.maximum):
            # At its end the number waits; turning back moves it at once.
            drag.anchor_si, drag.tenths = value_si, 0
        if value_si != self.value_si:
            self._edit(value_si, drag.gesture)

    def _give_up_drag(self) -> None:
        drag, self._drag = self._drag, None
        if self.value_si != drag.start_si:
            self._edit(drag.start_si, drag.gesture)

    def _step(self, tenths: int) -> None:
        value_si = stepped(self.value_si, tenths, self.spec, display_unit(self.spec.unit))
        if value_si != self.value_si:
            self._edit(value_si, self._burst.gesture())

    def _tenths(self, modifiers: Qt.KeyboardModifier) -> int:
        if modifiers & Qt.KeyboardModifier.ControlModifier and not self.spec.whole:
            return FINE
        return COARSE if modifiers & Qt.KeyboardModifier.ShiftModifier else PLAIN
