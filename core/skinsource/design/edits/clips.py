"""Which clips are selected, and where the playhead stands."""

import operator
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from skinsource.base.errors import InvalidInputError
from skinsource.base.work import counted
from skinsource.design.clips import GAIN as CLIP_GAIN
from skinsource.design.clips import LABEL, MUTED, ONSET, Clip, Fragment, Lane, numbered
from skinsource.design.design import MAX_CLIPS, MAX_INPUTS, Design, Input
from skinsource.design.edits.edit import Edit, Refusal, location_text, refused, with_clips
from skinsource.design.view import View
from skinsource.design.waveform import Waveform
from skinsource.specs import codec as text
from skinsource.specs import models
from skinsource.specs.spec import Address, Spec


def clips_selected(design: Design, view: View, ids: Iterable[int]) -> View:
    """The view with these clips selected, and the tracks that they are on; the last one last.

    Where there are none, the selected tracks stay.
    """
    track_ids = {clip.id: track.id for track in design.inputs for clip in track.clips}
    chosen = tuple(dict.fromkeys(id for id in ids if id in track_ids))
    if not chosen:
        return replace(view, selected_clips=())
    # The track of the last clip stands last.
    tracks = tuple(dict.fromkeys(track_ids[id] for id in reversed(chosen)))[::-1]
    return replace(view, selected_clips=chosen, selected_inputs=tracks)


def select_clips(design: Design, view: View, ids: Iterable[int]) -> Edit:
    """Select clips, the last of them the one that stands apart, and their tracks."""
    return Edit(label="Select clips", design=design, view=clips_selected(design, view, ids))


def toggle_clip(design: Design, view: View, id: int) -> Edit:
    """Add a clip to the selected ones, or take it out."""
    remaining = tuple(clip_id for clip_id in view.selected_clips if clip_id != id)
    return select_clips(design, view, remaining if id in view.selected_clips else (*remaining, id))


def select_all_clips(design: Design, view: View) -> Edit:
    """Select every clip; the one that stood apart still does."""
    last = () if view.selected_clip is None else (view.selected_clip,)
    others = (clip.id for clip in design.clips if clip.id not in last)
    return select_clips(design, view, (*others, *last))


def move_playhead(design: Design, view: View, time_s: float) -> Edit | Refusal:
    """Put the playhead somewhere."""
    try:
        after = replace(view, playhead_s=time_s)
    except InvalidInputError as error:
        return refused(error)
    return Edit(label="Move playhead", design=design, view=after)


