"""Place, move, copy, remove, silence and reorder inputs; group their clips."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import count
from typing import Any

from skinsource.base.errors import counted
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, View, track
from skinsource.design.edits.clips import (
    add_clip,
    chosen_clips,
    clips_selected,
    clips_text,
    present_clips,
    short,
    with_clips,
)
from skinsource.design.edits.edit import (
    Edit,
    Refusal,
    change_inputs,
    chosen_inputs,
    clip_of,
    kept_selection,
    leading_input,
    listed,
    location_text,
    present_inputs,
    refusing,
    tracks_text,
    with_inputs_added,
)
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.samples import MAX_PARTS, Layers, Mode
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of

#: Pad of digit II on the published limbs, where an input goes if nobody chooses a location.
_USUAL_LOCATION = 7


def usual_location(limb: str) -> int:
    """Return where an input goes on a limb if nobody chooses a location."""
    return min(_USUAL_LOCATION, facts_of(limb).n_inputs)


@refusing
def place_input(design: Design, view: View, location: int, besides: bool = False) -> Edit | Refusal:
    """Add an input at a place and select it; with ``besides`` the selected inputs stay selected.

    It plays what the selected clip plays, with the same amplitude, from time 0; noise gets a seed
    of its own.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.place_input(design, ss.View(), 12)
    >>> print([track.location for track in edit.design.inputs])
    [7, 8, 12]
    """
    new = track(location)
    selected = leading_input(design, view)
    if selected is not None:
        clip = clip_of(selected, view)
        if clip is not None:
            waveform = _with_fresh_seed(clip.waveform, design)
            copy = replace(clip, waveform=waveform, onset_s=0.0, muted=False, label="", id=0)
            new = replace(new, clips=(copy,))
        new = replace(new, amplitude=selected.amplitude)
    edit = _added(design, view, f"Place input at {location_text(location, design.limb)}", [new])
    if not besides:
        return edit
    return replace(
        edit,
        view=replace(
            view,
            selected_inputs=(*view.selected_inputs, *edit.view.selected_inputs),
            selected_clips=(*view.selected_clips, *edit.view.selected_clips),
        ),
    )


@refusing
def add_input(design: Design, view: View) -> Edit | Refusal:
    """Add an input at a free place, if possible at the usual one, and select it.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.add_input(design, ss.View())
    >>> print([track.location for track in edit.design.inputs])
    [7, 8, 1]
    """
    return place_input(design, view, free_location(design))


@refusing
def add_track(design: Design, view: View) -> Edit | Refusal:
    """Add an input without clips at the next free place, and select it."""
    selected = leading_input(design, view)
    location = free_location(design, 0 if selected is None else selected.location)
    label = f"Add track at {location_text(location, design.limb)}"
    return _added(design, view, label, [Input(location=location)])


def free_location(design: Design, after: int = 0) -> int:
    """Return a free place: the usual one if possible, or the next one ``after`` another."""
    used, usual_place = {track.location for track in design.inputs}, usual_location(design.limb)
    numbers = range(1, facts_of(design.limb).n_inputs + 1)
    places = (*numbers[after:], *numbers[:after]) if after else (usual_place, *numbers)
    return next((k for k in places if k not in used), usual_place)


@refusing
def move_inputs(design: Design, view: View, ids: Iterable[int], location: int) -> Edit | Refusal:
    """Put inputs at another place.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.move_inputs(design, ss.View(), [1], 12)
    >>> print(edit.design.inputs[0].location)
    12
    """
    chosen = present_inputs(design, ids)
    changes = {track.id: {"location": location} for track in chosen}
    outcome = change_inputs(design, view, "Move", changes)
    if isinstance(outcome, Refusal):
        return outcome
    # The label does not name the origin: during a drag that is the previous step.
    what = "input" if len(chosen) == 1 else tracks_text(chosen, design.limb)
    return replace(outcome, label=f"Move {what} to {location_text(location, design.limb)}")


@refusing
def duplicate_inputs(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Add a copy of each input at the end, and select the copies, as the inputs were.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.duplicate_inputs(design, ss.View(), [1])
    >>> print([track.location for track in edit.design.inputs])
    [7, 8, 7]
    """
    chosen = chosen_inputs(design, ids)
    edit = _added(design, view, f"Duplicate {tracks_text(chosen, design.limb)}", chosen)
    if view.selected_clips:
        return edit
    # Keys go on acting on tracks.
    return replace(edit, view=replace(edit.view, selected_clips=()))


