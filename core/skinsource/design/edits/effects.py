"""The chain of effects of a clip."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import Any

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import quoted, sentence
from skinsource.design.clips import GAIN, LABEL, MAX_EFFECTS, ONSET, Clip
from skinsource.design.design import AMPLITUDE, GAIN_CURVE, Design, Input
from skinsource.design.edits.clips import NO_CLIP, clips_text, present_clips
from skinsource.design.edits.edit import (
    NOTHING_CHOSEN,
    Edit,
    KindSpec,
    Refusal,
    as_kind,
    changed,
    clip_of,
    clips_of,
    location_text,
    nearest,
    present,
    refused,
    with_clips,
)
from skinsource.design.effects import effect_kinds
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.level import Envelope, Fade
from skinsource.design.effects.time import Trim
from skinsource.design.view import View
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.catalog import kinds
from skinsource.design.waveforms.catalog import kinds as waveform_kinds
from skinsource.design.waveforms.samples import Drawn
from skinsource.design.waveforms.tones import Glide
from skinsource.design.waveforms.wavelet_train import SOFTEST_DB, WaveletTrain
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.drawing import bounded_to_band
from skinsource.signals.synthesis import Column, Curve, with_curve
from skinsource.specs.breakpoints import Breakpoint
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec
from skinsource.specs.samples import Samples
from skinsource.specs.spec import ChoiceSpec, Spec

_GONE = Refusal(sentence="That effect is no longer there; choose another one.")
_FADE_S = 0.02


def add_effect(
    design: Design, view: View, ids: Iterable[int], kind: str, index: int | None = None
) -> Edit | Refusal:
    """Put a new effect into the chains of clips, before the ``index``-th there; None: last."""
    wanted = next((candidate for candidate in effect_kinds() if candidate.__name__ == kind), None)
    if wanted is None:
        known = ", ".join(candidate.__name__ for candidate in effect_kinds())
        return Refusal(sentence=f"No effect is called {quoted(kind)}; there are {known}.")
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    if any(len(clip.effects) >= MAX_EFFECTS for clip in chosen):
        return Refusal(sentence=f"A clip has at most {MAX_EFFECTS} effects; remove one first.")
    chains = {}
    for clip in chosen:
        chain = list(clip.effects)
        chain.insert(len(chain) if index is None else max(index, 0), fitted(wanted, clip))
        chains[clip.id] = tuple(chain)
    return _changed(design, view, f"Add {_words(wanted)} to", chosen, chains)


def remove_effect(design: Design, view: View, id: int, index: int) -> Edit | Refusal:
    """Take an effect out of the chain of a clip."""
    clip = _with_effect(design, id, index)
    if clip is None:
        return _GONE
    chain = (*clip.effects[:index], *clip.effects[index + 1 :])
    verb = f"Remove {_words(clip.effects[index])} from"
    return _changed(design, view, verb, (clip,), {id: chain})


def move_effect(design: Design, view: View, id: int, index: int, to: int) -> Edit | Refusal:
    """Let an effect stand at another place of the chain, from 0; as far as there is room."""
    clip = _with_effect(design, id, index)
    if clip is None:
        return _GONE
    chain = list(clip.effects)
    moved = chain.pop(index)
    chain.insert(min(max(to, 0), len(chain)), moved)
    return _changed(design, view, "Reorder effects of", (clip,), {id: tuple(chain)})


def switch_effect(design: Design, view: View, id: int, index: int, on: bool) -> Edit | Refusal:
    """Switch an effect on or off."""
    clip = _with_effect(design, id, index)
    if clip is None:
        return _GONE
    verb = f"Switch {_words(clip.effects[index])} {'on' if on else 'off'} in"
    return _set(design, view, verb, clip, index, "on", on)


def change_effect_field(
    design: Design, view: View, id: int, index: int, name: str, value: Any
) -> Edit | Refusal:
    """Set a field of an effect."""
    clip = _with_effect(design, id, index)
    if clip is None or name not in specs_of(clip.effects[index]):
        return _GONE
    label = specs_of(clip.effects[index])[name].label.lower()
    return _set(design, view, f"Change {label} of", clip, index, name, value)


def set_envelope(
    design: Design, view: View, id: int, points: tuple[Breakpoint, ...]
) -> Edit | Refusal:
    """Give a clip an envelope: that of its last one, or of a new one at the end of the chain."""
    chosen = present_clips(design, (id,))
    if not chosen:
        return NO_CLIP
    [clip] = chosen
    try:
        drawn = Envelope(points)
    except InvalidInputError as error:
        return refused(error)
    places = [k for k, each in enumerate(clip.effects) if isinstance(each, Envelope)]
    if places:
        chain = (*clip.effects[: places[-1]], drawn, *clip.effects[places[-1] + 1 :])
    elif len(clip.effects) < MAX_EFFECTS:
        chain = (*clip.effects, drawn)
    else:
        return Refusal(sentence=f"A clip has at most {MAX_EFFECTS} effects; remove one first.")
    return _changed(design, view, "Change envelope of", chosen, {id: chain})


def fitted(kind: type[Effect], clip: Clip) -> Effect:
    """A new effect that fits what a clip plays."""
    length_s = float(f"{min(clip.duration_s, 600.0):.12g}")
    if kind is Envelope and length_s > 0.0:
        return Envelope(((0.0, 1.0, "straight"), (length_s, 1.0, "straight")))
    if kind is Fade:
        fade_s = min(_FADE_S, float(f"{length_s / 4.0:.3g}"))
        return Fade(fade_s, fade_s)
    if kind is Trim:
        return Trim(0.0, length_s)
    return kind()


def _with_effect(design: Design, id: int, index: int) -> Clip | None:
    """The clip, if it has an effect at this place."""
    for clip in present_clips(design, (id,)):
        if 0 <= index < len(clip.effects):
            return clip
    return None


def _set(
    design: Design, view: View, verb: str, clip: Clip, index: int, name: str, value: Any
) -> Edit | Refusal:
    chain = list(clip.effects)
    recipe: Any = chain[index]
    try:
        chain[index] = replace(recipe, **{name: value})
    except InvalidInputError as error:
        return refused(error)
    return _changed(design, view, verb, (clip,), {clip.id: tuple(chain)})


def _changed(
    design: Design,
    view: View,
    verb: str,
    chosen: tuple[Clip, ...],
    chains: dict[int, tuple[Effect, ...]],
) -> Edit | Refusal:
    try:
        after = with_clips(design, {id: {"effects": chain} for id, chain in chains.items()})
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=f"{verb} {clips_text(design, chosen)}", design=after, view=view)


def _words(effect: Effect | type[Effect]) -> str:
    return effect.title.lower()


# Recipes in lists within recipes: what a new part may be, how parts are called and put in order.
#
# A clip is a part of layers, an effect one of a clip.  All functions are pure; what they return
# goes into a design by `skinsource.design.edits.effects.change_field`, as any value of a field
# does.

Parts = tuple[Any, ...]


def choices_of(spec: ModelSpec) -> ChoiceSpec:
    """What can be chosen for a recipe: its kinds, by name and title.

    Where there is one kind alone, it is what that holds which is chosen: of a clip the waveform.
    """
    chosen = _chosen(spec)
    options = tuple((kind.__name__, _title(kind)) for kind in chosen)
    made = KindSpec if set(chosen) <= set(waveform_kinds()) else ChoiceSpec
    return made(label=spec.label, hint=spec.hint, options=options)


def new_part(spec: ModelSpec, name: str, holder: Any = None) -> Any:
    """A new recipe of `choices_of` ``spec``; an effect fits the clip that is to hold it.

    Raises
    ------
    InvalidInputError
        Nothing that can be chosen is called so.
    """
    kinds, chosen = spec.kinds(), _chosen(spec)
    kind = next((candidate for candidate in chosen if candidate.__name__ == name), None)
    if kind is None:
        known = ", ".join(candidate.__name__ for candidate in chosen)
        raise InvalidInputError(f"{spec.label} is {quoted(name)}, expected one of {known}")
    held = _held(kinds[0])
    if kind not in kinds and held is not None:
        return kinds[0](**{held[0]: kind()})
    if kind in effect_kinds() and isinstance(holder, Clip):
        return fitted(kind, holder)
    return kind()


def part_text(part: Any) -> str:
    """What a part is called: the user's label, or the title of its kind or of what it holds."""
    held = _held(type(part))
    inside = _title(type(getattr(part, held[0]))) if held else ""
    words = getattr(part, "label", "") or inside or _title(type(part))
    off = getattr(part, "muted", False) or not getattr(part, "on", True)
    return f"{words} (off)" if off else words


