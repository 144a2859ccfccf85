"""Tooltips in lines of readable length, and the guard against a second click."""

from functools import lru_cache
from textwrap import fill

from PySide6.QtCore import QPoint, QRect, QTimer
from PySide6.QtGui import QCursor
from PySide6.QtWidgets import QApplication, QToolTip, QWidget

# Characters in a line: about as wide as a panel.
_LINE = 64


def tooltip(*sentences: str) -> str:
    """Return sentences below each other, in lines of readable length, without empty ones."""
    return "\n".join(_in_lines(sentence) for sentence in sentences if sentence)


def show_tooltip(widget: QWidget, text: str) -> None:
    """Set the tooltip of a widget, unless it is the same, which would cause an event."""
    if widget.toolTip() != text:
        widget.setToolTip(text)


def show_tip_below(widget: QWidget, text: str) -> None:
    """Show a tooltip below a widget at once, if the widget is visible."""
    if widget.isVisible():
        QToolTip.showText(widget.mapToGlobal(QPoint(0, widget.height())), text, widget)


@lru_cache(maxsize=512)
def _in_lines(sentence: str) -> str:
    # Many fields have the same sentences on keys and mouse.
    return fill(sentence, _LINE)


# After so many intervals of a double click even a pointer at rest may click what is there.
_MOST_INTERVALS = 6


class ClickGuard(QWidget):
    """Takes the second click of a double click where a button has just disappeared.

    Attributes
    ----------
    interval
        After this time the guard stays only while the pointer rests.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("click_guard")
        self._at, self._intervals = QPoint(), 0
        self.interval = QTimer(self, singleShot=True)
        self.interval.timeout.connect(self._hide_unless_at_rest)
        self.hide()

    def cover(self, place: QRect) -> None:
        """Cover a place."""
        self.setGeometry(place)
        self.show()
        self.raise_()
        self._begin()
        # The layout changes later, and that may take most of the time.
        QTimer.singleShot(0, self, self._begin)

    def _begin(self) -> None:
        self._at, self._intervals = QCursor.pos(), 0
        self.interval.start(QApplication.doubleClickInterval())

    def _hide_unless_at_rest(self) -> None:
        """Hide, unless the pointer still rests here."""
        self._intervals += 1
        at = QCursor.pos()
        rests = at == self._at and self.rect().contains(self.mapFromGlobal(at))
        if rests and self._intervals < _MOST_INTERVALS:
            self.interval.start()
        else:
            self.hide()
