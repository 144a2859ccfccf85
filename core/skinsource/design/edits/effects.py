"""Change what inputs and clips play: their waveforms, effects, numbers and drawn curves.

A waveform or an effect can hold a list of parts: a clip is a part of layers, an effect a part of a
clip.  `choices_of`, `new_part` and the functions after them work on such lists; what they return is
set with `change_field`, as any other value of a field.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from math import isfinite
from typing import Any, TypeAlias, TypeVar

from skinsource.base.arguments import checking, one_of
from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError, counted, quoted
from skinsource.design.clips import GAIN, LABEL, MAX_EFFECTS, ONSET, Clip
from skinsource.design.design import AMPLITUDE, GAIN_CURVE, Design, Input, View
from skinsource.design.edits.clips import chosen_clips, clips_text, present_clips
from skinsource.design.edits.edit import (
    NOTHING_CHOSEN,
    Edit,
    KindSpec,
    Refusal,
    as_kind,
    change_clips,
    change_inputs,
    clip_of,
    clips_of,
    location_text,
    nearest,
    present_inputs,
    refusing,
    with_field,
)
from skinsource.design.effects import effect_kinds
from skinsource.design.effects.effect import Effect, KeepsTime
from skinsource.design.effects.level import BandLimit, Envelope, Fade
from skinsource.design.effects.playing import played
from skinsource.design.effects.time import Reverse, Trim
from skinsource.design.labels import span_label
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms import kinds as waveform_kinds
from skinsource.design.waveforms.samples import Drawn
from skinsource.design.waveforms.tones import Glide
from skinsource.design.waveforms.wavelet_train import SOFTEST_DB, WaveletTrain
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.synthesis import Column, Curve, with_curve
from skinsource.specs.breakpoints import Breakpoint
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec
from skinsource.specs.samples import Samples
from skinsource.specs.spec import ChoiceSpec, Spec

_NO_EFFECT = "That effect is no longer there; choose another one."
_TOO_MANY_EFFECTS = Refusal(sentence=f"A clip has at most {MAX_EFFECTS} effects; remove one first.")
_FADE_S = 0.02
Kind = TypeVar("Kind")


@refusing
def add_effect(
    design: Design, view: View, ids: Iterable[int], kind: str, index: int | None = None
) -> Edit | Refusal:
    """Add a new effect to clips, before the ``index``-th effect of each; None: at the end.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.add_effect(design, ss.View(), [1], "Fade")
    >>> print(type(edit.design.clips[0].effects[0]).__name__)
    Fade
    """
    effect_kind = _kind_called(kind, effect_kinds(), "effect")
    chosen = chosen_clips(design, ids)
    if any(len(clip.effects) >= MAX_EFFECTS for clip in chosen):
        return _TOO_MANY_EFFECTS
    at = MAX_EFFECTS if index is None else max(index, 0)
    effects = {
        clip.id: (*clip.effects[:at], _new_effect(effect_kind, clip), *clip.effects[at:])
        for clip in chosen
    }
    return _with_effects(design, view, f"Add {effect_kind.title.lower()} to", effects)


@refusing
def remove_effect(design: Design, view: View, id: int, index: int) -> Edit | Refusal:
    """Remove an effect from a clip.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> faded = ss.edits.fade_clip(design, ss.View(), 1, 0.01, 0.05).design
    >>> edit = ss.edits.remove_effect(faded, ss.View(), 1, 0)
    >>> print(edit.design.clips[0].effects)
    ()
    """
    clip = _with_effect(design, id, index)
    verb = f"Remove {clip.effects[index].title.lower()} from"
    return _with_effects(design, view, verb, {id: without_part(clip.effects, index)})


@refusing
def move_effect(design: Design, view: View, id: int, index: int, to: int) -> Edit | Refusal:
    """Move an effect to another place among the effects of its clip, from 0, within the list.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> both = ss.edits.add_effect(design, ss.View(), [1], "Fade").design
    >>> both = ss.edits.add_effect(both, ss.View(), [1], "Envelope").design
    >>> edit = ss.edits.move_effect(both, ss.View(), 1, 0, 1)
    >>> print([type(effect).__name__ for effect in edit.design.clips[0].effects])
    ['Envelope', 'Fade']
    """
    clip = _with_effect(design, id, index)
    effects = moved_part(clip.effects, index, to)
    return _with_effects(design, view, "Reorder effects of", {id: effects})


@refusing
def switch_effect(design: Design, view: View, id: int, index: int, on: bool) -> Edit | Refusal:
    """Switch an effect on or off.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> faded = ss.edits.fade_clip(design, ss.View(), 1, 0.01, 0.05).design
    >>> edit = ss.edits.switch_effect(faded, ss.View(), 1, 0, False)
    >>> print(edit.design.clips[0].effects[0].on)
    False
    """
    clip = _with_effect(design, id, index)
    verb = f"Switch {clip.effects[index].title.lower()} {'on' if on else 'off'} in"
    return _with_effect_field(design, view, verb, clip, index, "on", on)


@refusing
def change_effect_field(
    design: Design, view: View, id: int, index: int, name: str, value: Any
) -> Edit | Refusal:
    """Set a field of an effect.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> faded = ss.edits.fade_clip(design, ss.View(), 1, 0.01, 0.05).design
    >>> edit = ss.edits.change_effect_field(faded, ss.View(), 1, 0, "out_s", 0.1)
    >>> print(edit.design.clips[0].effects[0].out_s)
    0.1
    """
    clip = _with_effect(design, id, index)
    if name not in specs_of(clip.effects[index]):
        raise InvalidInputError(_NO_EFFECT)
    label = specs_of(clip.effects[index])[name].label.lower()
    verb = f"Change {label} of"
    return _with_effect_field(design, view, verb, clip, index, name, value)


@refusing
def set_envelope(
    design: Design, view: View, id: int, points: tuple[Breakpoint, ...]
) -> Edit | Refusal:
    """Set the points of the last envelope of a clip; a clip without one gets it as last effect.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.set_envelope(design, ss.View(), 1, ((0.0, 1.0), (0.2, 0.0)))
    >>> print(edit.label)
    Change envelope of clip at 7 (II pad)
    """
    (clip,) = chosen_clips(design, (id,))
    envelope = Envelope(points)
    places = [k for k, effect in enumerate(clip.effects) if isinstance(effect, Envelope)]
    if places:
        effects = with_part(clip.effects, places[-1], envelope)
    elif len(clip.effects) < MAX_EFFECTS:
        effects = (*clip.effects, envelope)
    else:
        return _TOO_MANY_EFFECTS
    return _with_effects(design, view, "Change envelope of", {id: effects})


def _new_effect(kind: type[Effect], clip: Clip) -> Effect:
    """Return a new effect that fits the length of a clip."""
    length_s = float(f"{min(clip.duration_s, 600.0):.12g}")
    if kind is Envelope and length_s > 0.0:
        return Envelope(((0.0, 1.0, "straight"), (length_s, 1.0, "straight")))
    if kind is Fade:
        fade_s = min(_FADE_S, float(f"{length_s / 4.0:.3g}"))
        return Fade(fade_s, fade_s)
    if kind is Trim:
        return Trim(0.0, length_s)
    return kind()


def _with_effect(design: Design, id: int, index: int) -> Clip:
    """Return the clip that has an effect with this index."""
    for clip in present_clips(design, (id,)):
        if 0 <= index < len(clip.effects):
            return clip
    raise InvalidInputError(_NO_EFFECT)


def _with_effect_field(
    design: Design, view: View, verb: str, clip: Clip, index: int, name: str, value: Any
) -> Edit:
    effect: Any = clip.effects[index]
    effects = with_part(clip.effects, index, replace(effect, **{name: value}))
    return _with_effects(design, view, verb, {clip.id: effects})


def _with_effects(
    design: Design, view: View, verb: str, effects: dict[int, tuple[Effect, ...]]
) -> Edit:
    """Give clips, by id, other effects."""
    after = change_clips(design, {id: {"effects": each} for id, each in effects.items()})
    label = f"{verb} {clips_text(design, present_clips(design, effects))}"
    return Edit(label=label, design=after, view=view)


Parts = tuple[Any, ...]


def choices_of(spec: ModelSpec) -> ChoiceSpec:
    """Return a choice among the kinds that a part can be, by name and title.

    Where there is only one kind, what it holds is chosen: for a clip its waveform.
    """
    kinds = _kinds_to_choose(spec)
    options = tuple((kind.__name__, _title(kind)) for kind in kinds)
    spec_kind = KindSpec if set(kinds) <= set(waveform_kinds()) else ChoiceSpec
    return spec_kind(label=spec.label, hint=spec.hint, options=options)


def new_part(spec: ModelSpec, name: str, holder: Any = None) -> Any:
    """Make a part of the kind that was chosen of `choices_of` ``spec``.

    An effect fits the clip ``holder`` that will hold it.

    Raises
    ------
    InvalidInputError
        No kind that can be chosen has this name.
    """
    kinds, chosen = spec.kinds(), _kinds_to_choose(spec)
    named = {kind.__name__: kind for kind in chosen}
    kind = named[one_of(spec.label, name, tuple(named))]
    inner = _inner_field(kinds[0])
    if kind not in kinds and inner is not None:
        return kinds[0](**{inner[0]: kind()})
    if kind in effect_kinds() and isinstance(holder, Clip):
        return _new_effect(kind, holder)
    return kind()


def part_text(part: Any) -> str:
    """Return the user's label of a part, or the title of its kind or of what it holds."""
    inner = _inner_field(type(part))
    inner_title = _title(type(getattr(part, inner[0]))) if inner else ""
    text = getattr(part, "label", "") or inner_title or _title(type(part))
    off = getattr(part, "muted", False) or not getattr(part, "on", True)
    return f"{text} (off)" if off else text


