"""The panel of figures of the selected outputs, as a table that can be copied."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from PySide6.QtCore import (
    QAbstractTableModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractItemView,
    QStackedWidget,
    QTableView,
    QWidget,
)

from skinsource.base.arrays import Floats
from skinsource.design.comparing import match_text
from skinsource.design.design import Design
from skinsource.design.labels import signal_label, span_label
from skinsource.design.view import View
from skinsource.limbs.locations import output_name
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.signals.analysis.statistics import BEGUN_SHARE, Statistics
from skinsource_gui.plots.figure import NoteLabel
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.keys import claims_shortcut
from skinsource_gui.qt.labels import (
    SHORT_NAME,
    fit_name_column,
    set_table_look,
)
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.questions import CopyButton, copied_number
from skinsource_gui.qt.theme import UNIT_PX, current_theme
from skinsource_gui.state.panel import OutputsPanel

#: Titles, as narrow as they can be, and what they mean.
COLUMNS = (
    ("Output", "Number and place of the output"),
    ("RMS\nm/s²", "RMS over what the choice Levels says"),
    ("Peak\nm/s²", "Largest magnitude of the signal, over the whole record"),
    ("Crest", "Peak over RMS"),
    ("Main\nHz", "Frequency with the most power along the chosen axes"),
    (
        "Delay\nms",
        f"From the start of the first input to where the output first reaches {BEGUN_SHARE:.0%} of "
        "its peak; the pre-trigger counts unless it is removed",
    ),
)
NOISE_MARK = "≈"
NOISE_NOTE = f"{NOISE_MARK} less than {LEAST_ABOVE_NOISE_DB:g} dB above the noise"


@dataclass(frozen=True, slots=True, kw_only=True)
class StatisticsRow:
    """One output: its name, its figures, and whether they are mostly those of noise."""

    number: int
    name: str
    values: tuple[float, ...]
    noisy: bool

    def texts(self) -> tuple[str, ...]:
        """Return the texts of a row; a dash where there is no number."""
        mark = f" {NOISE_MARK}" if self.noisy else ""
        written = (
            format(value, style).removesuffix(".") if np.isfinite(value) else "–"
            for value, style in zip(self.shown, ("#.3g", "#.3g", ".2f", ".1f", ".1f"), strict=True)
        )
        return (f"{self.number}  {self.name}{mark}", *(text.replace("-", "−") for text in written))

    @property
    def short_name(self) -> str:
        """The name where there is little room: the number."""
        return f"{self.number} {NOISE_MARK}" if self.noisy else str(self.number)

    @property
    def shown(self) -> tuple[float, ...]:
        """Values in the units of the table."""
        *others, delay_s = self.values
        return (*others, delay_s * 1e3)


def rows_of(
    outputs: tuple[int, ...], figures: Statistics, above_noise_db: Floats | None, limb: str = ""
) -> tuple[StatisticsRow, ...]:
    """Return a row for each selected output of a limb."""
    rows = []
    columns = (
        figures.rms,
        figures.peak,
        figures.crest,
        figures.dominant_hz,
        figures.delay_s,
    )
    for rank, output in enumerate(outputs):
        above = np.inf if above_noise_db is None else above_noise_db[output - 1]
        rows.append(
            StatisticsRow(
                number=output,
                name=output_name(output, limb).short_name,
                values=tuple(float(column[rank]) for column in columns),
                noisy=bool(above < LEAST_ABOVE_NOISE_DB),
            )
        )
    return tuple(rows)


def tab_separated(rows: tuple[StatisticsRow, ...]) -> str:
    """Return the table for a spreadsheet: a header, then numbers that read back exactly."""
    header: tuple[str, ...] = ("output", "place", "rms_m_per_s2", "peak_m_per_s2")
    header += ("crest", "dominant_hz", "delay_ms", "mostly_noise")
    lines = ["\t".join(header)]
    for row in rows:
        numbers = map(copied_number, row.shown)
        lines.append("\t".join((str(row.number), row.name, *numbers, "yes" if row.noisy else "no")))
    return "\n".join(lines) + "\n"


_Index = QModelIndex | QPersistentModelIndex
_Role = Qt.ItemDataRole


class TableModel(QAbstractTableModel):
    """Figures of the selected outputs, one row each."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.rows: tuple[StatisticsRow, ...] = ()

    def show_rows(self, rows: tuple[StatisticsRow, ...]) -> None:
        """Take over other rows; where they are the same outputs, the selection stays."""
        same = [row.number for row in rows] == [row.number for row in self.rows]
        if not same:
            self.beginResetModel()
        self.rows = rows
        if not same:
            self.endResetModel()
        elif rows:
            end = self.index(len(rows) - 1, len(COLUMNS) - 1)
            self.dataChanged.emit(self.index(0, 0), end)

    def rowCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.rows)

    def columnCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(COLUMNS)

    def data(self, index: _Index, role: int = _Role.DisplayRole) -> object:
        row, column = self.rows[index.row()], index.column()
        if role == _Role.DisplayRole:
            return row.texts()[column]
        if role == _Role.TextAlignmentRole and column:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        if role == _Role.ForegroundRole:
            if column == 0:
                return current_theme().output_colour(index.row())
            return QColor(current_theme().dim if row.noisy else current_theme().text)
        if role == SHORT_NAME and column == 0:
            return row.short_name
        if role == _Role.ToolTipRole and (row.noisy or not column):
            return f"{row.texts()[0]}: {NOISE_NOTE}" if row.noisy else row.texts()[0]
        return None

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole
    ) -> object:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == _Role.DisplayRole:
            return COLUMNS[section][0]
        if role == _Role.ToolTipRole:
            return COLUMNS[section][1]
        if role == _Role.TextAlignmentRole and section == 0:
            return int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        return None


