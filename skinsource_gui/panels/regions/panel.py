"""RMS levels by region: of snapshots side by side, and of the design on all people's limbs."""

from collections.abc import Mapping, Sequence
from typing import ClassVar

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QGuiApplication, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QTableWidget,
    QTableWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from skinsource.choice_words import signal_words, span_words
from skinsource.comparing import limbs_beside
from skinsource.comparing.regions import REGION_OUTPUTS
from skinsource.design import Design
from skinsource.limb import PUBLISHED
from skinsource.view import View
from skinsource_gui.compared import Compared
from skinsource_gui.panel import Panel
from skinsource_gui.panels.regions.columns import NO_REGIONS, Column, columns_of, tab_separated
from skinsource_gui.theme import UNIT_PX, Theme, scaled, tabular
from skinsource_gui.widgets.figure.words_label import WordsLabel
from skinsource_gui.widgets.lateness import Lateness
from skinsource_gui.widgets.name_column import dress_table

_NEEDS = frozenset({"output_levels_db"})
#: Size of its words: six columns beside the names of regions need it.
_TEXT = 0.9
#: Names where those of the table have too little room.
_SHORT = {"Back of the hand": "Back", "Wrist, palm side": "W. palm"}


class RegionsPanel(Panel):
    """A row for each region, a column for each design or person, mean and spread."""

    title: ClassVar[str] = "Regions"
    name: ClassVar[str] = "regions"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(240, 120)
        self._limbs: tuple[str, ...] = ()
        self._snapshots: Sequence[Compared] = ()
        self._on_limbs: Sequence[Compared] = ()
        self.columns: list[Column] = []
        self._about = ""
        self.about = WordsLabel("regions_about")
        self.copy = QToolButton()
        self.copy.setObjectName("regions_copy")
        self.copy.setText("Copy")
        self.copy.setToolTip("Copy the numbers as a table, with tabs between the columns")
        self.copy.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.copy.clicked.connect(self._copy)
        self.table = QTableWidget(len(REGION_OUTPUTS), 0)
        self.table.setObjectName("regions_table")
        self.table.setAccessibleName("RMS levels by region")
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        dress_table(self.table)
        # Names stay in sight where snapshots make it wider than its room.
        self.table.verticalHeader().show()
        self._fit_words()
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
        self._lateness = Lateness(self)
        self._lateness.changed.connect(self.table.setDisabled)

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        return _NEEDS

    @property
    def needs_on_limbs(self) -> Mapping[str, frozenset[str]]:
        return dict.fromkeys(self._limbs, _NEEDS)

    def sizeHint(self) -> QSize:
        return QSize(460, 300)

    def show_state(self, design: Design, view: View) -> None:
        # Of others it is not known which outputs lie where.
        self._limbs = limbs_beside(design.limb) if design.limb in PUBLISHED else ()
        if self._on_limbs and not self._limbs:
            self.show_on_limbs(())
        if not self._limbs:
            self._about = NO_REGIONS
            self._say_about()
            return
        words = signal_words(view.axes, view.method)
        self._about = f"RMS in dB, {words} · {span_words(view.span)} · no sensor on the palm"
        self._say_about()

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        self._snapshots = compared
        self._show_columns()

    def show_on_limbs(self, compared: Sequence[Compared]) -> None:
        self._on_limbs = compared
        self._lateness.set_stale(any(one.late for one in compared))
        self._show_columns()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._name_rows()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fit_words()

    def show_theme(self, theme: Theme) -> None:
        self.about.show_theme(theme)

    def _show_columns(self) -> None:
        self.columns = columns_of(self._snapshots, self._on_limbs)
        self.table.setColumnCount(len(self.columns))
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for k, column in enumerate(self.columns):
            head = QTableWidgetItem(column.head or column.title)
            head.setToolTip(column.hint)
            self.table.setHorizontalHeaderItem(k, head)
            for row, text in enumerate(column.texts()):
                item = QTableWidgetItem(text)
                item.setTextAlignment(right)
                item.setToolTip(column.hint)
                self.table.setItem(row, k, item)
        self._say_about()
        self._name_rows()

    def _say_about(self) -> None:
        some = any(one.synthetic for one in self.columns)
        note = " · syn.: a synthetic limb, computed" if some else ""
        self.about.say(f"{self._about}{note}")

    def _fit_words(self) -> None:
        font = scaled(tabular(self.font()), _TEXT)
        for part in (self.table, self.table.horizontalHeader(), self.table.verticalHeader()):
            part.setFont(font)
        rows = self.table.verticalHeader()
        rows.setDefaultSectionSize(self.table.fontMetrics().height() + UNIT_PX // 2)
        self._name_rows()

    def _name_rows(self) -> None:
        """Call regions by their names, or shorter where the numbers need the room."""
        names = list(REGION_OUTPUTS)
        metrics, header = self.table.fontMetrics(), self.table.horizontalHeader()
        needed = max(metrics.horizontalAdvance(name) for name in names) + 2 * UNIT_PX
        if needed + header.length() > self.width():
            names = [_SHORT.get(name, name) for name in names]
        self.table.setVerticalHeaderLabels(names)
        for row, name in enumerate(REGION_OUTPUTS):
            self.table.verticalHeaderItem(row).setToolTip(name)

    def _copy(self) -> None:
        QGuiApplication.clipboard().setText(tab_separated(self.columns))
