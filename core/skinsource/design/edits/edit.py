"""Edits and refusals, and what all edits share: changing fields, kinds and selections.

The selected input or clip that was selected last is the leading one: where a panel shows one value
of several, it is that of the leading one.
"""

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import wraps
from itertools import islice
from typing import Any, ParamSpec, TypeVar

from skinsource.base.arguments import checking
from skinsource.base.errors import InvalidInputError, sentence
from skinsource.design.clips import Clip
from skinsource.design.design import MAX_INPUTS, Design, Input, View
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms import kinds
from skinsource.design.waveforms.samples import Layers
from skinsource.design.waveforms.tones import Glide
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource.limbs.locations import input_name
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec, SamplesSpec
from skinsource.specs.samples import Samples
from skinsource.specs.spec import ChoiceSpec, Spec

P = ParamSpec("P")
R = TypeVar("R")


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit:
    """The design and the view after an edit.

    Attributes
    ----------
    label
        Name of the edit in the history: "Mute input at 7 (II pad)".
    said
        Message about what the user may not see in the window; mostly empty.
    """

    label: str
    design: Design
    view: View
    said: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Refusal:
    """An edit that is not done; ``sentence`` says why, and what to do instead."""

    sentence: str


NOTHING_CHOSEN = "No input is selected; click one, on the hand or in the list."


def refusing(edit: Callable[P, R]) -> Callable[P, R | Refusal]:
    """Return an edit that gives a `Refusal` where it would raise an `InvalidInputError`.

    That includes arguments of a wrong type.
    """
    checked_edit = checking(edit)

    @wraps(edit)
    def refusing_edit(*args: P.args, **kwargs: P.kwargs) -> R | Refusal:
        try:
            return checked_edit(*args, **kwargs)
        except InvalidInputError as error:
            return Refusal(sentence=sentence(str(error)))

    return refusing_edit


#: More ids than all clips of a design can have.
_MOST_IDS = 200_000


def listed(ids: Iterable[int]) -> tuple[int, ...]:
    """Return ids as a tuple; refuse what may have no end."""
    several = tuple(islice(ids, _MOST_IDS + 1))
    if len(several) > _MOST_IDS:
        raise InvalidInputError(f"there are more than {_MOST_IDS} ids, expected those of a design")
    return several


def present_inputs(design: Design, ids: Iterable[int]) -> tuple[Input, ...]:
    """Return those inputs that ``design`` has, in its order."""
    wanted_ids = set(listed(ids))
    return tuple(track for track in design.inputs if track.id in wanted_ids)


def chosen_inputs(design: Design, ids: Iterable[int]) -> tuple[Input, ...]:
    """Return those inputs that ``design`` has, in its order; `InvalidInputError` without any."""
    chosen = present_inputs(design, ids)
    if not chosen:
        raise InvalidInputError(NOTHING_CHOSEN)
    return chosen


def tracks_text(chosen: tuple[Input, ...], limb: str) -> str:
    """Return the name of inputs in the history: "input at 7 (II pad)", or "3 inputs"."""
    if len(chosen) != 1:
        return f"{len(chosen)} inputs"
    return f"input at {location_text(chosen[0].location, limb)}"


def location_text(location: int, limb: str = "") -> str:
    """Return number and short name of an input place of a limb: "7 (II pad)"."""
    short = input_name(location, limb).short_name
    return str(location) if short == f"place {location}" else f"{location} ({short})"


@refusing
def change_inputs(
    design: Design,
    view: View,
    verb: str,
    changes: dict[int, dict[str, Any]],
    clip_changes: dict[int, dict[str, Any]] | None = None,
) -> Edit | Refusal:
    """Change fields of inputs and of their clips, by id."""
    chosen = chosen_inputs(design, changes)
    inputs = tuple(
        _with_clips(_replaced(track, changes.get(track.id, {})), clip_changes or {})
        for track in design.inputs
    )
    after = replace(design, inputs=inputs)
    n_clips = len(clip_changes or {}) if view.selected_clips else 0
    what = f"{n_clips} clips" if n_clips > 1 else tracks_text(chosen, design.limb)
    return Edit(label=f"{verb} {what}", design=after, view=view)


@refusing
def change_view(design: Design, view: View, label: str, **changes: Any) -> Edit | Refusal:
    """Change fields of the view."""
    return Edit(label=label, design=design, view=replace(view, **changes))


