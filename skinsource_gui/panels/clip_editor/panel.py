"""The panel of the selected clip, large, with its tools and its spectrum."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import Qt, Signal

from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError, sentence
from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.describing import duration_text, figure_text
from skinsource.design.design import Design, View
from skinsource.design.edits.cutting import faded_ends
from skinsource.design.edits.edit import Edit, Refusal, leading_clip
from skinsource.design.edits.effects import bake_clip, changes_time, time_effects_end
from skinsource.design.effects.breakpoints import Points, with_point_after
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.level import UNCHANGED, Envelope
from skinsource.design.effects.playing import placed, played
from skinsource.design.effects.time import Trim
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.samples import Drawn
from skinsource.design.waveforms.tones import Glide
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.synthesis import Column, Curve, bends_of, curve_of
from skinsource_gui.fields.editor import Burst
from skinsource_gui.fields.inputs import clip_text, waveforms_of
from skinsource_gui.panels.clip_editor.tools import EnvelopeTool, GlideTool, Pen, ViewTool
from skinsource_gui.panels.clip_editor.view import EditorView, SpectrumStrip, Tool
from skinsource_gui.qt.buttons import page_label, tool_button
from skinsource_gui.qt.keys import arrow_steps, key_text, meaning_of
from skinsource_gui.qt.labels import HOW_TO_SELECT_CLIP, FittingLabel, how_to_add
from skinsource_gui.qt.layouts import in_column, in_row, named, show_tooltip
from skinsource_gui.qt.questions import ask_yes
from skinsource_gui.qt.theme import set_tone
from skinsource_gui.state.panel import Panel

_CANVAS_PART, _SPECTRUM_PART = 3, 1
# In a panel that is lower, and so many times wider than high, the spectrum is at the right.
_LOW_PX = 300
_WIDE = 3


class EditorBody(QtWidgets.QWidget):
    """Canvas and spectrum: where the panel is low and wide, the spectrum is at the right."""

    def __init__(self, canvas: QtWidgets.QWidget, spectrum: QtWidgets.QWidget) -> None:
        super().__init__()
        parts = (canvas, _CANVAS_PART), (spectrum, _SPECTRUM_PART)
        self._layout = in_column(*parts, of=self, margins=0, gap_px=0)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        low = self.height() < _LOW_PX and self.width() >= _WIDE * self.height()
        ways = QtWidgets.QBoxLayout.Direction
        self._layout.setDirection(ways.LeftToRight if low else ways.TopToBottom)
        self._layout.activate()


class ToolEdits:
    """Turns what a tool does into edits of the clip in the editor.

    Parameters
    ----------
    tool
        The tool, which emits ``cancelled`` with the number of a drag.
    """

    def __init__(self, tool: Pen | EnvelopeTool | GlideTool, panel: "ClipEditorPanel") -> None:
        self._panel = panel
        # The first edit of a drag was made of these.
        self._gesture: int | None = None
        self._before: Edit | None = None
        tool.cancelled.connect(self._give_up)

    def forget(self) -> None:
        """Forget what belongs to another clip."""

    def _edit(self, gesture: int | None, edit: Callable[..., Edit | Refusal], *more: Any) -> None:
        """Emit what an edit makes of the clip; remember what there was before a drag."""
        design, view, clip = self._panel.design, self._panel.view, self._panel.clip
        if clip is None:
            return
        if gesture is not None and gesture != self._gesture:
            self._gesture, self._before = gesture, Edit(label="", design=design, view=view)
        self._panel.edited.emit(edit(design, view, clip.id, *more), gesture)

    def _give_up(self, gesture: int) -> None:
        if gesture == self._gesture:
            self._panel.edited.emit(self._before, gesture)


class PenEdits(ToolEdits):
    """Turns strokes into edits; asks once before a clip of another kind becomes samples."""

    def __init__(self, panel: "ClipEditorPanel") -> None:
        self.tool = Pen(panel)
        super().__init__(self.tool, panel)
        # By identity: another design has clips of the same numbers.
        self._allowed: Waveform | None = None
        self.tool.may_begin = self._may_begin
        self.tool.drawn.connect(self._draw)
        self.tool.refused.connect(
            lambda why: panel.edited.emit(Refusal(sentence=sentence(why)), None)
        )

    def may_draw(self, clip: Clip) -> bool:
        """Return whether a clip can be drawn on without a question."""
        known = isinstance(clip.waveform, Drawn) or self._allowed is clip.waveform
        return known and not time_effects_end(clip)

    def is_allowed(self, clip: Clip) -> bool:
        """Return whether a clip may become samples; ask, unless it is drawn or was asked before."""
        if self.may_draw(clip):
            return True
        baked = clip.effects[: time_effects_end(clip)]
        lost = f" and effects ({', '.join(effect.title.lower() for effect in baked)})"
        question = (
            f"The clip plays {figure_text(clip.waveform)}. Drawing converts it into samples; its "
            f"parameters{lost if baked else ''} can then no longer be edited. "
            "Undo brings them back."
        )
        if not ask_yes(self._panel, "Draw over the waveform?", question):
            return False
        self._allowed = clip.waveform
        if baked:
            # The pen draws what plays, so that it has to be what the clip holds.
            self._edit(None, bake_clip, self._panel.rate_hz)
        return True

    def _may_begin(self) -> bool:
        """Return whether a stroke begins; one that had to be asked about is drawn anew."""
        clip = self._panel.clip
        if clip is None or self.may_draw(clip):
            return clip is not None
        self.is_allowed(clip)
        return False

    def _draw(self, samples: Floats, stroke: int) -> None:
        self._edit(stroke, edits.draw_clip, samples, self._panel.rate_hz)


_PLACE = "clip_editor"
_TOOLS = (
    ("look", "View", "Read values; drag to scroll"),
    ("pen", "Draw", "Draw samples; Shift: straight line; right button: zero"),
    ("envelope", "Envelope", "Shape the envelope: click to add a point, drag to move"),
    ("glide", "Glide", "Shape frequency and amplitude of a glide: click to add points"),
)


class EditorToolbar(QtWidgets.QWidget):
    """Buttons of the tools and of the zoom, and a text about the clip.

    Attributes
    ----------
    fit
        The button that shows all of the clip.
    """

    tool_requested = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self.setStyleSheet("QToolButton { padding: 2px 8px; }")
        row = in_row(of=self, margins=(4, 2, 4, 2), gap_px=2)
        self._group = QtWidgets.QButtonGroup(self)
        self.tools: dict[str, QtWidgets.QToolButton] = {}
        for name, text, hint in _TOOLS:
            hint = f"{hint} ({key_text(_PLACE, name)})"
            label = f"clip_{text.lower()}"
            button = tool_button(self, label, text, hint, checkable=True, takes_keyboard=False)
            self._group.addButton(button)
            self.tools[name] = button
            button.clicked.connect(lambda _=False, name=name: self.tool_requested.emit(name))
            row.addWidget(button)
        self.tools["look"].setChecked(True)
        row.addSpacing(8)
        hint = f"Show the whole clip ({key_text(_PLACE, 'whole')})"
        self.fit = tool_button(self, "clip_fit", "Fit", hint, takes_keyboard=False)
        row.addWidget(self.fit)
        self._description = named(FittingLabel(), "clip_words")
        set_tone(self._description, "dim")
        row.addWidget(self._description, 1)

    def show_text(self, text: str, *, enabled: bool, hint: str = "") -> None:
        """Show a text about the clip, and how to begin; ``enabled``: there is a clip to edit."""
        whole = f"{text} · {hint}" if hint else text
        self._description.show_phrases((whole, hint or text, text))
        show_tooltip(self._description, whole)
        for button in (*self.tools.values(), self.fit):
            button.setEnabled(enabled)


#: One step of an arrow key to the side.
STEP_S = 0.001
#: One step of an arrow key up.
STEPS: dict[Column, float] = {"frequency": 1.0, "amplitude": 0.01}


class PointEdits(ToolEdits):
    """Turns what a tool and keys do to points of a curve into edits of the clip."""

    def __init__(self, tool: EnvelopeTool | GlideTool, panel: "ClipEditorPanel") -> None:
        super().__init__(tool, panel)
        self._burst = Burst(panel)

    def _press(
        self,
        tool: EnvelopeTool,
        command: str,
        event: QtGui.QKeyEvent,
        points: Points,
        end_s: float,
        step: float,
    ) -> None:
        """Do what a command does to the points of a tool, which end at ``end_s``."""
        if command == "remove":
            tool.remove_chosen()
        elif command == "add":
            # Halfway from the chosen point to the next; arrow keys move the new one.
            chosen = tool.chosen[-1] if tool.chosen else 0
            added, number = with_point_after(points, chosen, end_s)
            tool.chosen = (number,)
            tool.changed.emit(added, None)
        elif command in ("next_point", "point_before"):
            tool.choose_next(1 if command == "next_point" else -1)
        elif command == "nudge":
            right, up = arrow_steps(event)
            tool.nudge(right * STEP_S, up * step, self._burst.gesture())


class GlideEdits(PointEdits):
    """Turns changes of the two curves into edits of the glide that a clip plays."""

    def __init__(self, panel: "ClipEditorPanel") -> None:
        self.tool = GlideTool(self._points, panel)
        super().__init__(self.tool, panel)
        # What was drawn: points that bend nothing yet are not part of a glide.
        self._drawn: dict[Column, Points] = {}
        self.tool.changed.connect(self._change)

    def forget(self) -> None:
        self.tool.forget()
        self._drawn = {}

    def can_edit(self, clip: Clip | None) -> bool:
        """Return whether a clip plays a glide."""
        return clip is not None and isinstance(clip.waveform, Glide)

    def press(self, command: str, event: QtGui.QKeyEvent) -> None:
        """Do what a command does to the points."""
        active = self.tool.active
        if command == "flip":
            self.tool.flip()
        elif self._panel.clip is not None:
            end_s = self._panel.clip.waveform.duration_s
            tool, points = self.tool.tools[active], self._points(active)
            self._press(tool, command, event, points, end_s, STEPS[active])

    def _points(self, column: Column) -> Points:
        clip = self._panel.clip
        waveform = None if clip is None else clip.waveform
        if not isinstance(waveform, Glide):
            return ((0.0, 0.0, "straight"),)
        curve, drawn = curve_of(waveform.points, column), self._drawn.get(column, ())
        if drawn and bends_of(_curve(drawn)) == curve:
            return drawn
        return tuple((x, y, "straight") for x, y in curve)

    def _change(self, column: Column, points: Points, gesture: int | None) -> None:
        # Half the sample rate itself cannot be played.
        most = 1.0 if column == "amplitude" else 0.4999 * self._panel.rate_hz
        rounded: Points = tuple(
            (round(x, 12), round(min(y, most), 12), kind) for x, y, kind in points
        )
        self._drawn[column] = rounded
        self._edit(gesture, edits.set_glide_curve, column, _curve(rounded))

    def _give_up(self, gesture: int) -> None:
        self._drawn = {}
        super()._give_up(gesture)


def _curve(points: Points) -> Curve:
    return tuple((x, y) for x, y, _ in points)


class EnvelopeEdits(PointEdits):
    """Turns changes of the points into edits of the clip's envelope."""

    def __init__(self, panel: "ClipEditorPanel") -> None:
        self.tool = EnvelopeTool(self._points, panel)
        super().__init__(self.tool, panel)
        self.tool.changed.connect(
            lambda points, gesture: self._edit(gesture, edits.set_envelope, points)
        )

    def forget(self) -> None:
        self.tool.chosen = ()

    def press(self, command: str, event: QtGui.QKeyEvent) -> None:
        """Do what a command does to the points."""
        if self._panel.clip is not None:
            end_s = self._panel.clip.duration_s
            self._press(self.tool, command, event, self._points(), end_s, STEPS["amplitude"])

    def _points(self) -> Points:
        effects = () if self._panel.clip is None else self._panel.clip.effects
        envelopes = [effect for effect in effects if isinstance(effect, Envelope)]
        return envelopes[-1].points if envelopes else UNCHANGED


