"""Words of a tooltip, in lines that the eye can follow."""

from functools import lru_cache
from textwrap import fill

from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QToolTip, QWidget

# Characters in a line: about as wide as a panel.
_LINE = 64


def tooltip(*sentences: str) -> str:
    """Sentences below each other, each in lines of readable length; empty ones are left out."""
    return "\n".join(_in_lines(sentence) for sentence in sentences if sentence)


def show_tooltip(widget: QWidget, words: str) -> None:
    """Give a widget a tooltip; one that it has already is told to nobody."""
    if widget.toolTip() != words:
        widget.setToolTip(words)


def show_tip_below(widget: QWidget, words: str) -> None:
    """Show words below a widget at once, as a tooltip, while the widget is in sight."""
    if widget.isVisible():
        QToolTip.showText(widget.mapToGlobal(QPoint(0, widget.height())), words, widget)


@lru_cache(maxsize=512)
def _in_lines(sentence: str) -> str:
    # Many fields say the same of keys and mouse.
    return fill(sentence, _LINE)
