"""Clips that go to an input place, from whatever track they are on."""

from collections.abc import Iterable
from dataclasses import replace

from skinsource.design import MAX_CLIPS, MAX_INPUTS, Design, Input
from skinsource.edits.clip_selection import clips_selected
from skinsource.edits.clips import (
    NO_CLIP,
    TOO_MANY_CLIPS,
    clips_words,
    present_clips,
    replace_clips,
    with_new_clips,
)
from skinsource.edits.edit import Edit, Refusal, place_words, refused
from skinsource.errors import InvalidInputError
from skinsource.view import View


def move_clips_to_place(
    design: Design, view: View, ids: Iterable[int], location: int, copies: bool = False
) -> Edit | Refusal:
    """Move clips, or copies of them, to the track at an input place; their onsets stay.

    Of several tracks there it is the selected one, or else the first.  Where there is none one is
    made, with the amplitude of the track that the last of the clips was on.
    """
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    target = _track_at(design, view, location)
    if target is None:
        if len(design.inputs) >= MAX_INPUTS:
            words = f"A design holds at most {MAX_INPUTS} inputs; remove one first."
            return Refusal(sentence=words)
        amplitude = design.track_of(chosen[-1].id).amplitude
        try:
            design = design.adding(Input(location=location, amplitude=amplitude))
        except InvalidInputError as error:
            return refused(error)
        target = design.ids[-1]
    verb = "Copy" if copies else "Move"
    label = f"{verb} {clips_words(design, chosen)} to {place_words(location, design.limb)}"
    if copies:
        return with_new_clips(design, view, label, [(target, clip) for clip in chosen])
    moved = {one.id for one in chosen}
    inputs = []
    for one in design.inputs:
        own = {clip.id for clip in one.clips}
        clips = [clip for clip in one.clips if one.id == target or clip.id not in moved]
        clips += [clip for clip in chosen if one.id == target and clip.id not in own]
        if len(clips) > MAX_CLIPS:
            return TOO_MANY_CLIPS
        inputs.append(replace_clips(one, clips))
    after = replace(design, inputs=tuple(inputs))
    selected = view.selected_clips if moved & set(view.selected_clips) else tuple(moved)
    return Edit(label=label, design=after, view=clips_selected(after, view, selected))


def _track_at(design: Design, view: View, location: int) -> int | None:
    there = [one.id for one in design.inputs if one.location == location]
    selected = [id for id in view.selected_inputs if id in there]
    return next(iter(selected[-1:] or there), None)
