"""Which output of a map is pointed at, and which are to be selected."""

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent

from skinsource.base.arrays import Floats
from skinsource_gui.widgets.keys import meaning_of
from skinsource_gui.widgets.outputs.keys import ADDS, OutputKeys
from skinsource_gui.widgets.outputs.mouse import OutputMouse
from skinsource_gui.widgets.outputs.picking import Outputs


class OutputPicker(QObject):
    """What the mouse and keys mean on a map whose outputs are selected.

    Attributes
    ----------
    mouse, keys
        What each of them means.
    selected
        The outputs that are selected at present.
    """

    #: The outputs to select, a tuple of numbers.
    chosen = Signal(object)
    #: The cursor of the keyboard is at another output, and counts from now on.
    moved = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.mouse, self.keys = OutputMouse(self), OutputKeys(self)
        self.selected: Outputs = ()
        self.mouse.meant.connect(self._choose)
        self.keys.meant.connect(self._choose)
        self.keys.moved.connect(self._follow_cursor)

    def pointed_at(self, *, focused: bool) -> int | None:
        """The output under the pointer; without one, and ``focused``, under the cursor of keys."""
        if self.mouse.pointer is not None:
            return self.mouse.hovered
        return self.keys.cursor_output if focused else None

    def claims(self, event: QKeyEvent) -> bool:
        """Whether a key is wanted here even if it is a shortcut of the window."""
        # Until keys are used here, Space is left to whom the window gives it.
        is_used = self.keys.used or event.key() != Qt.Key.Key_Space
        return is_used and self.keys.claims(event)

    def press(self, event: QMouseEvent) -> None:
        """A button goes down."""
        self.keys.used = False
        if event.button() == Qt.MouseButton.LeftButton:
            self.mouse.press(event.position())

    def release(self, event: QMouseEvent, points: Floats) -> None:
        """The left button goes up; ``points`` is (n_outputs, 2), px."""
        adds = bool(event.modifiers() & ADDS)
        self.mouse.release(event.position(), points, self.selected, adds=adds)

    def press_key(
        self, event: QKeyEvent, points: Floats, unplaced: Outputs, middle: QPointF
    ) -> bool:
        """Act on a key, see `OutputKeys.press`; return whether it means anything to outputs."""
        if meaning_of("skin", event) != "select_none":
            return self.keys.press(event, points, unplaced, self.selected, middle)
        if not self.mouse.give_up():
            self._choose(())
        return True

    def _choose(self, outputs: Outputs) -> None:
        if len(outputs) == 1:
            self.keys.cursor_output = outputs[0]
        if outputs != self.selected:
            self.chosen.emit(outputs)

    def _follow_cursor(self) -> None:
        self.mouse.leave()
        self.moved.emit()
