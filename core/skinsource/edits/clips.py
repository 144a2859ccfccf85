"""Adding, moving, copying, repeating and removing clips; their gain, label and silence."""

import operator
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from skinsource.clips import ONSET, Clip, numbered
from skinsource.clips.clip import GAIN as CLIP_GAIN
from skinsource.clips.clip import LABEL, MUTED
from skinsource.design import MAX_CLIPS, Design, Input
from skinsource.edits.clip_selection import clips_selected
from skinsource.edits.edit import Edit, Refusal, place_words, refused, with_clips
from skinsource.errors import InvalidInputError
from skinsource.fields import Spec
from skinsource.view import View
from skinsource.waveforms import Waveform

NO_CLIP = Refusal(sentence="No clip is selected; click one in the timeline.")
NO_TIME = Refusal(sentence="A time is a number of seconds.")
TOO_MANY_CLIPS = Refusal(
    sentence=f"A track holds at most {MAX_CLIPS} clips; put some of them on another track."
)
#: What of clips is set by name; what they play is set by `change_field`.
_FIELDS: dict[str, Spec] = {
    "onset_s": ONSET,
    "gain": CLIP_GAIN,
    "label": LABEL,
    "muted": MUTED,
}


def add_clip(
    design: Design, view: View, input_id: int, onset_s: float, waveform: Waveform
) -> Edit | Refusal:
    """Put a waveform on a track, and select it."""
    if input_id not in design.ids:
        return Refusal(sentence="That track is no longer there; choose another one.")
    try:
        new = Clip(waveform=waveform, onset_s=onset_s)
    except InvalidInputError as error:
        return refused(error)
    return with_new_clips(design, view, "Add clip", [(input_id, new)])


def remove_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Take clips off their tracks; the next clip of the last one's track is selected."""
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    gone = {one.id for one in chosen}
    inputs = tuple(_without(one, gone) for one in design.inputs)
    after = replace(design, inputs=inputs)
    last = chosen[-1]
    beside = list(after.input(design.track_of(last.id).id).clips)
    beside.sort(key=lambda one: (one.onset_s < last.onset_s, abs(one.onset_s - last.onset_s)))
    return Edit(
        label=f"Remove {clips_words(design, chosen)}",
        design=after,
        view=clips_selected(after, view, tuple(one.id for one in beside[:1])),
    )


def move_clips(
    design: Design, view: View, ids: Iterable[int], by_s: float, by_tracks: int = 0
) -> Edit | Refusal:
    """Move clips together in time and to other tracks, as far as there is room for all."""
    moved = _moved_as_asked(design, ids, by_s, by_tracks)
    if isinstance(moved, Refusal):
        return moved
    target = {clip.id: (track_id, clip) for track_id, clip in moved}
    inputs = []
    for one in design.inputs:
        # On its own track a clip keeps its place in the list.
        clips = [
            target[clip.id][1] if clip.id in target else clip
            for clip in one.clips
            if target.get(clip.id, (one.id, clip))[0] == one.id
        ]
        own = {clip.id for clip in one.clips}
        clips += [clip for track_id, clip in moved if track_id == one.id and clip.id not in own]
        if len(clips) > MAX_CLIPS:
            return TOO_MANY_CLIPS
        inputs.append(replace_clips(one, clips))
    after = replace(design, inputs=tuple(inputs))
    selected = view.selected_clips
    if not target.keys() & set(selected):
        selected = tuple(target)
    return Edit(
        label=f"Move {_words_of(design, moved)}",
        design=after,
        view=clips_selected(after, view, selected),
    )


def copy_clips(
    design: Design, view: View, ids: Iterable[int], by_s: float, by_tracks: int = 0
) -> Edit | Refusal:
    """Put copies of clips elsewhere, and select the copies."""
    moved = _moved_as_asked(design, ids, by_s, by_tracks)
    if isinstance(moved, Refusal):
        return moved
    return with_new_clips(design, view, f"Copy {_words_of(design, moved)}", moved)


