"""Widgets that adapt to the room they have: widths, visible heights, rows that fold."""

from collections.abc import Sequence

from PySide6 import QtWidgets
from PySide6.QtCore import QEvent

from skinsource_gui.qt.layouts import FlowLayout, in_row
from skinsource_gui.qt.theme import letter_scale
from skinsource_gui.qt.windows import WindowEvents


def fit_to_letters(widget: QtWidgets.QWidget, usual_px: int, *, at_most: bool = False) -> None:
    """Scale the width of a widget with the size of its letters, now and whenever that changes.

    Parameters
    ----------
    widget
        The widget.
    usual_px
        Its width in letters of the usual size.
    at_most
        Whether it may be narrower.
    """

    def fit(_event: QEvent | None = None) -> None:
        width_px = round(usual_px * letter_scale(widget.font()))
        widget.setMaximumWidth(width_px)
        if not at_most:
            widget.setMinimumWidth(width_px)

    WindowEvents.follow(widget, fit, QEvent.Type.FontChange)
    fit()


def grouped(*widgets: QtWidgets.QWidget | None, gap_px: int) -> QtWidgets.QWidget:
    """Return widgets that stay beside each other; None is a stretch between them."""
    group = QtWidgets.QWidget()
    in_row(*widgets, of=group, margins=0, gap_px=gap_px)
    return group


class FoldingRow(QtWidgets.QWidget):
    """Puts widgets beside each other, in several rows where it is narrow.

    Parameters
    ----------
    widgets
        Widgets in their order; hidden ones take no room.
    spacing_px
        Space between them.
    left
        Whether they are aligned left; else they share the width.
    """

    def __init__(
        self,
        widgets: Sequence[QtWidgets.QWidget],
        spacing_px: int,
        *,
        left: bool = False,
        parent: QtWidgets.QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        row = FlowLayout(self, spacing_px, shares=not left)
        for index, widget in enumerate(widgets):
            row.insert(index, widget)
