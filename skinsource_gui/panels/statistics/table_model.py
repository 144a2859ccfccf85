"""Rows of figures, as Qt asks for them."""

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtGui import QColor

from skinsource_gui.panels.statistics.rows import COLUMNS, NOISE_WORDS, Row
from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.name_column import SHORT_NAME

_Index = QModelIndex | QPersistentModelIndex
_Role = Qt.ItemDataRole


class TableModel(QAbstractTableModel):
    """Figures of the selected outputs, one row each."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.rows: tuple[Row, ...] = ()

    def show_rows(self, rows: tuple[Row, ...]) -> None:
        """Take over other rows; where they are the same outputs, the selection stays."""
        same = [row.number for row in rows] == [row.number for row in self.rows]
        if not same:
            self.beginResetModel()
        self.rows = rows
        if not same:
            self.endResetModel()
        elif rows:
            end = self.index(len(rows) - 1, len(COLUMNS) - 1)
            self.dataChanged.emit(self.index(0, 0), end)

    def rowCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.rows)

    def columnCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(COLUMNS)

    def data(self, index: _Index, role: int = _Role.DisplayRole) -> object:
        row, column = self.rows[index.row()], index.column()
        if role == _Role.DisplayRole:
            return row.texts()[column]
        if role == _Role.TextAlignmentRole and column:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        if role == _Role.ForegroundRole:
            if column == 0:
                return current_theme().output_colour(index.row())
            return QColor(current_theme().dim if row.noisy else current_theme().text)
        if role == SHORT_NAME and column == 0:
            return row.short_name
        if role == _Role.ToolTipRole and (row.noisy or not column):
            return f"{row.texts()[0]}: {NOISE_WORDS}" if row.noisy else row.texts()[0]
        return None

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole
    ) -> object:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == _Role.DisplayRole:
            return COLUMNS[section][0]
        if role == _Role.ToolTipRole:
            return COLUMNS[section][1]
        if role == _Role.TextAlignmentRole and section == 0:
            return int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        return None
