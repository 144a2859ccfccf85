"""The one way to tell the user that something went wrong, or what is offered."""

from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import (
    QApplication,
    QHBoxLayout,
    QLabel,
    QMainWindow,
    QPushButton,
    QToolButton,
    QWidget,
)

from skinsource_gui.theme import UNIT_PX, Theme

#: How long good news stay, which nobody need close; bad ones stay until they are dealt with.
PASSING_MS = 5000
#: How long a passing notice stays at least, and for each of its letters besides.
_LEAST_MS, _LETTER_MS = 4000, 60
#: A click so soon belongs to what the notice is about, and takes nothing away.
_FRESH_MS = 700
#: What can be done about it: words of the button, and what it does.
Choice = tuple[str, Callable[[], object]]
_LAID_OUT = (QEvent.Type.Resize, QEvent.Type.LayoutRequest)


class Notice(QObject):
    """Words over the lower edge of a window; they stay until closed, replaced or outdated.

    Nothing moves to make room for them, and a click on the words reaches what lies below.

    Parameters
    ----------
    window
        Over whose panels they lie, just above the status bar; also the parent.
    """

    #: The user has closed it, with its cross.
    closed = Signal()

    def __init__(self, window: QMainWindow) -> None:
        super().__init__(window)
        self._window = window
        self._colours = {"error": "", "warning": "", "info": ""}
        self._background, self._border = "", ""
        self._kind = "info"
        self._words = QLabel(window)
        self._words.setObjectName("notice")
        self._words.setWordWrap(True)
        self._words.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        # Who aims at what was here a moment ago shall hit it.
        self._words.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._picture = QLabel(window)
        self._picture.setObjectName("notice_picture")
        self._picture.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.buttons = QWidget(window)
        self.buttons.setObjectName("notice_buttons")
        self._row = QHBoxLayout(self.buttons)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.setSpacing(UNIT_PX)
        self._choices: list[QPushButton] = []
        self._close = QToolButton()
        self._close.setText("✕")
        self._close.setObjectName("close_notice")
        self._close.setToolTip("Close this notice")
        self._close.setAccessibleName("Close this notice")
        self._close.clicked.connect(self.be_quiet)
        self._close.clicked.connect(self.closed)
        self._row.addWidget(self._close)
        self._passing, self._watches = QTimer(self), False
        self._passing.setSingleShot(True)
        self._passing.timeout.connect(self.be_quiet)
        self.be_quiet()
        window.installEventFilter(self)

    @property
    def text(self) -> str:
        """What it says; empty while hidden."""
        return self._words.text() if not self._words.isHidden() else ""

    def say(
        self,
        text: str,
        kind: str = "info",
        choices: Sequence[Choice] = (),
        picture: QPixmap | None = None,
        *,
        passes: bool = False,
    ) -> None:
        """Show ``text``; ``kind`` is ``"error"``, ``"warning"`` or ``"info"``.

        A ``picture`` stands before the words.  What ``passes`` goes by itself after a while, which
        is long enough to read it, or at the next click anywhere.
        """
        self._kind = kind
        self._offer(choices)
        self._picture.setPixmap(picture or QPixmap())
        self._picture.setHidden(picture is None or picture.isNull())
        self._words.setText(text)
        self._paint()
        for part in (self._words, self.buttons):
            part.show()
            part.raise_()
        self._picture.raise_()
        self._place()
        self._let_pass(_LEAST_MS + _LETTER_MS * len(text) if passes else None)

    def be_quiet(self) -> None:
        """Take away what it says."""
        if self.buttons.isAncestorOf(self._window.focusWidget()):
            self._window.setFocus()
        self._let_pass(None)
        for part in (self._words, self.buttons, self._picture):
            part.hide()

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._colours = {"error": theme.error, "warning": theme.warning, "info": theme.accent}
        self._background, self._border = theme.raised, theme.border
        self._paint()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.MouseButtonPress and self._passing.isActive():
            stood_ms = self._passing.interval() - self._passing.remainingTime()
            if stood_ms >= _FRESH_MS and not self.buttons.underMouse():
                self.be_quiet()
        elif watched is self._window and self.text and event.type() in _LAID_OUT:
            self._place()
        return super().eventFilter(watched, event)

    def _let_pass(self, after_ms: int | None) -> None:
        """Go after a while, or at a click; None: stay."""
        application = QApplication.instance()
        # Looking at each event of the studio is worth it for some seconds only.
        if application is not None and self._watches:
            application.removeEventFilter(self)
        self._passing.stop()
        self._watches = after_ms is not None
        if application is not None and after_ms is not None:
            application.installEventFilter(self)
            self._passing.start(after_ms)

    def _offer(self, choices: Sequence[Choice]) -> None:
        for button in self._choices:
            button.hide()
            button.deleteLater()
        self._choices = []
        for words, act in choices:
            button = QPushButton(words)
            button.setObjectName("notice_choice")
            button.setAutoDefault(False)
            button.clicked.connect(partial(self._choose, act))
            self._row.insertWidget(len(self._choices), button)
            self._choices.append(button)

    def _choose(self, act: Callable[[], object], _checked: bool = False) -> None:
        self.be_quiet()
        act()

    def _place(self) -> None:
        width, bottom = self._window.width(), self._window.statusBar().y()
        size = self.buttons.sizeHint()
        shown = QSize() if self._picture.isHidden() else self._picture.sizeHint()
        left = shown.width() + 2 * UNIT_PX if shown.isValid() else UNIT_PX
        self._words.setContentsMargins(left, UNIT_PX // 2, size.width() + 2 * UNIT_PX, 4)
        least = max(size.height(), shown.height()) + UNIT_PX
        height = max(self._words.heightForWidth(width), least)
        self._picture.setGeometry(QRect(QPoint(UNIT_PX, bottom - height + UNIT_PX // 2), shown))
        self._words.setGeometry(0, bottom - height, width, height)
        top = bottom - height + (height - size.height()) // 2
        self.buttons.setGeometry(width - size.width() - UNIT_PX, top, size.width(), size.height())

    def _paint(self) -> None:
        self._words.setStyleSheet(
            f"#notice {{ background: {self._background}; border: none; "
            f"border-top: 1px solid {self._border}; "
            f"border-left: 4px solid {self._colours[self._kind]}; }}"
        )
