"""Everything about the selected inputs."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QApplication,
    QLabel,
    QScrollArea,
    QStackedLayout,
    QVBoxLayout,
    QWidget,
)

from skinsource import edits
from skinsource.design import AMPLITUDE, ONSET, Design, Input, amplitude_unit, audible_inputs
from skinsource.edits import Edit, Refusal
from skinsource.edits.kinds import kind_name, kind_spec
from skinsource.fields import ChoiceSpec, specs_of
from skinsource.locations import INPUTS
from skinsource.view import View
from skinsource.waveforms import Waveform
from skinsource_gui.panel import Panel
from skinsource_gui.panels.inspector.field_grid import FieldGrid
from skinsource_gui.panels.inspector.input_heading import InputHeading
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme
from skinsource_gui.widgets.fields.field_cell import FieldCell, LabelledCell, WordsCell
from skinsource_gui.widgets.inputs.gesture_start import GestureStart
from skinsource_gui.widgets.inputs.input_words import fixed_length_text
from skinsource_gui.widgets.inputs.waveform_preview import WaveformPreview
from skinsource_gui.widgets.lateness import Lateness

_PLACE = ChoiceSpec(
    label="Place",
    options=tuple((str(place.number), f"{place.number} · {place.name}") for place in INPUTS),
    hint="Where the actuator touches",
)


class InspectorPanel(Panel):
    """Edits the selected inputs: place, waveform, the waveform's own fields, amplitude, onset.

    Shown is the one that was selected last.  A typed value sets all; a drag moves all by as much.
    """

    title = "Inspector"
    name = "inspector"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        self._theme = LIGHT
        self._shown: tuple[int, ...] = ()
        self._results: Mapping[str, Any] | None = None
        self._gesture = GestureStart()
        self._own_cells: tuple[LabelledCell, ...] = ()
        self._built_for: type[Waveform] | None = None
        self._kind = FieldCell("kind", kind_spec())
        self._place = FieldCell("location", _PLACE)
        self._amplitude = FieldCell("amplitude", AMPLITUDE)
        self._onset = FieldCell("onset_s", ONSET)
        self._kind.edited.connect(self._change_kind)
        self._place.edited.connect(self._change_place)
        self._amplitude.edited.connect(self._change_field)
        self._onset.edited.connect(self._change_field)
        self._heading = InputHeading()
        self._heading.mute_toggled.connect(self._toggle_mute)
        self._heading.solo_toggled.connect(self._toggle_solo)
        self._preview = WaveformPreview(axis=True)
        self._preview.setMinimumHeight(64)
        self._preview.setMaximumHeight(160)
        self._grid = FieldGrid()
        self._lay_out()
        self._lateness = Lateness(self)
        self._lateness.changed.connect(self._preview.set_pale)

    @property
    def needs(self) -> frozenset[str]:
        """What each input plays, and its rate."""
        return frozenset({"input_waveforms", "sample_rate_hz"})

    @property
    def selected(self) -> Input | None:
        """The input that was selected last."""
        if self._design is None or self._view.selected_input not in self._design.ids:
            return None
        return self._design.input(self._view.selected_input)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        one = self.selected
        if one is None:
            self._forget_typing()
            self._shown = ()
            self._empty.setText(
                "Select an input, on the hand or in the list, to edit it"
                if design.inputs
                else "Click a place on the hand to add an input"
            )
            self._stack.setCurrentWidget(self._empty)
            return
        if self._shown != view.selected_inputs:
            # What was being typed, or dragged, was meant for others.
            self._forget_typing()
            self._shown = view.selected_inputs
            self._show_waveform()
        self._show_input(
            one, silent=all(one is not heard for heard in audible_inputs(design.inputs))
        )
        self._stack.setCurrentWidget(self._editor)

    def show_results(self, results: Mapping[str, Any]) -> None:
        self.show_stale(False)
        self._results = {name: results[name] for name in self.needs}
        self._show_waveform()

    def _show_waveform(self) -> None:
        waveforms = self._results["input_waveforms"] if self._results else ()
        # Results of an older design may have another number of inputs; the next ones come soon.
        if self.selected is not None and len(waveforms) == len(self._design.inputs):
            index = self._design.index_of(self.selected.id)
            self._preview.show_samples(waveforms[index], self._results["sample_rate_hz"])
        else:
            self._preview.show_words("")

    def show_stale(self, stale: bool) -> None:
        self._lateness.set_stale(stale)

    def show_problem(self, reason: str) -> None:
        self.show_stale(False)
        self._results = None
        self._preview.show_words(reason)

    def show_theme(self, theme: Theme) -> None:
        self._theme = theme
        self._empty.setStyleSheet(f"color: {theme.dim};")
        for part in (self._heading, self._preview, *self._cells()):
            part.show_theme(theme)
        if self.selected is not None:
            self._show_look(self.selected)

    def _lay_out(self) -> None:
        inside = QWidget()
        fields = QVBoxLayout(inside)
        fields.setContentsMargins(UNIT_PX, 0, UNIT_PX, UNIT_PX)
        fields.addWidget(self._grid)
        fields.addStretch(1)
        scroll = QScrollArea()
        scroll.setObjectName("inspector_fields")
        scroll.setWidgetResizable(True)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        scroll.setWidget(inside)
        self._editor = QWidget()
        column = QVBoxLayout(self._editor)
        column.setContentsMargins(0, UNIT_PX // 2, 0, 0)
        column.setSpacing(UNIT_PX // 2)
        top = QVBoxLayout()
        top.setContentsMargins(UNIT_PX, 0, UNIT_PX, 0)
        top.addWidget(self._heading)
        top.addWidget(self._preview)
        column.addLayout(top, 1)
        column.addWidget(scroll, 3)
        self._empty = QLabel()
        self._empty.setObjectName("inspector_empty")
        self._empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._empty.setWordWrap(True)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self._empty)
        self._stack.addWidget(self._editor)
        self.setMinimumSize(204, 224)
        self.setFocusProxy(self._kind)

    def _cells(self) -> tuple[LabelledCell, ...]:
        return (self._kind, *self._own_cells, self._amplitude, self._onset, self._place)

    def _show_input(self, one: Input, *, silent: bool) -> None:
        chosen = self._chosen()
        self._heading.show_input(one, silent=silent, together=chosen)
        if type(one.waveform) is not self._built_for:
            self._build_own_cells(one.waveform)
        self._kind.set_value(kind_name(one.waveform))
        self._place.set_value(str(one.location))
        unit = amplitude_unit(self._design.scaling)
        self._amplitude.set_spec(replace(AMPLITUDE, unit=unit))
        self._amplitude.set_value(one.amplitude)
        self._onset.set_value(one.onset_s)
        for cell in self._own_cells:
            if isinstance(cell, FieldCell):
                cell.set_value(getattr(one.waveform, cell.name))
        for cell in self._field_cells():
            cell.show_differs(len({_value(other, cell.name) for other in chosen} - {None}) > 1)
        self._show_look(one)

    def _show_look(self, one: Input) -> None:
        self._preview.set_look(self._theme.input_colour(one.colour), flipped=one.amplitude < 0)

    def _build_own_cells(self, waveform: Waveform) -> None:
        old, cells = self._own_cells, []
        for name, spec in specs_of(waveform).items():
            cell = FieldCell(name, spec)
            cell.edited.connect(self._change_field)
            cells.append(cell)
        if fixed_length_text(waveform):
            cells.append(WordsCell("Duration", fixed_length_text(waveform)))
        self._own_cells = tuple(cells)
        self._built_for = type(waveform)
        for cell in cells:
            cell.show_theme(self._theme)
        focused = QApplication.focusWidget()
        if focused is not None and any(cell.isAncestorOf(focused) for cell in old):
            self._kind.field.setFocus(Qt.FocusReason.OtherFocusReason)
        self._grid.show_cells(self._cells())
        for part in (widget for cell in old for widget in (cell.label, cell)):
            part.deleteLater()

    def _field_cells(self) -> list[FieldCell]:
        return [cell for cell in self._cells() if isinstance(cell, FieldCell)]

    def _forget_typing(self) -> None:
        for cell in self._field_cells():
            cell.forget_typing()

    def _change_kind(self, _: str, kind: str, gesture: int | None) -> None:
        self._tell(edits.change_kind(self._design, self._view, self._ids(), kind), gesture)

    def _change_place(self, _: str, number: str, gesture: int | None) -> None:
        moved = edits.move_inputs(self._design, self._view, self._ids(), int(number))
        self._tell(moved, gesture)

    def _change_field(self, name: str, value: object, gesture: int | None) -> None:
        if self.selected is None:
            return
        changed = self._changed(name, value, gesture)
        if isinstance(changed, Refusal):
            # Each number is allowed alone, but not together with the others.
            cell = next(cell for cell in self._field_cells() if cell.name == name)
            cell.set_value(_value(self.selected, name))
            cell.show_reason(changed.sentence)
            return
        self._tell(changed, gesture)

    def _changed(self, name: str, value: object, gesture: int | None) -> Edit | Refusal:
        design, view, ids = self._design, self._view, self._ids()
        if gesture is None or len(ids) == 1:
            return edits.change_field(design, view, ids, name, value)
        start = self._gesture.of(gesture, design)
        return edits.drag_field(design, view, ids, name, value, lead=ids[-1], start=start)

    def _toggle_mute(self) -> None:
        self._tell(edits.toggle_mute(self._design, self._view, self._ids()), None)

    def _toggle_solo(self) -> None:
        self._tell(edits.toggle_solo(self._design, self._view, self._ids()), None)

    def _ids(self) -> tuple[int, ...]:
        return self._view.selected_inputs

    def _chosen(self) -> tuple[Input, ...]:
        return tuple(one for one in self._design.inputs if one.id in self._ids())

    def _tell(self, outcome: Edit | Refusal, gesture: int | None) -> None:
        # A field that is held while its input goes has nothing more to say.
        if self.selected is not None and (
            isinstance(outcome, Refusal) or outcome.design != self._design
        ):
            self.edited.emit(outcome, gesture)


def _value(one: Input, name: str) -> object:
    """What the cell of this name shows of an input; None where it has no such field."""
    if name == "kind":
        return kind_name(one.waveform)
    if name == "location":
        return one.location
    return edits.value_of(one, name) if name in edits.fields_of(one) else None
