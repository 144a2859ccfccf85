"""The first column of a table: names that are written shorter where there is little room."""

from PySide6.QtCore import QEvent, QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtWidgets import (
    QHeaderView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
)
from shiboken6 import isValid

from skinsource_gui.theme import UNIT_PX, tabular

#: Under this role a name has its short form; one without stays as it is.
SHORT_NAME = Qt.ItemDataRole.UserRole
_LEAST_PX = 3 * UNIT_PX
_REFITTED = (QEvent.Type.Resize, QEvent.Type.FontChange, QEvent.Type.StyleChange)
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
    """Have the first column take what the others leave, and no more than its names need.

    There must be one.  Were it wider, nobody could tell which name numbers at the far edge are of.
    """
    known = table.findChild(_NameWidth)
    (_NameWidth(table) if known is None else known).begin()


class _NameWidth(QObject):
    """Keeps the first column of a table, which owns it, as wide as it shall be."""

    def __init__(self, table: QTableView) -> None:
        super().__init__(table)
        self._table, model, header = table, table.model(), table.horizontalHeader()
        header.sectionResized.connect(self._follow)
        for changed in (model.modelReset, model.dataChanged, model.rowsInserted):
            changed.connect(self._fit)
        table.viewport().installEventFilter(self)

    def begin(self) -> None:
        """Take over the first column, which may be a new one."""
        self._table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.Fixed)
        self._fit()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in _REFITTED:
            self._fit()
        return super().eventFilter(watched, event)

    def _follow(self, section: int) -> None:
        if section:
            self._fit()

    def _fit(self) -> None:
        if not isValid(self._table):
            return  # what is changed as a table goes
        header = self._table.horizontalHeader()
        room = self._table.viewport().width() - (header.length() - header.sectionSize(0))
        width = min(room, self._names_px())
        header.resizeSection(0, max(width, header.minimumSectionSize()))

    def _names_px(self) -> int:
        """Width of the longest name, or of what stands above them."""
        table, model = self._table, self._table.model()
        margin = table.style().pixelMetric(QStyle.PixelMetric.PM_FocusFrameHMargin, None, table) + 1
        names = (str(model.index(row, 0).data() or "") for row in range(model.rowCount()))
        metrics = table.fontMetrics()
        longest = max((metrics.horizontalAdvance(one) for one in names), default=0)
        return max(longest + 2 * margin + UNIT_PX, table.horizontalHeader().sectionSizeHint(0))
