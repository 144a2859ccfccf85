"""What keys mean on the heads of tracks."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent

from skinsource_gui.widgets.keys import meaning_of

_PLACE = "inputs"
_Key = Qt.Key
_STEPS = {_Key.Key_Up: -1, _Key.Key_Down: 1}
_ENDS = (_Key.Key_Home, _Key.Key_End)


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
    gain_toggled = Signal()

    def claims(self, event: QKeyEvent) -> bool:
        """Whether the list wants this key for itself, before any shortcut of the window."""
        return bool(meaning_of(_PLACE, event))

    def press(self, event: QKeyEvent, here: int | None, count: int) -> bool:
        """Tell what a key means at row ``here`` of ``count``; whether it means anything."""
        wanted = meaning_of(_PLACE, event)
        if not wanted or not count:
            return False
        if wanted == "go":
            extending = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
            self.moved.emit(_target(_Key(event.key()), here, count), extending)
        elif wanted in ("shift_up", "shift_down"):
            self.shifted.emit(wanted == "shift_down")
        elif wanted == "select_all":
            self.all_selected.emit()
        elif here is None:
            return False
        else:
            self._act(wanted)
        return True

    def _act(self, wanted: str) -> None:
        """Tell what is wanted of the selected inputs."""
        {
            "mute": self.mute_toggled,
            "solo": self.solo_toggled,
            "duplicate": self.duplicated,
            "type": self.typing_wanted,
            "gain_curve": self.gain_toggled,
            "remove": self.removed,
        }[wanted].emit()


def _target(key: Qt.Key, here: int | None, count: int) -> int:
    if here is None or key in _ENDS:
        return count - 1 if key in (_Key.Key_End, _Key.Key_Up) else 0
    return min(max(here + _STEPS[key], 0), count - 1)