def without_part(parts: Parts, index: int) -> Parts:
    """Return the parts without the one at an index."""
    return (*parts[:index], *parts[index + 1 :])


def moved_part(parts: Parts, index: int, to: int) -> Parts:
    """Return the parts with one moved to another index, within the list."""
    rest = list(parts)
    moved = rest.pop(index)
    rest.insert(min(max(to, 0), len(rest)), moved)
    return tuple(rest)


def with_part(parts: Parts, index: int, part: Any) -> Parts:
    """Return the parts with the one at an index replaced."""
    return (*parts[:index], part, *parts[index + 1 :])


def change_text(spec: Spec, before: Any, after: Any) -> str:
    """Name a change of a field for the history: "Change onset of", "Add to parts of"."""
    label = spec.label.lower()
    if isinstance(spec, ListSpec) and spec.nests:
        more = len(after) - len(before)
        if more:
            return f"{'Add to' if more > 0 else 'Remove from'} {label} of"
        if before != after and all(before.count(part) == after.count(part) for part in after):
            return f"Reorder {label} of"
    return f"Change {label} of"


def _kind_called(name: str, kinds: tuple[type[Kind], ...], what: str) -> type[Kind]:
    named = {kind.__name__: kind for kind in kinds}
    if name not in named:
        raise InvalidInputError(f"No {what} is called {quoted(name)}; there are {', '.join(named)}")
    return named[name]


