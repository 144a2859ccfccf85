"""Shortcuts of the window work from inside number fields and lines of text too."""

from collections.abc import Iterable

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QApplication, QLineEdit, QPlainTextEdit, QWidget

_Standard = QKeySequence.StandardKey
#: What these keys do to a text while it is typed.
_WHILE_TYPING = (
    _Standard.Copy,
    _Standard.Cut,
    _Standard.Paste,
    _Standard.Undo,
    _Standard.Redo,
    _Standard.SelectAll,
    _Standard.DeleteStartOfWord,
    _Standard.DeleteEndOfWord,
)
#: What they do to a text that is only shown.
_WHILE_RESTING = (_Standard.Copy, _Standard.Paste)
_TEXTS = (QLineEdit, QPlainTextEdit)


class ShortcutsInFields(QObject):
    """Keeps lines of text from taking shortcuts for keys of their own.

    On some desktops Ctrl+E goes to the end of a line, Ctrl+K deletes to it, and so on: nobody
    expects that of a number, and everybody that a shortcut does the same everywhere.

    Parameters
    ----------
    actions
        Whose shortcuts these are.
    window
        In which they work; also the parent.
    """

    def __init__(self, actions: Iterable[QAction], window: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._shortcuts = [key for action in actions for key in action.shortcuts()]
        self._watched: QLineEdit | QPlainTextEdit | None = None
        # One line of text at a time: a filter on all widgets would see each event of the studio.
        QApplication.instance().focusChanged.connect(self._watch)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(watched, _TEXTS):
            own = _WHILE_RESTING if watched.isReadOnly() else _WHILE_TYPING
            pressed = QKeySequence(event.keyCombination())
            if pressed in self._shortcuts and not any(event.matches(key) for key in own):
                event.ignore()
                return True
        return super().eventFilter(watched, event)

    def _watch(self, _old: QWidget | None, new: QWidget | None) -> None:
        if self._watched is not None:
            self._watched.removeEventFilter(self)
            self._watched.destroyed.disconnect(self._forget)
            self._watched = None
        if isinstance(new, _TEXTS) and self._window.isAncestorOf(new):
            self._watched = new
            new.installEventFilter(self)
            new.destroyed.connect(self._forget)

    def _forget(self) -> None:
        self._watched = None
