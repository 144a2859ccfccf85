"""Labelled fields in aligned columns."""

from collections.abc import Sequence
from itertools import pairwise

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QGridLayout, QWidget

from skinsource_gui.theme import UNIT_PX, letter_scale
from skinsource_gui.widgets.fields.edited_cell import LabelledCell
from skinsource_gui.widgets.room.room_or_words import RoomOrWords

#: From this width on, two fields stand side by side, in letters of the usual size.
WIDE_PX = 440
_MOST_PAIRS = 2
_ANY_HEIGHT_PX = 16_777_215


class FieldGrid(QWidget):
    """Cells with their labels beside them: one column of pairs, or two where there is room.

    Where even one pair has too little room, labels stand above their fields.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._cells: tuple[LabelledCell, ...] = ()
        self._pairs, self._above = 1, False
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(UNIT_PX)
        self._grid.setVerticalSpacing(UNIT_PX // 4)
        RoomOrWords(self).changed.connect(self._fold)

    def set_margins(self, left: int, top: int, right: int, bottom: int) -> None:
        """Leave room around the cells, px."""
        self._grid.setContentsMargins(left, top, right, bottom)

    @property
    def pairs(self) -> int:
        """Fields side by side."""
        return self._pairs

    def show_cells(self, cells: Sequence[LabelledCell]) -> None:
        """Show these cells, in reading order; others are taken off and left to the caller."""
        for cell in self._cells:
            if cell not in cells:
                for part in (cell.label, cell):
                    self._grid.removeWidget(part)
                    part.hide()
        self._cells = tuple(cells)
        self._above = self.width() < self._paired_px
        self._arrange()
        proxies = (cell.focusProxy() for cell in cells)
        stops = [one for one in proxies if one is not None]
        for before, after in pairwise(stops):
            self.setTabOrder(before, after)
        for cell in cells:
            cell.label.show()
            cell.show()

    def minimumSizeHint(self) -> QSize:
        # Neither fields side by side nor labels beside them must keep the grid so wide that they
        # stay there.
        fields = max((cell.minimumSizeHint().width() for cell in self._cells), default=0)
        margins = self._grid.contentsMargins()
        least = fields + margins.left() + margins.right()
        return super().minimumSizeHint().boundedTo(QSize(least, _ANY_HEIGHT_PX))

    def _fold(self) -> None:
        wide_px = WIDE_PX * letter_scale(self.font())
        pairs = _MOST_PAIRS if self.width() >= wide_px else 1
        above = self.width() < self._paired_px
        if (pairs, above) != (self._pairs, self._above):
            self._pairs, self._above = pairs, above
            self._arrange()

    @property
    def _paired_px(self) -> int:
        """Least width of a label with its field beside it."""
        beside = [cell for cell in self._cells if not cell.across]
        labels = max((cell.label.sizeHint().width() for cell in beside), default=0)
        fields = max((cell.minimumSizeHint().width() for cell in beside), default=0)
        margins = self._grid.contentsMargins()
        gap = self._grid.horizontalSpacing()
        return labels + gap + fields + margins.left() + margins.right()

    def _arrange(self) -> None:
        # One that is across holds its label, which stands in no layout of the grid.
        for part in (widget for cell in self._cells for widget in (cell.label, cell)):
            self._grid.removeWidget(part)
        row, pair = 0, 0
        for cell in self._cells:
            if cell.across:
                row += pair > 0
                self._grid.addWidget(cell, row, 0, 1, 2 * self._pairs)
                row, pair = row + 1, 0
                continue
            if self._above:
                self._grid.addWidget(cell.label, row, 0, 1, 2)
                self._grid.addWidget(cell, row + 1, 0, 1, 2)
                row += 2
                continue
            self._grid.addWidget(cell.label, row, 2 * pair, Qt.AlignmentFlag.AlignTop)
            self._grid.addWidget(cell, row, 2 * pair + 1, Qt.AlignmentFlag.AlignTop)
            row, pair = (row, pair + 1) if pair + 1 < self._pairs else (row + 1, 0)
        for pair in range(_MOST_PAIRS):
            self._grid.setColumnStretch(2 * pair + 1, 1 if pair < self._pairs else 0)
