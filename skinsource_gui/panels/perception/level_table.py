"""The table of levels above threshold."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractItemView, QTableWidget, QTableWidgetItem

from skinsource_gui.widgets.name_column import SHORT_NAME, dress_table, give_names_the_rest


class LevelTable(QTableWidget):
    """Texts in rows; the first column says which output, the others are numbers."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("perception_table")
        self.setAccessibleName("Levels above threshold")
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        dress_table(self)

    def fill(
        self,
        columns: Sequence[tuple[str, str]],
        outputs: Sequence[int],
        texts: Sequence[Sequence[str]],
    ) -> None:
        """Show rows of outputs under columns, of which each has a title and a hint."""
        self.setColumnCount(len(columns))
        self.setRowCount(len(texts))
        give_names_the_rest(self)
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        left = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        for k, (title, hint) in enumerate(columns):
            item = QTableWidgetItem(title)
            item.setToolTip(hint)
            item.setTextAlignment(right if k else left)
            self.setHorizontalHeaderItem(k, item)
        for row, (output, line) in enumerate(zip(outputs, texts, strict=True)):
            for k, text in enumerate(line):
                item = QTableWidgetItem(text)
                if k:
                    item.setTextAlignment(right)
                else:
                    item.setData(SHORT_NAME, str(output))
                    item.setToolTip(text)
                self.setItem(row, k, item)