def duplicate_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Put copies of clips right after them, and select the copies."""
    outcome = repeat_clips(design, view, ids, 2)
    if isinstance(outcome, Refusal):
        return outcome
    return replace(outcome, label=outcome.label.replace("Repeat", "Duplicate", 1))


def repeat_clips(design: Design, view: View, ids: Iterable[int], times: int) -> Edit | Refusal:
    """Let clips, all together, play so many times in a row; the copies are selected."""
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    if isinstance(times, bool) or not isinstance(times, int) or not 2 <= times <= MAX_CLIPS:
        return Refusal(sentence=f"Clips can be repeated 2 to {MAX_CLIPS} times.")
    length_s = max(one.end_s for one in chosen) - min(one.onset_s for one in chosen)
    if max(one.onset_s for one in chosen) + (times - 1) * length_s > ONSET.maximum:
        return Refusal(sentence=f"The last repetition would begin after {ONSET.maximum:g} s.")
    copies = []
    for k in range(1, times):
        copies += _moved(design, chosen, k * length_s, 0)
    return with_new_clips(design, view, f"Repeat {clips_words(design, chosen)}", copies)


def set_clips(
    design: Design, view: View, ids: Iterable[int], name: str, value: Any
) -> Edit | Refusal:
    """Give clips an onset, a gain or a label, or mute them: the field is called ``name``."""
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    if name not in _FIELDS:
        return Refusal(sentence=f"Of clips, one can set {', '.join(_FIELDS)}.")
    try:
        after = with_clips(design, {one.id: {name: value} for one in chosen})
    except InvalidInputError as error:
        return refused(error)
    verb = f"Change {_FIELDS[name].label.lower()} of"
    if name == "muted":
        verb = "Mute" if value else "Unmute"
    return Edit(label=f"{verb} {clips_words(design, chosen)}", design=after, view=view)


def toggle_mute_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Silence clips; if all of them are muted, let them be heard again."""
    chosen = present_clips(design, ids)
    muted = not all(one.muted for one in chosen)
    return set_clips(design, view, (one.id for one in chosen), "muted", muted)


def present_clips(design: Design, ids: Iterable[int]) -> tuple[Clip, ...]:
    """Those clips that ``design`` has, track by track."""
    wanted = set(ids)
    return tuple(one for one in design.clips if one.id in wanted)


def clips_words(design: Design, chosen: tuple[Clip, ...]) -> str:
    """What the history calls them: "clip at 7 (II pad)", or "3 clips"."""
    if len(chosen) != 1:
        return f"{len(chosen)} clips"
    return f"clip at {place_words(design.track_of(chosen[0].id).location, design.limb)}"


def short(time_s: float) -> float:
    """The time without the last digits that sums of decimal times leave behind."""
    return float(f"{time_s:.15g}")


def replace_clips(one: Input, clips: list[Clip]) -> Input:
    """The input with other clips; the very same where they are as they were."""
    same = len(clips) == len(one.clips) and all(map(operator.is_, clips, one.clips))
    return one if same else replace(one, clips=tuple(clips))


def with_new_clips(
    design: Design, view: View, label: str, new: list[tuple[int, Clip]]
) -> Edit | Refusal:
    """Put clips on tracks, given by id; the new ones are selected."""
    ids = numbered([*(one.id for one in design.clips), *(0 for _ in new)], "clips")
    new_ids = ids[len(ids) - len(new) :]
    on_track: dict[int, list[Clip]] = {}
    for (track_id, clip), id in zip(new, new_ids, strict=True):
        on_track.setdefault(track_id, []).append(replace(clip, id=id))
    if any(len(one.clips) + len(on_track.get(one.id, ())) > MAX_CLIPS for one in design.inputs):
        return TOO_MANY_CLIPS
    inputs = tuple(
        replace(one, clips=(*one.clips, *on_track[one.id])) if one.id in on_track else one
        for one in design.inputs
    )
    after = replace(design, inputs=inputs)
    return Edit(label=label, design=after, view=clips_selected(after, view, new_ids))


def _moved_as_asked(
    design: Design, ids: Iterable[int], by_s: float, by_tracks: int
) -> list[tuple[int, Clip]] | Refusal:
    """What `_moved` says of clips by their ids, or why they cannot be moved so."""
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    if isinstance(by_s, bool) or not isinstance(by_s, int | float) or by_s != by_s:
        return NO_TIME
    if isinstance(by_tracks, bool) or not isinstance(by_tracks, int):
        return Refusal(sentence="Tracks are counted in whole numbers.")
    return _moved(design, chosen, by_s, by_tracks)


def _moved(
    design: Design, chosen: tuple[Clip, ...], by_s: float, by_tracks: int
) -> list[tuple[int, Clip]]:
    """Clips elsewhere, each with the id of its track there; all the same way, as far as all can."""
    onsets = [one.onset_s for one in chosen]
    by_s = min(max(by_s, ONSET.minimum - min(onsets)), ONSET.maximum - max(onsets))
    place_of = {c.id: place for place, one in enumerate(design.inputs) for c in one.clips}
    places = [place_of[one.id] for one in chosen]
    down = min(max(by_tracks, -min(places)), len(design.inputs) - 1 - max(places))
    return [
        (design.inputs[place + down].id, replace(one, onset_s=_onset(one.onset_s + by_s)))
        for place, one in zip(places, chosen, strict=True)
    ]


def _words_of(design: Design, moved: list[tuple[int, Clip]]) -> str:
    """What the history calls clips that were moved, by where they were."""
    return clips_words(design, tuple(clip for _, clip in moved))


def _onset(time_s: float) -> float:
    return min(max(short(time_s), ONSET.minimum), ONSET.maximum)


def _without(one: Input, gone: set[int]) -> Input:
    return replace_clips(one, [clip for clip in one.clips if clip.id not in gone])