def with_inputs_added(design: Design, new: Sequence[Input]) -> Design:
    """Return ``design`` with more inputs at the end; `InvalidInputError` where it has no room."""
    if len(design.inputs) + len(new) > MAX_INPUTS:
        raise InvalidInputError(f"A design holds at most {MAX_INPUTS} inputs; remove some first.")
    for track in new:
        design = design.adding(track)
    return design


def change_clips(design: Design, changes: dict[int, dict[str, Any]]) -> Design:
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
    if changes.keys().isdisjoint([clip.id for clip in track.clips]):
        return track
    clips = tuple(
        replace(clip, **changes[clip.id]) if clip.id in changes else clip for clip in track.clips
    )
    return track if clips == track.clips else replace(track, clips=clips)


def _replaced(track: Input, changes: dict[str, Any]) -> Input:
    # An unchanged input stays the same object.
    if not changes:
        return track
    after = replace(track, **changes)
    return track if after == track else after


@dataclass(frozen=True, slots=True, kw_only=True)
class KindSpec(ChoiceSpec):
    """A choice among kinds of waveforms."""


def kind_spec() -> KindSpec:
    """Return the choice of what an input plays."""
    return KindSpec(
        label="Waveform",
        options=tuple((kind.__name__, kind.title) for kind in kinds()),
        hint="What this input plays",
    )


def kind_name(waveform: Waveform) -> str:
    """Return the option of `kind_spec` for a waveform."""
    return type(waveform).__name__


def as_kind(waveform: Waveform, kind: type[Waveform], rate_hz: float) -> Waveform:
    """Return a waveform of another kind that keeps the fields that both kinds have.

    A number that the other kind does not allow becomes the nearest allowed one.  A kind that holds
    samples gets those that ``waveform`` plays at ``rate_hz``, the rate of the limb; layers have
    ``waveform`` as the first one.
    """
    if kind is type(waveform):
        return waveform
    if kind is Layers:
        return Layers((Clip(waveform=waveform),))
    present = specs_of(waveform)
    result: Any = Glide.like(waveform) if kind is Glide else kind()
    for field, spec in specs_of(kind).items():
        change: dict[str, Any] = {}
        if isinstance(spec, SamplesSpec):
            change = _played(waveform, field, spec, rate_hz)
        elif type(present.get(field)) is type(spec):
            change = _shared(waveform, field, spec)
        # A field that does not fit the other fields keeps its default.
        with suppress(InvalidInputError):
            result = replace(result, **change)
    return result


def _shared(waveform: Waveform, field: str, spec: Spec) -> dict[str, Any]:
    """Return the value of a field that both kinds have, as the new kind allows it."""
    value = getattr(waveform, field)
    if isinstance(spec, NumberSpec):
        return {field: nearest(value, spec)}
    return {field: value} if isinstance(spec, ChoiceSpec) and value in dict(spec.options) else {}


def _played(
    waveform: Waveform, field: str, spec: SamplesSpec, rate_hz: float
) -> dict[str, Samples]:
    """Return what a waveform plays as the samples of ``field``; empty where it cannot."""
    samples = getattr(waveform, field, None)
    try:
        if isinstance(samples, Samples):
            played = samples if spec.unit is None else replace(samples, unit=spec.unit)
        else:
            played = Samples(values=waveform.samples(rate_hz), sample_rate_hz=rate_hz)
        return {field: spec.checked(played)}
    except InvalidInputError:
        return {}


def with_field(model: Any, name: str, value: Any, at_start: Any = None) -> Any:
    """Return a model with another value in a field; gains of wavelets follow their frequencies.

    If a wavelet has no gain, neither now nor ``at_start`` of the gesture, all gains go.

    >>> train = WaveletTrain((50.0, 400.0), gains_db=(-6.0, 0.0))
    >>> with_field(train, "frequencies_hz", (400.0, 50.0)).gains_db
    (0.0, -6.0)
    """
    if name != "frequencies_hz" or not isinstance(model, WaveletTrain):
        return replace(model, **{name: value})

    def wavelets(train: WaveletTrain) -> list[tuple[float, int]]:
        # A frequency that is there again is another wavelet.
        all_hz = train.frequencies_hz
        return [(hz, all_hz[:k].count(hz)) for k, hz in enumerate(all_hz)]

    gains_db: dict[tuple[float, int], float] = {}
    for train in (at_start, model):
        if isinstance(train, WaveletTrain) and train.gains_db:
            gains_db |= zip(wavelets(train), train.gains_db, strict=True)
    after = replace(model, frequencies_hz=value, gains_db=())
    if not gains_db.keys() >= set(wavelets(after)):
        return after
    return replace(after, gains_db=tuple(gains_db[each] for each in wavelets(after)))


