"""One table of levels: a row for each region, as high as all of them."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QFont, QResizeEvent
from PySide6.QtWidgets import QAbstractItemView, QSizePolicy, QTableWidget, QTableWidgetItem

from skinsource.design.comparing import REGION_OUTPUTS
from skinsource_gui.panels.regions.columns import Column
from skinsource_gui.theme import UNIT_PX, scaled, tabular
from skinsource_gui.widgets.name_column import dress_table

#: Size of its words: six columns beside the names of regions need it.
_TEXT = 0.9
# Of a row, besides what its name needs.
_ROW_PX = 1
#: Names where those of the table have too little room.
_SHORT = {"Back of the hand": "Back", "Wrist, palm side": "W. palm"}


class RegionTable(QTableWidget):
    """Columns beside the names of regions; what is around it scrolls up and down."""

    def __init__(self, name: str, title: str) -> None:
        super().__init__(len(REGION_OUTPUTS), 0)
        self.setObjectName(name)
        self.setAccessibleName(title)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        dress_table(self)
        # Names stay in sight where there are more columns than have room.
        self.verticalHeader().show()
        self.fit_words(self.font())

    @property
    def needed_px(self) -> int:
        """Width that shows all columns beside whole names."""
        return self._names_px() + self.horizontalHeader().length() + 2 * self.frameWidth()

    def show_columns(self, columns: Sequence[Column]) -> None:
        """Show them in this order."""
        self.setColumnCount(len(columns))
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for k, column in enumerate(columns):
            head = QTableWidgetItem(column.head or column.title)
            head.setToolTip(column.hint)
            self.setHorizontalHeaderItem(k, head)
            for row, text in enumerate(column.texts()):
                item = QTableWidgetItem(text)
                item.setTextAlignment(right)
                item.setToolTip(column.hint)
                self.setItem(row, k, item)
        self.setVisible(bool(columns))
        self._name_rows()
        self._fit_height()

    def fit_words(self, around: QFont) -> None:
        """Take over the size of the words around."""
        font = scaled(tabular(around), _TEXT)
        for part in (self, self.horizontalHeader(), self.verticalHeader()):
            part.setFont(font)
        self._name_rows()
        self._fit_height()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._name_rows()

    def event(self, event: QEvent) -> bool:
        done = super().event(event)
        if event.type() == QEvent.Type.LayoutRequest:
            self._fit_height()
        return done

    def _fit_height(self) -> None:
        head = self.horizontalHeader().sizeHint().height()
        bar = self.horizontalScrollBar()
        below = bar.sizeHint().height() if bar.maximum() > 0 else 0
        self.setFixedHeight(head + self.verticalHeader().length() + below + 2 * self.frameWidth())

    def _names_px(self) -> int:
        return max(map(self.fontMetrics().horizontalAdvance, REGION_OUTPUTS)) + 2 * UNIT_PX

    def _name_rows(self) -> None:
        """Call regions by their names, or shorter where the numbers need the room."""
        names = list(REGION_OUTPUTS)
        if self.needed_px > self.width():
            names = [_SHORT.get(name, name) for name in names]
        self.setVerticalHeaderLabels(names)
        for row, name in enumerate(REGION_OUTPUTS):
            item = self.verticalHeaderItem(row)
            item.setToolTip(name)
            # The header itself takes over the font around it once it is shown.
            item.setFont(self.font())
        rows = self.verticalHeader()
        rows.setDefaultSectionSize(max(map(rows.sectionSizeHint, range(rows.count()))) + _ROW_PX)
