"""Frequency and amplitude of the selected input, large, for presenting."""

from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from skinsource.design import edits
from skinsource.design.amplitudes import is_gain, peak_text
from skinsource.design.clips import ONSET as ONSET_S
from skinsource.design.clips import Clip
from skinsource.design.design import AMPLITUDE, AMPLITUDE_GAIN, Design, Input, amplitude_spec
from skinsource.design.edits.edit import clip_of
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.specs.fields import Spec, specs_of
from skinsource.studies import scenes
from skinsource_gui.panel import Panel
from skinsource_gui.panels.frequency_and_amplitude.heading import Heading
from skinsource_gui.panels.frequency_and_amplitude.settings import ALL, CONTROL, ControlSettings
from skinsource_gui.panels.frequency_and_amplitude.settings import AMPLITUDE as TURNS_AMPLITUDE
from skinsource_gui.panels.frequency_and_amplitude.settings import FREQUENCY as TURNS_FREQUENCY
from skinsource_gui.panels.frequency_and_amplitude.settings import ONSET as TURNS_ONSET
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.empty_words import add_words, select_words
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.fields.field_cell import FieldCell
from skinsource_gui.widgets.folding_row import FoldingRow
from skinsource_gui.widgets.inputs.input_words import EMPTY, stretched_text

_FREQUENCY, _ONSET = "frequency_hz", "onset_s"


class _Labelled(QWidget):
    """A field with its label on the left, as one part of a row."""

    def __init__(self, cell: FieldCell | None = None) -> None:
        super().__init__()
        self._line = QHBoxLayout(self)
        self._line.setContentsMargins(0, 0, 0, 0)
        self._line.setSpacing(UNIT_PX)
        if cell is not None:
            self.hold(cell.label, cell)

    def hold(self, label: QLabel, field: QWidget) -> None:
        """Take a field up."""
        label.setBuddy(field)
        self._line.addWidget(label)
        self._line.addWidget(field, 1)


class FrequencyAndAmplitudePanel(Panel):
    """The two numbers that are turned while presenting, in front of an audience.

    They are the amplitude and, where the waveform has one, the frequency.
    """

    title = "Frequency and amplitude"
    name = "frequency_and_amplitude"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        self._words = Heading(add_words(self.in_sight))
        self._words.setObjectName("frequency_and_amplitude_words")
        set_tone(self._words, "dim")
        self._control = ChoiceField(CONTROL, self)
        self._control.setObjectName("control_field")
        self._control_label, self._control_part = QLabel(CONTROL.label), _Labelled()
        set_tone(self._control_label, "dim")
        self._control_part.hold(self._control_label, self._control)
        self._control.chosen.connect(self._choose_control)
        self._amplitude = FieldCell("amplitude", AMPLITUDE)
        self._onset = FieldCell(_ONSET, ONSET_S)
        self._frequency: FieldCell | None = None
        self._spec: Spec | None = None
        self._turned = _Labelled()
        self._amplitude_part = _Labelled(self._amplitude)
        self._onset_part = _Labelled(self._onset)
        parts = (self._turned, self._amplitude_part, self._onset_part, self._control_part)
        self._row = FoldingRow(parts, UNIT_PX)
        column = QVBoxLayout(self)
        column.setContentsMargins(UNIT_PX, 0, UNIT_PX, UNIT_PX)
        column.setSpacing(UNIT_PX // 2)
        column.addWidget(self._words)
        column.addWidget(self._row)
        column.addStretch(1)
        self._amplitude.edited.connect(self._change)
        self._onset.edited.connect(self._change)
        self.setFocusProxy(self._amplitude)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        control = settings_of(view, self.name, ControlSettings).control
        self._control.set_value(control)
        one = _turned_input(design, view)
        known = one is not None
        self._amplitude_part.setVisible(known and control in (ALL, TURNS_AMPLITUDE))
        self._onset_part.setVisible(False)
        if one is not None:
            self._show_input(design, view, one, control)
        else:
            words = select_words if design.inputs else add_words
            self._words.show_phrases(words(self.in_sight))
            self._show_frequency(None)
        self._row.fold()

    def _show_input(self, design: Design, view: View, one: Input, control: str) -> None:
        clip = clip_of(one, view)
        playing = EMPTY.capitalize()
        if clip is not None:
            playing = f"{clip.waveform.title}{stretched_text(clip)}"
        played = f"{playing} at place {one.location}"
        factor = is_gain(design, one)
        if factor:
            played += f" · peak {peak_text(design, one)}"
        title = scenes.title_of(design) if design.title else ""
        self._words.show_phrases(*((f"{title} · {played}", title) if title else ()), played)
        if clip is not None:
            self._onset.set_value(clip.onset_s)
            self._onset_part.setVisible(control == TURNS_ONSET)
        self._amplitude.set_spec(AMPLITUDE_GAIN if factor else amplitude_spec(design))
        self._amplitude.set_value(one.amplitude)
        self._show_frequency(clip if control in (ALL, TURNS_FREQUENCY) else None)

    def show_in_sight(self, names: frozenset[str]) -> None:
        super().show_in_sight(names)
        if self._design is not None:
            self.show_state(self._design, self._view)

    def _show_frequency(self, one: Clip | None) -> None:
        spec = None if one is None else specs_of(one.waveform).get(_FREQUENCY)
        if spec != self._spec:
            self._spec = spec
            self._drop_frequency()
            if spec is not None:
                self._frequency = FieldCell(_FREQUENCY, spec)
                self._frequency.edited.connect(self._change)
                self._turned.hold(self._frequency.label, self._frequency)
        self._turned.setVisible(self._frequency is not None)
        if self._frequency is not None and one is not None:
            self._frequency.set_value(getattr(one.waveform, _FREQUENCY))

    def _choose_control(self, control: str, _gesture: int | None) -> None:
        settings = ControlSettings(control=control)
        self.view_changed.emit(with_settings(self._view, self.name, settings))

    def _drop_frequency(self) -> None:
        if self._frequency is not None:
            for part in (self._frequency.label, self._frequency):
                part.hide()
                part.deleteLater()
            self._frequency = None

    def _change(self, name: str, value: float, gesture: int | None) -> None:
        if self._design is not None:
            one = _turned_input(self._design, self._view)
            ids = self._view.selected_inputs or (() if one is None else (one.id,))
            outcome = edits.change_field(self._design, self._view, ids, name, value)
            self.edited.emit(outcome, gesture)


def _turned_input(design: Design, view: View) -> Input | None:
    """The selected input; where there is only one, nobody has to select it."""
    if len(design.inputs) == 1:
        return design.inputs[0]
    return next((one for one in design.inputs if one.id == view.selected_input), None)
