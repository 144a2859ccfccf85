"""Keys that a widget keeps for itself, though they are shortcuts of the window."""

from collections.abc import Callable

from PySide6.QtCore import QEvent
from PySide6.QtGui import QKeyEvent


def kept_from_shortcuts(event: QEvent, wanted: Callable[[QKeyEvent], object]) -> bool:
    """Whether an event asks for a key that is ``wanted`` here: then no shortcut takes it.

    Before it looks for a shortcut, Qt asks the widget that has the keyboard, by an event of its
    own; what is accepted there is pressed here.
    """
    is_asked = event.type() == QEvent.Type.ShortcutOverride
    if not is_asked or not isinstance(event, QKeyEvent) or not wanted(event):
        return False
    event.accept()
    return True