def _kinds_to_choose(spec: ModelSpec) -> tuple[type, ...]:
    kinds = spec.kinds()
    inner = _inner_field(kinds[0]) if len(kinds) == 1 else None
    return kinds if inner is None else inner[1].kinds()


def _inner_field(kind: type) -> tuple[str, ModelSpec] | None:
    """Return name and specification of the first field that holds another model, if any."""
    pairs = specs_of(kind).items()
    return next(((name, spec) for name, spec in pairs if isinstance(spec, ModelSpec)), None)


def _title(kind: type) -> str:
    return str(getattr(kind, "title", kind.__name__))


_OF_TRACK: dict[str, Spec] = {"amplitude": AMPLITUDE, "gain_curve": GAIN_CURVE}
_OF_CLIP: dict[str, Spec] = {"onset_s": ONSET, "gain": GAIN, "label": LABEL}


@refusing
def change_kind(design: Design, view: View, ids: Iterable[int], kind: str) -> Edit | Refusal:
    """Give clips of inputs another kind of waveform, which keeps what both kinds share.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.change_kind(design, ss.View(), [1], "Noise")
    >>> print(type(edit.design.clips[0].waveform).__name__)
    Noise
    """
    waveform_kind = _kind_called(kind, waveform_kinds(), "waveform")
    rate_hz = facts_of(design.limb).sample_rate_hz
    return _with_waveforms(
        design, view, ids, lambda clip: as_kind(clip.waveform, waveform_kind, rate_hz)
    )


