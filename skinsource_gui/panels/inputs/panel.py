"""The inputs of the design, one row each."""

from collections.abc import Mapping
from functools import partial
from typing import Any

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QLabel, QMenu, QStackedLayout, QVBoxLayout, QWidget

from skinsource.design import Design, amplitude_unit, audible_inputs
from skinsource.edits.selection import clip_of
from skinsource.view import View
from skinsource_gui.panel import Panel
from skinsource_gui.panels.inputs.input_list import InputList
from skinsource_gui.panels.inputs.list_edits import ListEdits
from skinsource_gui.panels.inputs.list_selection import ListSelection
from skinsource_gui.panels.inputs.row_state import RowState
from skinsource_gui.theme import UNIT_PX, Theme
from skinsource_gui.widgets.drop_place import DropPlace
from skinsource_gui.widgets.inputs.inputs_menu import ENTRIES, ORDER, fill_inputs_menu
from skinsource_gui.widgets.lateness import Lateness


class InputsPanel(Panel):
    """Lists the inputs; selects, mutes, duplicates and removes them, and sets their amplitude."""

    title = "Inputs"
    name = "inputs"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._edits, self._selection = ListEdits(self), ListSelection(self)
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
        self._connect()

    @property
    def needs(self) -> frozenset[str]:
        """What each input plays."""
        return frozenset({"input_waveforms"})

    def show_state(self, design: Design, view: View) -> None:
        for part in (self._edits, self._selection):
            part.show_state(design, view)
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
                    clip=clip_of(one, view),
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

    def drop_place(self, at: QPoint) -> DropPlace | None:
        under = [row for row in self._rows.rows if row.rect().contains(row.mapFrom(self, at))]
        return DropPlace(input_id=under[0].id) if under and self._list.isVisible() else None

    def _connect(self) -> None:
        rows, keys, mouse = self._rows.signals, self._rows.keys, self._rows.mouse
        selection, changes = self._selection, self._edits
        selection.edited.connect(self.edited)
        changes.edited.connect(self.edited)
        rows.entered.connect(selection.enter)
        rows.amplitude_edited.connect(changes.change_amplitude)
        rows.mute_toggled.connect(changes.toggle_mute)
        rows.solo_toggled.connect(changes.toggle_solo)
        rows.removed.connect(changes.remove)
        mouse.selected.connect(selection.select)
        mouse.toggled.connect(selection.toggle)
        mouse.reached.connect(selection.select_through)
        mouse.dropped.connect(changes.put)
        mouse.menu_wanted.connect(self._open_menu)
        keys.moved.connect(selection.go)
        keys.all_selected.connect(selection.select_all)
        keys.shifted.connect(changes.shift)
        keys.mute_toggled.connect(changes.toggle_mute)
        keys.solo_toggled.connect(changes.toggle_solo)
        keys.removed.connect(changes.remove)
        keys.duplicated.connect(changes.duplicate)

    def _open_menu(self, one: int, at: QPoint) -> None:
        self._selection.enter(one)
        menu = QMenu(self)
        menu.setObjectName("inputs_menu")
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        ids = self._edits.together(one)
        chosen = [row.state.shown for row in self._rows.rows if row.id in ids]
        act = partial(self._edits.edit, ids)
        fill_inputs_menu(menu, chosen, act, place="inputs", entries=ENTRIES + ORDER)
        menu.popup(at)

    def _show_foot(self, words: str) -> None:
        self._foot.setText(words)
        self._foot.setVisible(bool(words))

    def _set_pale(self, pale: bool) -> None:
        for row in self._rows.rows:
            row.preview.set_pale(pale)
