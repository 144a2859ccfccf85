"""What all editors share: their base, gestures, and marks of errors."""

from collections.abc import Callable
from itertools import count
from typing import TYPE_CHECKING, Any

from PySide6 import QtWidgets
from PySide6.QtCore import QObject, Qt, QTimer, Signal

from skinsource.specs.spec import Spec

if TYPE_CHECKING:
    _Widget = QtWidgets.QWidget
else:
    # Qt allows one base with a widget in it.
    _Widget = object


#: What a field says while the selected inputs have different values.
MIXED = "mixed"
#: Losses of the focus after which it comes back: what is typed stays.
TEMPORARY_LOSSES = (Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason)


class Editor(_Widget):
    """What a widget does that edits one value; the widget inherits this first.

    Attributes
    ----------
    label
        The label, where the widget contains it and takes the whole width; else None.
    """

    #: The new value, number of the gesture or None.
    edited = Signal(object, object)
    #: Why the input is not allowed, or "".
    problem_changed = Signal(str)
    label: QtWidgets.QLabel | None = None

    def set_value(self, value: Any) -> None:
        """Show a value without a signal."""
        raise NotImplementedError

    def set_spec(self, spec: Any) -> None:
        """Change the allowed values, where they depend on the design."""

    def advice(self) -> str:
        """Return a remark on the present value, or ""."""
        return ""

    def mark_error(self, reason: str) -> None:
        """Mark the error in the input for which an edit was refused, if it stays."""

    def cancel(self) -> None:
        """Forget what is being typed."""

    def show_mixed(self, mixed: bool) -> None:
        """Say "mixed" in place of the value, or show the value."""


#: Makes the editor for a field.
NewEditor = Callable[[Spec, QtWidgets.QWidget], Editor]


_numbers = count(1)


def new_gesture() -> int:
    """Return a new number for a gesture; edits that share it are one step of undo."""
    return next(_numbers)


#: A pause as long as this ends a burst.
PAUSE_MS = 600


class Burst(QObject):
    """Gives quick successive steps one gesture number, so that they are one step of undo."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._gesture = 0
        self._pause = QTimer(self, singleShot=True, interval=PAUSE_MS)

    def gesture(self) -> int:
        """Return the gesture number of a step that happens now."""
        if not self._pause.isActive():
            self._gesture = new_gesture()
        self._pause.start()
        return self._gesture

    def end(self) -> None:
        """Let the next step begin a new burst."""
        self._pause.stop()