@refusing
def change_waveform(
    design: Design, view: View, ids: Iterable[int], waveform: Waveform
) -> Edit | Refusal:
    """Give clips of inputs a waveform.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.change_waveform(design, ss.View(), [1], ss.waveforms.Noise())
    >>> print(edit.label)
    Change waveform of input at 7 (II pad)
    """
    return _with_waveforms(design, view, ids, lambda _: waveform)


@refusing
def change_field(
    design: Design, view: View, ids: Iterable[int], name: str, value: Any
) -> Edit | Refusal:
    """Set a field of inputs, of their clips or of the waveforms of those to one value.

    Inputs without a clip, and clips whose waveform has no field of this name, stay as they are.
    Gains of a wavelet train follow its frequencies; all go where a new frequency has none.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.change_field(design, ss.View(), [1], "frequency_hz", 250.0)
    >>> print(edit.design.clips[0].waveform.frequency_hz)
    250.0
    """
    targets = _targets(design, view, ids, name)
    return _with_values(design, view, name, [(target, value) for target in targets])


@refusing
def drag_field(
    design: Design,
    view: View,
    ids: Iterable[int],
    name: str,
    value: float,
    *,
    lead: int | None,
    start: Design,
) -> Edit | Refusal:
    """Set a number of the input ``lead`` or its clip, and move those of the others as far.

    The others move by the same step, or by the same factor where the number is logarithmic, an
    amplitude or a gain, and stay within what is allowed.  ``start`` is the design when the drag
    began: all values are computed from it, so that dragging back restores it.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.drag_field(
    ...     design, ss.View(), [1], "frequency_hz", 120.0, lead=1, start=design
    ... )
    >>> print(edit.design.clips[0].waveform.frequency_hz)
    120.0
    """
    targets = _targets(design, view, ids, name)
    leading = (
        (track, clip)
        for track, clip in targets
        if track.id == lead and (clip is None or clip is clip_of(track, view))
    )
    dragged = next(leading, None)
    spec = dragged and fields_of(*dragged)[name]
    if dragged is None or not isinstance(spec, NumberSpec):
        return _with_values(design, view, name, [(target, value) for target in targets], start)
    at_start = {_ids_of(target): target for target in _targets(start, view, start.ids, name)}

    def value_at_start(target: _Target) -> float:
        track, clip = at_start.get(_ids_of(target), target)
        return float(value_of(track, name, clip))

    origin = value_at_start(dragged)
    spec.checked(value)
    values = [(dragged, value)]
    for target in targets:
        spec = fields_of(*target)[name]
        if target is not dragged and isinstance(spec, NumberSpec):
            values.append((target, _moved_value(value_at_start(target), origin, value, spec)))
    return _with_values(design, view, name, values)


@checking
def fields_of(one: Input, clip: Clip | None = None) -> dict[str, Spec]:
    """Return the fields of an input that can be set, with those of a clip and of its waveform.

    ``clip`` is one of its clips; None: its first, if it has any.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> value = ss.edits.fields_of(design.inputs[0])
    >>> print(list(value)[:4])
    ['amplitude', 'gain_curve', 'onset_s', 'gain']
    """
    clip = clip or next(iter(one.clips), None)
    return {**_OF_TRACK} if clip is None else {**_OF_TRACK, **_OF_CLIP, **specs_of(clip.waveform)}


@checking
def value_of(one: Input, name: str, clip: Clip | None = None) -> Any:
    """Return the value of one of `fields_of`.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> value = ss.edits.value_of(design.inputs[0], "frequency_hz")
    >>> print(value)
    100.0
    """
    values = values_of(one, clip)
    return values[one_of("name", name, tuple(values))]


