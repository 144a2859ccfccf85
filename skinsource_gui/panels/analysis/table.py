"""A table with a row for each selected output, and the base of the views that show one."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, Signal

from skinsource_gui.panels.analysis.view import AnalysisView
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.keys import claims_shortcut
from skinsource_gui.qt.labels import set_table_look, table_cell
from skinsource_gui.qt.layouts import named
from skinsource_gui.qt.theme import current_theme

#: Titles of columns, and what they mean.
Columns = Sequence[tuple[str, str]]


# The least that is written of a name.
_LEAST_NAME = "00 ≈…0"


@dataclass(frozen=True, slots=True, kw_only=True)
class TableRow:
    """A row of texts, the first of which begins with the number of the output.

    Attributes
    ----------
    hint
        What is to be known of the numbers, which are then dim; "": nothing.
    """

    output: int
    texts: tuple[str, ...]
    hint: str = ""


class OutputTable(QtWidgets.QTableWidget):
    """The table; the usual key copies all of it."""

    copy_requested = Signal()

    def __init__(self, name: str, accessible_name: str) -> None:
        super().__init__()
        self._columns: Columns = ()
        self._rows: Sequence[TableRow] = ()
        set_table_look(named(self, name, accessible_name))
        self.setSelectionBehavior(QtWidgets.QAbstractItemView.SelectionBehavior.SelectRows)

    def show_rows(self, columns: Columns, rows: Sequence[TableRow]) -> None:
        """Show a row for each output under columns; of the same outputs the selection stays."""
        if [row.output for row in rows] != [row.output for row in self._rows]:
            self.clearSelection()
        self._columns, self._rows = columns, rows
        self.setColumnCount(len(columns))
        self.setRowCount(len(rows))
        theme = current_theme()
        for column, (title, hint) in enumerate(columns):
            self.setHorizontalHeaderItem(column, table_cell(title, hint, right=column > 0))
        for rank, row in enumerate(rows):
            for column, text in enumerate(row.texts):
                hint = row.hint if column else row.hint or text
                item = table_cell(text, hint, right=column > 0)
                colour = QtGui.QColor(theme.dim if row.hint else theme.text)
                item.setForeground(colour if column else theme.output_colour(rank))
                self.setItem(rank, column, item)
        self._fit_names()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit_names()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.FontChange):
            self.show_rows(self._columns, self._rows)

    def _fit_names(self) -> None:
        """Give names what they need, or what the numbers leave, but room for a number at least."""
        header, modes = self.horizontalHeader(), QtWidgets.QHeaderView.ResizeMode
        sections = range(header.count())
        if not sections:
            return
        names, *others = (
            max(header.sectionSizeHint(k), self.sizeHintForColumn(k)) for k in sections
        )
        least = self.fontMetrics().horizontalAdvance(_LEAST_NAME)
        header.setSectionResizeMode(0, modes.Fixed)
        header.resizeSection(0, min(names, max(self.viewport().width() - sum(others), least)))

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
