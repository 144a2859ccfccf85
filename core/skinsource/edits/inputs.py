"""Placing, moving, copying, removing and silencing inputs."""

from collections.abc import Iterable
from dataclasses import replace
from itertools import count
from typing import Any

from skinsource.design import MAX_INPUTS, Design, track
from skinsource.edits.edit import (
    NOTHING_CHOSEN,
    Edit,
    Refusal,
    changed,
    inputs_words,
    place_words,
    present,
    refused,
)
from skinsource.edits.selection import clip_of, kept_selection
from skinsource.errors import InvalidInputError
from skinsource.fields import specs_of
from skinsource.own_limbs import facts_of
from skinsource.view import View
from skinsource.waveforms import Waveform

#: Where an input is added, and a recording goes, if nobody says where.
USUAL_LOCATION = 7


def usual_location(limb: str) -> int:
    """Where an input goes on a limb if nobody says where: digit II's pad of the published ones."""
    return min(USUAL_LOCATION, facts_of(limb).n_inputs)


_TOO_MANY = Refusal(sentence=f"A design holds at most {MAX_INPUTS} inputs; remove one first.")


def place_input(design: Design, view: View, location: int, besides: bool = False) -> Edit | Refusal:
    """Add an input at a place and select it, or with ``besides`` add it to the selected ones.

    It plays what the selected clip plays, as strongly, but noise of its own; from the start.
    """
    if len(design.inputs) >= MAX_INPUTS:
        return _TOO_MANY
    try:
        new = track(location)
    except InvalidInputError as error:
        return refused(error)
    if view.selected_input in design.ids:
        model = design.input(view.selected_input)
        clip = clip_of(model, view)
        if clip is not None:
            waveform = _with_fresh_seed(clip.waveform, design)
            copy = replace(clip, waveform=waveform, onset_s=0.0, muted=False, label="", id=0)
            new = replace(new, clips=(copy,))
        new = replace(new, amplitude=model.amplitude)
    after = design.adding(new)
    return Edit(
        label=f"Place input at {place_words(location, design.limb)}",
        design=after,
        view=replace(
            view,
            selected_inputs=(*(view.selected_inputs if besides else ()), after.ids[-1]),
            selected_clips=(),
        ),
    )


def add_input(design: Design, view: View) -> Edit | Refusal:
    """Add an input at a place where there is none yet, the usual one first, and select it."""
    taken, usual = {one.location for one in design.inputs}, usual_location(design.limb)
    free = (k for k in (usual, *range(1, facts_of(design.limb).n_inputs + 1)) if k not in taken)
    return place_input(design, view, next(free, usual))


def move_inputs(design: Design, view: View, ids: Iterable[int], location: int) -> Edit | Refusal:
    """Put inputs at another place."""
    chosen = present(design, ids)
    changes = {one.id: {"location": location} for one in chosen}
    outcome = changed(design, view, "Move", changes)
    if isinstance(outcome, Refusal):
        return outcome
    # Where it comes from is not said: during a drag that is the place before.
    what = "input" if len(chosen) == 1 else inputs_words(chosen, design.limb)
    return replace(outcome, label=f"Move {what} to {place_words(location, design.limb)}")


def duplicate_inputs(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Add a copy of each input at the end, and select the copies."""
    chosen = present(design, ids)
    if not chosen:
        return NOTHING_CHOSEN
    if len(design.inputs) + len(chosen) > MAX_INPUTS:
        return _TOO_MANY
    after = design
    for one in chosen:
        after = after.adding(one)
    return Edit(
        label=f"Duplicate {inputs_words(chosen, design.limb)}",
        design=after,
        view=replace(view, selected_inputs=after.ids[len(design.inputs) :], selected_clips=()),
    )


def remove_inputs(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Remove inputs; where the selected ones are among them, a neighbour is selected."""
    chosen = present(design, ids)
    if not chosen:
        return NOTHING_CHOSEN
    after = replace(design, inputs=tuple(one for one in design.inputs if one not in chosen))
    return Edit(
        label=f"Remove {inputs_words(chosen, design.limb)}",
        design=after,
        view=kept_selection(view, design, after),
    )


def clear_inputs(design: Design, view: View) -> Edit | Refusal:
    """Remove all inputs."""
    if not design.inputs:
        return Refusal(sentence="There is no input to remove.")
    return Edit(
        label="Remove all inputs",
        design=replace(design, inputs=()),
        view=replace(view, selected_inputs=(), selected_clips=()),
    )


def mute_inputs(design: Design, view: View, ids: Iterable[int], muted: bool) -> Edit | Refusal:
    """Silence inputs, or let them be heard again."""
    verb = "Mute" if muted else "Unmute"
    return changed(design, view, verb, {one: {"muted": muted} for one in ids})


def toggle_mute(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Silence inputs; if all of them are muted, let them be heard again."""
    chosen = present(design, ids)
    muted = not all(one.muted for one in chosen)
    return mute_inputs(design, view, (one.id for one in chosen), muted)


def solo_inputs(design: Design, view: View, ids: Iterable[int], solo: bool) -> Edit | Refusal:
    """Hear only these inputs and other solo ones, or no longer."""
    verb = "Solo" if solo else "End solo of"
    return changed(design, view, verb, {one: {"solo": solo} for one in ids})


def toggle_solo(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Make inputs solo; if all of them are, no longer."""
    chosen = present(design, ids)
    solo = not all(one.solo for one in chosen)
    return solo_inputs(design, view, (one.id for one in chosen), solo)


def _with_fresh_seed(waveform: Waveform, design: Design) -> Waveform:
    """Return ``waveform`` with the smallest seed that no clip has, if it has one at all.

    Noise of equal seed is the same noise, and sums up as no two noises do.
    """
    if "seed" not in specs_of(waveform):
        return waveform
    taken = {getattr(one.waveform, "seed", None) for one in design.clips}
    recipe: Any = waveform
    return replace(recipe, seed=next(k for k in count() if k not in taken))