def values_of(one: Input, clip: Clip | None = None) -> dict[str, Any]:
    """Return the value of each of `fields_of`, by name."""
    clip = clip or next(iter(one.clips), None)
    values: dict[str, Any] = {}
    for name in fields_of(one, clip):
        holder: Any = one if name in _OF_TRACK else clip
        values[name] = getattr(holder if name in _OF_TRACK | _OF_CLIP else holder.waveform, name)
    return values


# An input, or one of its clips, whose field is set.
_Target: TypeAlias = tuple[Input, Clip | None]


def _ids_of(target: _Target) -> tuple[int, int | None]:
    track, clip = target
    return track.id, None if clip is None else clip.id


def _targets(design: Design, view: View, ids: Iterable[int], name: str) -> list[_Target]:
    chosen = present_inputs(design, ids)
    if name in _OF_TRACK:
        return [(track, None) for track in chosen]
    pairs = [(track, clip) for track in chosen for clip in clips_of(track, view)]
    return [(track, clip) for track, clip in pairs if name in fields_of(track, clip)]


def _with_values(
    design: Design,
    view: View,
    name: str,
    values: list[tuple[_Target, Any]],
    start: Design | None = None,
) -> Edit | Refusal:
    if not values:
        return Refusal(sentence=NOTHING_CHOSEN)
    at_start = {clip.id: clip.waveform for clip in start.clips} if start else {}
    changes: dict[int, dict[str, Any]] = {}
    clip_changes: dict[int, dict[str, Any]] = {}
    gains: list[tuple[float, ...]] = []
    for (track, clip), value in values:
        changes[track.id] = {} if clip else {name: value}
        if clip and name in _OF_CLIP:
            clip_changes[clip.id] = {name: value}
        elif clip:
            before: Any = clip.waveform
            after = with_field(before, name, value, at_start.get(clip.id))
            clip_changes[clip.id] = {"waveform": after}
            if name == "frequencies_hz" and after.gains_db != before.gains_db:
                gains.append(after.gains_db)
    (track, clip), value = values[0]
    verb = change_text(fields_of(track, clip)[name], value_of(track, name, clip), value)
    outcome = change_inputs(design, view, verb, changes, clip_changes)
    if isinstance(outcome, Edit) and gains:
        return replace(outcome, said=_CARRIED if all(gains) else _UNBALANCED)
    if name != "duration_s" or isinstance(outcome, Refusal):
        return outcome
    played_s = [outcome.design.clip(id).duration_s for id in clip_changes]
    return outcome if all(played_s) else replace(outcome, said=_EMPTIED)


_CARRIED = "Each frequency keeps its gain."
_UNBALANCED = "Gains removed: a new frequency has none. Balance the wavelets again."
_EMPTIED = "Nothing plays: the trim begins behind the new end. Start it earlier."


def _with_waveforms(
    design: Design, view: View, ids: Iterable[int], waveform: Callable[[Clip], Waveform]
) -> Edit | Refusal:
    changes: dict[int, dict[str, Any]] = {}
    clip_changes: dict[int, dict[str, Any]] = {}
    for track in present_inputs(design, ids):
        # An input without a clip gets one.
        changes[track.id] = {} if track.clips else {"clips": (Clip(waveform=waveform(Clip())),)}
        for clip in clips_of(track, view):
            clip_changes[clip.id] = {"waveform": waveform(clip)}
    return change_inputs(design, view, "Change waveform of", changes, clip_changes)


def _moved_value(own_value: float, origin: float, value: float, spec: NumberSpec) -> float:
    """Return ``own_value`` moved by the step or factor from ``origin`` to ``value``."""
    by_factor = spec.logarithmic and min(own_value, origin, value) > 0
    if spec in (AMPLITUDE, GAIN):
        # An inverted one stays inverted.
        by_factor = origin * value > 0
    moved = own_value * (value / origin) if by_factor else own_value + (value - origin)
    # Sums of decimal steps must stay short to read.
    return nearest(float(f"{moved:.12g}"), spec)


# What trims leave of a wavelet, with what the others leak into its level, is as far below them.
_FAINT_DB = 60.0


