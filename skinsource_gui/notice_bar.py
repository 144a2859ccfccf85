"""The one way to tell the user that something went wrong, or went well."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QToolButton, QWidget

from skinsource_gui.theme import Theme


class NoticeBar(QFrame):
    """A line across the window; it stays until it is closed or replaced."""

    #: Whether there is something to show.
    shown = Signal(bool)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("notice")
        self._colours = {"error": "", "warning": "", "info": ""}
        self._background = ""
        self._kind = "info"
        self._text = QLabel()
        self._text.setWordWrap(True)
        self._text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        close = QToolButton()
        close.setText("✕")
        close.setObjectName("close_notice")
        close.setToolTip("Close this notice")
        close.setAccessibleName("Close this notice")
        close.clicked.connect(self.be_quiet)
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 4, 8, 4)
        row.addWidget(self._text, 1)
        row.addWidget(close)
        self._speaks = False

    @property
    def text(self) -> str:
        """What it says; empty while hidden."""
        return self._text.text() if self._speaks else ""

    def say(self, text: str, kind: str = "info") -> None:
        """Show ``text``; ``kind`` is ``"error"``, ``"warning"`` or ``"info"``."""
        self._kind = kind
        self._text.setText(text)
        self._paint()
        self._speaks = True
        self.shown.emit(True)

    def be_quiet(self) -> None:
        """Take away what it says."""
        self._speaks = False
        self.shown.emit(False)

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._colours = {"error": theme.error, "warning": theme.warning, "info": theme.accent}
        self._background = theme.raised
        self._paint()

    def _paint(self) -> None:
        colour = self._colours[self._kind]
        self.setStyleSheet(
            f"#notice {{ background: {self._background}; border: none; "
            f"border-left: 4px solid {colour}; }}"
        )
