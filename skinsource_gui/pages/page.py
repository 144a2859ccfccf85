"""The base of the pages that a menu opens."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QFileDialog, QPushButton, QWidget

from skinsource.base.quoting import sentence
from skinsource_gui.qt.buttons import page_button, page_label
from skinsource_gui.qt.theme import set_tone


class ToolPage(QDialog):
    """A window of its own with a message and buttons, which is deleted when it is closed.

    Parameters
    ----------
    parent
        The window in front of which it opens.
    name, title
        Object name, and title of the window.
    size_px
        First size; by default as large as its content.

    Attributes
    ----------
    message
        Label that a page lays out where it says what happens; hidden until it has a parent.
    """

    def __init__(
        self, parent: QWidget | None, name: str, title: str, size_px: tuple[int, int] | None = None
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName(name)
        self.setWindowTitle(title)
        self.message = page_label("page_message")
        self.message.setTextFormat(Qt.TextFormat.PlainText)
        if size_px is not None:
            self.resize(*size_px)

    def say(self, text: str) -> None:
        """Show a message."""
        set_tone(self.message, "")
        self.message.setText(text)

    def say_reading(self, text: str) -> None:
        """Show what is read under the pointer of a figure, if anything is."""
        if text:
            self.say(text)

    def complain(self, reason: str) -> None:
        """Show why something did not work."""
        set_tone(self.message, "error")
        self.message.setText(sentence(reason))

    def add_button(self, name: str, text: str, hint: str, do: Callable[[], object]) -> QPushButton:
        """Return a button that does something when it is pressed; the page lays it out."""
        button = page_button(name, text, hint)
        button.clicked.connect(lambda: do())
        return button

    def ask_open(self, title: str, kinds: str, start: Path | None = None) -> Path | None:
        """Ask for a file to read; None where the user has chosen none."""
        name, _ = QFileDialog.getOpenFileName(self, title, str(start or ""), kinds)
        return Path(name) if name else None

    def ask_save(self, title: str, kinds: str, start: Path) -> Path | None:
        """Ask for a file to write; None where the user has chosen none."""
        name, _ = QFileDialog.getSaveFileName(self, title, str(start), kinds)
        return Path(name) if name else None
