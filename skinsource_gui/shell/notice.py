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

from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.click_guard import ClickGuard

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
    """Words at the edge of a window; they stay until closed, replaced or outdated.

    No panel lies below them.  What passes by itself lies over the status bar, or, while that is
    away, over the upper right corner, where no panel has its title; what stays gets room below the
    status bar.  A click on the words reaches nothing else, nor does one where a button of theirs
    has just been.

    Parameters
    ----------
    window
        At whose edge they are; also the parent.
    """

    #: The user has closed it, with its cross.
    closed = Signal()

    def __init__(self, window: QMainWindow) -> None:
        super().__init__(window)
        self._window = window
        self._kind, self._passes = "info", False
        self._words = QLabel(window)
        self._words.setObjectName("notice")
        self._words.setWordWrap(True)
        self._words.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self._picture = QLabel(window)
        self._picture.setObjectName("notice_picture")
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
        self._close.clicked.connect(self._choose)
        self._close.clicked.connect(self.closed)
        self._row.addWidget(self._close)
        self._passing, self._watches = QTimer(self), False
        self._passing.setSingleShot(True)
        self._passing.timeout.connect(self.be_quiet)
        self._guard = ClickGuard(window)
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
        self._kind, self._passes = kind, passes
        self._offer(choices)
        self._picture.setPixmap(picture or QPixmap())
        self._picture.setHidden(picture is None or picture.isNull())
        self._words.setText(text)
        set_tone(self._words, self._kind)
        for part in (self._words, self.buttons):
            part.show()
            part.raise_()
        self._picture.raise_()
        self._place()
        self._let_pass(_LEAST_MS + _LETTER_MS * len(text) if passes else None)

    def pass_now(self) -> None:
        """Take away what would go by itself."""
        if self._passes:
            self.be_quiet()

    def be_quiet(self) -> None:
        """Take away what it says."""
        if self.buttons.isAncestorOf(self._window.focusWidget()):
            self._window.setFocus()
        self._let_pass(None)
        for part in (self._words, self.buttons, self._picture):
            part.hide()
        self._window.setContentsMargins(0, 0, 0, 0)

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

    def _choose(self, act: Callable[[], object] | None = None, _checked: bool = False) -> None:
        self._guard.cover(self.buttons.geometry())
        self.be_quiet()
        if act:
            act()

    def _place(self) -> None:
        whole, height = self._window.width(), self._window.height()
        status = self._window.statusBar()
        at_top = self._passes and status.isHidden()
        self._close.setHidden(at_top)
        size = self.buttons.sizeHint()
        shown = QSize() if self._picture.isHidden() else self._picture.sizeHint()
        left = shown.width() + 2 * UNIT_PX if shown.isValid() else UNIT_PX
        self._words.setContentsMargins(left, UNIT_PX // 2, size.width() + 2 * UNIT_PX, 4)
        least = max(size.height(), shown.height()) + (2 if self._passes else UNIT_PX)
        if self._passes and not at_top:
            least = max(least, status.height())
        width = whole
        if at_top:
            # Beside a border a label indents words by half a letter: in one line they cover least.
            metrics = self._words.fontMetrics()
            words = metrics.horizontalAdvance(self._words.text()) + metrics.horizontalAdvance("x")
            width = min(whole, words + left + size.width() + 4 * UNIT_PX)
        needed = max(self._words.heightForWidth(width), least)
        start, top = whole - width, 0 if at_top else height - needed
        self._picture.setGeometry(QRect(QPoint(start + UNIT_PX, top + UNIT_PX // 4), shown))
        self._words.setGeometry(start, top, width, needed)
        middle = top + (needed - size.height()) // 2
        self.buttons.setGeometry(
            whole - size.width() - UNIT_PX, middle, size.width(), size.height()
        )
        over = needed if at_top else status.height() if self._passes else 0
        self._window.setContentsMargins(0, 0, 0, max(0, needed - over))
