"""The view on a design: what the studio shows, an immutable value that is saved with the design."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from skinsource.base.arguments import brief
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.base.measurement_conditions import MOST_LOCATIONS, Axes
from skinsource.design import labels
from skinsource.design.comparing import NUMBERS, Snapshot, shown_snapshot
from skinsource.design.design import Design
from skinsource.limbs.own_limbs import outputs_on
from skinsource.signals.analysis.windows import MOST_WINDOWS
from skinsource.signals.loudest_window import Span
from skinsource.signals.projection import Method
from skinsource.specs import fields
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec, Range, RangeSpec
from skinsource.specs.spec import ChoiceSpec, PlainSpec, SwitchSpec, ValidationError

#: Numbers of outputs, or ids of inputs or clips.
Numbers = tuple[int, ...]
#: The value of one field of a panel's settings.
Plain = None | bool | int | float | str | tuple[float, ...]
#: Settings of panels: (name of the panel, ((name of a field, its value), …)), by name.
PanelFields = tuple[tuple[str, tuple[tuple[str, Plain], ...]], ...]


def _choice_of(label: str, options: tuple[labels.Word, ...]) -> ChoiceSpec:
    return ChoiceSpec(label=label, options=tuple((option.name, option.title) for option in options))


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
    label="Match levels", hint="Show snapshots with equal levels at their loudest outputs"
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
