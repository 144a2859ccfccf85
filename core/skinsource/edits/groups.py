"""Clips of one track as one clip, and back."""

from collections.abc import Iterable
from dataclasses import replace

from skinsource.clips import Clip
from skinsource.design import Design
from skinsource.edits.clip_selection import clips_selected
from skinsource.edits.clips import NO_CLIP, clips_words, present_clips, replace_clips, short
from skinsource.edits.edit import Edit, Refusal, refused
from skinsource.errors import InvalidInputError
from skinsource.view import View
from skinsource.waveforms import Layers
from skinsource.waveforms.layers import MAX_PARTS, Mode


def group_clips(
    design: Design, view: View, ids: Iterable[int], mode: Mode = "sum"
) -> Edit | Refusal:
    """Put clips of one track into one clip, added up or multiplied."""
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    track = design.track_of(chosen[0].id)
    wanted = {one.id for one in chosen}
    if not wanted <= {one.id for one in track.clips}:
        return Refusal(sentence="Clips of several tracks make no group; select those of one track.")
    if len(chosen) > MAX_PARTS:
        return Refusal(sentence=f"A group holds at most {MAX_PARTS} clips.")
    start_s = min(one.onset_s for one in chosen)
    parts = tuple(replace(one, onset_s=short(one.onset_s - start_s), id=0) for one in chosen)
    first = chosen[0]
    try:
        group = Clip(waveform=Layers(parts=parts, mode=mode), onset_s=start_s, id=first.id)
        clips = [
            group if one.id == first.id else one
            for one in track.clips
            if one.id == first.id or one.id not in wanted
        ]
        inputs = tuple(replace_clips(one, clips) if one is track else one for one in design.inputs)
        after = replace(design, inputs=inputs)
    except InvalidInputError as error:
        return refused(error)
    view = clips_selected(after, view, (group.id,))
    return Edit(label=f"Group {clips_words(design, chosen)}", design=after, view=view)


def ungroup_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Put the parts of groups back on their track, where no effect stands in between."""
    groups = {one.id: one.waveform for one in present_clips(design, ids) if _can_be_ungrouped(one)}
    if not groups:
        return Refusal(
            sentence="None of the selected clips is a sum of layers without effects; only those "
            "can be ungrouped."
        )
    inputs = []
    try:
        for one in design.inputs:
            clips: list[Clip] = []
            for clip in one.clips:
                if clip.id not in groups or not isinstance(clip.waveform, Layers):
                    clips.append(clip)
                    continue
                parts = [_freed(part, clip) for part in clip.waveform.parts]
                clips += [replace(parts[0], id=clip.id), *parts[1:]]
            inputs.append(replace_clips(one, clips))
        after = replace(design, inputs=tuple(inputs))
    except InvalidInputError as error:
        return refused(error)
    known = {one.id for one in design.clips} - set(groups)
    freed = tuple(one.id for one in after.clips if one.id not in known)
    words = "clip" if len(groups) == 1 else f"{len(groups)} clips"
    view = clips_selected(after, view, freed)
    return Edit(label=f"Ungroup {words}", design=after, view=view)


def _can_be_ungrouped(one: Clip) -> bool:
    is_sum = isinstance(one.waveform, Layers) and one.waveform.mode == "sum"
    return is_sum and not any(effect.on for effect in one.effects)


def _freed(part: Clip, group: Clip) -> Clip:
    onset_s = short(group.onset_s + part.onset_s)
    return replace(
        part,
        onset_s=onset_s,
        gain=part.gain * group.gain,
        muted=part.muted or group.muted,
        id=0,
    )
