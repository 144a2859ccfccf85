"""Shortcuts of the window and the keys of the widget that has the keyboard: which goes first.

Shortcuts work from inside number fields and lines of text too.  Keys without Ctrl or Alt that a
widget needs itself stay with it: letters and spaces where a text is typed, Space on what is
pressed with it, and on a list until something was chosen from it.
"""

from collections.abc import Iterable

import shiboken6
from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QAction, QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QApplication,
    QComboBox,
    QLineEdit,
    QPlainTextEdit,
    QWidget,
)

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
#: What is pressed, or chosen from, with Space.
_PRESSED = (QAbstractButton, QComboBox, QAbstractItemView)
_HELD = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier


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
        self._watched: QWidget | None = None
        # The list that was clicked, or chosen from, and still has the keyboard.
        self._used: QComboBox | None = None
        # One widget at a time: a filter on all widgets would see each event of the studio.
        application = QApplication.instance()
        if isinstance(application, QApplication):
            application.focusChanged.connect(self._watch)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() != QEvent.Type.ShortcutOverride or not isinstance(event, QKeyEvent):
            return super().eventFilter(watched, event)
        if isinstance(watched, _TEXTS):
            own = _WHILE_RESTING if watched.isReadOnly() else _WHILE_TYPING
            typed = not watched.isReadOnly() and _is_typed(event)
            pressed = QKeySequence(event.keyCombination())
            if (
                pressed in self._shortcuts
                and not typed
                and not any(event.matches(key) for key in own)
            ):
                event.ignore()
                return True
        elif event.key() == Qt.Key.Key_Space and not event.modifiers() & _HELD:
            if watched is self._used:
                # What was chosen shall be heard; to choose again, the arrow keys do.
                event.ignore()
            else:
                event.accept()
            return True
        return super().eventFilter(watched, event)

    def _watch(self, _old: QWidget | None, new: QWidget | None) -> None:
        if self._watched is not None:
            self._watched.removeEventFilter(self)
            self._watched.destroyed.disconnect(self._forget)
            if isinstance(self._watched, QComboBox):
                self._watched.activated.disconnect(self._note_used)
            self._watched = None
        if new is not None and new is not self._used and not _is_popup_of(self._used, new):
            self._used = None
        # A button that was clicked has the keyboard too, but nobody means it any more.
        clicked = isinstance(new, QAbstractButton) and bool(QApplication.mouseButtons())
        wanted = isinstance(new, (*_TEXTS, *_PRESSED)) and not clicked
        if wanted and new is not None and self._window.isAncestorOf(new):
            self._watched = new
            new.installEventFilter(self)
            new.destroyed.connect(self._forget)
            if isinstance(new, QComboBox):
                new.activated.connect(self._note_used)
                if QApplication.mouseButtons():
                    self._used = new

    def _note_used(self) -> None:
        if isinstance(self._watched, QComboBox):
            self._used = self._watched

    def _forget(self) -> None:
        self._watched = self._used = None


def _is_popup_of(field: QComboBox | None, widget: QWidget) -> bool:
    """Whether a widget belongs to the list that drops down from a field."""
    # A field may be gone that was used last, and is watched no more.
    return field is not None and shiboken6.isValid(field) and field.isAncestorOf(widget)


def _is_typed(event: QKeyEvent) -> bool:
    """Whether a key puts something into a text."""
    return event.text().isprintable() and event.text() != "" and not event.modifiers() & _HELD