@refusing
def remove_inputs(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Remove inputs; if no selected input is left, the next one is selected.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.remove_inputs(design, ss.View(), [1])
    >>> print([track.location for track in edit.design.inputs])
    [8]
    """
    chosen = chosen_inputs(design, ids)
    after = replace(design, inputs=tuple(track for track in design.inputs if track not in chosen))
    return Edit(
        label=f"Remove {tracks_text(chosen, design.limb)}",
        design=after,
        view=kept_selection(view, design, after),
        said=_removed_text(chosen),
    )


def _removed_text(chosen: tuple[Input, ...]) -> str:
    """Return how many inputs were removed, and how many clips where those are more."""
    n_clips = sum(len(track.clips) for track in chosen)
    clips = f" with {counted(n_clips, 'clip')}" if n_clips > len(chosen) else ""
    return f"{counted(len(chosen), 'input')}{clips} removed"


@refusing
def clear_inputs(design: Design, view: View) -> Edit | Refusal:
    """Remove all inputs.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.clear_inputs(design, ss.View())
    >>> print(edit.design.inputs)
    ()
    """
    if not design.inputs:
        return Refusal(sentence="There is no input to remove.")
    return Edit(
        label="Remove all inputs",
        design=replace(design, inputs=()),
        view=replace(view, selected_inputs=(), selected_clips=()),
        said=_removed_text(design.inputs),
    )


@refusing
def mute_inputs(design: Design, view: View, ids: Iterable[int], muted: bool) -> Edit | Refusal:
    """Mute inputs, or unmute them.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.mute_inputs(design, ss.View(), [1], True)
    >>> print(edit.design.inputs[0].muted)
    True
    """
    verb = "Mute" if muted else "Unmute"
    return change_inputs(
        design, view, verb, {input_id: {"muted": muted} for input_id in listed(ids)}
    )


@refusing
def toggle_mute(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Mute inputs; if all of them are muted, unmute them.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.toggle_mute(design, ss.View(), [1])
    >>> print(edit.design.inputs[0].muted)
    True
    """
    chosen = present_inputs(design, ids)
    muted = not all(track.muted for track in chosen)
    return mute_inputs(design, view, (track.id for track in chosen), muted)


@refusing
def solo_inputs(design: Design, view: View, ids: Iterable[int], solo: bool) -> Edit | Refusal:
    """Make inputs solo, or end their solo.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.solo_inputs(design, ss.View(), [2], True)
    >>> print(edit.design.inputs[1].solo)
    True
    """
    verb = "Solo" if solo else "End solo of"
    return change_inputs(design, view, verb, {input_id: {"solo": solo} for input_id in listed(ids)})


@refusing
def toggle_solo(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Make inputs solo; if all of them are solo, end their solo.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.toggle_solo(design, ss.View(), [1])
    >>> print(edit.design.inputs[0].solo)
    True
    """
    chosen = present_inputs(design, ids)
    solo = not all(track.solo for track in chosen)
    return solo_inputs(design, view, (track.id for track in chosen), solo)


def _with_fresh_seed(waveform: Waveform, design: Design) -> Waveform:
    """Return ``waveform`` with the smallest seed that no clip uses, if it has a seed.

    Noises of equal seed are identical and add up coherently, as independent noises do not.
    """
    if "seed" not in specs_of(waveform):
        return waveform
    used = {getattr(clip.waveform, "seed", None) for clip in design.clips}
    model: Any = waveform
    return replace(model, seed=next(k for k in count() if k not in used))


@refusing
def group_clips(
    design: Design, view: View, ids: Iterable[int], mode: Mode = "sum"
) -> Edit | Refusal:
    """Combine clips of one track into one clip, which adds or multiplies them.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> two = ss.edits.duplicate_clips(design, ss.View(), [1]).design
    >>> ids = [clip.id for clip in two.inputs[0].clips]
    >>> edit = ss.edits.group_clips(two, ss.View(), ids)
    >>> print(len(edit.design.inputs[0].clips))
    1
    """
    chosen = chosen_clips(design, ids)
    owner = design.track_of(chosen[0].id)
    chosen_ids = {clip.id for clip in chosen}
    if not chosen_ids <= {clip.id for clip in owner.clips}:
        return Refusal(sentence="A group holds clips of one track; select those of one track.")
    if len(chosen) > MAX_PARTS:
        return Refusal(sentence=f"A group holds at most {MAX_PARTS} clips; select fewer.")
    start_s = min(clip.onset_s for clip in chosen)
    parts = tuple(replace(clip, onset_s=short(clip.onset_s - start_s), id=0) for clip in chosen)
    first = chosen[0]
    group = Clip(waveform=Layers(parts=parts, mode=mode), onset_s=start_s, id=first.id)
    clips = [
        group if clip.id == first.id else clip
        for clip in owner.clips
        if clip.id == first.id or clip.id not in chosen_ids
    ]
    after = with_clips(design, lambda track: clips if track is owner else track.clips)
    view = clips_selected(after, view, (group.id,))
    return Edit(label=f"Group {clips_text(design, chosen)}", design=after, view=view)


@refusing
def ungroup_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Put the parts of groups back on their track; groups with effects stay.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> two = ss.edits.duplicate_clips(design, ss.View(), [1]).design
    >>> ids = [clip.id for clip in two.inputs[0].clips]
    >>> group = ss.edits.group_clips(two, ss.View(), ids).design
    >>> ids = [clip.id for clip in group.inputs[0].clips]
    >>> edit = ss.edits.ungroup_clips(group, ss.View(), ids)
    >>> print(len(edit.design.inputs[0].clips))
    2
    """
    groups = {clip.id: clip.waveform for clip in present_clips(design, ids) if is_plain_sum(clip)}
    if not groups:
        return Refusal(
            sentence="Only a sum of layers without effects can be ungrouped; select such a clip."
        )

    def clips_of(owner: Input) -> list[Clip]:
        clips: list[Clip] = []
        for clip in owner.clips:
            if clip.id not in groups or not isinstance(clip.waveform, Layers):
                clips.append(clip)
                continue
            parts = [_ungrouped(part, clip) for part in clip.waveform.parts]
            clips += [replace(parts[0], id=clip.id), *parts[1:]]
        return clips

    after = with_clips(design, clips_of)
    known = {clip.id for clip in design.clips} - set(groups)
    new_ids = tuple(clip.id for clip in after.clips if clip.id not in known)
    text = "clip" if len(groups) == 1 else f"{len(groups)} clips"
    view = clips_selected(after, view, new_ids)
    return Edit(label=f"Ungroup {text}", design=after, view=view)


def is_plain_sum(clip: Clip) -> bool:
    """Return whether a clip can be ungrouped."""
    is_sum = isinstance(clip.waveform, Layers) and clip.waveform.mode == "sum"
    return is_sum and not any(effect.on for effect in clip.effects)


def _ungrouped(part: Clip, group: Clip) -> Clip:
    return replace(
        part,
        onset_s=short(group.onset_s + part.onset_s),
        gain=part.gain * group.gain,
        muted=part.muted or group.muted,
        id=0,
    )


@refusing
def place_waveform(
    design: Design, view: View, location: int, waveform: Waveform, onset_s: float = 0.0
) -> Edit | Refusal:
    """Add an input that plays ``waveform`` with amplitude 1, and select its clip.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.place_waveform(design, ss.View(), 12, ss.waveforms.Noise(), 0.1)
    >>> print(edit.design.inputs[-1].location)
    12
    """
    new = track(location, waveform, onset_s=onset_s)
    label = f"Place {waveform.title.lower()} at {location_text(location, design.limb)}"
    return _added(design, view, label, [new])


@refusing
def add_waveform(
    design: Design, view: View, waveform: Waveform, input_id: int | None = None
) -> Edit | Refusal:
    """Add a clip at the playhead, or behind the last clip of the track if one plays then.

    It goes to the track ``input_id``, None: the selected one, or else a new one at a free place.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.add_waveform(design, ss.View(selected_inputs=(1,)), ss.waveforms.Noise())
    >>> print([clip.onset_s for clip in edit.design.clips])
    [0.0, 0.2, 0.0]
    """
    selected = leading_input(design, view) if input_id is None else design.input(input_id)
    if selected is None:
        return place_waveform(design, view, free_location(design), waveform, view.playhead_s)
    start_s, end_s = view.playhead_s, view.playhead_s + waveform.duration_s
    if not any(clip.onset_s < end_s and clip.end_s > start_s for clip in selected.clips):
        return add_clip(design, view, selected.id, start_s, waveform)
    start_s = short(max(clip.end_s for clip in selected.clips))
    outcome = add_clip(design, view, selected.id, start_s, waveform)
    said = f"Clip added at {start_s * 1e3:.6g} ms, behind the last: no room at the playhead"
    return replace(outcome, said=said) if isinstance(outcome, Edit) else outcome


def _added(design: Design, view: View, label: str, new: Sequence[Input]) -> Edit:
    """Add inputs at the end, and select them with their clips."""
    after = with_inputs_added(design, new)
    added = after.inputs[len(design.inputs) :]
    view = replace(
        view,
        selected_inputs=tuple(track.id for track in added),
        selected_clips=tuple(clip.id for track in added for clip in track.clips),
    )
    return Edit(label=label, design=after, view=view)


@refusing
def put_inputs_before(design: Design, view: View, ids: Iterable[int], index: int) -> Edit | Refusal:
    """Move inputs together in the list, before the one that is ``index``-th now.

    The number of all inputs moves them to the end.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.put_inputs_before(design, ss.View(), [2], 0)
    >>> print([track.location for track in edit.design.inputs])
    [8, 7]
    """
    chosen = chosen_inputs(design, ids)
    before = [track for track in design.inputs[: max(index, 0)] if track not in chosen]
    after = [track for track in design.inputs[max(index, 0) :] if track not in chosen]
    return Edit(
        label=f"Reorder {tracks_text(chosen, design.limb)}",
        design=replace(design, inputs=(*before, *chosen, *after)),
        view=view,
    )


@refusing
def shift_inputs(design: Design, view: View, ids: Iterable[int], down: bool) -> Edit | Refusal:
    """Move each input one row up or down in the list, within the list.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.shift_inputs(design, ss.View(), [1], True)
    >>> print([track.location for track in edit.design.inputs])
    [8, 7]
    """
    chosen = chosen_inputs(design, ids)
    order = list(design.inputs[::-1] if down else design.inputs)
    for row in range(1, len(order)):
        if order[row] in chosen and order[row - 1] not in chosen:
            order[row - 1], order[row] = order[row], order[row - 1]
    return Edit(
        label=f"Reorder {tracks_text(chosen, design.limb)}",
        design=replace(design, inputs=tuple(order[::-1] if down else order)),
        view=view,
    )