class FigureTable(QTableView):
    """The table; the usual key copies all of it."""

    copy_requested = Signal()

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, _is_copy) or super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if _is_copy(event):
            self.copy_requested.emit()
        else:
            super().keyPressEvent(event)


class StatisticsPanel(OutputsPanel):
    """RMS, peak, crest factor, main frequency and delay of each selected output."""

    title: ClassVar[str] = "Statistics"
    name: ClassVar[str] = "statistics"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(240, 120)
        self.model = TableModel(self)
        self.table = FigureTable()
        self.table.setObjectName("statistics_table")
        self.table.setAccessibleName("Figures of the selected outputs")
        self.table.setModel(self.model)
        set_table_look(self.table)
        fit_name_column(self.table)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        header = self.table.horizontalHeader()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._message = page_label("statistics_message", tone="dim", centred=True)
        self._stack = QStackedWidget()
        self._stack.addWidget(self._message)
        self._stack.addWidget(self.table)
        self.about = NoteLabel("statistics_about")
        self.copy = CopyButton(self.name, lambda: tab_separated(self.model.rows))
        self.table.copy_requested.connect(self.copy.click)
        self.computed = (self.table,)
        bar = in_row((self.about, 1), self.copy, margins=(UNIT_PX, 1, UNIT_PX // 2, 1))
        in_column(bar, (self._stack, 1), of=self, margins=0, gap_px=0)
        self.setFocusProxy(self.table)
        self.say_instead(self.no_outputs)

    @property
    def needs(self) -> frozenset[str]:
        drawn = {"output_statistics", "shown_outputs", "above_noise_db", "limb_data"}
        return frozenset(drawn | {"axes", "match_gain", "method", "span"})

    @property
    def message(self) -> str:
        return self._message.text()

    def sizeHint(self) -> QSize:
        return QSize(460, 260)

    def show_state(self, design: Design, view: View) -> None:
        self.show_selection(view)

    def show_results(self, results: Mapping[str, Any]) -> None:
        outputs = results["shown_outputs"]
        if not outputs:
            self.say_instead(self.no_outputs)
            return
        figures, above_noise_db = results["output_statistics"], results["above_noise_db"]
        rows = rows_of(outputs, figures, above_noise_db, results["limb_data"].name)
        self.model.show_rows(rows)
        parts = (
            signal_label(results["axes"], results["method"]),
            f"RMS: {span_label(results['span'])}",
            match_text(results["match_gain"]),
            NOISE_NOTE if any(row.noisy for row in rows) else "",
        )
        self.about.say(" · ".join(filter(None, parts)))
        self.copy.offer(True)
        self._stack.setCurrentWidget(self.table)

    def say_instead(self, message: str) -> None:
        self.model.show_rows(())
        self.about.say("")
        self.copy.offer(False)
        self._message.setText(message)
        self._stack.setCurrentWidget(self._message)


def _is_copy(event: QKeyEvent) -> bool:
    return event.matches(QKeySequence.StandardKey.Copy)
