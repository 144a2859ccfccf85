"""The selected clip, large: looked at, drawn, shaped."""

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLabel, QStackedLayout, QVBoxLayout, QWidget

from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.edits import Refusal
from skinsource.design.edits.edit import clip_of
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.view import View
from skinsource.limbs.locations import input_words
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.panel import Panel
from skinsource_gui.panels.clip_editor.body import EditorBody
from skinsource_gui.panels.clip_editor.drawing import Drawing
from skinsource_gui.panels.clip_editor.editor_toolbar import EditorToolbar
from skinsource_gui.panels.clip_editor.editor_view import EditorView
from skinsource_gui.panels.clip_editor.gliding import Gliding
from skinsource_gui.panels.clip_editor.shaping import Shaping
from skinsource_gui.panels.clip_editor.spectrum_strip import SpectrumStrip
from skinsource_gui.panels.clip_editor.tools.look import Look
from skinsource_gui.panels.clip_editor.tools.tool import Tool
from skinsource_gui.theme import set_tone
from skinsource_gui.widgets.empty_words import clip_words
from skinsource_gui.widgets.inputs.clip_waveforms import waveforms_of
from skinsource_gui.widgets.inputs.input_words import clip_text, duration_text
from skinsource_gui.widgets.keys import meaning_of

_NO_GLIDE = Refusal(sentence="The clip does not play a glide; choose that waveform first.")
_ZOOM = 1.5


