"""The first column of a table: names that are written shorter where there is little room."""

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtWidgets import (
    QHeaderView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
)

from skinsource_gui.theme import UNIT_PX, tabular

#: Under this role a name has its short form; one without stays as it is.
SHORT_NAME = Qt.ItemDataRole.UserRole
_LEAST_PX = 3 * UNIT_PX
# With fewer letters of a name its short form says as much.
_LETTERS = 7


class NameDelegate(QStyledItemDelegate):
    """Paints as much of a name as has room; its short form where next to nothing of it has."""

    def initStyleOption(
        self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        super().initStyleOption(option, index)
        style = option.widget.style() if option.widget is not None else None
        if style is None:
            return
        edge = style.pixelMetric(QStyle.PixelMetric.PM_FocusFrameHMargin, option, option.widget) + 1
        short, room = index.data(SHORT_NAME), option.rect.width() - 2 * edge
        if short is None:
            return
        metrics = option.fontMetrics
        least = metrics.horizontalAdvance(str(short)) + _LETTERS * metrics.averageCharWidth()
        if metrics.horizontalAdvance(str(index.data())) > room and room < least:
            option.text = str(short)


def dress_table(table: QTableView) -> None:
    """Give a table of numbers its looks: dense rows, a name column that yields, no grid.

    The first column takes the room that the numbers leave, so that nothing has to scroll sideways
    before even short names have too little.
    """
    table.setFont(tabular(table.font()))
    table.setShowGrid(False)
    table.setTabKeyNavigation(False)
    rows = table.verticalHeader()
    rows.hide()
    rows.setMinimumSectionSize(1)
    rows.setDefaultSectionSize(table.fontMetrics().height() + UNIT_PX // 2)
    rows.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
    sections = table.horizontalHeader()
    sections.setMinimumSectionSize(_LEAST_PX)
    sections.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    sections.setHighlightSections(False)
    table.setItemDelegateForColumn(0, NameDelegate(table))


def give_names_the_rest(table: QTableView) -> None:
    """Have the first column take what the others leave; there must be one."""
    table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
