"""The table of which rows are chosen, in pages and panels."""

from collections.abc import Collection, Mapping, Sequence

from PySide6 import QtWidgets
from PySide6.QtCore import Qt

from skinsource_gui.qt.labels import set_table_look


class RowTable(QtWidgets.QTableWidget):
    """A table of which rows are chosen; two columns of words, then numbers.

    Parameters
    ----------
    name, title
        Object name and accessible name.
    columns
        Hints of the columns, by their titles.
    wide
        Numbers of the columns that get the room that is left.
    """

    def __init__(
        self, name: str, title: str, columns: Mapping[str, str], wide: Collection[int]
    ) -> None:
        super().__init__(0, len(columns))
        self.setObjectName(name)
        self.setAccessibleName(title)
        set_table_look(self)
        header = self.horizontalHeader()
        for k, (heading, hint) in enumerate(columns.items()):
            item = QtWidgets.QTableWidgetItem(heading)
            item.setToolTip(hint)
            self.setHorizontalHeaderItem(k, item)
            mode = QtWidgets.QHeaderView.ResizeMode
            header.setSectionResizeMode(k, mode.Stretch if k in wide else mode.ResizeToContents)
        self.setEditTriggers(QtWidgets.QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QtWidgets.QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QtWidgets.QAbstractItemView.SelectionMode.SingleSelection)
        self.setWordWrap(False)

    def fill(self, rows: Sequence[Sequence[tuple[str, str]]], chosen: int = 0) -> None:
        """Show rows of cells, each a text and its tooltip, and choose one of them."""
        self.setRowCount(len(rows))
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for line, cells in enumerate(rows):
            for column, (text, hint) in enumerate(cells):
                item = QtWidgets.QTableWidgetItem(text)
                item.setToolTip(hint)
                if column > 1:
                    item.setTextAlignment(right)
                self.setItem(line, column, item)
        if rows:
            self.setCurrentCell(min(chosen, len(rows) - 1), 0)
