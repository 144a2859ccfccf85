"""A table with a row for each selected output, and the base of the views that show one."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import (
    QAbstractTableModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    Qt,
    Signal,
)

from skinsource_gui.panels.analysis.view import AnalysisView
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.keys import claims_shortcut
from skinsource_gui.qt.labels import SHORT_NAME, fit_name_column, set_table_look
from skinsource_gui.qt.theme import current_theme

#: Titles of columns, and what they mean.
Columns = Sequence[tuple[str, str]]

_RIGHT = int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
_LEFT = int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
_Index = QModelIndex | QPersistentModelIndex
_Role = Qt.ItemDataRole


@dataclass(frozen=True, slots=True, kw_only=True)
class TableRow:
    """A row of texts, the first of which names the output.

    Attributes
    ----------
    short
        The name where there is little room.
    hint
        What is to be known of the numbers, which are then dim; "": nothing.
    """

    output: int
    texts: tuple[str, ...]
    short: str
    hint: str = ""


class OutputTableModel(QAbstractTableModel):
    """Rows of outputs under columns."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.columns: Columns = ()
        self.rows: Sequence[TableRow] = ()

    def show_rows(self, columns: Columns, rows: Sequence[TableRow]) -> bool:
        """Take over other rows; return whether they are of other outputs or columns.

        Otherwise the selection stays.
        """
        outputs = [[row.output for row in some] for some in (rows, self.rows)]
        other = outputs[0] != outputs[1] or list(columns) != list(self.columns)
        if other:
            self.beginResetModel()
        self.columns, self.rows = columns, rows
        if other:
            self.endResetModel()
        elif rows:
            end = self.index(len(rows) - 1, len(columns) - 1)
            self.dataChanged.emit(self.index(0, 0), end)
        return other

    def rowCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.rows)

    def columnCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.columns)

    def data(self, index: _Index, role: int = _Role.DisplayRole) -> object:
        row, column = self.rows[index.row()], index.column()
        if role == _Role.DisplayRole:
            return row.texts[column]
        if role == _Role.TextAlignmentRole and column:
            return _RIGHT
        if role == _Role.ForegroundRole:
            if column == 0:
                return current_theme().output_colour(index.row())
            return QtGui.QColor(current_theme().dim if row.hint else current_theme().text)
        if role == SHORT_NAME and column == 0:
            return row.short
        if role == _Role.ToolTipRole:
            return row.hint or (None if column else row.texts[0])
        return None

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole
    ) -> object:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == _Role.DisplayRole:
            return self.columns[section][0]
        if role == _Role.ToolTipRole:
            return self.columns[section][1]
        if role == _Role.TextAlignmentRole and section == 0:
            return _LEFT
        return None


class OutputTable(QtWidgets.QTableView):
    """The table; the usual key copies all of it."""

    copy_requested = Signal()

    def __init__(self, name: str, accessible_name: str) -> None:
        super().__init__()
        self.setObjectName(name)
        self.setAccessibleName(accessible_name)
        self.rows_model = OutputTableModel(self)
        self.setModel(self.rows_model)
        set_table_look(self)
        self.setSelectionBehavior(QtWidgets.QAbstractItemView.SelectionBehavior.SelectRows)
        self.horizontalHeader().setDefaultAlignment(
            Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        )

    def show_rows(self, columns: Columns, rows: Sequence[TableRow]) -> None:
        """Show a row for each output under columns, of which there is one at least."""
        if self.rows_model.show_rows(columns, rows):
            fit_name_column(self)

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, _is_copy) or super().event(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if _is_copy(event):
            self.copy_requested.emit()
        else:
            super().keyPressEvent(event)


class OutputTableView(AnalysisView):
    """A view that shows a table of the selected outputs, or a message in its place.

    Parameters
    ----------
    accessible_name
        What the table shows, for those who do not see it.

    Attributes
    ----------
    table, stack
        The table, and what shows it or the message.
    """

    def __init__(self, accessible_name: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.table = OutputTable(f"{self.name}_table", accessible_name)
        self.table.copy_requested.connect(self.copy_requested)
        self._message = page_label(f"{self.name}_message", tone="dim", centred=True)
        self.stack = QtWidgets.QStackedWidget()
        self.stack.addWidget(self._message)
        self.stack.addWidget(self.table)
        self.computed = (self.table,)
        self.setFocusProxy(self.table)

    @property
    def message(self) -> str:
        return self._message.text()

    def say_instead(self, message: str) -> None:
        self.offer_copy(False)
        self._message.setText(message)
        self.stack.setCurrentWidget(self._message)

    def show_rows(self, columns: Columns, rows: Sequence[TableRow]) -> None:
        """Show rows in place of a message."""
        self._message.setText("")
        self.table.show_rows(columns, rows)
        self.offer_copy(True)
        self.stack.setCurrentWidget(self.table)


def _is_copy(event: QtGui.QKeyEvent) -> bool:
    return event.matches(QtGui.QKeySequence.StandardKey.Copy)
