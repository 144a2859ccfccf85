"""The inputs of the design, one row each."""

from collections.abc import Mapping
from dataclasses import replace
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
        self.setMinimumSize(300, 150)
        self.setFocusProxy(self._rows)
        self._lateness = Lateness(self)
        self._lateness.changed.connect(self._set_pale)
        self._rows.selected.connect(self._select)
        self._rows.amplitude_edited.connect(self._change_amplitude)
        self._rows.mute_toggled.connect(self._toggle_mute)
        self._rows.solo_toggled.connect(self._toggle_solo)
        self._rows.removed.connect(self._remove)
        self._rows.duplicated.connect(self._duplicate)

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
                    index=index,
                    shown=one,
                    silent=id(one) not in audible,
                    selected=one.id == view.selected_input,
                    list_focused=False,
                    unit=unit,
                )
                for index, one in enumerate(design.inputs)
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

    def _select(self, index: int) -> None:
        chosen = (self._id(index),)
        if chosen != self._view.selected_inputs:
            self.view_changed.emit(replace(self._view, selected_inputs=chosen))

    def _change_amplitude(self, index: int, value: float, gesture: int | None) -> None:
        ids = (self._id(index),)
        changed = edits.change_field(self._design, self._view, ids, "amplitude", value)
        self.edited.emit(changed, gesture)

    def _toggle_mute(self, index: int) -> None:
        self._tell(edits.toggle_mute(self._design, self._view, (self._id(index),)))

    def _toggle_solo(self, index: int) -> None:
        self._tell(edits.toggle_solo(self._design, self._view, (self._id(index),)))

    def _remove(self, index: int) -> None:
        self._tell(edits.remove_inputs(self._design, self._view, (self._id(index),)))

    def _duplicate(self, index: int) -> None:
        self._tell(edits.duplicate_inputs(self._design, self._view, (self._id(index),)))

    def _id(self, index: int) -> int:
        return self._design.inputs[index].id

    def _tell(self, outcome: edits.Edit | edits.Refusal) -> None:
        self.edited.emit(outcome, None)

    def _show_foot(self, words: str) -> None:
        self._foot.setText(words)
        self._foot.setVisible(bool(words))

    def _set_pale(self, pale: bool) -> None:
        for row in self._rows.rows:
            row.preview.set_pale(pale)