class ClipEditorPanel(Panel):
    """The waveform of the selected clip, large, with tools, and its spectrum."""

    title = "Clip"
    name = "clip_editor"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design, self._view = Design(limb=""), View()
        self._rate_hz = facts_of("").sample_rate_hz
        self._waveforms: Mapping[int, Floats] = {}
        self._raw: tuple[Any, float, Floats | None] = (None, 0.0, None)
        self._said: tuple[Clip | None, Design | None, str] = (None, None, "")
        self._unplayable: frozenset[int] = frozenset()
        self._drawing, self._shaping = Drawing(self), Shaping(self)
        self._look, self._pen = Look(self), self._drawing.pen
        self._gliding = Gliding(self)
        self._tools: dict[str, Tool] = {
            "look": self._look,
            "pen": self._pen,
            "envelope": self._shaping.tool,
            "glide": self._gliding.tool,
        }
        self._canvas = EditorView(self._look)
        self._toolbar, self._spectrum = EditorToolbar(), SpectrumStrip()
        self._empty = QLabel()
        set_tone(self._empty, "dim")
        self._empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._empty.setWordWrap(True)
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._toolbar)
        column.addWidget(EditorBody(self._canvas, self._spectrum), 1)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self._empty)
        self._stack.addWidget(inside)
        self.setMinimumSize(260, 176)
        self.setFocusProxy(self._canvas)
        self._connect()

    @property
    def needs(self) -> frozenset[str]:
        """What each clip plays."""
        return frozenset({"clip_waveforms", "inputs", "sample_rate_hz"})

    @property
    def clip(self) -> Clip | None:
        """The clip that was selected last, or the first one of the selected track."""
        selected = self._view.selected_input
        track = next((one for one in self._design.inputs if one.id == selected), None)
        return None if track is None else clip_of(track, self._view)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self._show()

    def show_in_sight(self, names: frozenset[str]) -> None:
        super().show_in_sight(names)
        if self.clip is None:
            self._show()

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._rate_hz = results["sample_rate_hz"]
        self._waveforms = waveforms_of(results)
        self._show()

    def show_unplayable(self, unplayable: tuple[UnplayableInput, ...]) -> None:
        self._unplayable = frozenset(one.id for one in unplayable)
        if self.clip is not None:
            self._say(self.clip)

    def show_late(self, late: bool) -> None:
        self._canvas.item.show_late(late)

    def show_problem(self, reason: str) -> None:
        self._waveforms = {}
        self._show()
        self._toolbar.show_words(reason, enabled=self.clip is not None)

    def use(self, tool: str) -> None:
        """Take a tool; a clip that is not drawn asks once whether it may become samples."""
        clip = self.clip
        if tool == "pen" and clip is not None and not self._drawing.may_draw(clip):
            # While it is asked nothing of another tool is seen, or can be done.
            self._take("look")
            tool = "pen" if self._drawing.is_allowed(clip) else "look"
        if tool == "glide" and not self._gliding.can_edit(clip):
            self.edited.emit(_NO_GLIDE, None)
            tool = "look"
        self._take(tool)
        # A question may have taken the keyboard away.
        self._canvas.setFocus(Qt.FocusReason.OtherFocusReason)

    def _take(self, tool: str) -> None:
        self._canvas.use(self._tools[tool])
        self._toolbar.show_tool(tool)
        if self.clip is not None:
            self._say(self.clip)

    def _connect(self) -> None:
        self._toolbar.tool_wanted.connect(self.use)
        self._toolbar.bound_wanted.connect(self._drawing.bound)
        self._toolbar.everything_wanted.connect(self._canvas.seen.show_everything)
        self._canvas.key_pressed.connect(self._press)
        self._look.pan_wanted.connect(self._canvas.seen.pan)
        self._drawing.edited.connect(self.edited)
        self._shaping.edited.connect(self.edited)
        self._gliding.edited.connect(self.edited)

    def _show(self) -> None:
        clip = self.clip
        self._drawing.show_state(self._design, self._view, clip, self._rate_hz)
        self._shaping.show_state(self._design, self._view, clip)
        self._gliding.show_state(self._design, self._view, clip, self._rate_hz)
        self._stack.setCurrentIndex(0 if clip is None else 1)
        if clip is None:
            inputs = bool(self._design and self._design.inputs)
            self._empty.setText(clip_words(self.in_sight, inputs=inputs))
            self._canvas.show_clip(None, None, None, self._rate_hz)
            return
        gone = self._canvas.tool is self._gliding.tool and not self._gliding.can_edit(clip)
        if gone or (self._canvas.tool is self._pen and not self._drawing.may_draw(clip)):
            # Another clip than the one that was asked about, or another waveform.
            self.use("look")
        self._toolbar.offer_glide(self._gliding.can_edit(clip))
        raw = self._sampled(clip)
        played = self._waveforms.get(clip.id)
        if not clip.effects and raw is not None:
            played = raw
        self._canvas.show_clip(clip, raw, played, self._rate_hz)
        band_hz = facts_of(self._design.limb).band_hz
        self._spectrum.show_samples(played, self._rate_hz, band_hz)
        self._toolbar.show_band(band_hz)
        self._say(clip)

    def _say(self, clip: Clip) -> None:
        said_of, design, words = self._said
        if said_of is not clip or design is not self._design:
            words = _words(clip, self._design)
            self._said = clip, self._design, words
        if self._view.selected_input in self._unplayable and not clip.muted:
            words = f"{words} · cannot be played"
        self._toolbar.show_words(words, enabled=True, hint=self._canvas.tool.hint)

    def _sampled(self, clip: Clip) -> Floats | None:
        """What the clip plays before its effects; it is drawn once for each waveform."""
        waveform, rate_hz, samples = self._raw
        if waveform is not clip.waveform or rate_hz != self._rate_hz:
            try:
                samples = clip.waveform.samples(self._rate_hz)
            except InvalidInputError:
                # The other panels say why.
                samples = None
            self._raw = (clip.waveform, self._rate_hz, samples)
        return samples

    def _press(self, event: QKeyEvent) -> None:
        wanted = meaning_of("clip_editor", event)
        if wanted in self._tools:
            self.use(wanted)
        elif wanted in ("zoom_in", "zoom_out"):
            self._canvas.seen.zoom(_ZOOM if wanted == "zoom_in" else 1 / _ZOOM)
        elif wanted == "whole":
            self._canvas.seen.show_everything()
        elif wanted == "give_up":
            self.use("look")
        else:
            # Points that are not seen are not changed.
            for one in (self._gliding, self._shaping):
                if self._canvas.tool is one.tool:
                    one.press(wanted, event)
            self._canvas.lay_out()


def _words(clip: Clip, design: Design) -> str:
    """Where a clip plays, and what."""
    place = input_words(design.track_of(clip.id).location, design.limb)
    label = f"{clip.label} · " if clip.label else ""
    figure = f"{clip_text(clip)} · {duration_text(clip.duration_s)}"
    return f"{label}{place.number} {place.short_name} · {figure}"
