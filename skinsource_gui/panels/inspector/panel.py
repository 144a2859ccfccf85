"""Everything about the selected inputs."""

from collections.abc import Mapping
from functools import partial
from typing import Any

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import (
    QLabel,
    QStackedLayout,
    QStyle,
    QVBoxLayout,
    QWidget,
)

from skinsource.design.amplitudes import is_gain, peak_text
from skinsource.design.design import AMPLITUDE_GAIN, Design, Input, amplitude_spec, audible_inputs
from skinsource.design.edits.edit import clip_of, clips_of
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.view import View
from skinsource_gui.panel import Panel
from skinsource_gui.panels.inspector.effects.chain_edits import ChainEdits
from skinsource_gui.panels.inspector.effects.effect_chain import EffectChain
from skinsource_gui.panels.inspector.input_fields import InputFields
from skinsource_gui.panels.inspector.input_heading import InputHeading
from skinsource_gui.panels.inspector.selection import Selection
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.empty_words import add_words, select_words
from skinsource_gui.widgets.inputs.waveform_preview import WaveformPreview
from skinsource_gui.widgets.room.steady_area import SteadyArea

# In letters of any size, px.
_LEAST = QSize(204, 224)


class InspectorPanel(Panel):
    """Edits the selected inputs: place, waveform, the waveform's own fields, amplitude, onset.

    Shown is the one that was selected last.  A typed value sets all; a drag moves all by as much.
    """

    title = "Inspector"
    name = "inspector"
    reads_down = True

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design = Design(limb="")
        self._shown: tuple[tuple[int, ...], ...] = ()
        self._view = View()
        self._results: Mapping[str, Any] | None = None
        self._problems: Mapping[int, str] = {}
        self._selection = Selection(self)
        self._selection.edited.connect(self.edited)
        self._selection.field_refused.connect(self._show_refused)
        self._fields = InputFields(self)
        self._fields.kind.edited.connect(self._selection.change_kind)
        self._fields.place.edited.connect(self._selection.change_place)
        self._fields.edited.connect(self._selection.change_field)
        self._fields.pen_wanted.connect(partial(self.action_wanted.emit, "draw_clip"))
        self._fields.file_wanted.connect(partial(self.action_wanted.emit, "import_recording"))
        self._chain, self._chain_edits = EffectChain(), ChainEdits(self)
        self._connect_chain()
        self._heading = InputHeading()
        self._heading.mute_toggled.connect(self._selection.toggle_mute)
        self._heading.solo_toggled.connect(self._selection.toggle_solo)
        self._preview = WaveformPreview(axis=True)
        self._preview.setMaximumHeight(160)
        self.computed = (self._preview,)
        self._lay_out()

    def minimumSizeHint(self) -> QSize:
        # Fields scroll down, never sideways.
        bar = self.style().pixelMetric(QStyle.PixelMetric.PM_ScrollBarExtent)
        width = self._scrolled.minimumSizeHint().width() + bar
        return super().minimumSizeHint().expandedTo(QSize(width, 0)).expandedTo(_LEAST)

    @property
    def needs(self) -> frozenset[str]:
        """What each input plays, and its rate."""
        return frozenset({"input_waveforms", "sample_rate_hz"})

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self._selection.show_state(design, view)
        one = self._selection.last
        if one is None:
            self._fields.forget_typing()
            self._chain.forget_typing()
            self._shown = ()
            self._show_empty()
            self._stack.setCurrentWidget(self._empty)
            return
        if self._shown != (view.selected_inputs, view.selected_clips):
            # What was being typed, or dragged, was meant for others.
            self._fields.forget_typing()
            self._chain.forget_typing()
            self._shown = (view.selected_inputs, view.selected_clips)
            self._show_waveform()
        self._show_input(
            one, silent=all(one is not heard for heard in audible_inputs(design.inputs))
        )
        self._stack.setCurrentWidget(self._editor)

    def show_in_sight(self, names: frozenset[str]) -> None:
        super().show_in_sight(names)
        self._show_empty()

    def _show_empty(self) -> None:
        words = select_words if self._design.inputs else add_words
        self._empty.setText(words(self.in_sight))

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._results = {name: results[name] for name in self.needs}
        self._fields.show_rate(results["sample_rate_hz"])
        self._show_waveform()

    def show_unplayable(self, unplayable: tuple[UnplayableInput, ...]) -> None:
        self._problems = {one.id: one.problem for one in unplayable}
        if self._selection.last is not None:
            self._show_look(self._selection.last)

    def _show_waveform(self) -> None:
        results = self._results or {"input_waveforms": ()}
        waveforms = results["input_waveforms"]
        # Results of an older design may have another number of inputs; the next ones come soon.
        one = self._selection.last
        if one is not None and len(waveforms) == len(self._design.inputs):
            samples = waveforms[self._design.index_of(one.id)]
            if samples is None:
                self._preview.show_words("Cannot be sampled at the rate of this limb")
            else:
                self._preview.show_samples(samples, results["sample_rate_hz"])
        else:
            self._preview.show_words("")

    def show_problem(self, reason: str) -> None:
        self._results = None
        self._preview.show_words(reason)

    def _lay_out(self) -> None:
        self._scrolled = inside = QWidget()
        fields = QVBoxLayout(inside)
        fields.setContentsMargins(UNIT_PX, 0, UNIT_PX, UNIT_PX)
        fields.addWidget(self._fields.grid)
        fields.addWidget(self._chain)
        fields.addStretch(1)
        scroll = SteadyArea()
        scroll.setObjectName("inspector_fields")
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
        set_tone(self._empty, "dim")
        self._empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._empty.setWordWrap(True)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self._empty)
        self._stack.addWidget(self._editor)
        self.setFocusProxy(self._fields.kind)

    def _show_input(self, one: Input, *, silent: bool) -> None:
        together = self._selection.together
        self._heading.show_input(one, self._design.limb, silent=silent, together=together)
        amplitude, peak = amplitude_spec(self._design), ""
        if is_gain(self._design, one):
            amplitude, peak = AMPLITUDE_GAIN, peak_text(self._design, one)
        self._fields.show_limb(self._design.limb)
        self._fields.show_input(one, together, amplitude, self._view, peak)
        self._show_chain(one, together)
        self._show_look(one)

    def _show_look(self, one: Input) -> None:
        problem = self._problems.get(one.id, "")
        self._preview.set_look(one.colour, flipped=one.amplitude < 0, problem=problem)

    def _show_chain(self, one: Input, together: tuple[Input, ...]) -> None:
        clip = clip_of(one, self._view)
        ids = tuple(each.id for other in together for each in clips_of(other, self._view))
        self._chain_edits.show_state(self._design, self._view, clip, ids)
        if clip is None:
            self._chain.show_chain(None, ())
        else:
            self._chain.show_chain(clip.id, clip.effects, clip.duration_s)

    def _connect_chain(self) -> None:
        chain, changes = self._chain, self._chain_edits
        chain.added.connect(changes.add)
        chain.removed.connect(changes.remove)
        chain.moved.connect(changes.move)
        chain.switched.connect(changes.switch)
        chain.edited.connect(changes.change_field)
        changes.edited.connect(self.edited)
        changes.field_refused.connect(chain.show_refused)

    def _show_refused(self, name: str, reason: str) -> None:
        # Each number is allowed alone, but not together with the others.
        if self._selection.last is not None:
            self._fields.show_refused(self._selection.last, name, reason)