_FADES = "Dashed: fades, changed in the timeline or under Effects"
_NO_GLIDE = Refusal(sentence="The clip does not play a glide; choose that waveform first.")
_ZOOM = 1.5


class ClipEditorPanel(Panel):
    """The waveform of the selected clip, large, with tools, and its spectrum.

    Attributes
    ----------
    design, view
        What there is now.
    rate_hz
        Sample rate of what clips play.
    """

    title = "Clip editor"
    name = "clip_editor"
    #: What each clip plays.
    needs = frozenset({"clip_waveforms", "inputs", "sample_rate_hz"})

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.design, self.view = Design(limb=""), View()
        self.rate_hz = facts_of("").sample_rate_hz
        self._waveforms: Mapping[int, Floats] = {}
        self._raw: tuple[Any, Any, Floats | None] = (None, None, None)
        self._unplayable: frozenset[int] = frozenset()
        self._view_tool = ViewTool(self)
        self._pen, self._envelope = PenEdits(self), EnvelopeEdits(self)
        self._glide = GlideEdits(self)
        self._tools: dict[str, Tool] = {
            "look": self._view_tool,
            "pen": self._pen.tool,
            "envelope": self._envelope.tool,
            "glide": self._glide.tool,
        }
        self._canvas = EditorView(self._view_tool)
        self._toolbar, self._spectrum = EditorToolbar(), SpectrumStrip()
        self._empty = page_label("clip_empty", tone="dim", centred=True)
        inside = QtWidgets.QWidget()
        body = EditorBody(self._canvas, self._spectrum)
        in_column(self._toolbar, (body, 1), of=inside, margins=0, gap_px=0)
        self._stack = QtWidgets.QStackedLayout(self)
        self._stack.addWidget(self._empty)
        self._stack.addWidget(inside)
        self.setMinimumSize(260, 176)
        self.setFocusProxy(self._canvas)
        self._toolbar.tool_requested.connect(self.use)
        self._toolbar.fit.clicked.connect(self._canvas.show_everything)
        self._canvas.key_pressed.connect(self._press)
        self._view_tool.pan_requested.connect(self._canvas.pan)

    @property
    def clip(self) -> Clip | None:
        """The clip that was selected last, or the first one of the selected track."""
        return leading_clip(self.design, self.view)

    def show_state(self, design: Design, view: View) -> None:
        self.design, self.view = design, view
        self._show()

    def start_over(self) -> None:
        self._waveforms = {}
        self._canvas.show_clip(None, None, None, self.rate_hz)

    def show_results(self, results: Mapping[str, Any]) -> None:
        self.rate_hz = results["sample_rate_hz"]
        self._waveforms = waveforms_of(results)
        self._show()

    def show_unplayable(self, unplayable: tuple[UnplayableInput, ...]) -> None:
        self._unplayable = frozenset(track.id for track in unplayable)
        if self.clip is not None:
            self._show_text(self.clip)

    def show_staleness(self, stale: bool) -> None:
        self._canvas.item.show_staleness(stale)

    def show_problem(self, reason: str) -> None:
        self._waveforms = {}
        self._show()
        self._toolbar.show_text(reason, enabled=self.clip is not None)

    def use(self, tool: str) -> None:
        """Use a tool; ask once whether a clip of another kind may become samples."""
        clip = self.clip
        if tool == "pen" and clip is not None and not self._pen.may_draw(clip):
            # During the question no other tool is active.
            self._switch_to("look")
            tool = "pen" if self._pen.is_allowed(clip) else "look"
        if tool == "glide" and not self._glide.can_edit(clip):
            self.edited.emit(_NO_GLIDE, None)
            tool = "look"
        self._switch_to(tool)
        # After a question the keyboard may be elsewhere.
        self._canvas.setFocus(Qt.FocusReason.OtherFocusReason)

    def _switch_to(self, tool: str) -> None:
        self._canvas.use(self._tools[tool])
        self._toolbar.tools[tool].setChecked(True)
        self._show()

    def _show(self) -> None:
        clip = self.clip
        shown = self._canvas.content
        if clip is None or shown is None or clip.id != shown.clip.id:
            self._envelope.forget()
            self._glide.forget()
        self._stack.setCurrentIndex(0 if clip is None else 1)
        if clip is None:
            has_inputs = bool(self.design and self.design.inputs)
            self._empty.setText(HOW_TO_SELECT_CLIP if has_inputs else how_to_add())
            self._canvas.show_clip(None, None, None, self.rate_hz)
            return
        if self._canvas.tool is self._glide.tool and not self._glide.can_edit(clip):
            self.use("look")
        self._toolbar.tools["glide"].setVisible(self._glide.can_edit(clip))
        timed = tuple(effect for effect in clip.effects if changes_time(effect))
        # Points of a glide lie in the time of its waveform.
        kept = () if self._canvas.tool is self._glide.tool else timed
        raw, plays = self._sampled(clip, kept), self._waveforms.get(clip.id)
        if raw is not None and kept == tuple(effect for effect in clip.effects if effect.on):
            plays = raw
        self._canvas.show_clip(clip, raw, plays if kept == timed else None, self.rate_hz)
        band_hz = facts_of(self.design.limb).band_hz
        self._spectrum.show_samples(plays, self.rate_hz, band_hz)
        self._show_text(clip)

    def _show_text(self, clip: Clip) -> None:
        text = _description(clip, self.design)
        if self.view.selected_input in self._unplayable and not clip.muted:
            text = f"{text} · cannot be played"
        tool = self._canvas.tool
        fades = tool is self._envelope.tool and any(faded_ends(clip))
        self._toolbar.show_text(text, enabled=True, hint=_FADES if fades else tool.hint)

    def _sampled(self, clip: Clip, timed: tuple[Effect, ...]) -> Floats | None:
        """Return the part of its waveform that trims leave; it is sampled once.

        None where another effect changes the time: stretching a long waveform takes seconds.
        """
        waveform, rate_hz = clip.waveform, self.rate_hz
        # The pen draws on what the clip holds, wherever between two samples it begins.
        shift_s = placed(waveform, timed, clip.onset_s, rate_hz)[1] if timed else 0.0
        before, key, samples = self._raw
        if before is not waveform or key != (timed, rate_hz, shift_s):
            samples = None
            if all(isinstance(effect, Trim) for effect in timed):
                # Other panels show the reason.
                with suppress(InvalidInputError):
                    samples = played(waveform, timed, rate_hz, shift_s)
            self._raw = waveform, (timed, rate_hz, shift_s), samples
        return samples

    def _press(self, event: QtGui.QKeyEvent) -> None:
        command = meaning_of("clip_editor", event)
        if command in self._tools:
            self.use(command)
        elif command in ("zoom_in", "zoom_out"):
            self._canvas.zoom(_ZOOM if command == "zoom_in" else 1 / _ZOOM)
        elif command == "whole":
            self._canvas.show_everything()
        elif command == "give_up":
            self.use("look")
        else:
            # Keys change only points that are visible.
            for shaper in (self._glide, self._envelope):
                if self._canvas.tool is shaper.tool:
                    shaper.press(command, event)
            self._canvas.lay_out()


def _description(clip: Clip, design: Design) -> str:
    """Return where a clip plays, and what."""
    place = input_name(design.track_of(clip.id).location, design.limb)
    label = f"{clip.label} · " if clip.label else ""
    figure = f"{clip_text(clip)} · {duration_text(clip.duration_s)}"
    return f"{label}{place.number} {place.short_name} · {figure}"
