"""What the mouse means on the heads of tracks."""

from dataclasses import dataclass

from PySide6.QtCore import QObject, QPoint, Qt, Signal
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

_Held = Qt.KeyboardModifier


@dataclass(slots=True, kw_only=True)
class _Press:
    """The left button, held since it went down on a row; ``gap`` is where a drag would put it."""

    id: int
    at: QPoint
    was_selected: bool
    gap: int | None = None


class ListMouse(QObject):
    """Turns presses, moves and releases into what they mean.

    A press selects; with Ctrl it adds or takes out, with Shift it selects all rows on the way.
    Moving farther drags the selected rows between two others.
    """

    #: Id of an input.
    selected = Signal(int)
    toggled = Signal(int)
    reached = Signal(int)
    #: The gap between rows over which the selected ones are held, or None.
    held_over = Signal(object)
    #: The gap into which the selected ones are dropped.
    dropped = Signal(int)
    #: Id of the input whose menu is wanted, and where on the screen.
    menu_wanted = Signal(int, QPoint)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._press: _Press | None = None

    def press(self, event: QMouseEvent, id: int, was_selected: bool) -> None:
        """The left button goes down on the row of an input."""
        self.cancel()
        if event.modifiers() & _Held.ControlModifier:
            self.toggled.emit(id)
            return
        if event.modifiers() & _Held.ShiftModifier:
            self.reached.emit(id)
            return
        at = event.globalPosition().toPoint()
        self._press = _Press(id=id, at=at, was_selected=was_selected)
        if not was_selected:
            self.selected.emit(id)

    def move(self, event: QMouseEvent, gap: int) -> None:
        """The mouse moves, nearest to ``gap``."""
        press = self._press
        if press is None or not event.buttons() & Qt.MouseButton.LeftButton:
            return
        way = (event.globalPosition().toPoint() - press.at).manhattanLength()
        if press.gap is not None or way >= QApplication.startDragDistance():
            press.gap = gap
            self.held_over.emit(gap)

    def release(self) -> None:
        """The left button goes up."""
        press, self._press = self._press, None
        if press is None:
            return
        if press.gap is not None:
            self.held_over.emit(None)
            self.dropped.emit(press.gap)
        elif press.was_selected:
            # Among several, a click selects the one.
            self.selected.emit(press.id)

    def cancel(self) -> bool:
        """Give up a drag; whether there was one."""
        press, self._press = self._press, None
        if press is None or press.gap is None:
            return False
        self.held_over.emit(None)
        return True
