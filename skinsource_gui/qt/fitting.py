"""Widgets that adapt to the room they have: widths, visible heights, rows that fold."""

from collections.abc import Sequence

from PySide6 import QtWidgets
from PySide6.QtCore import QEvent, QObject, Signal

from skinsource_gui.qt.layouts import FlowLayout, in_row
from skinsource_gui.qt.theme import letter_scale


class LetterWidth(QObject):
    """Scales the width of a widget with the size of its letters.

    Parameters
    ----------
    widget
        The widget; also the parent.
    usual_px
        Its width in letters of the usual size.
    at_most
        Whether it may be narrower.
    """

    def __init__(self, widget: QtWidgets.QWidget, usual_px: int, *, at_most: bool = False) -> None:
        super().__init__(widget)
        self._widget, self._usual_px, self._at_most = widget, usual_px, at_most
        widget.installEventFilter(self)
        self._fit()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.FontChange:
            self._fit()
        return super().eventFilter(watched, event)

    def _fit(self) -> None:
        width_px = round(self._usual_px * letter_scale(self._widget.font()))
        self._widget.setMaximumWidth(width_px)
        if not self._at_most:
            self._widget.setMinimumWidth(width_px)


_ROOM_EVENTS = (QEvent.Type.Resize, QEvent.Type.LayoutRequest, QEvent.Type.FontChange)


class LayoutWatcher(QObject):
    """Signals when the size of a widget, or the text or font in it, may have changed.

    A slot that changes the layout of the widget causes a further signal.  That ends if the same
    room and texts always lead to the same layout.

    Parameters
    ----------
    widget
        The widget; also the parent.
    """

    changed = Signal()

    def __init__(self, widget: QtWidgets.QWidget) -> None:
        super().__init__(widget)
        widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # A resized widget already has its new size.
        if event.type() in _ROOM_EVENTS:
            self.changed.emit()
        return False


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
