"""Buttons of pages."""

from PySide6.QtWidgets import QPushButton


def page_button(name: str, words: str, hint: str = "") -> QPushButton:
    """A button that Enter elsewhere on the page does not press."""
    button = QPushButton(words)
    button.setObjectName(name)
    button.setToolTip(hint)
    button.setAutoDefault(False)
    return button
