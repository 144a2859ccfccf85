"""Words of a tooltip, in lines that the eye can follow."""

from functools import lru_cache
from textwrap import fill

from PySide6.QtCore import QPoint, QRect, QTimer
from PySide6.QtGui import QCursor
from PySide6.QtWidgets import QApplication, QToolTip, QWidget

# Characters in a line: about as wide as a panel.
_LINE = 64


def tooltip(*sentences: str) -> str:
    """Sentences below each other, each in lines of readable length; empty ones are left out."""
    return "\n".join(_in_lines(sentence) for sentence in sentences if sentence)


def show_tooltip(widget: QWidget, text: str) -> None:
    """Give a widget a tooltip; one that it has already is told to nobody."""
    if widget.toolTip() != text:
        widget.setToolTip(text)


def show_tip_below(widget: QWidget, text: str) -> None:
    """Show words below a widget at once, as a tooltip, while the widget is in sight."""
    if widget.isVisible():
        QToolTip.showText(widget.mapToGlobal(QPoint(0, widget.height())), text, widget)


@lru_cache(maxsize=512)
def _in_lines(sentence: str) -> str:
    # Many fields say the same of keys and mouse.
    return fill(sentence, _LINE)


# What stands for a moment where a button has just been.

# After so many intervals of a double click even a pointer that rests means what lies there.
_MOST_INTERVALS = 6


class ClickGuard(QWidget):
    """Takes the second click of who clicks twice, so that it reaches nothing else.

    Attributes
    ----------
    interval
        After it, the guard stays only where the pointer rests.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("click_guard")
        self._at, self._intervals = QPoint(), 0
        self.interval = QTimer(self, singleShot=True)
        self.interval.timeout.connect(self._hide_unless_at_rest)
        self.hide()

    def cover(self, place: QRect) -> None:
        """Stand there."""
        self.setGeometry(place)
        self.show()
        self.raise_()
        self._begin()
        # Room that goes away is laid out anew later, and that may take most of the time.
        QTimer.singleShot(0, self, self._begin)

    def _begin(self) -> None:
        self._at, self._intervals = QCursor.pos(), 0
        self.interval.start(QApplication.doubleClickInterval())

    def _hide_unless_at_rest(self) -> None:
        """Who has not moved the pointer since does not mean what lies there now."""
        self._intervals += 1
        at = QCursor.pos()
        rests = at == self._at and self.rect().contains(self.mapFromGlobal(at))
        if rests and self._intervals < _MOST_INTERVALS:
            self.interval.start()
        else:
            self.hide()
