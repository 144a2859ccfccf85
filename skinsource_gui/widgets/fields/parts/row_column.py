"""Rows that are put in another order by the mouse or by keys."""

from functools import partial
from typing import Any, Protocol

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QFrame, QVBoxLayout, QWidget

from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.fields.parts.row_title import RowTitle

_LINE_PX = 2


class Row(Protocol):
    """A widget in the column.

    Attributes
    ----------
    title
        Its name, by which it is dragged.
    stops
        Where the Tab key stops, in order.
    """

    title: RowTitle
    stops: tuple[QWidget, ...]

    def forget_typing(self) -> None:
        """Close an open editor without committing."""


class RowColumn(QWidget):
    """Rows one below the other.

    Parameters
    ----------
    head
        Comes before the rows for the Tab key, and has the keyboard where none is left.
    """

    #: Place of a row, and the one that it is to be moved to.
    moved = Signal(int, int)

    def __init__(self, head: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._head = head
        self._rows: tuple[Any, ...] = ()
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(UNIT_PX // 4)
        # Where a dragged row would go.
        self._line = QFrame(self)
        self._line.setBackgroundRole(QPalette.ColorRole.Highlight)
        self._line.setAutoFillBackground(True)
        self._line.hide()

    @property
    def rows(self) -> tuple[Any, ...]:
        """The rows, in their order."""
        return self._rows

    def take_in(self, row: Any) -> None:
        """Let a new row be dragged."""
        row.title.dragged.connect(self._show_line)
        row.title.dropped.connect(partial(self._drop, row))
        row.title.given_up.connect(self._line.hide)

    def show_rows(self, rows: tuple[Any, ...]) -> None:
        """Show these rows; others are gone."""
        if rows == self._rows:
            return
        gone = [row for row in self._rows if row not in rows]
        was_focused = [k for k, row in enumerate(self._rows) if row in gone and _has_focus(row)]
        for row in self._rows:
            self._column.removeWidget(row)
        for row in gone:
            # What was being typed in it is for no other one.
            row.forget_typing()
            row.hide()
            row.deleteLater()
        self._rows = rows
        for row in rows:
            self._column.addWidget(row)
            row.show()
        self.order_stops()
        if was_focused:
            stops = [row.title for row in rows] or [self._head]
            stops[min(was_focused[0], len(stops) - 1)].setFocus(Qt.FocusReason.OtherFocusReason)

    def order_stops(self) -> None:
        """Let the Tab key go along the rows."""
        before = self._head
        for stop in (stop for row in self._rows for stop in row.stops):
            self.setTabOrder(before, stop)
            before = stop

    def step(self, row: Any, name: str) -> None:
        """Do what a key means to a row: move it, or go to another one."""
        index, last = self._rows.index(row), len(self._rows) - 1
        if name in ("shift_up", "shift_down"):
            to = index + (1 if name == "shift_down" else -1)
            if 0 <= to <= last:
                self.moved.emit(index, to)
            return
        to = {"up": index - 1, "down": index + 1, "first": 0}.get(name, last)
        self._rows[min(max(to, 0), last)].title.setFocus(Qt.FocusReason.OtherFocusReason)

    def _gap(self, y: int) -> int:
        """Before which row, or after the last one, something goes that is dropped at ``y``."""
        middles = [row.mapToGlobal(QPoint(0, row.title.height() // 2)).y() for row in self._rows]
        return sum(middle < y for middle in middles)

    def _show_line(self, y: int) -> None:
        gap = self._gap(y)
        behind = gap == len(self._rows)
        row = self._rows[gap - 1 if behind else gap]
        at = row.y() + row.height() - _LINE_PX if behind else max(row.y() - _LINE_PX, 0)
        self._line.setGeometry(0, at, self.width(), _LINE_PX)
        self._line.raise_()
        self._line.show()

    def _drop(self, row: Any, y: int) -> None:
        self._line.hide()
        index, gap = self._rows.index(row), self._gap(y)
        to = gap if gap <= index else gap - 1
        if to != index:
            self.moved.emit(index, to)


def _has_focus(row: QWidget) -> bool:
    focused = row.window().focusWidget()
    return focused is not None and row.isAncestorOf(focused)
