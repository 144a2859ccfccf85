"""What keys mean in the list of inputs."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence

_Key, _Held = Qt.Key, Qt.KeyboardModifier
_STEPS = {_Key.Key_Up: -1, _Key.Key_Down: 1}
_ENDS = (_Key.Key_Home, _Key.Key_End)
_TYPE = (_Key.Key_Return, _Key.Key_Enter, _Key.Key_F2)
_REMOVE = (_Key.Key_Delete, _Key.Key_Backspace)


class ListKeys(QObject):
    """Turns key presses into what they mean."""

    #: The row to go to; whether all rows on the way are selected too.
    moved = Signal(int, bool)
    #: Whether the selected inputs go down.
    shifted = Signal(bool)
    all_selected = Signal()
    removed = Signal()
    mute_toggled = Signal()
    solo_toggled = Signal()
    duplicated = Signal()
    typing_wanted = Signal()

    def claims(self, event: QKeyEvent) -> bool:
        """Whether the list wants this key for itself, before any shortcut of the window."""
        if event.matches(QKeySequence.StandardKey.Delete):
            return True
        key = _Key(event.key())
        held = event.modifiers() & ~_Held.KeypadModifier
        if key in (_Key.Key_D, _Key.Key_A):
            return held == _Held.ControlModifier
        if key in _STEPS:
            return held in (_Held.NoModifier, _Held.ShiftModifier, _Held.AltModifier)
        if key in _ENDS:
            return held in (_Held.NoModifier, _Held.ShiftModifier)
        return key in (_Key.Key_M, _Key.Key_S, *_TYPE, *_REMOVE) and held == _Held.NoModifier

    def press(self, event: QKeyEvent, here: int | None, count: int) -> bool:
        """Tell what a key means at row ``here`` of ``count``; whether it means anything."""
        if not self.claims(event) or not count:
            return False
        key, held = _Key(event.key()), event.modifiers()
        if key in _STEPS and held & _Held.AltModifier:
            self.shifted.emit(key == _Key.Key_Down)
        elif key in _STEPS or key in _ENDS:
            self.moved.emit(_target(key, here, count), bool(held & _Held.ShiftModifier))
        elif key == _Key.Key_A:
            self.all_selected.emit()
        elif here is None:
            return False
        else:
            self._act(key)
        return True

    def _act(self, key: Qt.Key) -> None:
        """Tell what is wanted of the selected inputs."""
        meanings = {
            _Key.Key_M: self.mute_toggled,
            _Key.Key_S: self.solo_toggled,
            _Key.Key_D: self.duplicated,
            **dict.fromkeys(_TYPE, self.typing_wanted),
        }
        meanings.get(key, self.removed).emit()


def _target(key: Qt.Key, here: int | None, count: int) -> int:
    if here is None or key in _ENDS:
        return count - 1 if key in (_Key.Key_End, _Key.Key_Up) else 0
    return min(max(here + _STEPS[key], 0), count - 1)
