"""The panel of all steps of the history, in which a click goes back or forth."""

import time
from functools import partial
from typing import Any, ClassVar

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import (
    QAbstractListModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QRect,
    QSize,
    Qt,
)

from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.theme import UNIT_PX, current_theme, tabular
from skinsource_gui.state.history import History, Step
from skinsource_gui.state.panel import Panel

_Role = Qt.ItemDataRole
#: Text at the right of a row; whether the step is done; whether it is the present one.
TIME, DONE, PRESENT = (_Role.UserRole + k for k in range(1, 4))

_Index = QModelIndex | QPersistentModelIndex


class StepsModel(QAbstractListModel):
    """One row for what was before all steps, and one for each step."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.history = History()

    def show_history(self, history: History) -> None:
        """Take over what was done."""
        if len(self.history.steps) != len(history.steps):
            self.beginResetModel()
            self.history = history
            self.endResetModel()
        else:
            self.history = history
            self.dataChanged.emit(self.index(0), self.index(self.rowCount() - 1))

    def rowCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.history.steps) + 1

    def data(self, index: _Index, role: int = _Role.DisplayRole) -> Any:
        row, history = index.row(), self.history
        if not 0 <= row <= len(history.steps):
            return None
        step = history.steps[row - 1] if row else None
        if role == _Role.DisplayRole:
            return step.label if step else history.start
        if role == TIME:
            return self._time_text(row, step)
        if role == DONE:
            return row <= history.present
        if role == PRESENT:
            return row == history.present
        if role in (_Role.AccessibleTextRole, _Role.ToolTipRole):
            return self._tooltip(row, step)
        return None

    def _time_text(self, row: int, step: Step | None) -> str:
        when = _clock(step) if step else ""
        return f"saved {when}".strip() if row == self.history.saved else when

    def _tooltip(self, row: int, step: Step | None) -> str:
        label = step.label if step else self.history.start
        when = f", {_clock(step)}" if step else ""
        where = ", present" if row == self.history.present else ""
        back = ", taken back" if row > self.history.present else ""
        return f"{label}{when}{where}{back}"


def _clock(step: Step) -> str:
    return time.strftime("%H:%M:%S", time.localtime(step.at_s))


# Label and time share a row as long as so much of it is left for the label.
_BAR_PX, _LEAST_LABEL = 3, 0.5


class StepDelegate(QtWidgets.QStyledItemDelegate):
    """Paints label and time of a step; undone steps are pale, the present one has a bar."""

    def sizeHint(
        self, option: QtWidgets.QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> QSize:
        return QSize(10 * UNIT_PX, option.fontMetrics.height() + UNIT_PX)

    def paint(
        self,
        painter: QtGui.QPainter,
        option: QtWidgets.QStyleOptionViewItem,
        index: QModelIndex | QPersistentModelIndex,
    ) -> None:
        theme, rect = current_theme(), option.rect
        chosen = bool(option.state & QtWidgets.QStyle.StateFlag.State_Selected)
        focused = chosen and bool(option.state & QtWidgets.QStyle.StateFlag.State_HasFocus)
        painter.save()
        if chosen or index.data(PRESENT):
            painter.fillRect(
                rect, QtGui.QColor(theme.raised if theme.name == "dark" else theme.window)
            )
        if index.data(PRESENT):
            bar = QRect(rect.left(), rect.top(), _BAR_PX, rect.height())
            painter.fillRect(bar, QtGui.QColor(theme.accent))
        inside = rect.adjusted(UNIT_PX, 0, -UNIT_PX, 0)
        painter.setFont(tabular(option.font))
        metrics = painter.fontMetrics()
        label, time = row_text(metrics, index.data(), index.data(TIME), inside.width())
        middle = Qt.AlignmentFlag.AlignVCenter
        painter.setPen(QtGui.QColor(theme.dim))
        painter.drawText(inside, middle | Qt.AlignmentFlag.AlignRight, time)
        painter.setPen(QtGui.QColor(theme.text if index.data(DONE) else theme.dim))
        painter.drawText(inside, middle | Qt.AlignmentFlag.AlignLeft, label)
        if focused:
            painter.setPen(QtGui.QColor(theme.accent))
            painter.drawRect(rect.adjusted(0, 0, -1, -1))
        painter.restore()


def row_text(metrics: QtGui.QFontMetrics, label: str, time: str, room_px: int) -> tuple[str, str]:
    """Return label and time as they share a row; a label that is too long is cut short."""
    width = metrics.horizontalAdvance(time) + UNIT_PX if time else 0
    if room_px - width < _LEAST_LABEL * room_px:
        # The label says more than the time; the tooltip has both.
        time, width = "", 0
    left = max(room_px - width, 0)
    return metrics.elidedText(label, Qt.TextElideMode.ElideRight, left), time


_PLACE = "history"


class StepList(QtWidgets.QListView):
    """Rows of the history; Enter goes to the one that the keys have reached."""

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, partial(meaning_of, _PLACE)) or super().event(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if meaning_of(_PLACE, event) == "go" and self.currentIndex().isValid():
            self.clicked.emit(self.currentIndex())
        else:
            super().keyPressEvent(event)


class HistoryPanel(Panel):
    """Every step with its label and time; a click goes there."""

    title: ClassVar[str] = "History"
    name: ClassVar[str] = "history"
    lists_history: ClassVar[bool] = True

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.model = StepsModel(self)
        self._delegate = StepDelegate(self)
        self.rows = StepList()
        self.rows.setObjectName("history_rows")
        self.rows.setAccessibleName("Steps of the history")
        self.rows.setModel(self.model)
        self.rows.setItemDelegate(self._delegate)
        self.rows.setUniformItemSizes(True)
        self.rows.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.rows.setSelectionMode(QtWidgets.QAbstractItemView.SelectionMode.SingleSelection)
        self.rows.setEditTriggers(QtWidgets.QAbstractItemView.EditTrigger.NoEditTriggers)
        self.rows.clicked.connect(self._go)
        in_column(self.rows, of=self, margins=(UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX // 2))
        self.setMinimumSize(204, 120)
        self.setFocusProxy(self.rows)

    def sizeHint(self) -> QSize:
        return QSize(260, 320)

    def show_history(self, history: History) -> None:
        if history == self.model.history:
            return
        self.model.show_history(history)
        present = self.model.index(history.present)
        self.rows.setCurrentIndex(present)
        self.rows.scrollTo(present)

    def _go(self, row: QModelIndex) -> None:
        if row.row() != self.model.history.present:
            self.step_requested.emit(row.row())