def without_part(parts: Parts, index: int) -> Parts:
    """The parts without one."""
    return (*parts[:index], *parts[index + 1 :])


def moved_part(parts: Parts, index: int, to: int) -> Parts:
    """The parts, where one stands at another place, from 0; as far as there is room."""
    rest = list(parts)
    moved = rest.pop(index)
    rest.insert(min(max(to, 0), len(rest)), moved)
    return tuple(rest)


def with_part(parts: Parts, index: int, part: Any) -> Parts:
    """The parts with another one in place of one."""
    return (*parts[:index], part, *parts[index + 1 :])


def change_text(spec: Spec, before: Any, after: Any) -> str:
    """What is done to a field, for the history: "Change onset of", "Add to parts of"."""
    label = spec.label.lower()
    if isinstance(spec, ListSpec) and spec.nests:
        more = len(after) - len(before)
        if more:
            return f"{'Add to' if more > 0 else 'Remove from'} {label} of"
        if before != after and all(before.count(part) == after.count(part) for part in after):
            return f"Reorder {label} of"
    return f"Change {label} of"


def _chosen(spec: ModelSpec) -> tuple[type, ...]:
    kinds = spec.kinds()
    held = _held(kinds[0]) if len(kinds) == 1 else None
    return kinds if held is None else held[1].kinds()


