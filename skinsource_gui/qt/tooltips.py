"""Tooltips in lines of readable length."""

from functools import lru_cache
from textwrap import fill

from PySide6 import QtWidgets
from PySide6.QtCore import QPoint

# Characters in a line: about as wide as a panel.
_LINE = 64


def tooltip(*sentences: str) -> str:
    """Return sentences below each other, in lines of readable length, without empty ones."""
    return "\n".join(_in_lines(sentence) for sentence in sentences if sentence)


def show_tooltip(widget: QtWidgets.QWidget, text: str) -> None:
    """Set the tooltip of a widget, unless it is the same, which would cause an event."""
    if widget.toolTip() != text:
        widget.setToolTip(text)


def show_tip_below(widget: QtWidgets.QWidget, text: str) -> None:
    """Show a tooltip below a widget at once, if the widget is visible."""
    if widget.isVisible():
        QtWidgets.QToolTip.showText(widget.mapToGlobal(QPoint(0, widget.height())), text, widget)


@lru_cache(maxsize=512)
def _in_lines(sentence: str) -> str:
    # Many fields have the same sentences on keys and mouse.
    return fill(sentence, _LINE)
