"""Designs, their inputs, snapshots of them, and the view on one: what files of designs hold.

All are plain immutable values, without arrays or files.  The view is what the studio shows.
"""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.rigs import Rig
from skinsource.base.arguments import brief, checking
from skinsource.base.conventions import MOST_LOCATIONS, Axes
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.design import labels
from skinsource.design.clips import GAIN as CLIP_GAIN
from skinsource.design.clips import ID, LATEST_S, MAX_CLIPS, PLACE, Clip, Marker, numbered
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.own_limbs import outputs_on
from skinsource.limbs.scaling import Scaling
from skinsource.signals.analysis.windows import MOST_WINDOWS
from skinsource.signals.loudest_window import Span
from skinsource.signals.projection import Method
from skinsource.specs import fields, models
from skinsource.specs.numbers import (
    CurveSpec,
    ListSpec,
    ModelSpec,
    NumberSpec,
    OptionalSpec,
    Range,
    RangeSpec,
)
from skinsource.specs.spec import ChoiceSpec, PlainSpec, SwitchSpec, TextSpec, ValidationError

if TYPE_CHECKING:  # motions write inputs
    from skinsource.design.motions import Motion

#: Several inputs can share a place; more than a hundred would be a mistake.
MAX_INPUTS = 100
MAX_MARKERS = 1000

AMPLITUDE = replace(CLIP_GAIN, label="Amplitude", hint="A negative amplitude inverts the polarity")
#: For an input whose amplitude is a plain factor, see `skinsource.design.amplitudes.is_gain`.
AMPLITUDE_GAIN = replace(
    AMPLITUDE,
    label="Input gain",
    unit="×",
    hint="Factor on what the clips play; a negative gain inverts the polarity",
)

TITLE = TextSpec(label="Title", longest=200, one_line=True)
AUTHOR = TextSpec(label="Author", longest=200, one_line=True)
NOTES = TextSpec(label="Notes", longest=20_000)
LICENCE = TextSpec(label="Licence", longest=2_000)

CLIPS = ListSpec(label="Clips", of=ModelSpec(label="Clip", kinds=lambda: (Clip,)), most=MAX_CLIPS)
GAIN_CURVE = CurveSpec(
    label="Gain curve",
    hint="Factor on all clips of the input, over time",
    x=NumberSpec(label="Time", unit="s", minimum=0.0, maximum=LATEST_S),
    y=NumberSpec(label="Gain", minimum=0.0, maximum=1000.0),
    fewest=0,
    most=1000,
)
MUTED = SwitchSpec(label="Mute", hint="A muted input is silent")
SOLO = SwitchSpec(label="Solo", hint="If any input is solo, only solo inputs play")
COLOUR = NumberSpec(label="Colour", minimum=0, maximum=2**31 - 1, whole=True)

LIMB = TextSpec(label="Limb", longest=200, one_line=True)
LIMB_DIGEST = TextSpec(label="Digest of the limb", longest=64, one_line=True)
INPUTS = ListSpec(
    label="Inputs", of=ModelSpec(label="Input", kinds=lambda: (Input,)), most=MAX_INPUTS
)
MARKERS = ListSpec(
    label="Markers", of=ModelSpec(label="Marker", kinds=lambda: (Marker,)), most=MAX_MARKERS
)
LOOP = RangeSpec(label="Loop", unit="s", minimum=0.0, maximum=LATEST_S)
ACTUATION = OptionalSpec(
    label="Actuators", of=ModelSpec(label="Actuators", kinds=lambda: (Actuation,))
)
RIG = OptionalSpec(
    label="Rig", of=ModelSpec(label="Rig", kinds=lambda: (Rig,)), left_out_empty=True
)


def _choice_of(label: str, options: tuple[labels.Word, ...]) -> ChoiceSpec:
    return ChoiceSpec(label=label, options=tuple((option.name, option.title) for option in options))


SCALING = _choice_of("Scaling", labels.SCALINGS)


