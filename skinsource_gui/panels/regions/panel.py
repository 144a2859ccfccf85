"""RMS levels by region: of snapshots side by side, and of the design on all people's limbs."""

from collections.abc import Mapping, Sequence
from typing import ClassVar

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QBoxLayout,
    QHBoxLayout,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from skinsource.design.comparing import limbs_beside
from skinsource.design.design import Design
from skinsource.design.labels import signal_words, span_words
from skinsource.design.view import View
from skinsource.limbs.limb import PUBLISHED
from skinsource.limbs.own_limbs import missing_limb
from skinsource_gui.compared import (
    LEVELS_MATCHED,
    Compared,
    alike_in_level,
    matched_text,
    shown_words,
)
from skinsource_gui.panel import Panel
from skinsource_gui.panels.regions.columns import (
    NO_REGIONS,
    Column,
    columns_of,
    columns_of_people,
    tab_separated,
)
from skinsource_gui.panels.regions.table import RegionTable
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.copy_button import CopyButton
from skinsource_gui.widgets.figure.words_label import WordsLabel
from skinsource_gui.widgets.room.steady_area import SteadyArea

_NEEDS = frozenset({"output_levels_db"})


class RegionsPanel(Panel):
    """A row for each region, a column for each design or person, mean and spread.

    Attributes
    ----------
    stored, table
        The tables of snapshots and of people.
    """

    title: ClassVar[str] = "Regions"
    name: ClassVar[str] = "regions"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(240, 120)
        self._limbs: tuple[str, ...] = ()
        self._matched = False
        self._snapshots: Sequence[Compared] = ()
        self._on_limbs: Sequence[Compared] = ()
        self.columns: list[Column] = []
        self._about = self._shifted = ""
        self.about = WordsLabel("regions_about")
        self.copy = CopyButton(self.name, lambda: tab_separated(self.columns))
        self.copy.offer(False)
        self.stored = RegionTable("regions_stored", "RMS levels of snapshots by region")
        self.table = RegionTable("regions_table", "RMS levels of people by region")
        self._tables = (self.stored, self.table)
        bar = QHBoxLayout()
        bar.setContentsMargins(UNIT_PX, 1, UNIT_PX // 2, 1)
        bar.addWidget(self.about, 1)
        bar.addWidget(self.copy)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(bar)
        column.addWidget(self._scrolled(), 1)
        self.setFocusProxy(self.table)
        self.computed = (self.table,)

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        return _NEEDS

    @property
    def needs_on_limbs(self) -> Mapping[str, frozenset[str]]:
        return dict.fromkeys(self._limbs, _NEEDS)

    def sizeHint(self) -> QSize:
        return QSize(460, 300)

    def show_state(self, design: Design, view: View) -> None:
        self._matched = view.levels_matched
        # Of others it is not known which outputs lie where.
        self._limbs = limbs_beside(design.limb) if design.limb in PUBLISHED else ()
        if self._on_limbs and not self._limbs:
            self.show_on_limbs(())
        if not self._limbs:
            missing = missing_limb(design.limb, design.limb_digest).rstrip(".")
            self._about = missing or NO_REGIONS
            self._say_about()
            return
        words = signal_words(view.axes, view.method)
        people = shown_words(design, view)
        parts = f"RMS in dB re 1 m/s², {words}", span_words(view.span), "no sensor on the palm"
        self._about = " · ".join([*parts, *([f"people: {people}"] if people else [])])
        self._say_about()

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        self._snapshots = compared
        self._show_columns()

    def show_on_limbs(self, compared: Sequence[Compared]) -> None:
        self._on_limbs = compared
        self.show_stale(any(one.late for one in compared))
        self._show_columns()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._put_in_order()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            for table in self._tables:
                table.fit_words(self.font())
            self._put_in_order()

    def _show_columns(self) -> None:
        matched = alike_in_level(self._snapshots, matched=self._matched)
        stored = columns_of(self._snapshots, matched=matched)
        told = matched and any(one.has_levels for one in stored)
        self._shifted = (matched_text(self._snapshots) or LEVELS_MATCHED) if told else ""
        people = columns_of_people(self._on_limbs)
        self.columns = [*stored, *people]
        computing = any(one.computing for one in self.columns)
        self.copy.offer(not computing and any(one.has_levels for one in self.columns))
        self.stored.show_columns(stored)
        self.table.show_columns(people)
        self._say_about()
        self._put_in_order()

    def _scrolled(self) -> SteadyArea:
        """The tables, which go below each other where they have no room side by side."""
        inside = QWidget()
        self._box = QBoxLayout(QBoxLayout.Direction.TopToBottom, inside)
        self._box.setContentsMargins(0, 0, 0, 0)
        self._box.setSpacing(UNIT_PX)
        for table in self._tables:
            self._box.addWidget(table, 0, Qt.AlignmentFlag.AlignTop)
        self._box.addStretch(1)
        area = SteadyArea()
        area.setObjectName("regions_scroll")
        area.setFrameShape(SteadyArea.Shape.NoFrame)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        area.setWidget(inside)
        # It takes what there is: the dock around it need not scroll as well.
        area.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Ignored)
        return area

    def _put_in_order(self) -> None:
        needed = sum(table.needed_px for table in self._tables if not table.isHidden()) + UNIT_PX
        beside = needed <= self.width()
        ways = QBoxLayout.Direction
        self._box.setDirection(ways.LeftToRight if beside else ways.TopToBottom)
        # What is left over is theirs beside each other, and below them otherwise.
        for k in range(self._box.count()):
            self._box.setStretch(k, int(beside == (k < len(self._tables))))

    def _say_about(self) -> None:
        some = any(one.synthetic for one in self.columns)
        note = " · syn.: a synthetic limb, computed" if some else ""
        # Only the columns of snapshots are shifted: those of people are as they are.
        shifted = f" · snapshots: {self._shifted}" if self._shifted else ""
        self.about.say(f"{self._about}{shifted}{note}")
