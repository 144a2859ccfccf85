"""Placing, moving, copying, removing and silencing inputs."""

from collections.abc import Iterable
from dataclasses import replace
from itertools import count
from typing import Any

from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import quoted
from skinsource.base.work import counted
from skinsource.design.clips import Clip
from skinsource.design.design import MAX_INPUTS, Design, track
from skinsource.design.edits.clips import (
    NO_CLIP,
    clips_selected,
    clips_text,
    present_clips,
    replace_clips,
    short,
)
from skinsource.design.edits.edit import (
    NOTHING_CHOSEN,
    Edit,
    Refusal,
    changed,
    clip_of,
    kept_selection,
    location_text,
    present,
    refused,
    tracks_text,
)
from skinsource.design.motions import Motion
from skinsource.design.view import View
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.samples import MAX_PARTS, Layers, Mode
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of

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
        label=f"Place input at {location_text(location, design.limb)}",
        design=after,
        view=replace(
            view,
            selected_inputs=(*(view.selected_inputs if besides else ()), after.ids[-1]),
            selected_clips=(),
        ),
    )


def add_input(design: Design, view: View) -> Edit | Refusal:
    """Add an input at a place where there is none yet, the usual one first, and select it."""
    taken, usual = {track.location for track in design.inputs}, usual_location(design.limb)
    free = (k for k in (usual, *range(1, facts_of(design.limb).n_inputs + 1)) if k not in taken)
    return place_input(design, view, next(free, usual))


def move_inputs(design: Design, view: View, ids: Iterable[int], location: int) -> Edit | Refusal:
    """Put inputs at another place."""
    chosen = present(design, ids)
    changes = {track.id: {"location": location} for track in chosen}
    outcome = changed(design, view, "Move", changes)
    if isinstance(outcome, Refusal):
        return outcome
    # Where it comes from is not said: during a drag that is the place before.
    what = "input" if len(chosen) == 1 else tracks_text(chosen, design.limb)
    return replace(outcome, label=f"Move {what} to {location_text(location, design.limb)}")