@refusing
def equalise_on_skin(
    design: Design, view: View, clip_id: int, levels_db: Sequence[float], measure: str
) -> Edit | Refusal:
    """Set the gains of a wavelet train so that all its wavelets have the same level on the skin.

    The softest wavelet keeps its drive, and the others are lowered to it.

    Parameters
    ----------
    clip_id
        The clip, which plays a `WaveletTrain`.
    levels_db
        Level of each wavelet without its gain, see `skinsource.engine.levelling.wavelet_levels_db`.
    measure
        Name of the quantity that these are levels of.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> train = ss.edits.change_kind(design, ss.View(), [1], "WaveletTrain").design
    >>> levels_db = range(len(train.clips[0].waveform.frequencies_hz))
    >>> edit = ss.edits.equalise_on_skin(train, ss.View(), 1, levels_db, "loudest output")
    >>> print(edit.design.clips[0].waveform.gains_db)
    (0.0, -1.0, -2.0, -3.0, -4.0)
    """
    clip, track = design.clip(clip_id), design.track_of(clip_id)
    train = clip.waveform
    if not isinstance(train, WaveletTrain) or len(levels_db) != len(train.frequencies_hz):
        return Refusal(sentence="The clip no longer plays that wavelet train; try again.")
    softest_db = min(levels_db)
    if not all(map(isfinite, levels_db)) or max(levels_db) - softest_db > _FAINT_DB:
        worst_hz = train.frequencies_hz[list(levels_db).index(softest_db)]
        return Refusal(
            sentence=f"The wavelet of {worst_hz:g} Hz hardly moves the skin, so others cannot "
            "match it; remove it, keep trims from it, or choose another place."
        )
    # Nobody can feel or set less than a hundredth of a dB; adding 0.0 turns -0.0 into 0.0.
    gains_db = tuple(round(softest_db - level_db, 2) + 0.0 for level_db in levels_db)
    changes = {clip_id: {"waveform": replace(train, gains_db=gains_db)}}
    outcome = change_inputs(design, view, "Balance wavelets of", {track.id: {}}, changes)
    place = location_text(track.location, design.limb)
    said = f"Balanced by the {measure}, on {design.limb} at {place}"
    return replace(outcome, said=said) if isinstance(outcome, Edit) else outcome


@refusing
def match_tracks(design: Design, view: View, levels_db: Mapping[int, float]) -> Edit | Refusal:
    """Set the amplitudes of inputs so that each alone has the same level on the skin.

    The one that was selected last keeps its amplitude, and the others follow it.

    Parameters
    ----------
    levels_db
        Level of each input alone, by its id, see `skinsource.engine.levelling.track_levels_db`.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.match_tracks(design, ss.View(selected_inputs=(1,)), {1: -10.0, 2: -16.0})
    >>> print([track.amplitude for track in edit.design.inputs])
    [1.0, 1.995]
    """
    chosen = present_inputs(design, levels_db)
    least_db = max(levels_db.values(), default=0.0) + SOFTEST_DB
    silent = next((track for track in chosen if not levels_db[track.id] > least_db), None)
    if silent is not None:
        place = location_text(silent.location, design.limb)
        return Refusal(sentence=f"The input at {place} does not move the skin; deselect it.")
    last = [id for id in view.selected_inputs if id in levels_db]
    target_db = levels_db[last[-1]] if last else max(levels_db.values(), default=0.0)
    changes: dict[int, dict[str, Any]] = {
        track.id: {
            "amplitude": float(
                f"{track.amplitude * 10.0 ** ((target_db - levels_db[track.id]) / 20.0):.4g}"
            )
        }
        for track in chosen
    }
    outcome = change_inputs(design, view, "Match levels of", changes)
    place = location_text(design.input(last[-1]).location, design.limb) if last else ""
    n_changed = sum(changes[track.id]["amplitude"] != track.amplitude for track in chosen)
    measure = f"magnitude of {', '.join(facts_of(design.limb).axes)}, {span_label('loudest')}"
    what = f"{counted(n_changed, 'input')} to {f'input {place}' if last else 'the strongest'}"
    said = f"Matched {what}, by the {measure} of any output"
    return replace(outcome, said=said) if isinstance(outcome, Edit) else outcome


_NO_BAND = Refusal(sentence="The measured band of this limb is unknown; import it with its band.")


