"""What an edit leads to."""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import sentence
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.view import View
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.catalog import kinds
from skinsource.design.waveforms.tones import Glide
from skinsource.limbs.locations import input_name
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec, SamplesSpec
from skinsource.specs.samples import Samples
from skinsource.specs.spec import ChoiceSpec, Spec


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit:
    """Another design and another view, both at once.

    Attributes
    ----------
    label
        What was done, as the history names it: "Mute input at 7 (II pad)".
    design, view
        What there is afterwards.
    said
        What is told once it is done, of what may not be seen.
    """

    label: str
    design: Design
    view: View
    said: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Refusal:
    """Nothing is done; ``sentence`` says why, and what to do instead."""

    sentence: str


NOTHING_CHOSEN = Refusal(sentence="No input is selected; click one, on the hand or in the list.")


def refused(error: InvalidInputError) -> Refusal:
    """Nothing is done, for a value that is not allowed."""
    return Refusal(sentence=sentence(str(error)))


def present(design: Design, ids: Iterable[int]) -> tuple[Input, ...]:
    """Those inputs that ``design`` has, in its order."""
    wanted_ids = set(ids)
    return tuple(track for track in design.inputs if track.id in wanted_ids)


def tracks_text(chosen: tuple[Input, ...], limb: str) -> str:
    """What the history calls them: "input at 7 (II pad)", or "3 inputs"."""
    return (
        f"input at {location_text(chosen[0].location, limb)}"
        if len(chosen) == 1
        else (f"{len(chosen)} inputs")
    )


def location_text(location: int, limb: str = "") -> str:
    """Number and short name of an input place of a limb, "7 (II pad)"."""
    short = input_name(location, limb).short_name
    return str(location) if short == f"place {location}" else f"{location} ({short})"


def changed(
    design: Design,
    view: View,
    verb: str,
    changes: dict[int, dict[str, Any]],
    clip_changes: dict[int, dict[str, Any]] | None = None,
) -> Edit | Refusal:
    """Change fields of inputs, and of clips of them, by id; refused where one is not allowed."""
    chosen = present(design, changes)
    if not chosen:
        return NOTHING_CHOSEN
    try:
        inputs = tuple(
            _with_clips(_replaced(track, changes.get(track.id, {})), clip_changes or {})
            for track in design.inputs
        )
        after = replace(design, inputs=inputs)
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=f"{verb} {tracks_text(chosen, design.limb)}", design=after, view=view)


def with_clips(design: Design, changes: dict[int, dict[str, Any]]) -> Design:
    """Return ``design`` with changed fields of clips, by id.

    Raises
    ------
    InvalidInputError
        A value is not allowed.
    """
    if not changes:
        return design
    return replace(design, inputs=tuple(_with_clips(track, changes) for track in design.inputs))


def _with_clips(track: Input, changes: dict[int, dict[str, Any]]) -> Input:
    if not changes or not any(clip.id in changes for clip in track.clips):
        return track
    clips = tuple(
        replace(clip, **changes[clip.id]) if clip.id in changes else clip for clip in track.clips
    )
    return track if clips == track.clips else replace(track, clips=clips)


def _replaced(track: Input, changes: dict[str, Any]) -> Input:
    # What does not change keeps its identity.
    if not changes:
        return track
    after = replace(track, **changes)
    return track if after == track else after


# From one kind of waveform to another.


@dataclass(frozen=True, slots=True, kw_only=True)
class KindSpec(ChoiceSpec):
    """A choice among kinds of waveforms."""


def kind_spec() -> KindSpec:
    """What an input may play."""
    return KindSpec(
        label="Waveform",
        options=tuple((kind.__name__, kind.title) for kind in kinds()),
        hint="What this input plays",
    )


def kind_name(waveform: Waveform) -> str:
    """Option of `kind_spec` that a waveform is."""
    return type(waveform).__name__


def as_kind(waveform: Waveform, kind: type[Waveform], rate_hz: float) -> Waveform:
    """A waveform of another kind that shares what it can with ``waveform``.

    A number that the other kind does not allow becomes the nearest one that it does.  A kind that
    holds samples gets those that ``waveform`` plays at ``rate_hz``, the rate of the limb.
    """
    if kind is type(waveform):
        return waveform
    present = specs_of(waveform)
    result: Any = Glide.like(waveform) if kind is Glide else kind()
    for field, spec in specs_of(kind).items():
        change: dict[str, Any] = {}
        if isinstance(spec, SamplesSpec):
            change = _played(waveform, field, spec, rate_hz)
        elif type(present.get(field)) is type(spec):
            change = _shared(waveform, field, spec)
        # What does not go together with the rest stays as it is in a new one.
        with suppress(InvalidInputError):
            result = replace(result, **change)
    return result


def _shared(waveform: Waveform, field: str, spec: Spec) -> dict[str, Any]:
    """The value of a field of both kinds, as the new one allows it."""
    value = getattr(waveform, field)
    if isinstance(spec, NumberSpec):
        return {field: nearest(value, spec)}
    return {field: value} if isinstance(spec, ChoiceSpec) and value in dict(spec.options) else {}


