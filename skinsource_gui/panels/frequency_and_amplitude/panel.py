"""The panel of frequency and amplitude of the selected track, large, for presenting."""

from PySide6 import QtWidgets
from PySide6.QtCore import QRect, Qt

from skinsource.design import edits
from skinsource.design.amplitudes import is_gain, peak_text
from skinsource.design.clips import ONSET as ONSET_S
from skinsource.design.clips import Clip
from skinsource.design.design import AMPLITUDE as DESIGN_AMPLITUDE
from skinsource.design.design import AMPLITUDE_GAIN, Design, Input, amplitude_spec
from skinsource.design.edits.edit import clip_of, leading_input
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.specs.models import specs_of
from skinsource.specs.spec import Spec
from skinsource.studies import scenes
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.inputs import EMPTY, stretched_text
from skinsource_gui.panels.frequency_and_amplitude.settings import (
    ALL,
    AMPLITUDE,
    CONTROL,
    FREQUENCY,
    ONSET,
    ControlSettings,
)
from skinsource_gui.qt.fitting import FoldingRow, LayoutWatcher
from skinsource_gui.qt.labels import HOW_TO_SELECT_INPUT, how_to_add
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.theme import UNIT_PX, set_tone
from skinsource_gui.state.panel import Panel

_TWO_LINES = "A\nA"
_ANY_HEIGHT_PX = 10_000
_WRAPPED = Qt.TextFlag.TextWordWrap


class Heading(QtWidgets.QLabel):
    """Shows the first of some phrases that fits into two lines; else the last, in more lines.

    It is always two lines high, so that the fields below keep their place from scene to scene, and
    stay in the window.
    """

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._phrases: tuple[str, ...] = (text,)
        self.setWordWrap(True)
        LayoutWatcher(self).changed.connect(self._fit)

    def show_phrases(self, *phrases: str) -> None:
        """Take over phrasings, the longest first."""
        self._phrases = phrases
        self._fit()

    def _fit(self) -> None:
        two_lines = self._height_of(_TWO_LINES)
        fitting = (phrase for phrase in self._phrases if self._height_of(phrase) <= two_lines)
        text = next(fitting, self._phrases[-1])
        self.setText(text)
        # The tooltip has what is left out.
        self.setToolTip("" if text == self._phrases[0] else self._phrases[0])
        self.setMinimumHeight(max(self._height_of(text), two_lines))

    def _height_of(self, text: str) -> int:
        room = QRect(0, 0, self.contentsRect().width(), _ANY_HEIGHT_PX)
        return self.fontMetrics().boundingRect(room, _WRAPPED, text).height()


_FREQUENCY, _ONSET = "frequency_hz", "onset_s"


class _LabelledField(QtWidgets.QWidget):
    """A field with its label on the left, as one part of a row."""

    def __init__(self, cell: FieldCell | None = None) -> None:
        super().__init__()
        self._line = in_row(of=self, margins=0, gap_px=UNIT_PX)
        if cell is not None:
            self.hold(cell.label, cell)

    def hold(self, label: QtWidgets.QLabel, field: QtWidgets.QWidget) -> None:
        """Add a field with its label."""
        label.setBuddy(field)
        self._line.addWidget(label)
        self._line.addWidget(field, 1)


class FrequencyAndAmplitudePanel(Panel):
    """The two numbers that are changed while presenting, large.

    These are the amplitude and, where the waveform has one, the frequency.
    """

    title = "Frequency and amplitude"
    name = "frequency_and_amplitude"

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        self._heading = Heading(how_to_add())
        self._heading.setObjectName("frequency_and_amplitude_words")
        set_tone(self._heading, "dim")
        self._control = ChoiceField(CONTROL, self)
        self._control.setObjectName("control_field")
        self._control_label, self._control_part = QtWidgets.QLabel(CONTROL.label), _LabelledField()
        set_tone(self._control_label, "dim")
        self._control_part.hold(self._control_label, self._control)
        self._control.edited.connect(self._choose_control)
        self._amplitude = FieldCell("amplitude", DESIGN_AMPLITUDE, edited=self._change)
        self._onset = FieldCell(_ONSET, ONSET_S, edited=self._change)
        self._frequency: FieldCell | None = None
        self._spec: Spec | None = None
        self._frequency_part = _LabelledField()
        self._amplitude_part = _LabelledField(self._amplitude)
        self._onset_part = _LabelledField(self._onset)
        parts = (self._frequency_part, self._amplitude_part, self._onset_part, self._control_part)
        self._row = FoldingRow(parts, UNIT_PX)
        margins = (UNIT_PX, 0, UNIT_PX, UNIT_PX)
        in_column(self._heading, self._row, None, of=self, margins=margins, gap_px=UNIT_PX // 2)
        self.setFocusProxy(self._amplitude)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        control = settings_of(view, self.name, ControlSettings).control
        self._control.set_value(control)
        track = _controlled_input(design, view)
        known = track is not None
        self._amplitude_part.setVisible(known and control in (ALL, AMPLITUDE))
        self._onset_part.setVisible(False)
        if track is not None:
            self._show_input(design, view, track, control)
        else:
            self._heading.show_phrases(HOW_TO_SELECT_INPUT if design.inputs else how_to_add())
            self._show_frequency(None)
        self._row.fold()

    def _show_input(self, design: Design, view: View, track: Input, control: str) -> None:
        clip = clip_of(track, view)
        playing = EMPTY.capitalize()
        if clip is not None:
            playing = f"{clip.waveform.title}{stretched_text(clip)}"
        played = f"{playing} at place {track.location}"
        factor = is_gain(design, track)
        if factor:
            played += f" · peak {peak_text(design, track)}"
        title = scenes.title_of(design) if design.title else ""
        self._heading.show_phrases(*((f"{title} · {played}", title) if title else ()), played)
        if clip is not None:
            self._onset.set_value(clip.onset_s)
            self._onset_part.setVisible(control == ONSET)
        self._amplitude.set_spec(AMPLITUDE_GAIN if factor else amplitude_spec(design))
        self._amplitude.set_value(track.amplitude)
        self._show_frequency(clip if control in (ALL, FREQUENCY) else None)

    def _show_frequency(self, clip: Clip | None) -> None:
        spec = None if clip is None else specs_of(clip.waveform).get(_FREQUENCY)
        if spec != self._spec:
            self._spec = spec
            if self._frequency is not None:
                for part in (self._frequency.label, self._frequency):
                    part.hide()
                    part.deleteLater()
                self._frequency = None
            if spec is not None:
                self._frequency = FieldCell(_FREQUENCY, spec, edited=self._change)
                self._frequency_part.hold(self._frequency.label, self._frequency)
        self._frequency_part.setVisible(self._frequency is not None)
        if self._frequency is not None and clip is not None:
            self._frequency.set_value(getattr(clip.waveform, _FREQUENCY))

    def _choose_control(self, control: str, _gesture: int | None) -> None:
        settings = ControlSettings(control=control)
        self.view_changed.emit(with_settings(self._view, self.name, settings))

    def _change(self, name: str, value: float, gesture: int | None) -> None:
        if self._design is not None:
            track = _controlled_input(self._design, self._view)
            ids = self._view.selected_inputs or (() if track is None else (track.id,))
            outcome = edits.change_field(self._design, self._view, ids, name, value)
            self.edited.emit(outcome, gesture)


def _controlled_input(design: Design, view: View) -> Input | None:
    """Return the selected track, or the only one, which nobody has to select."""
    return design.inputs[0] if len(design.inputs) == 1 else leading_input(design, view)