@dataclass(frozen=True, slots=True, kw_only=True)
class Input(fields.CheckedModel, models.Nesting):
    """A track: clips at an input location.

    It plays the sum of its clips that are not muted, each from its onset, times the gain curve.
    `track` makes an input with a single clip.

    Attributes
    ----------
    location
        Input place, from 1 to `Limb.n_inputs` of the limb.
    clips
        What it plays, in any order; without clips it is silent.
    amplitude
        Factor; its unit follows from the design, see `skinsource.design.amplitudes.amplitude_unit`.
    gain_curve
        Breakpoints, s and factor, straight between them and level before the first and after the
        last; empty: no change.
    muted, solo
        A muted input is silent.  If any input is solo, only solo inputs are audible.
    colour
        Number of its colour, which never changes, so that removing one input changes no colours.
    id
        Number that is unique among the inputs of a design, from 1; 0: the design gives it one.
    """

    location: int = fields.field(PLACE)
    clips: tuple[Clip, ...] = fields.field(CLIPS, ())
    amplitude: float = fields.number(1.0, AMPLITUDE)
    gain_curve: tuple[tuple[float, float], ...] = fields.field(GAIN_CURVE, ())
    muted: bool = fields.switch(False, MUTED)
    solo: bool = fields.switch(False, SOLO)
    colour: int = fields.number(0, COLOUR)
    id: int = fields.number(0, ID)


def _motions() -> tuple[type[Motion], ...]:
    motions = importlib.import_module("skinsource.design.motions").MOTIONS
    return (*motions, importlib.import_module("skinsource.design.target").Target)


