"""The fields of an input."""

from dataclasses import replace
from functools import lru_cache

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QApplication

from skinsource.base.published import Band
from skinsource.design import edits
from skinsource.design.clips import GAIN, ONSET, Clip
from skinsource.design.design import AMPLITUDE, GAIN_CURVE, Input
from skinsource.design.edits.edit import clip_of, clips_of, kind_name, kind_spec
from skinsource.design.view import View
from skinsource.design.waveforms import Drawn, Recording, Waveform
from skinsource.limbs.limb import LimbFacts
from skinsource.limbs.locations import input_words
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.fields import ChoiceSpec, NumberSpec, specs_of
from skinsource_gui.panels.inspector.button_cell import file_cell, pen_cell
from skinsource_gui.widgets.fields.edited_cell import LabelledCell, WordsCell
from skinsource_gui.widgets.fields.field_cell import FieldCell
from skinsource_gui.widgets.fields.field_grid import FieldGrid
from skinsource_gui.widgets.inputs.input_words import fixed_length_text, played_length_text


def _places_of(limb: str) -> ChoiceSpec:
    return _places(limb, facts_of(limb))


@lru_cache(maxsize=8)
def _places(limb: str, facts: LimbFacts) -> ChoiceSpec:
    numbers = range(1, facts.n_inputs + 1)
    return ChoiceSpec(
        label="Place",
        options=tuple((str(k), f"{k} · {input_words(k, limb).name}") for k in numbers),
        hint="Where the actuator touches",
    )


