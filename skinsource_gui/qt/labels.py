"""Labels, the look of tables, and the hints of empty panels."""

from collections.abc import Collection, Mapping, Sequence

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QSize, Qt

from skinsource_gui.qt.keys import shortcut_text
from skinsource_gui.qt.layouts import Policy, named
from skinsource_gui.qt.theme import UNIT_PX, tabular

#: Hints how to select an input, a clip, and outputs.
HOW_TO_SELECT_INPUT = "Select an input, on the hand or in the timeline, to edit it"
HOW_TO_SELECT_CLIP = "Select a clip in the timeline to see and draw it"
HOW_TO_SELECT_OUTPUT = "Select outputs on the skin map"


def how_to_add(what: str = "an input") -> str:
    """Return the hint how to add ``what``: an input, or a track, as the timeline calls it."""
    return f"Click a place on the hand, or press {shortcut_text('add_input')}, to add {what}"


class FittingLabel(QtWidgets.QLabel):
    """Shows the first of several phrases that fits, or the last one with dots, in any width."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._phrases: tuple[str, ...] = ("",)
        self.setSizePolicy(Policy.Ignored, Policy.Fixed)

    def show_phrases(self, phrases: Sequence[str]) -> None:
        """Set the phrases, longest first."""
        if tuple(phrases) != self._phrases:
            self._phrases = tuple(phrases) or ("",)
            self._choose()
            self.updateGeometry()

    def sizeHint(self) -> QSize:
        return QSize(self._width_of(self._phrases[0]), super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        return QSize(self._width_of(self._phrases[-1]), super().minimumSizeHint().height())

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._choose()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._choose()

    def _choose(self) -> None:
        fitting = (phrase for phrase in self._phrases if self._width_of(phrase) <= self.width())
        text = next(fitting, None) or self.fontMetrics().elidedText(
            self._phrases[-1], Qt.TextElideMode.ElideRight, self.contentsRect().width()
        )
        self.setText(text)

    def _width_of(self, text: str) -> int:
        margins = self.contentsMargins()
        return self.fontMetrics().horizontalAdvance(text) + margins.left() + margins.right() + 2


class FixedLabel(QtWidgets.QLabel):
    """Shows a number at the right, with room for the ``widest``: another one lays nothing out."""

    def __init__(self, widest: str, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self._widest = widest
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.setFont(tabular(self.font()))

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            metrics = self.fontMetrics()
            self.setFixedSize(metrics.horizontalAdvance(self._widest), metrics.height())


_LEAST_PX = 3 * UNIT_PX


def set_table_look(table: QtWidgets.QTableView) -> None:
    """Set the look of a table of numbers that are not edited: dense rows, no grid."""
    table.setFont(tabular(table.font()))
    table.setShowGrid(False)
    table.setTabKeyNavigation(False)
    table.setEditTriggers(table.EditTrigger.NoEditTriggers)
    rows = table.verticalHeader()
    rows.hide()
    rows.setMinimumSectionSize(1)
    rows.setDefaultSectionSize(table.fontMetrics().height() + UNIT_PX // 2)
    rows.setSectionResizeMode(QtWidgets.QHeaderView.ResizeMode.Fixed)
    sections = table.horizontalHeader()
    sections.setMinimumSectionSize(_LEAST_PX)
    sections.setSectionResizeMode(QtWidgets.QHeaderView.ResizeMode.ResizeToContents)
    sections.setHighlightSections(False)


def table_cell(text: str, hint: str, *, right: bool) -> QtWidgets.QTableWidgetItem:
    """Return a cell of a table, with its text at the left or the right."""
    cell, sides = QtWidgets.QTableWidgetItem(text), Qt.AlignmentFlag
    cell.setToolTip(hint)
    cell.setTextAlignment((sides.AlignRight if right else sides.AlignLeft) | sides.AlignVCenter)
    return cell


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
        named(self, name, title)
        set_table_look(self)
        header = self.horizontalHeader()
        for k, (heading, hint) in enumerate(columns.items()):
            item = QtWidgets.QTableWidgetItem(heading)
            item.setToolTip(hint)
            self.setHorizontalHeaderItem(k, item)
            mode = QtWidgets.QHeaderView.ResizeMode
            header.setSectionResizeMode(k, mode.Stretch if k in wide else mode.ResizeToContents)
        self.setSelectionBehavior(QtWidgets.QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QtWidgets.QAbstractItemView.SelectionMode.SingleSelection)
        self.setWordWrap(False)

    def fill(self, rows: Sequence[Sequence[tuple[str, str]]], chosen: int = 0) -> None:
        """Show rows of cells, each a text and its tooltip, and choose one of them."""
        self.setRowCount(len(rows))
        for line, cells in enumerate(rows):
            for column, (text, hint) in enumerate(cells):
                self.setItem(line, column, table_cell(text, hint, right=column > 1))
        if rows:
            self.setCurrentCell(min(chosen, len(rows) - 1), 0)