@refusing
def draw_clip(
    design: Design, view: View, clip_id: int, samples: Floats, sample_rate_hz: float
) -> Edit | Refusal:
    """Replace the waveform of a clip by drawn samples, (n_times,); its effects stay.

    Examples
    --------
    >>> import numpy as np
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.draw_clip(design, ss.View(), 1, np.sin(np.arange(260) / 4.0), 1300.0)
    >>> print(type(edit.design.clips[0].waveform).__name__)
    Drawn
    """
    waveform = Drawn(Samples(values=samples, sample_rate_hz=sample_rate_hz))
    after = design.with_clip(clip_id, waveform=waveform)
    place = location_text(design.track_of(clip_id).location, design.limb)
    return Edit(label=f"Draw at {place}", design=after, view=view)


def changes_time(effect: Effect) -> bool:
    """Return whether samples play at other times after an effect than before it."""
    return effect.on and (isinstance(effect, Reverse) or not isinstance(effect, KeepsTime))


def time_effects_end(clip: Clip) -> int:
    """Return how many effects of a clip lie up to the last one that changes its time."""
    ends = (number for number, effect in enumerate(clip.effects, 1) if changes_time(effect))
    return max(ends, default=0)


@refusing
def bake_clip(design: Design, view: View, clip_id: int, sample_rate_hz: float) -> Edit | Refusal:
    """Replace the waveform of a clip, with all `time_effects_end`, by the samples it plays."""
    clip = design.clip(clip_id)
    end = time_effects_end(clip)
    values = played(clip.waveform, clip.effects[:end], sample_rate_hz)
    waveform = Drawn(Samples(values=values, sample_rate_hz=sample_rate_hz))
    after = design.with_clip(clip_id, waveform=waveform, effects=clip.effects[end:])
    return Edit(label=f"Convert {clips_text(design, (clip,))}", design=after, view=view)


@refusing
def limit_to_band(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Add a band limit to clips, with the band in which the limb was measured, as last effect.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.limit_to_band(design, ss.View(), [1])
    >>> print(edit.design.clips[0].effects)
    (BandLimit(low_hz=25.0, high_hz=600.0, on=True),)
    """
    band_hz = facts_of(design.limb).band_hz
    if band_hz is None:
        return _NO_BAND
    limit = BandLimit(low_hz=band_hz[0], high_hz=band_hz[1])
    effects = {clip.id: (*clip.effects, limit) for clip in chosen_clips(design, ids)}
    return _with_effects(design, view, "Limit the band of", effects)


@refusing
def bound_clip(design: Design, view: View, clip_id: int, sample_rate_hz: float) -> Edit | Refusal:
    """Do as `limit_to_band` for one clip; the sample rate does not matter.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.bound_clip(design, ss.View(), 1, 1300.0)
    >>> print(edit.label)
    Limit the band of clip at 7 (II pad)
    """
    return limit_to_band(design, view, (clip_id,))


_NO_GLIDE = Refusal(sentence="The clip does not play a glide; choose that waveform first.")


@refusing
def set_glide_curve(
    design: Design, view: View, clip_id: int, column: Column, curve: Curve
) -> Edit | Refusal:
    """Set the frequency curve or the amplitude curve of a glide; the other curve stays.

    Parameters
    ----------
    clip_id
        The clip, which plays a `Glide`.
    column
        ``"frequency"`` or ``"amplitude"``.
    curve
        (time, value), times never falling; the last one ends the glide.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> glide = ss.edits.change_kind(design, ss.View(), [1], "Glide").design
    >>> curve = ((0.0, 50.0), (0.3, 300.0))
    >>> edit = ss.edits.set_glide_curve(glide, ss.View(), 1, "frequency", curve)
    >>> print(edit.label)
    Draw frequency of input at 7 (II pad)
    """
    clip, track = design.clip(clip_id), design.track_of(clip_id)
    glide = clip.waveform
    if not isinstance(glide, Glide) or column not in ("frequency", "amplitude"):
        return _NO_GLIDE
    waveform = replace(glide, points=with_curve(glide.points, column, curve))
    return change_inputs(
        design, view, f"Draw {column} of", {track.id: {}}, {clip_id: {"waveform": waveform}}
    )
