"""A small picture of the last times."""

from collections.abc import Callable, Sequence

from PySide6.QtCore import QEvent, QRect, QSize, Qt, QTimer
from PySide6.QtGui import QColor, QHelpEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from skinsource_gui.status.pause import PAUSE_MS
from skinsource_gui.theme import current_theme

#: One frame of most screens.
FRAME_S = 0.016
#: What the full height means; slower ones are cut, and have the colour of a warning anyway.
_TOP_S = 2.0 * FRAME_S
_SIZE = QSize(100, 16)


class Sparkline(QWidget):
    """One bar for each time, newest at the right, and a thin line at one frame.

    Parameters
    ----------
    about
        Makes the words that describe the times; asked when somebody wants them.
    """

    def __init__(self, about: Callable[[], str], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("sparkline")
        self.setAccessibleName("Times of the last edits")
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self._about = about
        self._times_s: Sequence[float] = ()
        self._pause = QTimer(self, singleShot=True, interval=PAUSE_MS)
        self._pause.timeout.connect(self._paint_again)
        self._waits = False

    def sizeHint(self) -> QSize:
        return _SIZE

    def show_times(self, times_s: Sequence[float]) -> None:
        """Take over times, oldest first; painted at most four times a second."""
        self._times_s = times_s
        self._waits = True
        if not self._pause.isActive():
            self._paint_again()

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            QToolTip.showText(event.globalPos(), self._about(), self)
            return True
        return super().event(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        width, height = self.width(), self.height()
        shown = self._times_s[-width:]
        slow: list[QRect] = []
        quick: list[QRect] = []
        for column, time_s in enumerate(shown, start=width - len(shown)):
            bar = round(height * min(time_s / _TOP_S, 1.0))
            bars = slow if time_s > FRAME_S else quick
            bars.append(QRect(column, height - bar, 1, bar))
        painter.setPen(Qt.PenStyle.NoPen)
        for bars, colour in ((slow, current_theme().warning), (quick, current_theme().accent)):
            painter.setBrush(QColor(colour))
            painter.drawRects(bars)
        at = round(height * (1.0 - FRAME_S / _TOP_S))
        painter.fillRect(0, at, width, 1, QColor(current_theme().dim))
        painter.fillRect(0, height - 1, width, 1, QColor(current_theme().border))
        painter.end()

    def _paint_again(self) -> None:
        # Once more after the last time, then rest.
        if self._waits:
            self._waits = False
            self.setAccessibleDescription(self._about())
            self.update()
            self._pause.start()
