"""What keys mean on the map."""

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from skinsource.base.arrays import Floats
from skinsource_gui.widgets.keys import meaning_of
from skinsource_gui.widgets.outputs.picking import (
    Outputs,
    dorsal_outputs,
    is_placed,
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


class OutputKeys(QObject):
    """Moves a cursor from output to output, and selects there.

    Attributes
    ----------
    cursor_output
        Where the cursor is; ``None`` until keys are used.
    used
        Whether keys were used here since the mouse was.
    """

    #: The outputs that are meant.
    meant = Signal(object)
    #: Another output has the cursor.
    moved = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.cursor_output: int | None = None
        self.used = False

    def claims(self, event: QKeyEvent) -> bool:
        """Whether a shortcut of the window must not take this key."""
        return bool(meaning_of("skin", event))

    def press(
        self,
        event: QKeyEvent,
        points: Floats,
        unplaced: Outputs,
        outputs: Outputs,
        middle: QPointF,
    ) -> bool:
        """Act on a key; return whether it means anything to outputs.

        Parameters
        ----------
        event
            The press.
        points : (n_outputs, 2)
            Screen places of the outputs.
        unplaced
            Those beside the map.
        outputs
            Those that are selected.
        middle
            Of the map, where the cursor begins.
        """
        wanted = meaning_of("skin", event)
        if wanted == "go":
            place = self._start(points, outputs, middle)
            if self.cursor_output is not None:
                place = output_beyond(points, place, *_ARROWS[Qt.Key(event.key())])
            self.cursor_output = place
            self.moved.emit()
        elif wanted in ("select", "toggle"):
            number = self._start(points, outputs, middle)
            self.cursor_output = number
            self.meant.emit(toggled(outputs, number) if wanted == "toggle" else (number,))
        elif wanted == "select_all":
            self.meant.emit(dorsal_outputs(points, unplaced))
        else:
            return False
        self.used = True
        return True

    def _start(self, points: Floats, outputs: Outputs, middle: QPointF) -> int:
        cursor = () if self.cursor_output is None else (self.cursor_output,)
        here = [number for number in (*cursor, *outputs) if is_placed(points, number)]
        return here[0] if here else output_at(points, middle, float("inf")) or 1
