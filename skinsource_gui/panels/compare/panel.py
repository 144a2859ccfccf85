"""The panel of snapshots as cards, and of how two of them differ."""

from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np
from PySide6.QtCore import QSize
from PySide6.QtWidgets import (
    QBoxLayout,
    QLabel,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from skinsource.design import edits
from skinsource.design.comparing import (
    EDITED,
    NUMBERS,
    difference_db,
    other_snapshot,
    same_outputs,
    shown_snapshot,
    why_no_comparison,
)
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource_gui.panels.compare.card import (
    LEAST_DB,
    Card,
    Difference,
    DifferenceMap,
    difference_captions,
    equal_captions,
    matching_text,
    played_db,
)
from skinsource_gui.plots.small_map import (
    ColourScale,
    SmallMap,
    SmallMaps,
    level_style,
    scale_of_levels,
)
from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.fitting import ButtonRow, FoldingRow, LayoutWatcher
from skinsource_gui.qt.theme import UNIT_PX, set_tone
from skinsource_gui.state.compared import (
    ELSEWHERE,
    SILENCE,
    Compared,
    gain_db,
    have_matching_level,
    is_silent,
)
from skinsource_gui.state.panel import COMPUTING, Panel

_NEEDS = frozenset({"limb_map", "limb_data", "output_levels_db", "surface", "surface_levels_db"})
# From this width on the map is beside the cards, in px and in lines of text.
_WIDE_PX, _WIDE_LINES = 620, 36


class ComparePanel(Panel):
    """A card for each snapshot, and the difference between the last two that were shown."""

    title: ClassVar[str] = "Compare"
    name: ClassVar[str] = "compare"
    compares: ClassVar[bool] = True

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        self._maps = SmallMaps()
        self.match = tool_button(
            self,
            "match_levels_button",
            "Match levels",
            "Show snapshots as loud as each other at their loudest output",
            checkable=True,
        )
        self.match.clicked.connect(self._match)
        self.toggle = tool_button(
            self,
            "toggle_snapshots_button",
            "Compare (X)",
            "Show the other one of the last two that were shown",
        )
        self.toggle.clicked.connect(self._toggle)
        self.file = tool_button(
            self,
            "take_snapshot_button",
            "File…",
            "Keep the design of a file as a snapshot, to compare this one with it",
        )
        self.file.clicked.connect(lambda: self.action_requested.emit("take_snapshot"))
        self.text_label = QLabel()
        self.text_label.setObjectName("matching_words")
        set_tone(self.text_label, "dim")
        # Wrapped, it would make the panel higher; where it is cut off, its tooltip is whole.
        self.text_label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.cards = [Card(number, self) for number in (EDITED, *NUMBERS)]
        self._row = FoldingRow(self.cards, UNIT_PX // 4, left=True, parent=self)
        self.map = DifferenceMap(self)
        self._lay_out()
        LayoutWatcher(self).changed.connect(self._fold)
        for card in self.cards:
            card.requested.connect(self._act)
        self.setFocusProxy(self.cards[1])
        self.guessed = self._row, self.text_label, self.map
        self.show_snapshots(())

    @property
    def needs(self) -> frozenset[str]:
        return _NEEDS

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        return _NEEDS

    def sizeHint(self) -> QSize:
        return QSize(420, 480)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self.match.setChecked(view.levels_matched)
        self.toggle.setEnabled(other_snapshot(view.snapshots, design) is not None)

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        matched = self._view.levels_matched
        self.text_label.setText(matching_text(compared, matched=matched))
        self.text_label.setToolTip(self.text_label.text())
        present = self._present(compared)
        levels = [played_db(side) for side in compared]
        loudest = max((level for level in levels if level is not None), default=0.0)
        for card in self.cards:
            side = next((side for side in compared if side.snapshot.number == card.number), None)
            card.setVisible(card.number != EDITED or side is not None)
            small, scale = self._map_of(side, loudest)
            card.show_snapshot(side, small, scale, present=side is not None and side is present)
        self._row.fold()
        self.map.show_difference(self._difference(compared, present))

    def show_problem(self, reason: str) -> None:
        self.map.show_difference(Difference(text=reason))

    def _fold(self) -> None:
        needed = max(_WIDE_PX, _WIDE_LINES * self.fontMetrics().height())
        side_by_side = self.width() >= needed
        direction = (
            QBoxLayout.Direction.LeftToRight if side_by_side else QBoxLayout.Direction.TopToBottom
        )
        self._halves.setDirection(direction)

    def _lay_out(self) -> None:
        upper = QVBoxLayout()
        upper.setSpacing(UNIT_PX // 2)
        upper.addWidget(ButtonRow((self.match, self.toggle, self.file), self))
        upper.addWidget(self._row, 1)
        upper.addWidget(self.text_label)
        upper.addStretch(0)
        # The map is beside the cards where the panel is wide enough, else below them.
        self._halves = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        self._halves.setContentsMargins(UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX // 2)
        self._halves.setSpacing(UNIT_PX // 2)
        self._halves.addLayout(upper)
        self._halves.addWidget(self.map, 1)

    def _present(self, compared: Sequence[Compared]) -> Compared | None:
        """Return the snapshot that is in the window."""
        if self._design is None:
            return None
        snapshot = shown_snapshot(self._view.snapshots, self._design)
        number = EDITED if snapshot is None else snapshot.number
        return next((side for side in compared if side.snapshot.number == number), None)

    def _map_of(
        self, side: Compared | None, loudest_db: float
    ) -> tuple[SmallMap | None, ColourScale | None]:
        """Return the map of a card, in colours that mean the same on all cards."""
        if side is None or side.values is None:
            return None, None
        scale, gain = scale_of_levels(np.array(loudest_db), level_style(self._view)), gain_db(side)
        low, high = scale.range_db
        return self._maps.map_of(side.values), replace(scale, range_db=(low - gain, high - gain))

    def _difference(self, compared: Sequence[Compared], present: Compared | None) -> Difference:
        snapshot = (
            None if self._design is None else other_snapshot(self._view.snapshots, self._design)
        )
        if snapshot is None or present is None:
            return Difference(text=why_no_comparison(self._view.snapshots))
        other = next((side for side in compared if side.snapshot.number == snapshot.number), None)
        if other is None or other.values is None or present.values is None:
            problem = "" if other is None else other.problem or present.problem or COMPUTING
            return Difference(text=problem)
        if not same_outputs(other.snapshot.design.limb, present.snapshot.design.limb):
            return Difference(text=ELSEWHERE)
        if is_silent(other) != is_silent(present):
            return Difference(text=SILENCE)
        minus = self._minus(present, other)
        matched = have_matching_level(compared, matched=self._view.levels_matched)
        heading, caption = difference_captions(present, other, matched=matched)
        if minus.levels_db is not None and np.abs(minus.levels_db).max() < LEAST_DB:
            heading, caption = equal_captions(present, other)
        if present.values["limb_data"].synthetic or other.values["limb_data"].synthetic:
            caption = f"{caption}, synthetic limb"
        limb, outputs = present.snapshot.design.limb, self._view.outputs
        return Difference(shown=minus, heading=heading, text=caption, limb=limb, outputs=outputs)

    def _minus(self, present: Compared, other: Compared) -> SmallMap:
        small = self._maps.map_of(present.values or {})
        loudest = [level for level in (played_db(present), played_db(other)) if level is not None]
        # Both are played: the first one's gain is taken off the other.
        gain, top = other.gain / present.gain, max(loudest) - gain_db(present)
        values, other_values = present.values or {}, other.values or {}
        levels = difference_db(
            values["output_levels_db"], other_values["output_levels_db"], gain=gain, loudest_db=top
        )
        if present.snapshot.design.limb == other.snapshot.design.limb:
            field = difference_db(
                values["surface_levels_db"],
                other_values["surface_levels_db"],
                gain=gain,
                loudest_db=top,
            )
        else:
            # Outputs correspond by their numbers; places between them do not.
            field = values["surface"].interpolate(levels)
        return replace(small, levels_db=levels, field_levels_db=field)

    def _act(self, number: int, what: str) -> None:
        if what == "store":
            self.action_requested.emit(f"store_snapshot_{number}")
        elif what == "show":
            self.snapshot_requested.emit(number)
        elif self._design is not None:
            self.edited.emit(edits.forget_snapshot(self._design, self._view, number), None)

    def _match(self) -> None:
        self.action_requested.emit("match_levels")

    def _toggle(self) -> None:
        self.action_requested.emit("toggle_snapshots")
