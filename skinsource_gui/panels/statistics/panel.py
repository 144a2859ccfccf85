"""Figures of the selected outputs, as a table that can be copied."""

from collections.abc import Mapping
from typing import Any, ClassVar

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QLabel,
    QStackedWidget,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from skinsource.design.comparing import match_words
from skinsource.design.design import Design
from skinsource.design.labels import signal_words, span_words
from skinsource.design.view import View
from skinsource_gui.figure_panel import COMPUTING
from skinsource_gui.panel import Panel
from skinsource_gui.panels.statistics.rows import NOISE_WORDS, rows_of, tab_separated
from skinsource_gui.panels.statistics.table_model import TableModel
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.copy_button import CopyButton
from skinsource_gui.widgets.empty_words import output_words
from skinsource_gui.widgets.figure.words_label import WordsLabel
from skinsource_gui.widgets.keys import claims_shortcut
from skinsource_gui.widgets.name_column import dress_table, give_names_the_rest


class FigureTable(QTableView):
    """The table; the usual key copies all of it."""

    copy_wanted = Signal()

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, _copies) or super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if _copies(event):
            self.copy_wanted.emit()
        else:
            super().keyPressEvent(event)


class StatisticsPanel(Panel):
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
        dress_table(self.table)
        give_names_the_rest(self.table)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        header = self.table.horizontalHeader()
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._message = QLabel()
        self._message.setObjectName("statistics_message")
        set_tone(self._message, "dim")
        self._message.setWordWrap(True)
        self._message.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._stack = QStackedWidget()
        self._stack.addWidget(self._message)
        self._stack.addWidget(self.table)
        self.about = WordsLabel("statistics_about")
        self.copy = CopyButton(self.name, lambda: tab_separated(self.model.rows))
        self.table.copy_wanted.connect(self.copy.click)
        self.computed = (self.table,)
        self._lay_out()
        self.setFocusProxy(self.table)
        self._say(self.no_outputs)

    @property
    def needs(self) -> frozenset[str]:
        drawn = {"output_statistics", "shown_outputs", "above_noise_db", "limb_data"}
        return frozenset(drawn | {"axes", "match_gain", "method", "span"})

    @property
    def no_outputs(self) -> str:
        """What it says while no output is selected."""
        return output_words(self.in_sight)

    def sizeHint(self) -> QSize:
        return QSize(460, 260)

    def show_state(self, design: Design, view: View) -> None:
        if not view.outputs:
            self._say(self.no_outputs)
        elif self._message.text() == self.no_outputs:
            self._message.setText(COMPUTING)

    def show_results(self, results: Mapping[str, Any]) -> None:
        outputs = results["shown_outputs"]
        if not outputs:
            self._say(self.no_outputs)
            return
        found = results["output_statistics"], results["above_noise_db"]
        rows = rows_of(outputs, *found, limb=results["limb_data"].name)
        self.model.show_rows(rows)
        parts = (
            signal_words(results["axes"], results["method"]),
            f"RMS: {span_words(results['span'])}",
            match_words(results["match_gain"]),
            NOISE_WORDS if any(row.noisy for row in rows) else "",
        )
        self.about.say(" · ".join(filter(None, parts)))
        self.copy.offer(True)
        self._stack.setCurrentWidget(self.table)

    def show_problem(self, reason: str) -> None:
        self._say(reason)

    def show_in_sight(self, names: frozenset[str]) -> None:
        said = self._message.text() == self.no_outputs
        super().show_in_sight(names)
        if said:
            self._message.setText(self.no_outputs)

    def _lay_out(self) -> None:
        bar = QHBoxLayout()
        bar.setContentsMargins(UNIT_PX, 1, UNIT_PX // 2, 1)
        bar.addWidget(self.about, 1)
        bar.addWidget(self.copy)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(bar)
        column.addWidget(self._stack, 1)

    def _say(self, message: str) -> None:
        self.model.show_rows(())
        self.about.say("")
        self.copy.offer(False)
        self._message.setText(message)
        self._stack.setCurrentWidget(self._message)


def _copies(event: QKeyEvent) -> bool:
    return event.matches(QKeySequence.StandardKey.Copy)
