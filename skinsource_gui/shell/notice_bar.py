"""The one way to tell the user that something went wrong, or went well."""

from PySide6.QtCore import QRect, QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QSizePolicy, QToolButton, QWidget

from skinsource_gui.theme import Theme

_NARROWEST_PX = 300
# The button, and the edges of the toolbar.
_BESIDE_TEXT_PX = 64


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
        self._close = close
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(12, 4, 8, 4)
        self._row.addWidget(self._text, 1)
        self._row.addWidget(close)
        self._text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Ignored)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self._speaks = False

    @property
    def text(self) -> str:
        """What it says; empty while hidden."""
        return self._text.text() if self._speaks else ""

    def sizeHint(self) -> QSize:
        # A toolbar knows nothing of text that needs more lines where there is less room.
        margins = self._row.contentsMargins()
        used = margins.left() + margins.right() + self._row.spacing() + _BESIDE_TEXT_PX
        # It lies across the window; its own width is not known before it is shown.
        room = QRect(0, 0, max(self.window().width() - used, _NARROWEST_PX), 1000)
        text = self.fontMetrics().boundingRect(room, Qt.TextFlag.TextWordWrap, self._text.text())
        height = max(text.height() + 4, self._close.sizeHint().height())
        return QSize(_NARROWEST_PX, height + margins.top() + margins.bottom())

    def minimumSizeHint(self) -> QSize:
        return self.sizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.updateGeometry()

    def say(self, text: str, kind: str = "info") -> None:
        """Show ``text``; ``kind`` is ``"error"``, ``"warning"`` or ``"info"``."""
        self._kind = kind
        self._text.setText(text)
        self.updateGeometry()
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
