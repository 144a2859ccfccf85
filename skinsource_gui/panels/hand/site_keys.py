"""What keys mean on the hand diagram."""

from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent

from skinsource_gui.widgets.fields.gesture import new_gesture
from skinsource_gui.widgets.keys import meaning_of

#: Two digits typed within this time make one number, ms.
TYPING_MS = 800

_PLACE = "hand"
_Key = Qt.Key
_STEPS = {
    _Key.Key_Left: (-1, 0),
    _Key.Key_Right: (1, 0),
    _Key.Key_Up: (0, -1),
    _Key.Key_Down: (0, 1),
}
_DIGITS = {_Key(_Key.Key_0 + digit): digit for digit in range(10)}


class SiteKeys(QObject):
    """Turns key presses into what they mean.

    A number of several digits may be typed; all Shift+arrow presses until Shift is let go are one
    gesture.

    Parameters
    ----------
    n_sites
        How many sites the hand has.
    """

    #: Direction (x right, y down).
    stepped = Signal(int, int)
    jumped = Signal(int)
    #: Whether a further input is wanted.
    activated = Signal(bool)
    #: Direction and gesture.
    shifted = Signal(int, int, int)
    removed = Signal()
    all_selected = Signal()

    def __init__(self, n_sites: int, parent: QObject) -> None:
        super().__init__(parent)
        self._n_sites = n_sites
        self._typed = 0
        self._gesture: int | None = None
        self._pause = QTimer(self, singleShot=True, interval=TYPING_MS)
        self._pause.setObjectName("typing")
        self._pause.timeout.connect(self._forget_digits)

    def show_count(self, n_sites: int) -> None:
        """Take over how many sites the hand has."""
        self._n_sites = n_sites
        self._forget_digits()

    def claims(self, event: QKeyEvent) -> bool:
        """Whether the diagram wants this key for itself, before any shortcut of the window."""
        return bool(meaning_of(_PLACE, event))

    def press(self, event: QKeyEvent) -> bool:
        """Tell by a signal what the key means; return whether it means anything here."""
        wanted, key = meaning_of(_PLACE, event), _Key(event.key())
        if wanted == "move":
            self._gesture = self._gesture or new_gesture()
            self.shifted.emit(*_STEPS[key], self._gesture)
        elif wanted == "go":
            self.stepped.emit(*_STEPS[key])
        elif wanted == "jump" and key in _DIGITS:
            self._type(_DIGITS[key])
        elif wanted == "jump":
            self.jumped.emit(1 if key == _Key.Key_Home else self._n_sites)
        elif wanted == "remove":
            self.removed.emit()
        elif wanted == "select_all":
            self.all_selected.emit()
        elif wanted:
            self.activated.emit(wanted == "place_another")
        return bool(wanted)

    def release(self, event: QKeyEvent) -> None:
        """Letting Shift go ends the gesture."""
        if event.key() == _Key.Key_Shift:
            self.end_gesture()

    def end_gesture(self) -> None:
        """The next Shift+arrow press is an undo step of its own."""
        self._gesture = None

    def _type(self, digit: int) -> None:
        number = 10 * self._typed + digit
        self._typed = number if number <= self._n_sites else digit
        self._pause.start()
        if self._typed:
            self.jumped.emit(self._typed)

    def _forget_digits(self) -> None:
        self._typed = 0
