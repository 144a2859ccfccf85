"""What the speaker reads, on a window of its own for another screen."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QCloseEvent, QFont, QGuiApplication
from PySide6.QtWidgets import QLabel, QTextBrowser, QVBoxLayout, QWidget

from skinsource_gui.theme import UNIT_PX

_LARGE = 1.6
_SIZE = 560, 420


class NotesWindow(QWidget):
    """Title, notes, and what comes next.

    Parameters
    ----------
    window
        What is presented in: keys pressed here are meant for it.
    """

    #: It was closed by hand.
    closed = Signal()

    def __init__(self, window: QWidget) -> None:
        super().__init__(window, Qt.WindowType.Window)
        self.setObjectName("notes_window")
        self.setWindowTitle("Notes – SkinSource studio")
        self.heading, self.next = QLabel(self), QLabel(self)
        self.notes = QTextBrowser(self)
        self.notes.setOpenExternalLinks(True)
        large = QFont(self.font())
        large.setPointSizeF(self.font().pointSizeF() * _LARGE)
        for part in (self.heading, self.notes, self.next):
            part.setFont(large)
        self.heading.setWordWrap(True)
        self.next.setWordWrap(True)
        bold = QFont(large)
        bold.setBold(True)
        self.heading.setFont(bold)
        column = QVBoxLayout(self)
        column.setContentsMargins(2 * UNIT_PX, 2 * UNIT_PX, 2 * UNIT_PX, 2 * UNIT_PX)
        column.addWidget(self.heading)
        column.addWidget(self.notes, 1)
        column.addWidget(self.next)
        self.resize(*_SIZE)

    def show_scene(self, heading: str, notes: str, following: str) -> None:
        """Show what belongs to a scene, and the title of the one after it."""
        self.heading.setText(heading)
        self.notes.setPlainText(notes or "No notes: a design carries them, see its properties.")
        self.next.setText(f"Next: {following}" if following else "This is the last one.")

    def show_beside(self, window: QWidget) -> None:
        """Show it on another screen than ``window``, where there is one."""
        others = [one for one in QGuiApplication.screens() if one is not window.screen()]
        if others:
            self.move(others[0].availableGeometry().center() - self.rect().center())
        self.show()

    def closeEvent(self, event: QCloseEvent) -> None:
        super().closeEvent(event)
        self.closed.emit()