def duplicate_inputs(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Add a copy of each input at the end, and select the copies."""
    chosen = present(design, ids)
    if not chosen:
        return NOTHING_CHOSEN
    if len(design.inputs) + len(chosen) > MAX_INPUTS:
        return _TOO_MANY
    after = design
    for track in chosen:
        after = after.adding(track)
    return Edit(
        label=f"Duplicate {tracks_text(chosen, design.limb)}",
        design=after,
        view=replace(view, selected_inputs=after.ids[len(design.inputs) :], selected_clips=()),
    )


def remove_inputs(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Remove inputs; where the selected ones are among them, a neighbour is selected."""
    chosen = present(design, ids)
    if not chosen:
        return NOTHING_CHOSEN
    after = replace(design, inputs=tuple(track for track in design.inputs if track not in chosen))
    return Edit(
        label=f"Remove {tracks_text(chosen, design.limb)}",
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
    return changed(design, view, verb, {input_id: {"muted": muted} for input_id in ids})


def toggle_mute(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Silence inputs; if all of them are muted, let them be heard again."""
    chosen = present(design, ids)
    muted = not all(track.muted for track in chosen)
    return mute_inputs(design, view, (track.id for track in chosen), muted)


def solo_inputs(design: Design, view: View, ids: Iterable[int], solo: bool) -> Edit | Refusal:
    """Hear only these inputs and other solo ones, or no longer."""
    verb = "Solo" if solo else "End solo of"
    return changed(design, view, verb, {input_id: {"solo": solo} for input_id in ids})


def toggle_solo(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Make inputs solo; if all of them are, no longer."""
    chosen = present(design, ids)
    solo = not all(track.solo for track in chosen)
    return solo_inputs(design, view, (track.id for track in chosen), solo)


def _with_fresh_seed(waveform: Waveform, design: Design) -> Waveform:
    """Return ``waveform`` with the smallest seed that no clip has, if it has one at all.

    Noise of equal seed is the same noise, and sums up as no two noises do.
    """
    if "seed" not in specs_of(waveform):
        return waveform
    taken = {getattr(clip.waveform, "seed", None) for clip in design.clips}
    recipe: Any = waveform
    return replace(recipe, seed=next(k for k in count() if k not in taken))


# Clips of one track as one clip, and back.


def group_clips(
    design: Design, view: View, ids: Iterable[int], mode: Mode = "sum"
) -> Edit | Refusal:
    """Put clips of one track into one clip, added up or multiplied."""
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    track = design.track_of(chosen[0].id)
    wanted = {clip.id for clip in chosen}
    if not wanted <= {clip.id for clip in track.clips}:
        return Refusal(sentence="Clips of several tracks make no group; select those of one track.")
    if len(chosen) > MAX_PARTS:
        return Refusal(sentence=f"A group holds at most {MAX_PARTS} clips.")
    start_s = min(clip.onset_s for clip in chosen)
    parts = tuple(replace(clip, onset_s=short(clip.onset_s - start_s), id=0) for clip in chosen)
    first = chosen[0]
    try:
        group = Clip(waveform=Layers(parts=parts, mode=mode), onset_s=start_s, id=first.id)
        clips = [
            group if clip.id == first.id else clip
            for clip in track.clips
            if clip.id == first.id or clip.id not in wanted
        ]
        inputs = tuple(replace_clips(one, clips) if one is track else one for one in design.inputs)
        after = replace(design, inputs=inputs)
    except InvalidInputError as error:
        return refused(error)
    view = clips_selected(after, view, (group.id,))
    return Edit(label=f"Group {clips_text(design, chosen)}", design=after, view=view)


def ungroup_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Put the parts of groups back on their track, where no effect stands in between."""
    groups = {
        clip.id: clip.waveform for clip in present_clips(design, ids) if _can_be_ungrouped(clip)
    }
    if not groups:
        return Refusal(
            sentence="None of the selected clips is a sum of layers without effects; only those "
            "can be ungrouped."
        )
    inputs = []
    try:
        for track in design.inputs:
            clips: list[Clip] = []
            for clip in track.clips:
                if clip.id not in groups or not isinstance(clip.waveform, Layers):
                    clips.append(clip)
                    continue
                parts = [_freed(part, clip) for part in clip.waveform.parts]
                clips += [replace(parts[0], id=clip.id), *parts[1:]]
            inputs.append(replace_clips(track, clips))
        after = replace(design, inputs=tuple(inputs))
    except InvalidInputError as error:
        return refused(error)
    known = {clip.id for clip in design.clips} - set(groups)
    freed = tuple(clip.id for clip in after.clips if clip.id not in known)
    words = "clip" if len(groups) == 1 else f"{len(groups)} clips"
    view = clips_selected(after, view, freed)
    return Edit(label=f"Ungroup {words}", design=after, view=view)


def _can_be_ungrouped(clip: Clip) -> bool:
    is_sum = isinstance(clip.waveform, Layers) and clip.waveform.mode == "sum"
    return is_sum and not any(effect.on for effect in clip.effects)


def _freed(part: Clip, group: Clip) -> Clip:
    onset_s = short(group.onset_s + part.onset_s)
    return replace(
        part,
        onset_s=onset_s,
        gain=part.gain * group.gain,
        muted=part.muted or group.muted,
        id=0,
    )


# Placing a waveform that was made elsewhere: a recording, a preset.


def place_waveform(
    design: Design, view: View, location: int, waveform: Waveform, onset_s: float = 0.0
) -> Edit | Refusal:
    """Add an input at a place that plays ``waveform``, with amplitude 1, and select it."""
    if len(design.inputs) >= MAX_INPUTS:
        return Refusal(sentence=f"A design holds at most {MAX_INPUTS} inputs; remove one first.")
    try:
        after = design.adding(track(location, waveform, onset_s=onset_s))
    except InvalidInputError as error:
        return refused(error)
    return Edit(
        label=f"Place {waveform.title.lower()} at {location_text(location, design.limb)}",
        design=after,
        view=replace(view, selected_inputs=after.ids[-1:], selected_clips=()),
    )


# Motions become tracks of a design.


def add_motion(design: Design, view: View, motion: Motion) -> Edit | Refusal:
    """Add the tracks of a motion at the end, and select them."""
    if not isinstance(motion, Motion):
        return Refusal(
            sentence=f"{quoted(motion)} is no motion; make one of skinsource.design.motions."
        )
    try:
        tracks = motion.tracks()
        if len(design.inputs) + len(tracks) > MAX_INPUTS:
            return Refusal(
                sentence=f"{motion.title} takes {counted(len(tracks), 'input')} more, and a "
                f"design holds at most {MAX_INPUTS}; remove some first."
            )
        after = design
        for track in tracks:
            after = after.adding(track)
    except InvalidInputError as error:
        return refused(error)
    return Edit(
        label=f"Add {motion.title.lower()} at {counted(len(tracks), 'place')}",
        design=after,
        view=replace(view, selected_inputs=after.ids[len(design.inputs) :], selected_clips=()),
    )


# The order in which inputs are listed; no number depends on it, but for rounding.


def put_inputs_before(design: Design, view: View, ids: Iterable[int], index: int) -> Edit | Refusal:
    """List inputs together, before the one that is ``index``-th now; the number of all: last."""
    chosen = present(design, ids)
    if not chosen:
        return NOTHING_CHOSEN
    before = [track for track in design.inputs[: max(index, 0)] if track not in chosen]
    after = [track for track in design.inputs[max(index, 0) :] if track not in chosen]
    return Edit(
        label=f"Reorder {tracks_text(chosen, design.limb)}",
        design=replace(design, inputs=(*before, *chosen, *after)),
        view=view,
    )


def shift_inputs(design: Design, view: View, ids: Iterable[int], down: bool) -> Edit | Refusal:
    """List each input one place further up or down, as far as there is room."""
    chosen = present(design, ids)
    if not chosen:
        return NOTHING_CHOSEN
    order = list(design.inputs[::-1] if down else design.inputs)
    for place in range(1, len(order)):
        if order[place] in chosen and order[place - 1] not in chosen:
            order[place - 1], order[place] = order[place], order[place - 1]
    return Edit(
        label=f"Reorder {tracks_text(chosen, design.limb)}",
        design=replace(design, inputs=tuple(order[::-1] if down else order)),
        view=view,
    )