class InputFields(QObject):
    """Fields of an input and a clip of it: kind, the waveform's own, amplitude, onset, place.

    The gain of a clip is shown where it has others beside it, the gain curve of a track where
    there is one.

    Attributes
    ----------
    grid
        Where they stand.
    kind, place
        Which tell by themselves what is chosen; all others by ``edited``.
    """

    #: Name of the field, its new value, number of the gesture or None.
    edited = Signal(str, object, object)
    #: The pen shall be taken.
    pen_wanted = Signal()
    #: A file shall be chosen for a recording.
    file_wanted = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        facts = facts_of("")
        self._played_at, self._places = (facts.sample_rate_hz, facts.band_hz), _places_of("")
        self._own: tuple[LabelledCell, ...] = ()
        self._built_for: type[Waveform] | None = None
        self._length: WordsCell | None = None
        self._several = False
        self._curve_of: int | None = None
        self._view = View()
        self.grid = FieldGrid()
        self.kind = FieldCell("kind", kind_spec())
        self.place = FieldCell("location", self._places)
        self._amplitude = FieldCell("amplitude", AMPLITUDE)
        self._onset = FieldCell("onset_s", ONSET)
        self._gain = FieldCell("gain", GAIN)
        self._curve = FieldCell("gain_curve", GAIN_CURVE)
        for cell in (self._amplitude, self._onset, self._gain, self._curve):
            cell.edited.connect(self.edited)
        self._peak = WordsCell("Peak", "")
        self._peak.words.setObjectName("peak")
        self._peak.words.setToolTip("Of all that the track plays, with its gain")
        self._lasts = WordsCell("Lasts", "")
        self._lasts.words.setObjectName("played_length")
        self._lasts.words.setToolTip("What is heard of the waveform, or how long it is drawn out")

    def show_input(
        self,
        one: Input,
        together: tuple[Input, ...],
        amplitude: NumberSpec,
        view: View,
        peak: str = "",
    ) -> None:
        """Show an input, and where those that are edited ``together`` differ.

        ``amplitude`` says what one means; ``view`` says which clips are selected; ``peak`` is said
        of an input whose amplitude is a plain factor.
        """
        self._view = view
        clip = clip_of(one, view)
        kind = None if clip is None else type(clip.waveform)
        several = len(one.clips) > 1
        # A curve that is typed away can be typed again, until another track is looked at.
        curved = one.id if one.gain_curve or self._curve_of == one.id else None
        lasts = "" if clip is None else played_length_text(clip)
        others = (several, curved) != (self._several, self._curve_of)
        before = self._said
        self._lasts.words.setText(lasts)
        self._peak.words.setText(peak)
        if kind is not self._built_for or others:
            self._several, self._curve_of = several, curved
            self._build_own(None if clip is None else clip.waveform)
        elif self._said != before:
            self.grid.show_cells(self._cells())
        if self._length is not None and clip is not None:
            self._length.words.setText(fixed_length_text(clip.waveform))
        self._amplitude.set_spec(amplitude)
        self._gain.set_spec(replace(GAIN, label="Clip gain") if peak else GAIN)
        pairs = [(other, each) for other in together for each in clips_of(other, view) or (None,)]
        for cell in self._fields():
            cell.set_value(_value(one, cell.name, clip))
            found = {_value(other, cell.name, each) for other, each in pairs} - {None}
            cell.show_differs(len(found) > 1)

    def show_limb(self, limb: str) -> None:
        """Take over which places there are, and in which band it was measured."""
        places = _places_of(limb)
        if places != self._places:
            self._places = places
            self.place.set_spec(places)
        self._take(self._played_at[0], facts_of(limb).band_hz)

    def show_rate(self, sample_rate_hz: float) -> None:
        """Take over the rate of the limb, which says what frequencies can be played."""
        self._take(sample_rate_hz, self._played_at[1])

    def _take(self, sample_rate_hz: float, band_hz: Band | None) -> None:
        if self._played_at == (sample_rate_hz, band_hz):
            return
        self._played_at = sample_rate_hz, band_hz
        specs = specs_of(self._built_for) if self._built_for else {}
        for cell in self._own:
            if isinstance(cell, FieldCell):
                cell.set_spec(specs[cell.name].at_rate(*self._played_at))

    def show_refused(self, one: Input, name: str, reason: str) -> None:
        """Show again what ``one`` has in this field, and why it stays so."""
        cell = next(cell for cell in self._fields() if cell.name == name)
        cell.set_value(_value(one, name, clip_of(one, self._view)))
        cell.show_reason(reason)

    def forget_typing(self) -> None:
        """Close an open editor without committing."""
        for cell in self._fields():
            cell.forget_typing()

    @property
    def _said(self) -> tuple[bool, bool]:
        """Whether it is said how long a clip lasts, and which peak results."""
        return bool(self._lasts.words.text()), bool(self._peak.words.text())

    def _cells(self) -> tuple[LabelledCell, ...]:
        of_clip = () if self._built_for is None else (self._onset,)
        gain = (self._gain,) if self._several else ()
        lasts, peak = (
            (cell,) if said else ()
            for cell, said in zip((self._lasts, self._peak), self._said, strict=True)
        )
        own = (self.kind, *self._own, *lasts)
        curve = () if self._curve_of is None else (self._curve,)
        return (*own, self._amplitude, *peak, *gain, *of_clip, self.place, *curve)

    def _fields(self) -> list[FieldCell]:
        return [cell for cell in self._cells() if isinstance(cell, FieldCell)]

    def _build_own(self, waveform: Waveform | None) -> None:
        old = self._own
        cells: list[LabelledCell] = []
        self._length = None
        for name, spec in (specs_of(waveform) if waveform else {}).items():
            own = FieldCell(name, spec.at_rate(*self._played_at))
            own.edited.connect(self.edited)
            cells.append(own)
        if waveform and fixed_length_text(waveform):
            self._length = WordsCell("Duration", fixed_length_text(waveform))
            cells.append(self._length)
        if isinstance(waveform, Drawn):
            pen = pen_cell()
            pen.wanted.connect(self.pen_wanted)
            cells.append(pen)
        if isinstance(waveform, Recording):
            file = file_cell()
            file.wanted.connect(self.file_wanted)
            cells.append(file)
        self._own = tuple(cells)
        self._built_for = type(waveform) if waveform else None
        focused = QApplication.focusWidget()
        if focused is not None and any(cell.isAncestorOf(focused) for cell in old):
            self.kind.field.setFocus(Qt.FocusReason.OtherFocusReason)
        self.grid.show_cells(self._cells())
        for part in (widget for cell in old for widget in (cell.label, cell)):
            part.deleteLater()


def _value(one: Input, name: str, clip: Clip | None) -> object:
    """What the cell of this name shows of an input and its clip; None where there is no such."""
    if name == "kind":
        return "" if clip is None else kind_name(clip.waveform)
    if name == "location":
        return str(one.location)
    return edits.value_of(one, name, clip) if name in edits.fields_of(one, clip) else None