def _held(kind: type) -> tuple[str, ModelSpec] | None:
    """The first field of a recipe that holds another one, if any does."""
    pairs = specs_of(kind).items()
    return next(((name, spec) for name, spec in pairs if isinstance(spec, ModelSpec)), None)


def _title(kind: type) -> str:
    return str(getattr(kind, "title", kind.__name__))


# Numbers and choices of inputs, of their clips, and of what those play.

_OF_TRACK: dict[str, Spec] = {"amplitude": AMPLITUDE, "gain_curve": GAIN_CURVE}
_OF_CLIP: dict[str, Spec] = {"onset_s": ONSET, "gain": GAIN, "label": LABEL}


def change_kind(design: Design, view: View, ids: Iterable[int], kind: str) -> Edit | Refusal:
    """Let clips of inputs play another kind of waveform, with what both kinds share."""
    wanted = next((candidate for candidate in kinds() if candidate.__name__ == kind), None)
    if wanted is None:
        known = ", ".join(candidate.__name__ for candidate in kinds())
        return Refusal(sentence=f"No waveform is called {quoted(kind)}; there are {known}.")
    rate_hz = facts_of(design.limb).sample_rate_hz
    return _playing(design, view, ids, lambda clip: as_kind(clip.waveform, wanted, rate_hz))


def change_waveform(
    design: Design, view: View, ids: Iterable[int], waveform: Waveform
) -> Edit | Refusal:
    """Let clips of inputs play a waveform."""
    return _playing(design, view, ids, lambda _: waveform)


def change_field(
    design: Design, view: View, ids: Iterable[int], name: str, value: Any
) -> Edit | Refusal:
    """Set a number or a choice of inputs, of their clips, or of what those play, to one value.

    Inputs without a clip, and clips whose waveform has no field of this name, are left as they are.
    """
    targets = _targets(design, view, ids, name)
    if not targets:
        return NOTHING_CHOSEN
    return _values_set(design, view, name, [(target, value) for target in targets])


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
    """Set a number of the input ``lead``, or its clip; the others move as far from where they were.

    They move by the same step, or by the same factor where the number is logarithmic, and stay
    within what is allowed.  ``start`` is the design as the drag began: the way back leads to it.
    """
    ids = tuple(ids)
    targets = _targets(design, view, ids, name)
    dragged = next((target for target in targets if target.leads(lead, view)), None)
    if dragged is None or not isinstance(dragged.spec(name), NumberSpec):
        return change_field(design, view, ids, name, value)
    began = {target.key: target for target in _targets(start, view, start.ids, name)}
    origin = began.get(dragged.key, dragged).value(name)
    try:
        dragged.spec(name).checked(value)
        values = [(dragged, value)]
        for target in targets:
            spec = target.spec(name)
            if target is not dragged and isinstance(spec, NumberSpec):
                own = began.get(target.key, target).value(name)
                values.append((target, _moved(own, origin, value, spec)))
    except InvalidInputError as error:
        return refused(error)
    return _values_set(design, view, name, values)