def nearest(value: float, spec: NumberSpec) -> float:
    """Return the allowed number nearest to ``value``."""
    within = min(max(value, spec.minimum), spec.maximum)
    return round(within) if spec.whole else float(within)


@checking
def select_inputs(design: Design, view: View, ids: Iterable[int]) -> Edit:
    """Select inputs and no clips; the last one is the leading one.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.select_inputs(design, ss.View(), [2])
    >>> print(edit.view.selected_inputs)
    (2,)
    """
    existing = dict.fromkeys(input_id for input_id in listed(ids) if input_id in design.ids)
    view = replace(view, selected_inputs=tuple(existing), selected_clips=())
    return Edit(label="Select inputs", design=design, view=view)


@checking
def select_all_inputs(design: Design, view: View) -> Edit:
    """Select every input; the leading one stays.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.select_all_inputs(design, ss.View())
    >>> print(edit.view.selected_inputs)
    (2, 1)
    """
    last = () if view.selected_input is None else (view.selected_input,)
    others = (input_id for input_id in design.ids if input_id not in last)
    return select_inputs(design, view, (*others, *last))


@checking
def toggle_selected(design: Design, view: View, id: int) -> Edit:
    """Add an input to the selected ones, or remove it from them.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.toggle_selected(design, ss.View(), 2)
    >>> print(edit.view.selected_inputs)
    (1, 2)
    """
    remaining = tuple(input_id for input_id in view.selected_inputs if input_id != id)
    return select_inputs(
        design, view, remaining if id in view.selected_inputs else (*remaining, id)
    )


@checking
def select_through(design: Design, view: View, start: int | None, end: int) -> Edit:
    """Select all inputs from ``start`` to ``end`` in the list; ``end`` is the leading one.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.select_through(design, ss.View(), 1, 2)
    >>> print(edit.view.selected_inputs)
    (1, 2)
    """
    if end not in design.ids:
        return select_inputs(design, view, view.selected_inputs)
    if start not in design.ids:
        return select_inputs(design, view, (end,))
    first, last = design.index_of(start), design.index_of(end)
    between = design.ids[min(first, last) : max(first, last) + 1]
    return select_inputs(design, view, between if first <= last else between[::-1])


def clips_of(track: Input, view: View) -> tuple[Clip, ...]:
    """Return the clips of an input that edits change: the selected ones, or else its first."""
    return tuple(clip for clip in track.clips if clip.id in view.selected_clips) or track.clips[:1]


def clip_of(track: Input, view: View) -> Clip | None:
    """Return the leading one of `clips_of`, which was selected last; None without clips."""
    own = {clip.id: clip for clip in track.clips}
    last = next((id for id in reversed(view.selected_clips) if id in own), None)
    return next(iter(track.clips), None) if last is None else own[last]


def leading_input(design: Design, view: View) -> Input | None:
    """Return the input that was selected last; None where the design has it no more."""
    last = view.selected_input
    return next((track for track in design.inputs if track.id == last), None)


def leading_clip(design: Design, view: View) -> Clip | None:
    """Return the clip of `leading_input` that edits change; None where there is none."""
    track = leading_input(design, view)
    return None if track is None else clip_of(track, view)


@checking
def kept_selection(view: View, before: Design, after: Design) -> View:
    """Return ``view`` with those selected inputs and clips that ``after`` still has.

    If no selected input is left, the one next to the leading one is selected: the next in the
    list, or else the one before.

    Examples
    --------
    >>> from dataclasses import replace
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> value = ss.edits.kept_selection(
    ...     ss.View(selected_inputs=(1, 2)), design, replace(design, inputs=())
    ... )
    >>> print(value.selected_inputs)
    ()
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
        index = before.index_of(view.selected_input)
        following = [input_id for input_id in before.ids[index:] if input_id in existing]
        preceding = [input_id for input_id in before.ids[:index] if input_id in existing]
        remaining = tuple([*preceding[-1:], *following[:1]][-1:])
    return replace(view, selected_inputs=remaining)