CLIP_IDS = ListSpec(label="Clips", of=ID, most=MAX_INPUTS * MAX_CLIPS, different=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionGroup(fields.CheckedModel):
    """A motion in a design, which can be changed again.

    Attributes
    ----------
    motion
        What wrote the clips.
    clips
        Ids of the clips, in the order in which the motion writes them.
    """

    motion: Motion = fields.field(ModelSpec(label="Motion", kinds=_motions))
    clips: tuple[int, ...] = fields.field(CLIP_IDS)


MOTIONS = ListSpec(
    label="Motions",
    of=ModelSpec(label="Motion", kinds=lambda: (MotionGroup,)),
    most=MAX_INPUTS,
    left_out_empty=True,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """Everything that is saved, undone and redone.

    Attributes
    ----------
    limb
        Name of the limb, see `skinsource.load_limb`; it need not be available here.
    limb_digest
        SHA-256 of all numbers of an imported limb, see `skinsource.limbs.own_limbs.facts_of`.
        Empty: any limb of this name.
    inputs
        In the order of the list.  Inputs and clips without an id get one.
    scaling
        ``"upstream"``, ``"relative"`` or ``"probe"``, see `skinsource.predict`.  The default is
        probe scaling, because there a new clip does not change the effect of the others.
    actuation
        Actuators, the equaliser that makes their voltages, and whether predictions go through both;
        the output of the equaliser is exported and played in either case. None: no actuators.
    rig
        The wiring that is exported and played for; None: not known.
    markers
        Names for times.
    loop_s
        Begin and end of the loop that is played again and again; None: no loop.
    motions
        Motions whose clips are as they wrote them.
    title, author, notes, licence
        Texts about the design; nothing is computed from them.
    """

    limb: str = fields.field(LIMB)
    inputs: tuple[Input, ...] = fields.field(INPUTS, ())
    scaling: Scaling = fields.choice("probe", SCALING)
    actuation: Actuation | None = fields.field(ACTUATION, None)
    rig: Rig | None = fields.field(RIG, None)
    markers: tuple[Marker, ...] = fields.field(MARKERS, ())
    loop_s: Range | None = fields.interval(None, LOOP)
    title: str = fields.text("", TITLE)
    author: str = fields.text("", AUTHOR)
    notes: str = fields.text("", NOTES)
    licence: str = fields.text("", LICENCE)
    limb_digest: str = fields.text("", LIMB_DIGEST)
    motions: tuple[MotionGroup, ...] = fields.field(MOTIONS, ())

    def __post_init__(self) -> None:
        fields.check(self)
        object.__setattr__(self, "inputs", _with_ids(self.inputs))

    def _repr_html_(self) -> str:
        """Return the HTML that a notebook shows."""
        return importlib.import_module("skinsource.design.displaying").html_of(self)

    @property
    def ids(self) -> tuple[int, ...]:
        """Ids of the inputs, in their order."""
        return tuple(track.id for track in self.inputs)

    @property
    def actuated(self) -> Actuation | None:
        """The actuators of the prediction; None where they are switched off."""
        return self.actuation if self.actuation is not None and self.actuation.on else None

    def input(self, id: int) -> Input:
        """The input with this id."""
        return self.inputs[self.index_of(id)]

    def index_of(self, id: int) -> int:
        """The index in `inputs` of the input with this id."""
        for index, track in enumerate(self.inputs):
            if track.id == id:
                return index
        known = ", ".join(map(str, self.ids)) or "none"
        raise InvalidInputError(f"no input has the id {quoted(id)}; there are {known}")

    @property
    def clips(self) -> tuple[Clip, ...]:
        """The clips of all inputs, track by track."""
        return tuple(clip for track in self.inputs for clip in track.clips)

    def clip(self, id: int) -> Clip:
        """The clip with this id."""
        for clip in self.clips:
            if clip.id == id:
                return clip
        raise InvalidInputError(f"no clip has the id {quoted(id)}; there are {len(self.clips)}")

    def track_of(self, clip_id: int) -> Input:
        """The input that the clip with this id is on."""
        clip = self.clip(clip_id)
        return next(track for track in self.inputs if any(other is clip for other in track.clips))

    def with_input(self, index: int, **changes: Any) -> Design:
        """Return a copy in which input ``index`` has ``changes`` applied."""
        inputs = list(self.inputs)
        inputs[index] = replace(inputs[index], **changes)
        return replace(self, inputs=tuple(inputs))

    def with_clip(self, id: int, **changes: Any) -> Design:
        """Return a copy in which the clip with this id has ``changes`` applied."""
        changed = replace(self.clip(id), **changes)
        track = self.track_of(id)
        clips = tuple(changed if clip.id == id else clip for clip in track.clips)
        return self.with_input(self.index_of(track.id), clips=clips)

    def adding(self, new: Input) -> Design:
        """Return a copy with one more input, which gets its own colour and ids."""
        used = {present.colour for present in self.inputs}
        colour = next(k for k in range(MAX_INPUTS + 1) if k not in used)
        clips = tuple(replace(clip, id=0) for clip in new.clips)
        added = replace(new, colour=colour, id=0, clips=clips)
        return replace(self, inputs=(*self.inputs, added))

    def without_input(self, index: int) -> Design:
        """Return a copy without input ``index``."""
        inputs = list(self.inputs)
        del inputs[index]
        return replace(self, inputs=tuple(inputs))


@checking
def track(
    location: int, waveform: Waveform | None = None, *, onset_s: float = 0.0, **changes: Any
) -> Input:
    """Return an input that plays one waveform.

    Parameters
    ----------
    location
        Input place, from 1.
    waveform
        What it plays; a `Tone` where none is given.
    onset_s
        When it starts.
    changes
        Other fields of `Input`: ``amplitude=0.5``.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.track(7, ss.waveforms.Tap(), onset_s=0.1).clips[0].onset_s)
    0.1
    """
    clip = Clip(waveform=Tone() if waveform is None else waveform, onset_s=onset_s)
    return Input(location=location, clips=(clip,), **changes)


def _with_ids(inputs: tuple[Input, ...]) -> tuple[Input, ...]:
    """Give ids to inputs and clips without one; check that no id comes twice."""
    ids_given = [track.id for track in inputs]
    ids = numbered(ids_given, "inputs")
    of_clips = [clip.id for track in inputs for clip in track.clips]
    clip_ids = iter(numbered(of_clips, "clips"))
    if all(ids_given) and all(of_clips):
        return inputs
    with_ids = []
    for track, id in zip(inputs, ids, strict=True):
        clips = tuple(_with_id(clip, next(clip_ids)) for clip in track.clips)
        same = track.id == id and all(a is b for a, b in zip(clips, track.clips, strict=True))
        with_ids.append(track if same else replace(track, id=id, clips=clips))
    return tuple(with_ids)


def _with_id(clip: Clip, id: int) -> Clip:
    # A clip that has an id stays the same object.
    return clip if clip.id == id else replace(clip, id=id)


def audible_indices(inputs: tuple[Input, ...]) -> tuple[int, ...]:
    """Return the indices of the audible inputs: the solo ones, if any, without muted ones."""
    solo = [index for index, track in enumerate(inputs) if track.solo]
    return tuple([index for index in solo or range(len(inputs)) if not inputs[index].muted])


def audible_inputs(inputs: tuple[Input, ...]) -> tuple[Input, ...]:
    """Return the audible inputs."""
    return tuple([inputs[index] for index in audible_indices(inputs)])


def played_clips(design: Design) -> list[Clip]:
    """Return the clips that are heard."""
    tracks = audible_inputs(design.inputs)
    return [clip for track in tracks for clip in track.clips if not clip.muted]


#: Numbers of outputs, or ids of inputs or clips.
Numbers = tuple[int, ...]
#: The value of one field of a panel's settings.
Plain = None | bool | int | float | str | tuple[float, ...]
#: Settings of panels: (name of the panel, ((name of a field, its value), …)), by name.
PanelFields = tuple[tuple[str, tuple[tuple[str, Plain], ...]], ...]

AXES = _choice_of("Axes", labels.AXES)
METHOD = _choice_of("Method", labels.METHODS)
SPAN = _choice_of("Levels", labels.SPANS)
OUTPUTS = ListSpec(
    label="Outputs",
    of=NumberSpec(label="Output", minimum=1, maximum=MOST_LOCATIONS, whole=True),
    most=MOST_LOCATIONS,
    different=True,
)
SELECTED_INPUTS = ListSpec(
    label="Selected inputs",
    of=NumberSpec(label="Id of an input", minimum=1, maximum=2**31 - 1, whole=True),
    different=True,
)
SELECTED_CLIPS = ListSpec(
    label="Selected clips",
    of=NumberSpec(label="Id of a clip", minimum=1, maximum=2**31 - 1, whole=True),
    most=100_000,
    different=True,
)
PLAYHEAD = NumberSpec(label="Playhead", unit="s", minimum=0.0, maximum=1e6)
SLOW_MOTION = NumberSpec(
    label="Slow motion",
    minimum=0.0,
    maximum=1000.0,
    hint="How many times slower than real time; sound plays only at 1",
    unset="automatic",
)
DELAY_REMOVED = SwitchSpec(label="Remove pre-trigger delay")
TIME_RANGE = RangeSpec(label="Zoom of time axes", unit="s")
WINDOWS_CUT = ChoiceSpec(
    label="Windows",
    options=(("count", "By number"), ("length", "By length")),
    hint="How the response is cut into consecutive windows",
)
WINDOW_COUNT = NumberSpec(
    label="Number",
    minimum=1,
    maximum=MOST_WINDOWS,
    whole=True,
    hint="Number of windows in the stimulus",
)
WINDOW_LENGTH = NumberSpec(
    label="Length",
    unit="s",
    minimum=0.005,
    maximum=60.0,
    step=0.005,
    hint="Length of each window",
)
PANELS = PlainSpec(label="Settings of panels")


#: Numbers under which the user stores snapshots.
NUMBERS: tuple[int, ...] = (1, 2, 3, 4)
#: Number of the edited design that was not stored when another one was shown.
EDITED = 0

NUMBER = NumberSpec(label="Number", minimum=0, maximum=max(NUMBERS), whole=True)
GAIN = NumberSpec(label="Gain", minimum=1e-12, maximum=1e12)


@dataclass(frozen=True, slots=True, kw_only=True)
class Snapshot:
    """A design stored under a number.

    Attributes
    ----------
    number
        1 to 4; 0 is the design that was edited when a snapshot was shown.
    title
        Its own, which the user gave it; empty: it is called as its design.
    gain
        Factor on predictions and playback that matched its level when it was shown last; it is
        not in the amplitudes of ``design``.
    """

    number: int = fields.number(EDITED, NUMBER)
    title: str = fields.text("", replace(TITLE, left_out_empty=True))
    design: Design = fields.field(ModelSpec(label="Design", kinds=lambda: (Design,)))
    gain: float = fields.number(1.0, GAIN)

    def __post_init__(self) -> None:
        fields.check(self)
        # `played` must not fail later.
        louder(self.design, self.gain)

    @property
    def played(self) -> Design:
        """The design as loud as it was when it was shown last."""
        return louder(self.design, self.gain)


def louder(design: Design, gain: float) -> Design:
    """Return ``design`` with all amplitudes times ``gain``; every level rises by 20 log10(gain).

    Raises
    ------
    InvalidInputError
        An amplitude would be larger than any input may have.
    """
    if gain == 1.0:
        return design
    inputs = tuple(replace(track, amplitude=track.amplitude * gain) for track in design.inputs)
    return replace(design, inputs=inputs)


def shown_snapshot(snapshots: Sequence[Snapshot], design: Design) -> Snapshot | None:
    """Return the snapshot that holds ``design``, if any."""
    # The one that was shown last is the last.
    return next((snapshot for snapshot in reversed(snapshots) if snapshot.design == design), None)


@dataclass(frozen=True, slots=True, kw_only=True)
class SnapshotSpec(ModelSpec):
    """A snapshot, which is not checked again for each new view: it was checked when made."""

    def checked(self, value: Any) -> Any:
        """Return ``value`` itself."""
        if not isinstance(value, Snapshot):
            raise ValidationError("a Snapshot")
        return value


SNAPSHOTS = ListSpec(
    label="Snapshots",
    of=SnapshotSpec(label="Snapshot", kinds=lambda: (Snapshot,)),
    most=1 + len(NUMBERS),
)
LEVELS_MATCHED = SwitchSpec(
    label="Match levels", hint="Show snapshots with equal levels in their loudest 100 ms"
)


@brief
@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """What the studio shows of a design.

    Attributes
    ----------
    axes, method
        See `skinsource.project_axes`.
    span
        What levels average over: ``"record"``, the whole response, or its ``"loudest"`` window.
    outputs
        Selected outputs, from 1 to `Limb.n_outputs` of the limb, in the order of selection.
    selected_inputs
        Ids of the selected inputs; the one that was selected last is last.  An id that no input of
        the design has selects nothing.
    selected_clips
        Ids of the selected clips in the order of selection.  If no clip of a selected input is
        selected, its first clip counts.
    playhead_s
        Time of the playhead.
    slow_motion
        How many times slower than in reality the animation plays; 0: as its waves can be followed.
    delay_removed
        Whether time axes are shifted by the pre-trigger delay of the responses.
    time_range_s
        Zoom of time axes; ``None``: everything.
    windows_cut, window_count, window_s
        Whether the response is cut into ``window_count`` windows, or into windows of ``window_s``:
        see `skinsource.signals.analysis.windows.windows_over`.
    snapshots
        Designs to compare with, each with its own number; the one that was stored or shown last is
        last.
    levels_matched
        Whether snapshots are shown and played at matched levels; exports never are.
    panels
        Settings of single panels, see `skinsource.design.panel_settings`.
    """

    axes: Axes = fields.choice("xyz", AXES)
    method: Method = fields.choice("pca", METHOD)
    span: Span = fields.choice("record", SPAN)
    outputs: Numbers = fields.field(OUTPUTS, (29, 52))
    selected_inputs: Numbers = fields.field(SELECTED_INPUTS, (1,))
    selected_clips: Numbers = fields.field(SELECTED_CLIPS, ())
    playhead_s: float = fields.number(0.0, PLAYHEAD)
    slow_motion: float = fields.number(1.0, SLOW_MOTION)
    delay_removed: bool = fields.switch(False, DELAY_REMOVED)
    time_range_s: Range | None = fields.interval(None, TIME_RANGE)
    windows_cut: str = fields.choice("count", WINDOWS_CUT)
    window_count: int = fields.number(5, WINDOW_COUNT)
    window_s: float = fields.number(0.12, WINDOW_LENGTH)
    snapshots: tuple[Snapshot, ...] = fields.field(SNAPSHOTS, ())
    levels_matched: bool = fields.switch(False, LEVELS_MATCHED)
    panels: PanelFields = fields.field(PANELS, ())

    def __post_init__(self) -> None:
        fields.check(self)
        numbers = [snapshot.number for snapshot in self.snapshots]
        if len(set(numbers)) < len(numbers):
            raise InvalidInputError(
                f"View.snapshots have the numbers {numbers}, expected different ones"
            )
        if not _is_table(self.panels) or not all(
            _is_table(settings) for _, settings in self.panels
        ):
            raise InvalidInputError(
                f"View.panels is {quoted(self.panels)}, expected pairs of a panel's name and its "
                "fields, each once"
            )
        in_order = tuple((name, tuple(sorted(settings))) for name, settings in sorted(self.panels))
        # Unchanged settings stay the same object, by which panels find what they cached.
        if in_order != self.panels:
            object.__setattr__(self, "panels", in_order)

    def match_gain(self, design: Design) -> float:
        """Return the factor with which ``design`` is shown and played.

        It is the gain of the snapshot that holds ``design``; an edited design has the factor 1.
        """
        snapshot = shown_snapshot(self.snapshots, design) if self.levels_matched else None
        return 1.0 if snapshot is None else snapshot.gain

    @property
    def selected_input(self) -> int | None:
        """Id of the input that was selected last, or None."""
        return self.selected_inputs[-1] if self.selected_inputs else None

    @property
    def selected_clip(self) -> int | None:
        """Id of the clip that was selected last, or None."""
        return self.selected_clips[-1] if self.selected_clips else None


def _is_table(pairs: Any) -> bool:
    """Whether these are pairs of a name and a value, with different names."""
    if not isinstance(pairs, tuple):
        return False
    if not all(isinstance(pair, tuple) and len(pair) == 2 for pair in pairs):
        return False
    names = [name for name, _ in pairs]
    return all(isinstance(name, str) and name for name in names) and len(set(names)) == len(names)


def view_on(limb: str, view: View) -> View:
    """Return a view for a limb, without selected outputs that the limb does not have."""
    outputs = outputs_on(limb, view.outputs)
    return view if outputs == view.outputs else replace(view, outputs=outputs)