def fields_of(one: Input, clip: Clip | None = None) -> dict[str, Spec]:
    """What of an input can be set: amplitude, gain curve, and fields of its clip and what it plays.

    ``clip`` is one of its clips; None: its first, if it has any.
    """
    clip = clip or next(iter(one.clips), None)
    return {**_OF_TRACK} if clip is None else {**_OF_TRACK, **_OF_CLIP, **specs_of(clip.waveform)}


def value_of(one: Input, name: str, clip: Clip | None = None) -> Any:
    """Value of one of `fields_of`."""
    clip = clip or next(iter(one.clips), None)
    holder: Any = one if name in _OF_TRACK else clip
    return getattr(holder if name in _OF_TRACK | _OF_CLIP else holder.waveform, name)


@dataclass(frozen=True, slots=True)
class _Target:
    """An input, or one of its clips, of which a field is set."""

    track: Input
    clip: Clip | None

    @property
    def key(self) -> tuple[int, int]:
        return self.track.id, 0 if self.clip is None else self.clip.id

    def leads(self, lead: int | None, view: View) -> bool:
        apart = self.clip is None or self.clip is clip_of(self.track, view)
        return self.track.id == lead and apart

    def spec(self, name: str) -> Spec:
        return fields_of(self.track, self.clip)[name]

    def value(self, name: str) -> Any:
        return value_of(self.track, name, self.clip)

    def setting(self, name: str, value: Any) -> dict[str, Any]:
        """Changes of the input, or of the clip, that give the field its value."""
        if self.clip is None or name in _OF_CLIP:
            return {name: value}
        waveform: Any = self.clip.waveform
        return {"waveform": replace(waveform, **{name: value})}


def _targets(design: Design, view: View, ids: Iterable[int], name: str) -> list[_Target]:
    chosen = present(design, ids)
    if name in _OF_TRACK:
        return [_Target(track, None) for track in chosen]
    pairs = [_Target(track, clip) for track in chosen for clip in clips_of(track, view)]
    return [target for target in pairs if name in fields_of(target.track, target.clip)]


def _values_set(
    design: Design, view: View, name: str, values: list[tuple[_Target, Any]]
) -> Edit | Refusal:
    changes: dict[int, dict[str, Any]] = {}
    of_clips: dict[int, dict[str, Any]] = {}
    try:
        for target, value in values:
            setting = target.setting(name, value)
            changes[target.track.id] = setting if target.clip is None else {}
            if target.clip is not None:
                of_clips[target.clip.id] = setting
    except InvalidInputError as error:
        return refused(error)
    target, value = values[0]
    verb = change_text(target.spec(name), target.value(name), value)
    return changed(design, view, verb, changes, of_clips)


def _playing(
    design: Design, view: View, ids: Iterable[int], waveform: Callable[[Clip], Waveform]
) -> Edit | Refusal:
    changes: dict[int, dict[str, Any]] = {}
    of_clips: dict[int, dict[str, Any]] = {}
    try:
        for track in present(design, ids):
            # What plays nothing yet begins to.
            changes[track.id] = {} if track.clips else {"clips": (Clip(waveform=waveform(Clip())),)}
            for clip in clips_of(track, view):
                of_clips[clip.id] = {"waveform": waveform(clip)}
    except InvalidInputError as error:
        return refused(error)
    return changed(design, view, "Change waveform of", changes, of_clips)


def _moved(own: float, origin: float, value: float, spec: NumberSpec) -> float:
    """``own`` moved as ``origin`` was to become ``value``."""
    by_factor = spec.logarithmic and min(own, origin, value) > 0
    moved = own * (value / origin) if by_factor else own + (value - origin)
    # Sums of decimal steps shall be short to read.
    return nearest(float(f"{moved:.12g}"), spec)


# What makes the wavelets of a train alike.

#: How the note in a label begins, so that the next one takes its place.
NOTED = "Equal on the skin: "
_BETWEEN = " · "