# Adding, moving, copying, repeating and removing clips; their gain, label and silence.

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
    removed = {clip.id for clip in chosen}
    inputs = tuple(_without(track, removed) for track in design.inputs)
    after = replace(design, inputs=inputs)
    last = chosen[-1]
    others = list(after.input(design.track_of(last.id).id).clips)
    others.sort(key=lambda clip: (clip.onset_s < last.onset_s, abs(clip.onset_s - last.onset_s)))
    return Edit(
        label=f"Remove {clips_text(design, chosen)}",
        design=after,
        view=clips_selected(after, view, tuple(clip.id for clip in others[:1])),
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
    for track in design.inputs:
        # On its own track a clip keeps its place in the list.
        clips = [
            target[clip.id][1] if clip.id in target else clip
            for clip in track.clips
            if target.get(clip.id, (track.id, clip))[0] == track.id
        ]
        own_ids = {clip.id for clip in track.clips}
        clips += [
            clip for track_id, clip in moved if track_id == track.id and clip.id not in own_ids
        ]
        if len(clips) > MAX_CLIPS:
            return TOO_MANY_CLIPS
        inputs.append(replace_clips(track, clips))
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
    length_s = max(clip.end_s for clip in chosen) - min(clip.onset_s for clip in chosen)
    if max(clip.onset_s for clip in chosen) + (times - 1) * length_s > ONSET.maximum:
        return Refusal(sentence=f"The last repetition would begin after {ONSET.maximum:g} s.")
    copies = []
    for k in range(1, times):
        copies += _moved(design, chosen, k * length_s, 0)
    return with_new_clips(design, view, f"Repeat {clips_text(design, chosen)}", copies)


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
        after = with_clips(design, {clip.id: {name: value} for clip in chosen})
    except InvalidInputError as error:
        return refused(error)
    verb = f"Change {_FIELDS[name].label.lower()} of"
    if name == "muted":
        verb = "Mute" if value else "Unmute"
    return Edit(label=f"{verb} {clips_text(design, chosen)}", design=after, view=view)


def toggle_mute_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Silence clips; if all of them are muted, let them be heard again."""
    chosen = present_clips(design, ids)
    muted = not all(clip.muted for clip in chosen)
    return set_clips(design, view, (clip.id for clip in chosen), "muted", muted)


def present_clips(design: Design, ids: Iterable[int]) -> tuple[Clip, ...]:
    """Those clips that ``design`` has, track by track."""
    wanted_ids = set(ids)
    return tuple(clip for clip in design.clips if clip.id in wanted_ids)


def clips_text(design: Design, chosen: tuple[Clip, ...]) -> str:
    """What the history calls them: "clip at 7 (II pad)", or "3 clips"."""
    if len(chosen) != 1:
        return f"{len(chosen)} clips"
    return f"clip at {location_text(design.track_of(chosen[0].id).location, design.limb)}"


def short(time_s: float) -> float:
    """The time without the last digits that sums of decimal times leave behind."""
    return float(f"{time_s:.15g}")


def replace_clips(track: Input, clips: list[Clip]) -> Input:
    """The input with other clips; the very same where they are as they were."""
    same = len(clips) == len(track.clips) and all(map(operator.is_, clips, track.clips))
    return track if same else replace(track, clips=tuple(clips))


def with_new_clips(
    design: Design, view: View, label: str, new: list[tuple[int, Clip]]
) -> Edit | Refusal:
    """Put clips on tracks, given by id; the new ones are selected."""
    ids = numbered([*(clip.id for clip in design.clips), *(0 for _ in new)], "clips")
    new_ids = ids[len(ids) - len(new) :]
    on_track: dict[int, list[Clip]] = {}
    for (track_id, clip), id in zip(new, new_ids, strict=True):
        on_track.setdefault(track_id, []).append(replace(clip, id=id))
    if any(
        len(track.clips) + len(on_track.get(track.id, ())) > MAX_CLIPS for track in design.inputs
    ):
        return TOO_MANY_CLIPS
    inputs = tuple(
        replace(track, clips=(*track.clips, *on_track[track.id])) if track.id in on_track else track
        for track in design.inputs
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
    onsets = [clip.onset_s for clip in chosen]
    by_s = min(max(by_s, ONSET.minimum - min(onsets)), ONSET.maximum - max(onsets))
    place_of = {c.id: place for place, track in enumerate(design.inputs) for c in track.clips}
    places = [place_of[clip.id] for clip in chosen]
    down = min(max(by_tracks, -min(places)), len(design.inputs) - 1 - max(places))
    return [
        (design.inputs[place + down].id, replace(clip, onset_s=_onset(clip.onset_s + by_s)))
        for place, clip in zip(places, chosen, strict=True)
    ]


def _words_of(design: Design, moved: list[tuple[int, Clip]]) -> str:
    """What the history calls clips that were moved, by where they were."""
    return clips_text(design, tuple(clip for _, clip in moved))


def _onset(time_s: float) -> float:
    return min(max(short(time_s), ONSET.minimum), ONSET.maximum)


def _without(track: Input, removed: set[int]) -> Input:
    return replace_clips(track, [clip for clip in track.clips if clip.id not in removed])


# Clips that go to an input place, from whatever track they are on.


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
            sentence = f"A design holds at most {MAX_INPUTS} inputs; remove one first."
            return Refusal(sentence=sentence)
        amplitude = design.track_of(chosen[-1].id).amplitude
        try:
            design = design.adding(Input(location=location, amplitude=amplitude))
        except InvalidInputError as error:
            return refused(error)
        target = design.ids[-1]
    verb = "Copy" if copies else "Move"
    label = f"{verb} {clips_text(design, chosen)} to {location_text(location, design.limb)}"
    if copies:
        return with_new_clips(design, view, label, [(target, clip) for clip in chosen])
    moved = {clip.id for clip in chosen}
    inputs = []
    for track in design.inputs:
        own_ids = {clip.id for clip in track.clips}
        clips = [clip for clip in track.clips if track.id == target or clip.id not in moved]
        clips += [clip for clip in chosen if track.id == target and clip.id not in own_ids]
        if len(clips) > MAX_CLIPS:
            return TOO_MANY_CLIPS
        inputs.append(replace_clips(track, clips))
    after = replace(design, inputs=tuple(inputs))
    selected = view.selected_clips if moved & set(view.selected_clips) else tuple(moved)
    return Edit(label=label, design=after, view=clips_selected(after, view, selected))


def _track_at(design: Design, view: View, location: int) -> int | None:
    track_ids = [track.id for track in design.inputs if track.location == location]
    selected = [id for id in view.selected_inputs if id in track_ids]
    return next(iter(selected[-1:] or track_ids), None)


# Copying pieces of a design, and putting them in: here, on other tracks, in another studio.

#: What the text of a fragment says that it is.
FORMAT = "skinsource clips"


def fragment_of(design: Design, ids: Iterable[int]) -> Fragment | None:
    """The clips with these ids as they lie to each other; None where there are none."""
    chosen = {clip.id for clip in present_clips(design, ids)}
    tracks = [
        (place, track, [clip for clip in track.clips if clip.id in chosen])
        for place, track in enumerate(design.inputs)
    ]
    tracks = [entry for entry in tracks if entry[2]]
    if not tracks:
        return None
    start_s = min(clip.onset_s for *_, clips in tracks for clip in clips)
    return Fragment(
        lanes=tuple(
            Lane(
                location=track.location,
                amplitude=track.amplitude,
                offset=place - tracks[0][0],
                clips=tuple(
                    replace(clip, onset_s=short(clip.onset_s - start_s), id=0) for clip in clips
                ),
            )
            for place, track, clips in tracks
        )
    )


def cut_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Remove clips that were copied as a fragment; no other clip is selected."""
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    removed = {clip.id for clip in chosen}
    inputs = tuple(
        replace(track, clips=remaining)
        if len(remaining := tuple(c for c in track.clips if c.id not in removed)) < len(track.clips)
        else track
        for track in design.inputs
    )
    return Edit(
        label=f"Cut {clips_text(design, chosen)}",
        design=replace(design, inputs=inputs),
        view=replace(view, selected_clips=()),
    )


def paste_fragment(design: Design, view: View, fragment: Fragment, at_s: float) -> Edit | Refusal:
    """Put a fragment in from a time on: its first lane on the selected track, the others below.

    Of several selected tracks the uppermost counts: what was copied from them goes back to them.
    Lanes for which there is no track below get a new one, at the place that they came from; and so
    do all of them where no track is selected.  How many and when is told: a clip that lies exactly
    on its original cannot be seen.
    """
    count = sum(len(lane.clips) for lane in fragment.lanes)
    outcome = _put_in(
        design, view, fragment, at_s, f"Paste {_words(count)}", _selected_place(design, view)
    )
    if isinstance(outcome, Refusal):
        return outcome
    over = ", on top of what was copied" if _lies_on_its_like(outcome.design, design) else ""
    return replace(outcome, said=f"{counted(count, 'clip')} pasted at {at_s * 1e3:.6g} ms{over}")


def _lies_on_its_like(after: Design, before: Design) -> bool:
    """Whether a clip that is new has an equal one on its track, at the same time."""
    old = {clip.id for clip in before.clips}
    for track in after.inputs:
        # Of thousands of clips hardly any two begin together.
        by_onset: dict[float, list[Clip]] = {}
        for clip in track.clips:
            if clip.id in old:
                by_onset.setdefault(clip.onset_s, []).append(clip)
        new = (clip for clip in track.clips if clip.id not in old)
        if any(
            replace(clip, id=like.id) == like
            for clip in new
            for like in by_onset.get(clip.onset_s, ())
        ):
            return True
    return False


def place_fragment(
    design: Design,
    view: View,
    fragment: Fragment,
    name: str,
    at_s: float | None = None,
    input_id: int | None = None,
    location: int | None = None,
) -> Edit | Refusal:
    """Put a fragment of the library in, and select its clips.

    Parameters
    ----------
    design, view
        What is open.
    fragment
        Clips.
    name
        What the fragment is called.
    at_s
        From when on; None: from the playhead on.
    input_id
        The track that takes its first lane; those below take the others.  None: the selected one,
        of several the uppermost.
    location
        Place of a new track for its first lane; the others get new ones too, at the places that
        they came from.  It goes before ``input_id``.
    """
    at_s = view.playhead_s if at_s is None else at_s
    label = f"Place {name}"
    if location is not None:
        try:
            first, *others = fragment.lanes
            fragment = replace(fragment, lanes=(replace(first, location=location), *others))
        except InvalidInputError as error:
            return refused(error)
        return _put_in(design, view, fragment, at_s, label, len(design.inputs))
    if input_id is None:
        return _put_in(design, view, fragment, at_s, label, _selected_place(design, view))
    if input_id not in design.ids:
        return Refusal(sentence="That track is no longer there; choose another one.")
    return _put_in(design, view, fragment, at_s, label, design.index_of(input_id))


def _selected_place(design: Design, view: View) -> int:
    """Where in the list the uppermost selected track is; behind the last one where none is."""
    chosen = (design.index_of(id) for id in view.selected_inputs if id in design.ids)
    return min(chosen, default=len(design.inputs))


def _put_in(
    design: Design, view: View, fragment: Fragment, at_s: float, label: str, place: int
) -> Edit | Refusal:
    """Put a fragment on the tracks from ``place`` on, and on new ones behind the last."""
    after = design
    new: list[tuple[int, Clip]] = []
    try:
        for lane in fragment.lanes:
            if place + lane.offset < len(design.inputs):
                track_id = design.inputs[place + lane.offset].id
            elif len(after.inputs) < MAX_INPUTS:
                after = after.adding(Input(location=lane.location, amplitude=lane.amplitude))
                track_id = after.ids[-1]
            else:
                return Refusal(sentence=f"A design holds at most {MAX_INPUTS} inputs.")
            new += [
                (track_id, replace(clip, onset_s=short(at_s + clip.onset_s))) for clip in lane.clips
            ]
    except (InvalidInputError, TypeError) as error:
        return refused(InvalidInputError(str(error)))
    return with_new_clips(after, view, label, new)


def fragment_text(fragment: Fragment) -> str:
    """The fragment as a text for the clipboard; see `skinsource.specs.codec`."""
    return text.to_text(models.encode(fragment), FORMAT)


def fragment_from(text_: str) -> Fragment:
    """The fragment that `fragment_text` wrote.

    Raises
    ------
    FileFormatError
        The text is something else, or damaged.
    """
    fragment: Fragment = models.decode(text.from_text(text_, FORMAT), (Fragment,), Address())
    return fragment


def _words(count: int) -> str:
    return "clip" if count == 1 else f"{count} clips"
