"""The table of levels above threshold."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem

from skinsource_gui.theme import UNIT_PX, tabular


class LevelTable(QTableWidget):
    """Texts in rows; the first column says which output, the others are numbers."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("perception_table")
        self.setAccessibleName("Levels above threshold")
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setFont(tabular(self.font()))
        self.setShowGrid(False)
        self.setTabKeyNavigation(False)
        rows = self.verticalHeader()
        rows.hide()
        rows.setMinimumSectionSize(1)
        rows.setDefaultSectionSize(self.fontMetrics().height() + UNIT_PX // 2)
        sections = self.horizontalHeader()
        sections.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        sections.setHighlightSections(False)

    def fill(self, columns: Sequence[tuple[str, str]], texts: Sequence[Sequence[str]]) -> None:
        """Show rows under columns, of which each has a title and a hint."""
        self.setColumnCount(len(columns))
        self.setRowCount(len(texts))
        for k, (title, hint) in enumerate(columns):
            item = QTableWidgetItem(title)
            item.setToolTip(hint)
            self.setHorizontalHeaderItem(k, item)
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for row, line in enumerate(texts):
            for k, text in enumerate(line):
                item = QTableWidgetItem(text)
                if k:
                    item.setTextAlignment(right)
                self.setItem(row, k, item)