def equalise_on_skin(
    design: Design, view: View, clip_id: int, levels_db: Sequence[float], measure: str
) -> Edit | Refusal:
    """Give each wavelet of a train the gain with which all arrive alike.

    The softest one keeps its drive, and the others are lowered to it.  The label of the clip notes
    the limb, the place and the measure: elsewhere, and by other measures, they differ.

    Parameters
    ----------
    clip_id
        The clip, which plays a `WaveletTrain`.
    levels_db
        Level of each wavelet without its gain, see `skinsource.engine.levelling.wavelet_levels_db`.
    measure
        What that is the level of, in words.
    """
    try:
        clip, track = design.clip(clip_id), design.track_of(clip_id)
    except InvalidInputError as error:
        return Refusal(sentence=sentence(str(error)))
    train = clip.waveform
    if not isinstance(train, WaveletTrain) or len(levels_db) != len(train.frequencies_hz):
        return Refusal(sentence="The clip does not play that wavelet train any more; try again.")
    softest_db = min(levels_db)
    if not all(map(isfinite, levels_db)) or max(levels_db) - softest_db > -SOFTEST_DB:
        worst_hz = train.frequencies_hz[list(levels_db).index(softest_db)]
        return Refusal(
            sentence=f"The wavelet of {worst_hz:g} Hz moves nothing on the skin, so none can be "
            "made like it; take it out, or choose another place."
        )
    # A hundredth of a dB is less than anything that can be felt or set; -0.0 would be odd.
    gains_db = tuple(round(softest_db - level_db, 2) + 0.0 for level_db in levels_db)
    note = f"{NOTED}{measure}, {design.limb}, {location_text(track.location, design.limb)}"
    kept = [words for words in clip.label.split(_BETWEEN) if words and not words.startswith(NOTED)]
    label = _BETWEEN.join((*kept, note))
    change = {
        "waveform": replace(train, gains_db=gains_db),
        "label": label if len(label) <= LABEL.longest else note[: LABEL.longest],
    }
    return changed(design, view, "Equalise wavelets of", {track.id: {}}, {clip_id: change})


# What a pen does to a clip.

_NO_BAND = Refusal(
    sentence="In which band this limb was measured is not known; import it with its band."
)


def draw_clip(
    design: Design, view: View, clip_id: int, samples: Floats, sample_rate_hz: float
) -> Edit | Refusal:
    """Let a clip play drawn samples, (n_times,), in place of its waveform; effects stay."""
    try:
        waveform = Drawn(Samples(values=samples, sample_rate_hz=sample_rate_hz))
        after = design.with_clip(clip_id, waveform=waveform)
        place = location_text(design.track_of(clip_id).location, design.limb)
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=f"Draw at {place}", design=after, view=view)


def bound_clip(design: Design, view: View, clip_id: int, sample_rate_hz: float) -> Edit | Refusal:
    """Take away what of a clip's waveform lies outside the measured band; it becomes samples."""
    try:
        band_hz = facts_of(design.limb).band_hz
        if band_hz is None:
            return _NO_BAND
        drawn = design.clip(clip_id).waveform.samples(sample_rate_hz)
        bounded = bounded_to_band(drawn, sample_rate_hz, band_hz)
    except InvalidInputError as error:
        return refused(error)
    if bounded.removed == 0.0 and np.array_equal(bounded.samples, drawn):
        return Refusal(sentence="Nothing of the clip lies outside the measured band.")
    outcome = draw_clip(design, view, clip_id, bounded.samples, sample_rate_hz)
    if isinstance(outcome, Refusal):
        return outcome
    low_hz, high_hz = band_hz
    label = f"Bound to {low_hz:g}\u2013{high_hz:g} Hz, {100 * bounded.removed:.3g} % removed"
    return Edit(label=label, design=outcome.design, view=outcome.view)


# Curves of a glide.

_NO_GLIDE = Refusal(sentence="The clip does not play a glide; choose that waveform first.")


def set_glide_curve(
    design: Design, view: View, clip_id: int, column: Column, curve: Curve
) -> Edit | Refusal:
    """Give the glide of a clip another curve of frequency, or of amplitude; the other one stays.

    Parameters
    ----------
    clip_id
        The clip, which plays a `Glide`.
    column
        ``"frequency"`` or ``"amplitude"``.
    curve
        (time, value), times never falling; the last one ends the glide.
    """
    try:
        clip, track = design.clip(clip_id), design.track_of(clip_id)
        glide = clip.waveform
        if not isinstance(glide, Glide) or column not in ("frequency", "amplitude"):
            return _NO_GLIDE
        waveform = replace(glide, points=with_curve(glide.points, column, curve))
    except InvalidInputError as error:
        return refused(error)
    return changed(
        design, view, f"Draw {column} of", {track.id: {}}, {clip_id: {"waveform": waveform}}
    )
