"""Rows of tracks, one below the other, each kept for its input."""

from collections.abc import Sequence

from PySide6.QtWidgets import QApplication, QVBoxLayout, QWidget

from skinsource_gui.panels.timeline.heads.input_row import InputRow
from skinsource_gui.panels.timeline.heads.row_signals import RowSignals


class KeptRows:
    """Rows stay with their input when others come and go, so that an open editor survives.

    Parameters
    ----------
    column, signals
        What they stand in, and what is told by their controls.
    """

    def __init__(self, column: QWidget, signals: RowSignals) -> None:
        self._column, self._signals = column, signals
        self._rows: dict[int, InputRow] = {}
        self._layout = QVBoxLayout(column)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(0)
        self._layout.addStretch(1)

    @property
    def rows(self) -> tuple[InputRow, ...]:
        """The rows, from top to bottom."""
        return tuple(self._rows.values())

    @property
    def last(self) -> InputRow | None:
        """The row that was selected last."""
        return next((row for row in self.rows if row.state.last), None)

    def at(self, y: float) -> InputRow | None:
        """The row at a height of the column."""
        return next((row for row in self.rows if row.y() <= y < row.y() + row.height()), None)

    def stand_for(self, ids: Sequence[int]) -> bool:
        """Whether there is a row for each of these inputs, in that order, and no other."""
        return list(ids) == list(self._rows)

    def arrange(self, ids: Sequence[int]) -> list[InputRow]:
        """Put the rows of these inputs in order; return those that are left over."""
        old, self._rows = self._rows, {}
        for position, one in enumerate(ids):
            row = old.pop(one, None) or self._new_row()
            self._rows[one] = row
            self._layout.insertWidget(position, row)
        before = self._column
        for row in self.rows:
            for control in row.controls:
                QWidget.setTabOrder(before, control)
                before = control
        return list(old.values())

    def remove(self, row: InputRow) -> bool:
        """Take away a row that was left over; whether it had the keyboard."""
        focused = QApplication.focusWidget()
        had_focus = focused is not None and row.isAncestorOf(focused)
        self._layout.removeWidget(row)
        row.amplitude.cancel_editing()
        row.hide()
        row.deleteLater()
        return had_focus

    def _new_row(self) -> InputRow:
        return InputRow(self._signals, self._column)