def _played(
    waveform: Waveform, field: str, spec: SamplesSpec, rate_hz: float
) -> dict[str, Samples]:
    """What a waveform plays, as the samples of ``field``; nothing where it cannot be."""
    samples = getattr(waveform, field, None)
    try:
        if isinstance(samples, Samples):
            played = samples if spec.unit is None else replace(samples, unit=spec.unit)
        else:
            played = Samples(values=waveform.samples(rate_hz), sample_rate_hz=rate_hz)
        return {field: spec.checked(played)}
    except InvalidInputError:
        return {}


def nearest(value: float, spec: NumberSpec) -> float:
    """The allowed number nearest to ``value``."""
    within = min(max(value, spec.minimum), spec.maximum)
    return round(within) if spec.whole else float(within)


# Why clips cannot be cut in two at a time.


def why_uncut(chosen: Sequence[Clip], at_s: float, same_s: float) -> str:
    """Why a time cuts none of some clips; times closer than ``same_s`` are the same."""
    whose, which = ("The", "it") if len(chosen) == 1 else ("A", "one of them")
    reason = f"None of the selected clips plays at {at_s:.6g} s"
    for verb, attribute in (("begins", "onset_s"), ("ends", "end_s")):
        if any(abs(getattr(clip, attribute) - at_s) <= same_s for clip in chosen):
            reason = f"{whose} selected clip {verb} at {at_s:.6g} s: there is nothing to split"
    return f"{reason}; put the playhead inside {which}."


# Which inputs and clips are selected, and which after an edit.


def select_inputs(design: Design, view: View, ids: Iterable[int]) -> Edit:
    """Select inputs, the last of them the one that stands apart."""
    existing = dict.fromkeys(input_id for input_id in ids if input_id in design.ids)
    on_them = {clip.id for track in design.inputs if track.id in existing for clip in track.clips}
    clips = tuple(clip_id for clip_id in view.selected_clips if clip_id in on_them)
    return Edit(
        label="Select inputs",
        design=design,
        view=replace(view, selected_inputs=tuple(existing), selected_clips=clips),
    )


def select_all_inputs(design: Design, view: View) -> Edit:
    """Select every input; the one that stood apart still does."""
    last = () if view.selected_input is None else (view.selected_input,)
    others = (input_id for input_id in design.ids if input_id not in last)
    return select_inputs(design, view, (*others, *last))


def toggle_selected(design: Design, view: View, id: int) -> Edit:
    """Add an input to the selected ones, or take it out."""
    remaining = tuple(input_id for input_id in view.selected_inputs if input_id != id)
    return select_inputs(
        design, view, remaining if id in view.selected_inputs else (*remaining, id)
    )


def select_through(design: Design, view: View, start: int | None, end: int) -> Edit:
    """Select all inputs from ``start`` to ``end`` as they are listed; ``end`` stands apart."""
    if end not in design.ids:
        return select_inputs(design, view, view.selected_inputs)
    if start not in design.ids:
        return select_inputs(design, view, (end,))
    first, last = design.index_of(start), design.index_of(end)
    between = design.ids[min(first, last) : max(first, last) + 1]
    return select_inputs(design, view, between if first <= last else between[::-1])


def clips_of(track: Input, view: View) -> tuple[Clip, ...]:
    """Clips of an input that edits of it are about: the selected ones, or else its first."""
    return tuple(clip for clip in track.clips if clip.id in view.selected_clips) or track.clips[:1]


def clip_of(track: Input, view: View) -> Clip | None:
    """The one of them that stands apart: selected last; None where there is no clip."""
    order = {id: place for place, id in enumerate(view.selected_clips)}
    return max(clips_of(track, view), key=lambda clip: order.get(clip.id, 0), default=None)


def kept_selection(view: View, before: Design, after: Design) -> View:
    """Return ``view`` with those selected inputs and clips that ``after`` still has.

    Where no input is left, the neighbour of the one that stood apart is selected: the next that is
    still there, or else the one before.
    """
    clip_ids = {clip.id for clip in after.clips} if view.selected_clips else set()
    if not clip_ids.issuperset(view.selected_clips):
        remaining = tuple(clip_id for clip_id in view.selected_clips if clip_id in clip_ids)
        view = replace(view, selected_clips=remaining)
    existing = set(after.ids)
    if existing.issuperset(view.selected_inputs):
        return view
    remaining = tuple(input_id for input_id in view.selected_inputs if input_id in existing)
    if not remaining and view.selected_input in before.ids:
        place = before.index_of(view.selected_input)
        following = [input_id for input_id in before.ids[place:] if input_id in existing]
        preceding = [input_id for input_id in before.ids[:place] if input_id in existing]
        remaining = tuple([*preceding[-1:], *following[:1]][-1:])
    return replace(view, selected_inputs=remaining)
