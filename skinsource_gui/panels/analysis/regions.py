"""RMS levels by region, of snapshots and of all people's limbs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import ClassVar

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QSize

from skinsource.base.decibels import FLOOR_DB
from skinsource.design.comparing import REGION_OUTPUTS, region_levels_db, related_limbs
from skinsource.design.design import Design, View
from skinsource.design.labels import LIMBS, label_of, signal_label, span_label
from skinsource.limbs.limb import PUBLISHED
from skinsource.limbs.own_limbs import missing_limb
from skinsource_gui.fields.units import minus
from skinsource_gui.panels.analysis.view import AnalysisView
from skinsource_gui.plots.figure import NoteLabel
from skinsource_gui.qt.labels import set_table_look, table_cell
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.questions import copied_level, tab_separated
from skinsource_gui.qt.theme import UNIT_PX, scaled, tabular
from skinsource_gui.state.compared import (
    LEVELS_MATCHED,
    Compared,
    display_gain_text,
    gain_db,
    have_matching_level,
    matched_text,
)
from skinsource_gui.state.panel import COMPUTING

#: Message for own limbs.
NO_REGIONS = "The regions of an own limb's outputs are unknown"


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """A column of the table: its title, a hint, and a number for each region.

    ``head`` is the title in two narrow lines, if it has any; ``full_title`` is the title in a
    spreadsheet; ``computing``: there are no numbers yet.
    """

    title: str
    hint: str
    numbers: tuple[float, ...]
    head: str = ""
    synthetic: bool = False
    computing: bool = False
    full_title: str = ""

    @property
    def has_levels(self) -> bool:
        """Whether any number is a level: a missing limb and silence have none."""
        return any(np.isfinite(level_db) and level_db > FLOOR_DB for level_db in self.numbers)

    def texts(self) -> list[str]:
        """Return the shown texts: a dash for no level, dots while it is computed."""
        if self.computing:
            return ["…"] * len(self.numbers)
        return [
            "–"
            if not np.isfinite(level_db) or level_db <= FLOOR_DB
            else f"{level_db:z.1f}".replace("-", "−")
            for level_db in self.numbers
        ]


def columns_of(snapshots: Sequence[Compared], *, matched: bool) -> list[Column]:
    """Return columns of snapshots, if any is stored; ``matched``: they have matching levels."""
    if len(snapshots) < 2:
        return []
    columns = [_column(*_stored(snapshot), snapshot) for snapshot in snapshots]
    if not matched:
        return columns
    gains = [
        f", {LEVELS_MATCHED} ({minus(f'{gain_db(snapshot):+z.1f}')} dB)" for snapshot in snapshots
    ]
    return [
        replace(column, hint=f"{column.hint}{gain}") if column.has_levels else column
        for column, gain in zip(columns, gains, strict=True)
    ]


def columns_of_people(people: Sequence[Compared]) -> list[Column]:
    """Return columns of people, their mean, and their standard deviation."""
    columns = [_column(*_names(person), person) for person in people]
    known = [column.numbers for column in columns if np.isfinite(column.numbers).all()]
    # A mean of the limbs that are computed first would change while others are computed.
    computing = any(person.values is None and not person.problem for person in people)
    if len(known) > 1 and not computing:
        by_region = np.array(known).T
        means, spreads = by_region.mean(axis=1), by_region.std(axis=1, ddof=1)
        # Silence is not a level, so that there is no spread around it.
        audible = [bool(np.all(levels > FLOOR_DB)) for levels in by_region]
        over_people = f"over {len(known)} people, dB"
        columns.append(
            Column(
                title="Mean",
                hint=f"Mean {over_people} re 1 m/s²",
                numbers=tuple(means.tolist()),
                full_title=f"Mean over {len(known)} people",
            )
        )
        columns.append(
            Column(
                title="± dB",
                head="±\ndB",
                hint=f"Standard deviation {over_people}",
                full_title=f"Standard deviation {over_people}",
                numbers=tuple(
                    spread if is_audible else float("nan")
                    for spread, is_audible in zip(spreads.tolist(), audible, strict=True)
                ),
            )
        )
    return columns


def _limb(compared: Compared) -> str:
    return compared.snapshot.design.limb


def _names(compared: Compared) -> tuple[str, str]:
    """Return title and head of a limb; a computed limb is called synthetic."""
    number = _limb(compared).rpartition("-")[2]
    if _is_synthetic(compared):
        return f"Synthetic {number}", f"Syn.\n{number}"
    return f"Limb {number}", f"Limb\n{number}"


def _stored(compared: Compared) -> tuple[str, str]:
    """Return title and head of a snapshot."""
    return (
        (f"{compared.name}, synthetic", f"{compared.name}\nsyn.")
        if _is_synthetic(compared)
        else (compared.name, "")
    )


def _is_synthetic(compared: Compared) -> bool:
    return _limb(compared).startswith("synthetic-")


def _column(title: str, head: str, compared: Compared) -> Column:
    kind = "synthetic" if _is_synthetic(compared) else "measured"
    full_title = title if kind in title.lower() else f"{title}, {kind}"
    if _limb(compared) not in PUBLISHED:
        full_title = title
    column = partial(
        Column, title=title, head=head, synthetic=_is_synthetic(compared), full_title=full_title
    )
    nothing = (float("nan"),) * len(REGION_OUTPUTS)
    if compared.values is None:
        computing = not compared.problem
        return column(hint=compared.problem or COMPUTING, numbers=nothing, computing=computing)
    if _limb(compared) not in PUBLISHED:
        return column(hint=NO_REGIONS, numbers=nothing)
    rms = 10.0 ** (compared.values["output_levels_db"] / 20.0)
    levels = region_levels_db(rms * compared.gain)
    limb = label_of(LIMBS, _limb(compared)).title
    return column(hint=f"{title}: dB re 1 m/s², {limb}", numbers=tuple(levels.values()))


def table_text(columns: Sequence[Column]) -> str:
    """Return the table for a spreadsheet; a cell is empty where the panel shows a dash."""
    titles = (column.full_title or column.title for column in columns)
    lines = (
        (region, *(copied_level(column.numbers[row]) for column in columns))
        for row, region in enumerate(REGION_OUTPUTS)
    )
    return tab_separated((("region_db_re_1_m_per_s2", *titles), *lines))


#: Relative size of the text, with which six columns fit beside the names of regions.
_TEXT = 0.9
#: Shorter names for narrow panels.
_SHORT = {"Back of the hand": "Back", "Wrist, palm side": "W. palm"}


class RegionTable(QtWidgets.QTableWidget):
    """A table with a row for each region, whose names stay visible while columns are scrolled."""

    def __init__(self) -> None:
        super().__init__(len(REGION_OUTPUTS), 0)
        named(self, "regions_table", "RMS levels by region")
        set_table_look(self)
        self.verticalHeader().show()
        self.fit_font(self.font())

    def show_columns(self, columns: Sequence[Column]) -> None:
        """Show these columns in their order."""
        self.setColumnCount(len(columns))
        for k, column in enumerate(columns):
            head = QtWidgets.QTableWidgetItem(column.head or column.title)
            head.setToolTip(column.hint)
            self.setHorizontalHeaderItem(k, head)
            for row, text in enumerate(column.texts()):
                self.setItem(row, k, table_cell(text, column.hint, right=True))
        self._name_rows()

    def fit_font(self, base: QtGui.QFont) -> None:
        """Take over the font of the surroundings."""
        font = scaled(tabular(base), _TEXT)
        for part in (self, self.horizontalHeader(), self.verticalHeader()):
            part.setFont(font)
        self._name_rows()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._name_rows()

    def _name_rows(self) -> None:
        """Show the names of regions, shorter ones where the numbers need the room."""
        names_px = max(map(self.fontMetrics().horizontalAdvance, REGION_OUTPUTS)) + 2 * UNIT_PX
        wide = names_px + self.horizontalHeader().length() <= self.width()
        for row, name in enumerate(REGION_OUTPUTS):
            item = QtWidgets.QTableWidgetItem(name if wide else _SHORT.get(name, name))
            item.setToolTip(name)
            # When it is shown, the header takes over the font of its surroundings.
            item.setFont(self.font())
            self.setVerticalHeaderItem(row, item)


_NEEDS = frozenset({"output_levels_db"})


class RegionsView(AnalysisView):
    """A row for each region, a column for each design or person, mean and spread."""

    name: ClassVar[str] = "regions"
    needs_of_snapshots = _NEEDS
    compares: ClassVar[bool] = True

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(240, 120)
        self._limbs: tuple[str, ...] = ()
        self._matched = False
        self._snapshots: Sequence[Compared] = ()
        self._on_limbs: Sequence[Compared] = ()
        self.columns: list[Column] = []
        self._about = self._shifted = ""
        self.about = NoteLabel("regions_about")
        self.table = RegionTable()
        bar = in_row((self.about, 1), margins=(UNIT_PX, 1, UNIT_PX // 2, 1))
        in_column(bar, (self.table, 1), of=self, margins=0, gap_px=0)
        self.setFocusProxy(self.table)
        self.computed = (self.table,)

    @property
    def needs_on_limbs(self) -> Mapping[str, frozenset[str]]:
        return dict.fromkeys(self._limbs, _NEEDS)

    def sizeHint(self) -> QSize:
        return QSize(460, 300)

    def show_state(self, design: Design, view: View) -> None:
        self._matched = view.levels_matched
        # For other limbs it is unknown which outputs lie in which region.
        self._limbs = related_limbs(design.limb) if design.limb in PUBLISHED else ()
        if self._on_limbs and not self._limbs:
            self.show_on_limbs(())
        if not self._limbs:
            missing = missing_limb(design.limb, design.limb_digest).rstrip(".")
            self._about = missing or NO_REGIONS
            self._show_about()
            return
        signal = signal_label(view.axes, view.method)
        people = display_gain_text(design, view)
        parts = f"RMS in dB re 1 m/s², {signal}", span_label(view.span), "no sensor on the palm"
        self._about = " · ".join([*parts, *([f"people: {people}"] if people else [])])
        self._show_about()

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        self._snapshots = compared
        self._show_columns()

    def show_on_limbs(self, compared: Sequence[Compared]) -> None:
        self._on_limbs = compared
        self.show_stale(any(person.is_stale for person in compared))
        self._show_columns()

    @property
    def words(self) -> str:
        return self.about.whole

    def table_text(self) -> str:
        return table_text(self.columns)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.table.fit_font(self.font())

    def _show_columns(self) -> None:
        matched = have_matching_level(self._snapshots, matched=self._matched)
        stored = columns_of(self._snapshots, matched=matched)
        has_gain = matched and any(column.has_levels for column in stored)
        self._shifted = (matched_text(self._snapshots) or LEVELS_MATCHED) if has_gain else ""
        people = columns_of_people(self._on_limbs)
        self.columns = [*stored, *people]
        computing = any(column.computing for column in self.columns)
        self.offer_copy(not computing and any(column.has_levels for column in self.columns))
        self.table.show_columns(self.columns)
        self._show_about()

    def _show_about(self) -> None:
        some = any(column.synthetic for column in self.columns)
        note = " · syn.: a synthetic limb, computed" if some else ""
        # Only the columns of snapshots have a display gain.
        shifted = f" · snapshots: {self._shifted}" if self._shifted else ""
        self.about.say(f"{self._about}{shifted}{note}")
