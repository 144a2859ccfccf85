"""Buttons in panels that Tab reaches."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton, QWidget


def tool_button(
    parent: QWidget | None, name: str, words: str, hint: str = "", *, checkable: bool = False
) -> QToolButton:
    """A button as narrow as its words, which the keyboard reaches too."""
    button = QToolButton(parent)
    button.setObjectName(name)
    button.setText(words)
    button.setToolTip(hint)
    button.setCheckable(checkable)
    button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    return button
