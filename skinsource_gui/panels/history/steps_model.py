"""The history as rows."""

import time
from typing import Any

from PySide6.QtCore import QAbstractListModel, QModelIndex, QObject, QPersistentModelIndex, Qt

from skinsource_gui.history import History, Step

_Role = Qt.ItemDataRole
#: What stands at the right of a row; whether it is done; whether it is the present one.
TIME, DONE, PRESENT = (_Role.UserRole + k for k in range(1, 4))

_Index = QModelIndex | QPersistentModelIndex


class StepsModel(QAbstractListModel):
    """One row for what was before all steps, and one for each step."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._history = History()

    @property
    def history(self) -> History:
        """What is listed."""
        return self._history

    def show_history(self, history: History) -> None:
        """Take over what was done."""
        if history == self._history:
            return
        if len(self._history.steps) != len(history.steps):
            self.beginResetModel()
            self._history = history
            self.endResetModel()
        else:
            self._history = history
            self.dataChanged.emit(self.index(0), self.index(self.rowCount() - 1))

    def rowCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self._history.steps) + 1

    def data(self, index: _Index, role: int = _Role.DisplayRole) -> Any:
        row, history = index.row(), self._history
        if not 0 <= row <= len(history.steps):
            return None
        step = history.steps[row - 1] if row else None
        if role == _Role.DisplayRole:
            return step.label if step else history.start
        if role == TIME:
            return self._right(row, step)
        if role == DONE:
            return row <= history.present
        if role == PRESENT:
            return row == history.present
        if role in (_Role.AccessibleTextRole, _Role.ToolTipRole):
            return self._sentence(row, step)
        return None

    def _right(self, row: int, step: Step | None) -> str:
        when = _clock(step) if step else ""
        return f"saved {when}".strip() if row == self._history.saved else when

    def _sentence(self, row: int, step: Step | None) -> str:
        label = step.label if step else self._history.start
        when = f", {_clock(step)}" if step else ""
        where = ", present" if row == self._history.present else ""
        back = ", taken back" if row > self._history.present else ""
        return f"{label}{when}{where}{back}"


def _clock(step: Step) -> str:
    return time.strftime("%H:%M:%S", time.localtime(step.at_s))
