"""What keys mean on the map."""

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence

from skinsource.arrays import Floats
from skinsource_gui.panels.skin.output_picking import (
    Outputs,
    dorsal_outputs,
    output_at,
    output_beyond,
    toggled,
)

#: Held, they add to the selection.
ADDS = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier
_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
}
_SELECT_KEYS = (Qt.Key.Key_Space, Qt.Key.Key_Return, Qt.Key.Key_Enter)
_OTHERS = (Qt.Key.Key_Escape, Qt.Key.Key_0, Qt.Key.Key_H)


class OutputKeys(QObject):
    """Moves a cursor from output to output, and selects there.

    Attributes
    ----------
    cursor_output
        Where the cursor is; ``None`` until keys are used.
    """

    #: The outputs that are meant.
    meant = Signal(object)
    #: Another output has the cursor.
    moved = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.cursor_output: int | None = None

    def claims(self, event: QKeyEvent) -> bool:
        """Whether a shortcut of the window must not take this key."""
        if _is_select_all(event):
            return True
        plain = not event.modifiers() & Qt.KeyboardModifier.ControlModifier
        return plain and event.key() in (*_ARROWS, *_SELECT_KEYS, *_OTHERS)

    def press(self, event: QKeyEvent, points: Floats, outputs: Outputs, middle: QPointF) -> bool:
        """Act on a key; return whether it means anything.

        Parameters
        ----------
        event
            The press.
        points : (n_outputs, 2)
            Screen places of the outputs.
        outputs
            Those that are selected.
        middle
            Of the map, where the cursor begins.
        """
        key = event.key()
        if key in _ARROWS:
            before = self.cursor_output
            start = self._start(points, outputs, middle)
            self.cursor_output = (
                start if before is None else output_beyond(points, start, *_ARROWS[Qt.Key(key)])
            )
            self.moved.emit()
        elif key in _SELECT_KEYS:
            number = self._start(points, outputs, middle)
            self.cursor_output = number
            adds = bool(event.modifiers() & ADDS)
            self.meant.emit(toggled(outputs, number) if adds else (number,))
        elif _is_select_all(event):
            self.meant.emit(dorsal_outputs(points))
        else:
            return False
        return True

    def _start(self, points: Floats, outputs: Outputs, middle: QPointF) -> int:
        if self.cursor_output is not None and self.cursor_output <= len(points):
            return self.cursor_output
        here = [number for number in outputs if number <= len(points)]
        return here[0] if here else output_at(points, middle, float("inf")) or 1


def _is_select_all(event: QKeyEvent) -> bool:
    # With Shift it is a shortcut of the window, and means the opposite.
    shift = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
    return event.matches(QKeySequence.StandardKey.SelectAll) and not shift
