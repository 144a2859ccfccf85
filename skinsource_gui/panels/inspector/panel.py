"""The clip panel: fields of the selected inputs and clips, and their effects."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QSize, Qt, Signal, SignalInstance

from skinsource.base.conventions import Band, Floats
from skinsource.design import edits
from skinsource.design.amplitudes import (
    amplitude_in_short,
    amplitude_meaning,
    amplitude_spec,
    is_gain,
    peak_before_amplitude,
    peak_text,
    says_peak,
)
from skinsource.design.clips import GAIN, ONSET, Clip
from skinsource.design.describing import DURATION_FIELD
from skinsource.design.design import (
    AMPLITUDE,
    AMPLITUDE_GAIN,
    GAIN_CURVE,
    TITLE,
    Design,
    Input,
    View,
    audible_inputs,
)
from skinsource.design.design_file import SENTENCE
from skinsource.design.edits.edit import (
    Edit,
    Refusal,
    clip_of,
    clips_of,
    kind_name,
    kind_spec,
    leading_input,
)
from skinsource.design.edits.effects import values_of
from skinsource.design.edits.view import change_texts
from skinsource.design.labels import SCALINGS, scalings_on
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.samples import Drawn, Recording
from skinsource.limbs.limb import LimbFacts
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import drive_unit_known, facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.editor import MIXED
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import (
    LABEL_PX,
    FieldGrid,
    LabelledCell,
    TextCell,
    discard,
    forget_typing,
)
from skinsource_gui.fields.inputs import (
    FieldChanges,
    fixed_length_text,
    peak_of,
    played_hz_text,
    played_length_text,
    played_of,
)
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.inspector.effects import EffectChain
from skinsource_gui.qt.buttons import (
    Fold,
    Swatch,
    menu_of,
    mute_button,
    page_label,
    scrolled,
    solo_button,
)
from skinsource_gui.qt.labels import HOW_TO_SELECT_INPUT, FittingLabel, how_to_add
from skinsource_gui.qt.layouts import in_column, in_row, named, show_tooltip, tooltip
from skinsource_gui.qt.theme import UNIT_PX, set_tone
from skinsource_gui.state.panel import Panel

# Where samples come from: name of the button, label, text, hint and action.
_Source = tuple[str, str, str, str, str]
_SOURCES: dict[type, _Source] = {
    Recording: (
        *("recording_button", "File", "Choose file…"),
        *("Import a recording, in place of these samples or beside them", "import_recording"),
    ),
    Drawn: ("draw_button", "Curve", "Draw…", "Draw this clip with the pen", "draw_clip"),
}


def _source_cell(source: _Source, wanted: SignalInstance) -> LabelledCell:
    """Return a cell with a button for where samples come from."""
    name, label, text, hint, action = source
    cell = LabelledCell(label)
    button = named(QtWidgets.QPushButton(text, cell), name, hint=tooltip(hint))
    button.setMinimumHeight(LABEL_PX)
    button.clicked.connect(lambda: wanted.emit(action))
    cell.stack.addWidget(button, 0, Qt.AlignmentFlag.AlignLeft)
    cell.label.setBuddy(button)
    cell.setFocusProxy(button)
    return cell


def _places_of(limb: str) -> ChoiceSpec:
    return _places(limb, facts_of(limb))


@lru_cache(maxsize=8)
def _places(limb: str, facts: LimbFacts) -> ChoiceSpec:
    numbers = range(1, facts.n_inputs + 1)
    return ChoiceSpec(
        label="Place",
        options=tuple((str(k), f"{k} · {input_name(k, limb).short_name}") for k in numbers),
        hint="Where the actuator touches the skin",
    )


_TITLE = replace(TITLE, hint="Of the window, pictures and exported files")
_SENTENCE = replace(SENTENCE, hint="Below the title on the stage; begins the notes")
_CLIP_GAIN = replace(GAIN, label="Clip gain")


class Meaning(QtWidgets.QToolButton):
    """Says what an amplitude of 1 means; its menu chooses another meaning."""

    #: The name of the scaling that was chosen.
    chosen = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("scaling")
        self.setAutoRaise(True)
        set_tone(self, "dim")
        menu = menu_of(self)
        menu.setToolTipsVisible(True)
        self._actions = {word.name: menu.addAction(word.title) for word in SCALINGS}
        for name, action in self._actions.items():
            action.setCheckable(True)
            action.triggered.connect(lambda _=False, name=name: self.chosen.emit(name))

    def show_scaling(self, design: Design) -> None:
        """Show that of a design, as it is meant on its limb."""
        known = drive_unit_known(design.limb, design.limb_digest)
        for word in scalings_on(drive_unit_known=known):
            action = self._actions[word.name]
            action.setToolTip(tooltip(word.sentence))
            action.setChecked(word.name == design.scaling)
            if action.isChecked():
                own = design.actuated is None
                texts = (word.title, word.sentence) if own else (amplitude_meaning(design),)
                self.setText(amplitude_in_short(design))
                self.setAccessibleName(f"Scaling: {texts[0]}")
                show_tooltip(self, tooltip(": ".join(texts)))


class InputFields(QObject):
    """Fields of an input and a clip of it, in three groups.

    The gain of a clip is shown beside others, selected or on its track, and where it is not 1, the
    gain curve of a track where there is one; of clips of different kinds the fields that all have.

    Attributes
    ----------
    head, grid, track
        Contain place, amplitude, onset and duration; kind and the waveform's own fields; and those
        of the track.
    kind, place, meaning
        These emit what is chosen themselves; all others emit ``edited``.
    peak
        What is computed: the peak of the track.
    """

    #: Name of the field, its new value, number of the gesture or None.
    edited = Signal(str, object, object)
    #: An action that gets the samples of a waveform, by its name.
    source_requested = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        facts = facts_of("")
        self._played_at, self._places = (facts.sample_rate_hz, facts.band_hz), _places_of("")
        self._own: tuple[LabelledCell, ...] = ()
        self._strength: tuple[NumberSpec, str] | None = None
        self._arranged: tuple[tuple[LabelledCell, ...], ...] = ()
        self._built_for: type[Waveform] | None = None
        # Kinds of waveforms of the clips that are shown.
        self._kinds: set[type[Waveform]] = set()
        self._duration: LabelledCell | None = None
        self._gain_of: int | None = None
        self._curve_of: int | None = None
        self._view = View()
        self.head, self.grid, self.track = FieldGrid(), FieldGrid(), FieldGrid()
        self.kind = FieldCell("kind", kind_spec())
        self.place = FieldCell("location", self._places)
        hint = "Place and amplitude belong to all clips of these tracks"
        self._whole = TextCell("Whole track", "", "whole_track", hint)
        self._amplitude = FieldCell("amplitude", AMPLITUDE, edited=self.edited)
        self.meaning = Meaning()
        self._amplitude.stack.insertWidget(1, self.meaning, 0, Qt.AlignmentFlag.AlignRight)
        self._onset = FieldCell("onset_s", ONSET, edited=self.edited)
        self._gain = FieldCell("gain", _CLIP_GAIN, edited=self.edited)
        self._curve = FieldCell("gain_curve", GAIN_CURVE, edited=self.edited)
        self.peak = TextCell(
            "Track peak", "", "peak", "Peak of the track, with its gain, between samples too"
        )
        self._played_length = TextCell("Played time", "", "played_length", "Duration after effects")
        self._played_hz = TextCell("Played at", "", "played_hz", "Frequency after effects")

    def show_input(self, track: Input, batch: tuple[Input, ...], view: View) -> None:
        """Show an input, and where the inputs of the ``batch`` that is edited with it differ.

        ``view`` says which clips are selected.
        """
        self._view = view
        clip = clip_of(track, view)
        kind = None if clip is None else type(clip.waveform)
        pairs = [(other, each) for other in batch for each in clips_of(other, view) or (None,)]
        clips = [each for _, each in pairs if each is not None]
        self._kinds = {type(each.waveform) for each in clips}
        # A curve that was deleted can be typed again until another track is shown, as can a gain.
        self._curve_of = track.id if track.gain_curve or self._curve_of == track.id else None
        several = len(view.selected_clips) > 1 or len(track.clips) > 1
        gained = several or {each.gain for each in clips} - {1.0}
        self._gain_of = clip.id if clip and (gained or self._gain_of == clip.id) else None
        self._played_length.text_label.setText(_text_of_all(played_length_text, clips))
        self._played_hz.text_label.setText(_text_of_all(played_hz_text, clips))
        n_clips = sum(len(each.clips) for each in batch)
        of_tracks = f"{len(batch)} tracks, " if len(batch) > 1 else ""
        several = any(len(each.clips) > 1 for each in batch)
        self._whole.text_label.setText(f"{of_tracks}{n_clips} clips" if several else "")
        if kind is not self._built_for:
            self._build_own(None if clip is None else clip.waveform)
        self._arrange()
        if isinstance(self._duration, TextCell) and clip is not None:
            differ = len({each.waveform.duration_s for each in clips}) > 1
            self._duration.text_label.setText(MIXED if differ else fixed_length_text(clip.waveform))
        own = _values(track, clip)
        rest = [
            _values(other, each) for other, each in pairs if other is not track or each is not clip
        ]
        for cell in self._fields():
            value = own.get(cell.name)
            cell.set_value(value)
            different = {value, *(other.get(cell.name) for other in rest)} - {None}
            cell.show_mixed(len(different) > 1)

    def start_over(self) -> None:
        """Forget what can be typed again: another design has clips and tracks of its numbers."""
        self._gain_of = self._curve_of = None

    def show_strength(self, amplitude: NumberSpec, peak: str) -> None:
        """Say what an amplitude is; ``peak``: the resulting one."""
        if self._strength == (amplitude, peak):
            return
        self._strength = amplitude, peak
        self._amplitude.set_spec(amplitude)
        self.peak.text_label.setText(peak)
        self._arrange()

    def show_limb(self, limb: str) -> None:
        """Take over the places of a limb and the band in which it was measured."""
        places = _places_of(limb)
        if places != self._places:
            self._places = places
            self.place.set_spec(places)
        self._update_specs(self._played_at[0], facts_of(limb).band_hz)

    def show_rate(self, sample_rate_hz: float) -> None:
        """Take over the sample rate, which bounds the frequencies that can be played."""
        self._update_specs(sample_rate_hz, self._played_at[1])

    def _update_specs(self, sample_rate_hz: float, band_hz: Band | None) -> None:
        if self._played_at == (sample_rate_hz, band_hz):
            return
        self._played_at = sample_rate_hz, band_hz
        specs = specs_of(self._built_for) if self._built_for else {}
        for cell in self._own:
            if isinstance(cell, FieldCell):
                cell.set_spec(specs[cell.name].at_rate(*self._played_at))

    def show_refused(self, track: Input, name: str, reason: str) -> None:
        """Show the value of this field again, and the reason why it did not change."""
        cell = next(cell for cell in self._fields() if cell.name == name)
        cell.refuse(_values(track, clip_of(track, self._view)).get(name), reason)

    def forget_problems(self, name: str) -> None:
        """Forget why other numbers than ``name`` were refused, whose values stand there again."""
        for cell in self._fields():
            if cell.name != name and isinstance(cell.field, NumberField):
                cell.forget_problem()

    def _groups(self) -> tuple[tuple[LabelledCell, ...], ...]:
        """Return the cells of each grid."""
        has_clip = self._built_for is not None
        head: tuple[tuple[LabelledCell | None, object], ...] = (
            (self._whole, self._whole.text_label.text()),
            (self.place, True),
            (self._amplitude, True),
            (self.peak, self.peak.text_label.text()),
            (self._onset, has_clip),
            (self._duration, has_clip),
            (self._played_length, self._played_length.text_label.text()),
            (self._gain, self._gain_of is not None),
        )
        played = (self._played_hz,) if self._played_hz.text_label.text() else ()
        own = self._own
        if len(self._kinds) > 1:
            shared = set.intersection(*(set(specs_of(kind)) for kind in self._kinds))
            own = tuple(cell for cell in own if getattr(cell, "name", "") in shared)
        # Fields of frequencies come first.
        n_hz = sum("hz" in getattr(cell, "name", "") for cell in own)
        return (
            tuple(cell for cell, shown in head if shown and cell is not None),
            (self.kind, *own[:n_hz], *played, *own[n_hz:]),
            () if self._curve_of is None else (self._curve,),
        )

    def _arrange(self) -> None:
        """Show the cells that belong to the input."""
        groups = self._groups()
        if groups != self._arranged:
            self._arranged = groups
            for grid, cells in zip((self.head, self.grid, self.track), groups, strict=True):
                grid.show_cells(cells)

    def _fields(self) -> list[FieldCell]:
        return [cell for group in self._arranged for cell in group if isinstance(cell, FieldCell)]

    def _build_own(self, waveform: Waveform | None) -> None:
        old = self._own if self._duration is None else (self._duration, *self._own)
        cells: list[LabelledCell] = []
        self._duration = None
        for name, spec in (specs_of(waveform) if waveform else {}).items():
            cell = FieldCell(name, spec.at_rate(*self._played_at), edited=self.edited)
            if name == DURATION_FIELD:
                self._duration = cell
            else:
                cells.append(cell)
        if waveform and fixed_length_text(waveform):
            self._duration = TextCell("Duration", fixed_length_text(waveform))
        if source := _SOURCES.get(type(waveform)):
            cells.append(_source_cell(source, self.source_requested))
        self._own = tuple(cells)
        self._built_for = type(waveform) if waveform else None
        discard(old, self.kind.field)
        self._arrange()


def _values(track: Input, clip: Clip | None) -> dict[str, object]:
    """Return the value of each cell for an input and its clip, by name."""
    kind = "" if clip is None else kind_name(clip.waveform)
    # Also a length that is no field of its kind differs from others.
    length_s = None if clip is None else clip.waveform.duration_s
    place = str(track.location)
    return values_of(track, clip) | {DURATION_FIELD: length_s, "kind": kind, "location": place}


def _text_of_all(text_of: Callable[[Any], str], things: Iterable[Any]) -> str:
    """Return the text of each of some clips or inputs, or that they differ; "" without any."""
    texts = {text_of(thing) for thing in things}
    return MIXED if len(texts) > 1 else "".join(texts)


class ClipHeading(QtWidgets.QWidget):
    """Colour and number of the place, which clip it is, and whether it is silent."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._swatch = Swatch()
        self._title = named(FittingLabel(), "inspector_heading")
        font = QtGui.QFont(self.font())
        font.setWeight(QtGui.QFont.Weight.DemiBold)
        self._title.setFont(font)
        self._state = QtWidgets.QLabel()
        set_tone(self._state, "warning")
        parts = (self._swatch, (self._title, 1), self._state)
        in_row(*parts, of=self, margins=0, gap_px=UNIT_PX // 2).insertSpacing(1, UNIT_PX // 2)

    def show_clip(
        self,
        track: Input,
        clip: Clip | None,
        limb: str,
        *,
        silent: bool,
        batch: tuple[Input, ...],
        clips: tuple[Clip, ...],
        by_clip: bool,
    ) -> None:
        """Show a clip, or how many ``clips`` of a ``batch`` of inputs are edited together.

        ``silent``: the last input is not heard; ``by_clip``: clips were selected, not inputs.
        """
        place = input_name(track.location, limb)
        which, title = "", "No clip yet"
        if clip is not None:
            which = f"Clip {track.clips.index(clip) + 1} of {len(track.clips)} · "
            title = clip.waveform.title
        phrases = f"{which}{title}", title
        if len(clips) > 1 or len(batch) > 1:
            of_clips = by_clip and len(clips) >= len(batch)
            several = f"{len(clips)} clips" if of_clips else f"{len(batch)} inputs"
            alike = {each.waveform.title for each in clips} == {title}
            # Fields of clips change the first one of each input, where none is selected.
            more = not of_clips and max(len(each.clips) for each in batch) > 1
            which = ", first clips" if more else ""
            phrases = f"{several}{which}{f' · {title}' if alike else ''}", several
        self._title.show_phrases(phrases)
        self._swatch.show_input(track.location, track.colour, silent=silent)
        contact = f" ({place.kind})" if place.kind else ""
        show_tooltip(self._title, f"Input place {place.number}: {place.name}{contact}")
        muted = clip is not None and clip.muted
        state = "muted" if muted else "silent" * silent
        of_several = len(batch) > 1 or (muted and len(clips) > 1)
        self._state.setText(f"last one {state}" if state and of_several else state)


# Smallest size with letters of any size, px.
_LEAST = QSize(204, 224)


class InspectorPanel(Panel):
    """Edits the selected inputs: which clip, place, amplitude and its meaning, onset, duration.

    These stay in sight; below them the waveform's own fields, effects and the track scroll.  The
    panel shows the input that was selected last. A typed value sets all inputs; a drag changes all
    by the same amount.
    """

    title = "Clip"
    name = "inspector"
    #: What each track plays.
    needs = frozenset({"input_waveforms", "inputs", "sample_rate_hz"})
    reads_down = True

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._shown: tuple[tuple[int, ...], ...] = ()
        # What each track plays before its amplitude, by its id.
        self._played: dict[int, Floats] = {}
        self._changes = FieldChanges()
        # The input that was selected last.
        self._last: Input | None = None
        # The selected inputs, in the order of the design.
        self._batch: tuple[Input, ...] = ()
        self._fields = InputFields(self)
        self._fields.kind.edited.connect(self._change_kind)
        self._fields.place.edited.connect(self._change_place)
        self._fields.edited.connect(self._change_field)
        self._fields.meaning.chosen.connect(self._change_scaling)
        self._fields.source_requested.connect(self._act)
        self._chain = EffectChain()
        self._chain.edited.connect(self.edited)
        self._chain.action_requested.connect(self._act)
        self._heading = ClipHeading()
        self._mute, self._solo = mute_button(), solo_button()
        self._mute.clicked.connect(lambda: self._change(edits.toggle_mute))
        self._solo.clicked.connect(lambda: self._change(edits.toggle_solo))
        self._texts = tuple(
            FieldCell(name, spec, edited=self._change_texts)
            for name, spec in (("title", _TITLE), ("sentence", _SENTENCE))
        )
        self.computed = (self._fields.peak,)
        self._lay_out()

    def minimumSizeHint(self) -> QSize:
        if not self.isVisible():
            # Behind another panel layouts do not follow other letters.
            for layout in self._editor.findChildren(QtWidgets.QLayout):
                layout.invalidate()
            self._stack.invalidate()
        # Fields scroll down, never sideways.
        bar = self.style().pixelMetric(QtWidgets.QStyle.PixelMetric.PM_ScrollBarExtent)
        width = self._scrolled.minimumSizeHint().width() + bar
        return super().minimumSizeHint().expandedTo(QSize(width, 0)).expandedTo(_LEAST)

    @property
    def fields(self) -> list[FieldCell]:
        """The fields of the selected input and its clip that are in sight or scroll there."""
        cells = self.findChildren(FieldCell) if self._last is not None else []
        return [cell for cell in cells if cell.isVisibleTo(self._editor)]

    def go_to(self, cell: FieldCell) -> None:
        """Give a field the keyboard."""
        self._scroll.ensureWidgetVisible(cell)
        cell.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        track = self._last = leading_input(design, view)
        if track is None:
            forget_typing(self._editor)
            self._shown = ()
            self._empty.setText(HOW_TO_SELECT_INPUT if design.inputs else how_to_add())
            texts = design.title, design.notes.partition("\n")[0]
            for cell, text in zip(self._texts, texts, strict=True):
                cell.set_value(text)
            self._stack.setCurrentWidget(self._of_design)
            self.setFocusProxy(self._texts[0])
            return
        if self._shown != (view.selected_inputs, view.selected_clips):
            # What was being typed or dragged belongs to other inputs.
            forget_typing(self._editor)
            self._shown = (view.selected_inputs, view.selected_clips)
            self._scroll.verticalScrollBar().setValue(0)
        self._show_input(
            track, silent=all(track is not audible for audible in audible_inputs(design.inputs))
        )
        self._stack.setCurrentWidget(self._editor)
        self.setFocusProxy(self._fields.place)

    def start_over(self) -> None:
        self._fields.start_over()

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._played = played_of(results)
        self._fields.show_rate(results["sample_rate_hz"])
        if self._last is not None:
            self._show_strength(self._last)

    def show_problem(self, reason: str) -> None:
        self._played = {}

    def _lay_out(self) -> None:
        fields, sides = self._fields, (UNIT_PX, 0, UNIT_PX, 0)
        self._scrolled = inside = QtWidgets.QWidget()
        track = QtWidgets.QWidget()
        buttons = in_row(self._mute, self._solo, None, margins=0, gap_px=UNIT_PX // 2)
        in_column(buttons, fields.track, of=track, margins=0, gap_px=UNIT_PX // 4)
        fold = Fold("track_fold", "Input", track)
        parts = fields.grid, self._chain, fold, track, None
        in_column(*parts, of=inside, margins=(UNIT_PX, 0, UNIT_PX, UNIT_PX), gap_px=UNIT_PX // 4)
        self._scroll = scroll = scrolled(inside, "inspector_fields")
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._editor = QtWidgets.QWidget()
        top = in_column(self._heading, fields.head, margins=sides, gap_px=UNIT_PX // 4)
        margins = (0, UNIT_PX // 4, 0, 0)
        in_column(top, (scroll, 1), of=self._editor, margins=margins, gap_px=UNIT_PX // 4)
        self._empty = page_label("inspector_empty", tone="dim", centred=True)
        self._of_design, grid = QtWidgets.QWidget(), FieldGrid()
        grid.show_cells(self._texts)
        in_column(
            page_label("design_heading", "Design"), grid, (self._empty, 1), of=self._of_design
        )
        self._stack = QtWidgets.QStackedLayout(self)
        self._stack.addWidget(self._of_design)
        self._stack.addWidget(self._editor)
        self.setFocusProxy(self._texts[0])

    def _show_input(self, track: Input, *, silent: bool) -> None:
        batch = tuple(each for each in self._design.inputs if each.id in self._view.selected_inputs)
        self._batch = batch
        clip, limb = clip_of(track, self._view), self._design.limb
        clips = tuple(each for other in batch for each in clips_of(other, self._view))
        by_clip = len(clips) == len(self._view.selected_clips)
        self._heading.show_clip(
            track, clip, limb, silent=silent, batch=batch, clips=clips, by_clip=by_clip
        )
        self._mute.setChecked(all(each.muted for each in batch))
        self._solo.setChecked(all(each.solo for each in batch))
        self._fields.meaning.show_scaling(self._design)
        self._fields.show_limb(limb)
        self._show_strength(track)
        self._fields.show_input(track, batch, self._view)
        self._chain.show_chain(self._design, self._view, clip, clips)

    def _show_strength(self, track: Input) -> None:
        design, amplitude, peak = self._design, amplitude_spec(self._design), ""
        known = [self._peaks_of(each) for each in self._batch]
        if gain := any(is_gain(design, whole, highest) for whole, highest, _ in known):
            amplitude = AMPLITUDE_GAIN
        if gain or any(says_peak(design, whole, heard) for whole, _, heard in known):
            peak = _text_of_all(str, (peak_text(design, whole, heard) for whole, _, heard in known))
        if track.amplitude < 0:
            amplitude = replace(amplitude, hint="Polarity inverted")
        self._fields.show_strength(amplitude, peak)

    def _peaks_of(self, track: Input) -> tuple[Input, float | None, float | None]:
        """Return a track without muted clips, and its peak before its amplitude, where known.

        Then the peak of what is not muted, if there is anything: what plays again stays the same.
        """
        played = self._played.get(track.id)
        heard = whole = None if played is None else peak_of(played)
        if any(clip.muted for clip in track.clips):
            track = replace(track, clips=tuple(replace(clip, muted=False) for clip in track.clips))
            whole = peak_before_amplitude(self._design, track)
        return track, whole, heard or whole

    def _act(self, name: str, _checked: bool = False) -> None:
        """Do an action with the clips that are edited here: they are selected first."""
        design, view = self._design, self._view
        tracks = (track for track in design.inputs if track.id in view.selected_inputs)
        shown = None if self._last is None else clip_of(self._last, view)
        clips = [clip for track in tracks for clip in clips_of(track, view) if clip != shown]
        ids = [clip.id for clip in (*clips, shown) if clip is not None]
        self.view_changed.emit(edits.select_clips(design, view, ids).view)
        self.action_requested.emit(name)

    def _change_kind(self, _: str, kind: str, gesture: int | None) -> None:
        self._change(edits.change_kind, kind, gesture=gesture)

    def _change_place(self, _: str, number: str, gesture: int | None) -> None:
        self._change(edits.move_inputs, int(number), gesture=gesture)

    def _change_scaling(self, scaling: str) -> None:
        self._tell(edits.change_scaling(self._design, self._view, scaling), None)

    def _change_texts(self, name: str, text: str, gesture: int | None) -> None:
        """Change the title of the design, or the first line of its notes."""
        _, line_end, others = self._design.notes.partition("\n")
        field, text = (name, text) if name == "title" else ("notes", f"{text}{line_end}{others}")
        self.edited.emit(change_texts(self._design, self._view, **{field: text}), gesture)

    def _change_field(self, name: str, value: Any, gesture: int | None) -> None:
        """Change a field of all selected inputs, by typing or dragging."""
        track, ids = self._last, self._view.selected_inputs
        if track is None:
            return
        self._fields.forget_problems(name)
        outcome = self._changes.change(
            self._design, self._view, ids, name, value, lead=ids[-1], gesture=gesture
        )
        if isinstance(outcome, Refusal):
            # Each number is allowed alone, but not together with the others.
            self._fields.show_refused(track, name, outcome.sentence)
        else:
            self._tell(outcome, gesture)

    def _change(
        self, edit: Callable[..., Edit | Refusal], *arguments: object, gesture: int | None = None
    ) -> None:
        """Edit all selected inputs."""
        self._tell(edit(self._design, self._view, self._view.selected_inputs, *arguments), gesture)

    def _tell(self, outcome: Edit | Refusal, gesture: int | None) -> None:
        # A field may still be dragged while its input is removed.
        if self._last is not None and (
            isinstance(outcome, Refusal) or outcome.design != self._design
        ):
            self.edited.emit(outcome, gesture)
