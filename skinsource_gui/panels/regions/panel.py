"""RMS levels by region: of snapshots side by side, and of the design on all people's limbs."""

from collections.abc import Sequence
from typing import ClassVar

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from skinsource.choice_words import signal_words, span_words
from skinsource.comparing.regions import REGION_OUTPUTS
from skinsource.design import Design
from skinsource.view import View
from skinsource_gui.compared import Compared
from skinsource_gui.panel import Panel
from skinsource_gui.panels.regions.columns import Column, columns_of, tab_separated
from skinsource_gui.theme import UNIT_PX, Theme, tabular
from skinsource_gui.widgets.figure.elided_label import ElidedLabel

_NEEDS = frozenset({"output_levels_db"})


class RegionsPanel(Panel):
    """A row for each region, a column for each design or person, mean and spread."""

    title: ClassVar[str] = "Regions"
    name: ClassVar[str] = "regions"
    needs_of_people: ClassVar[frozenset[str]] = _NEEDS

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(240, 120)
        self._snapshots: Sequence[Compared] = ()
        self._people: Sequence[Compared] = ()
        self.columns: list[Column] = []
        self.about = ElidedLabel("regions_about")
        self.copy = QToolButton()
        self.copy.setObjectName("regions_copy")
        self.copy.setText("Copy")
        self.copy.setToolTip("Copy the numbers as a table, with tabs between the columns")
        self.copy.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.copy.clicked.connect(self._copy)
        self.table = QTableWidget(len(REGION_OUTPUTS), 0)
        self.table.setObjectName("regions_table")
        self.table.setAccessibleName("RMS levels by region")
        self.table.setVerticalHeaderLabels(list(REGION_OUTPUTS))
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setFont(tabular(self.table.font()))
        self.table.setTabKeyNavigation(False)
        self.table.setShowGrid(False)
        rows = self.table.verticalHeader()
        rows.setMinimumSectionSize(1)
        rows.setDefaultSectionSize(self.table.fontMetrics().height() + UNIT_PX // 2)
        rows.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        sections = self.table.horizontalHeader()
        sections.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        sections.setHighlightSections(False)
        bar = QHBoxLayout()
        bar.setContentsMargins(UNIT_PX, 1, UNIT_PX // 2, 1)
        bar.addWidget(self.about, 1)
        bar.addWidget(self.copy)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(bar)
        column.addWidget(self.table, 1)
        self.setFocusProxy(self.table)

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        return _NEEDS

    def sizeHint(self) -> QSize:
        return QSize(460, 300)

    def show_state(self, design: Design, view: View) -> None:
        words = signal_words(view.axes, view.method)
        self.about.say(f"RMS in dB, {words} · {span_words(view.span)} · no sensor on the palm")

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        if compared and compared[0].on_limb:
            self._people = compared
        else:
            self._snapshots = compared
        self.columns = columns_of(self._snapshots, self._people)
        self._fill()

    def show_theme(self, theme: Theme) -> None:
        self.about.show_theme(theme)

    def _fill(self) -> None:
        self.table.setColumnCount(len(self.columns))
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for k, column in enumerate(self.columns):
            head = QTableWidgetItem(column.title)
            head.setToolTip(column.hint)
            self.table.setHorizontalHeaderItem(k, head)
            for row, text in enumerate(column.texts()):
                item = QTableWidgetItem(text)
                item.setTextAlignment(right)
                item.setToolTip(column.hint)
                self.table.setItem(row, k, item)

    def _copy(self) -> None:
        QGuiApplication.clipboard().setText(tab_separated(self.columns))
