"""The designs that are checked, as a table."""

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem

from skinsource.base.quoting import sentence
from skinsource.studies.checking import Condition
from skinsource_gui.checking_page.checking import Row
from skinsource_gui.theme import UNIT_PX, tabular
from skinsource_gui.widgets.fields.level_text import minus

_ERROR = "|p/P - m/M|; p predicted, m measured, P and M their RMS, mean over all channels"
_AMPLITUDE = "100 |RMS(p/P) - RMS(m/M)| / RMS(m/M); letters as of Error"
_COLUMNS = (
    ("Design", "What is predicted"),
    ("Recording", "What was measured of it"),
    ("Hz", "Frequency with the most power in the prediction"),
    ("Linear", "Smallest adjusted R² of outputs over the level of the inputs; 1: in proportion"),
    ("Superposed", "Smallest Pearson's r between the sum of the inputs and all together"),
    ("Channels", "How many are above twice the noise, and so count"),
    (
        "Error",
        f"Normalised mean absolute error, median over the channels: mean over time of {_ERROR}",
    ),
    ("Amplitude %", f"Difference in amplitude, median over the channels: {_AMPLITUDE}"),
    ("r", "Pearson's r over time, median over the channels"),
    ("Shift", "By how many samples the recording was moved onto the prediction"),
)


class CheckTable(QTableWidget):
    """A row for each design; the first columns are wide, the others numbers."""

    def __init__(self) -> None:
        super().__init__(0, len(_COLUMNS))
        self.setObjectName("check_table")
        self.setAccessibleName("Designs that are checked")
        for k, (title, hint) in enumerate(_COLUMNS):
            item = QTableWidgetItem(title)
            item.setToolTip(hint)
            self.setHorizontalHeaderItem(k, item)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setFont(tabular(self.font()))
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(self.fontMetrics().height() + UNIT_PX)
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        for wide in (0, 1):
            header.setSectionResizeMode(wide, QHeaderView.ResizeMode.Stretch)

    def show_rows(self, rows: Sequence[Row]) -> None:
        """Show them; the selected row stays selected."""
        chosen = max(self.currentRow(), 0)
        self.setRowCount(len(rows))
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for k, row in enumerate(rows):
            for column, text in enumerate(_texts(row)):
                item = QTableWidgetItem(text)
                item.setToolTip(_hint(row, column) or text)
                if column > 1:
                    item.setTextAlignment(right)
                self.setItem(k, column, item)
        if rows:
            self.setCurrentCell(min(chosen, len(rows) - 1), 0)


def _hint(row: Row, column: int) -> str:
    """What is more to be said of a cell than is in it; "": nothing."""
    found = row.result
    if isinstance(found, str):
        return sentence(found)
    if found is None or found.agreement is None or _COLUMNS[column][0] != "Channels":
        return ""
    return f"{found.noise_words[0].upper()}{found.noise_words[1:]}"


def _texts(row: Row) -> list[str]:
    recording = "–" if row.recording is None else row.recording.name
    found = row.result
    if not isinstance(found, Condition):
        return [row.name, recording, *([""] * (len(_COLUMNS) - 2))]
    texts = [_text(found.frequency_hz, "silent"), _text(found.linear), _text(found.superposed)]
    if found.agreement is None:
        texts += ["–"] * 5
    else:
        counted = found.agreement.counted
        texts += [f"{int(counted.sum())} of {counted.size}"]
        texts += [_text(value) for value in found.agreement.medians]
        texts += [str(found.shift_samples)]
    return [row.name, recording, *(minus(text) for text in texts)]


def _text(value: float, otherwise: str = "–") -> str:
    return f"{value:.3g}" if np.isfinite(value) else otherwise
