"""The inputs of the design, one row each."""

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QStackedLayout, QVBoxLayout, QWidget

from skinsource import edits
from skinsource.design import Design, amplitude_unit, audible_inputs
from skinsource.view import View
from skinsource_gui.panel import Panel
from skinsource_gui.panels.inputs.input_list import InputList
from skinsource_gui.panels.inputs.input_row import RowState
from skinsource_gui.theme import UNIT_PX, Theme
from skinsource_gui.widgets.inputs.field_changes import FieldChanges
from skinsource_gui.widgets.lateness import Lateness


class InputsPanel(Panel):
    """Lists the inputs; selects, mutes, duplicates and removes them, and sets their amplitude."""

    title = "Inputs"
    name = "inputs"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        self._list = InputList()
        self._rows = self._list.rows
        self._empty = QLabel("Click a place on the hand to add an input")
        self._empty.setObjectName("inputs_empty")
        self._empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._empty.setWordWrap(True)
        self._foot = QLabel()
        self._foot.setObjectName("inputs_problem")
        self._foot.setWordWrap(True)
        self._foot.setMargin(UNIT_PX)
        self._foot.hide()
        self._stack = QStackedLayout()
        self._stack.addWidget(self._empty)
        self._stack.addWidget(self._list)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addLayout(self._stack, 1)
        layout.addWidget(self._foot)
        self.setMinimumSize(300, 100)
        self.setFocusProxy(self._rows)
        self._lateness = Lateness(self)
        self._lateness.changed.connect(self._set_pale)
        self._changes = FieldChanges()
        # Where a selection of all rows on the way began.
        self._anchor: int | None = None
        self._connect()

    @property
    def needs(self) -> frozenset[str]:
        """What each input plays."""
        return frozenset({"input_waveforms"})

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        audible = {id(one) for one in audible_inputs(design.inputs)}
        unit = amplitude_unit(design.scaling)
        self._rows.show_rows(
            [
                RowState(
                    shown=one,
                    silent=id(one) not in audible,
                    selected=one.id in view.selected_inputs,
                    last=one.id == view.selected_input,
                    list_focused=False,
                    unit=unit,
                )
                for one in design.inputs
            ]
        )
        self._stack.setCurrentWidget(self._list if design.inputs else self._empty)
        self._list.reveal_selected()

    def show_results(self, results: Mapping[str, Any]) -> None:
        waveforms = results["input_waveforms"]
        self._show_foot("")
        self.show_stale(False)
        # Results of an older design may have another number of inputs; the next ones come soon.
        if len(waveforms) == len(self._rows.rows):
            for row, samples in zip(self._rows.rows, waveforms, strict=True):
                row.show_samples(samples)

    def show_stale(self, stale: bool) -> None:
        self._lateness.set_stale(stale)

    def show_problem(self, reason: str) -> None:
        self._lateness.set_stale(False)
        for row in self._rows.rows:
            row.preview.show_words("")
        self._show_foot(reason)

    def show_theme(self, theme: Theme) -> None:
        self._rows.show_theme(theme)
        self._empty.setStyleSheet(f"color: {theme.dim};")
        self._foot.setStyleSheet(f"color: {theme.error};")

    def _connect(self) -> None:
        rows, keys, mouse = self._rows, self._rows.keys, self._rows.mouse
        rows.entered.connect(self._enter)
        rows.amplitude_edited.connect(self._change_amplitude)
        rows.mute_toggled.connect(self._toggle_mute)
        rows.solo_toggled.connect(self._toggle_solo)
        rows.removed.connect(self._remove)
        mouse.selected.connect(self._select)
        mouse.toggled.connect(self._toggle)
        mouse.reached.connect(self._select_through)
        mouse.dropped.connect(self._put)
        keys.moved.connect(self._go)
        keys.all_selected.connect(self._select_all)
        keys.shifted.connect(self._shift)
        keys.mute_toggled.connect(self._toggle_mute)
        keys.solo_toggled.connect(self._toggle_solo)
        keys.removed.connect(self._remove)
        keys.duplicated.connect(self._duplicate)

    def _enter(self, chosen: int) -> None:
        # One of several may be typed or dragged for all.
        if chosen not in self._view.selected_inputs:
            self._select(chosen)

    def _select(self, chosen: int) -> None:
        self._anchor = chosen
        self._tell(edits.select_inputs(self._design, self._view, (chosen,)))

    def _toggle(self, chosen: int) -> None:
        self._anchor = chosen
        self._tell(edits.toggle_selected(self._design, self._view, chosen))

    def _select_through(self, chosen: int) -> None:
        known = self._anchor in self._view.selected_inputs
        self._anchor = self._anchor if known else self._view.selected_input
        self._tell(edits.select_through(self._design, self._view, self._anchor, chosen))

    def _select_all(self) -> None:
        self._tell(edits.select_all_inputs(self._design, self._view))

    def _go(self, place: int, extending: bool) -> None:
        self._rows.setFocus(Qt.FocusReason.OtherFocusReason)
        chosen = self._design.ids[place]
        (self._select_through if extending else self._select)(chosen)

    def _shift(self, down: bool) -> None:
        ids = self._view.selected_inputs
        self._tell(edits.shift_inputs(self._design, self._view, ids, down))

    def _put(self, gap: int) -> None:
        ids = self._view.selected_inputs
        self._tell(edits.put_inputs_before(self._design, self._view, ids, gap))

    def _change_amplitude(self, one: int, value: float, gesture: int | None) -> None:
        design, view, ids = self._design, self._view, self._together(one)
        changed = self._changes.change(
            design, view, ids, "amplitude", value, lead=one, gesture=gesture
        )
        self.edited.emit(changed, gesture)

    def _toggle_mute(self, one: int | None = None) -> None:
        self._tell(edits.toggle_mute(self._design, self._view, self._together(one)))

    def _toggle_solo(self, one: int | None = None) -> None:
        self._tell(edits.toggle_solo(self._design, self._view, self._together(one)))

    def _remove(self, one: int | None = None) -> None:
        # The cross of a row removes that row alone.
        ids = self._view.selected_inputs if one is None else (one,)
        self._tell(edits.remove_inputs(self._design, self._view, ids))

    def _duplicate(self) -> None:
        ids = self._view.selected_inputs
        self._tell(edits.duplicate_inputs(self._design, self._view, ids))

    def _together(self, one: int | None) -> tuple[int, ...]:
        """Whom a control of the row of ``one`` is about: all selected, if it is one of them."""
        selected = self._view.selected_inputs
        return selected if one is None or one in selected else (one,)

    def _tell(self, outcome: edits.Edit | edits.Refusal) -> None:
        self.edited.emit(outcome, None)

    def _show_foot(self, words: str) -> None:
        self._foot.setText(words)
        self._foot.setVisible(bool(words))

    def _set_pale(self, pale: bool) -> None:
        for row in self._rows.rows:
            row.preview.set_pale(pale)
