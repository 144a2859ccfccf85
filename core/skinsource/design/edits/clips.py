"""Select, add, move, copy, repeat, change and remove clips, also as fragments of a design.

A fragment holds copied clips of one or more tracks: it is pasted here or in another studio, and
the presets of the library hold one each.
"""

import operator
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

from skinsource.base.arguments import checking
from skinsource.base.errors import InvalidInputError, counted
from skinsource.design.clips import GAIN as CLIP_GAIN
from skinsource.design.clips import LABEL, MAX_CLIPS, MUTED, ONSET, Clip, Fragment, Lane, numbered
from skinsource.design.design import Design, Input, View
from skinsource.design.edits.edit import (
    Edit,
    Refusal,
    change_clips,
    change_view,
    listed,
    location_text,
    refusing,
    with_inputs_added,
)
from skinsource.design.waveform import Waveform
from skinsource.specs import codec, models
from skinsource.specs.spec import Address, Spec


def clips_selected(design: Design, view: View, ids: Iterable[int]) -> View:
    """Return the view with these clips and their tracks selected; the last clip stays last.

    If no clip of them exists, the selected tracks stay.
    """
    track_ids = {clip.id: track.id for track in design.inputs for clip in track.clips}
    chosen = tuple(dict.fromkeys(id for id in listed(ids) if id in track_ids))
    if not chosen:
        return replace(view, selected_clips=())
    # The track of the last clip has to be the last one.
    tracks = tuple(dict.fromkeys(track_ids[id] for id in reversed(chosen)))[::-1]
    return replace(view, selected_clips=chosen, selected_inputs=tracks)


@checking
def select_clips(design: Design, view: View, ids: Iterable[int]) -> Edit:
    """Select clips and their tracks; the last clip is the leading one.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.select_clips(design, ss.View(), [2])
    >>> print(edit.view.selected_clips)
    (2,)
    """
    return Edit(label="Select clips", design=design, view=clips_selected(design, view, ids))


@checking
def toggle_clip(design: Design, view: View, id: int) -> Edit:
    """Add a clip to the selected ones, or remove it from them.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.toggle_clip(design, ss.View(), 1)
    >>> print(edit.view.selected_clips)
    (1,)
    """
    remaining = tuple(clip_id for clip_id in view.selected_clips if clip_id != id)
    return select_clips(design, view, remaining if id in view.selected_clips else (*remaining, id))


@checking
def select_all_clips(design: Design, view: View) -> Edit:
    """Select every clip; the leading one stays.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.select_all_clips(design, ss.View())
    >>> print(edit.view.selected_clips)
    (1, 2)
    """
    last = () if view.selected_clip is None else (view.selected_clip,)
    others = (clip.id for clip in design.clips if clip.id not in last)
    return select_clips(design, view, (*others, *last))


@refusing
def move_playhead(design: Design, view: View, time_s: float) -> Edit | Refusal:
    """Move the playhead to a time.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.move_playhead(design, ss.View(), 0.1)
    >>> print(edit.view.playhead_s)
    0.1
    """
    return change_view(design, view, "Move playhead", playhead_s=time_s)


#: Times that differ by less are the same.
SAME_S = 1e-9
_NO_TRACK = Refusal(sentence="That track is no longer there; choose another one.")
#: Fields of clips that are set by name; `change_field` sets those of their waveforms.
_FIELDS: dict[str, Spec] = {
    "onset_s": ONSET,
    "gain": CLIP_GAIN,
    "label": LABEL,
    "muted": MUTED,
}


@refusing
def add_clip(
    design: Design, view: View, input_id: int, onset_s: float, waveform: Waveform
) -> Edit | Refusal:
    """Put a waveform on a track, and select it.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.add_clip(design, ss.View(), 1, 0.5, ss.waveforms.Noise())
    >>> print([clip.onset_s for clip in edit.design.clips])
    [0.0, 0.5, 0.0]
    """
    if input_id not in design.ids:
        return _NO_TRACK
    new = Clip(waveform=waveform, onset_s=onset_s)
    return _with_new_clips(design, view, "Add clip", [(input_id, new)])


@refusing
def remove_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Remove clips; no clip is selected afterwards, and the selected tracks stay.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.remove_clips(design, ss.View(), [1])
    >>> print(len(edit.design.clips))
    1
    """
    return _without_clips(design, view, ids, "Remove", "removed")


@refusing
def move_clips(
    design: Design, view: View, ids: Iterable[int], by_s: float, by_tracks: int = 0
) -> Edit | Refusal:
    """Move clips together in time and to other tracks, as far as all of them can move.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.move_clips(design, ss.View(), [1], by_s=0.25)
    >>> print(edit.design.clips[0].onset_s)
    0.25
    """
    chosen = chosen_clips(design, ids)
    moved = _moved(design, chosen, by_s, by_tracks)
    return _with_moved_clips(design, view, f"Move {clips_text(design, chosen)}", moved)


@refusing
def copy_clips(
    design: Design, view: View, ids: Iterable[int], by_s: float, by_tracks: int = 0
) -> Edit | Refusal:
    """Put copies of clips at another time and on other tracks, and select the copies.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.copy_clips(design, ss.View(), [1], by_s=0.3)
    >>> print([clip.onset_s for clip in edit.design.clips])
    [0.0, 0.3, 0.0]
    """
    chosen = chosen_clips(design, ids)
    moved = _moved(design, chosen, by_s, by_tracks)
    return _with_new_clips(design, view, f"Copy {clips_text(design, chosen)}", moved)


@refusing
def duplicate_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Put copies of clips right after them, and select the copies.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.duplicate_clips(design, ss.View(), [1])
    >>> print([clip.onset_s for clip in edit.design.clips])
    [0.0, 0.2, 0.0]
    """
    outcome = repeat_clips(design, view, ids, 2)
    if isinstance(outcome, Refusal):
        return outcome
    return replace(outcome, label=outcome.label.replace("Repeat", "Duplicate", 1))


@refusing
def repeat_clips(design: Design, view: View, ids: Iterable[int], times: int) -> Edit | Refusal:
    """Repeat clips as a group, ``times`` times in a row, and select the copies.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.repeat_clips(design, ss.View(), [1], 3)
    >>> print([clip.onset_s for clip in edit.design.clips])
    [0.0, 0.2, 0.4, 0.0]
    """
    chosen = chosen_clips(design, ids)
    if isinstance(times, bool) or not isinstance(times, int) or not 2 <= times <= MAX_CLIPS:
        return Refusal(sentence=f"Choose 2 to {MAX_CLIPS} repetitions.")
    length_s = max(clip.end_s for clip in chosen) - min(clip.onset_s for clip in chosen)
    if max(clip.onset_s for clip in chosen) + (times - 1) * length_s > ONSET.maximum:
        return Refusal(sentence=f"Choose fewer: the last would begin after {ONSET.maximum:g} s.")
    copies = []
    for k in range(1, times):
        copies += _moved(design, chosen, k * length_s, 0)
    return _with_new_clips(design, view, f"Repeat {clips_text(design, chosen)}", copies)


@refusing
def copy_behind(design: Design, view: View, ids: Iterable[int], verb: str) -> Edit | Refusal:
    """Put copies of clips as a group behind them, in the first room that their tracks have.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> busy = ss.edits.copy_clips(design, ss.View(), [1], by_s=0.3).design
    >>> print([clip.onset_s for clip in copy_behind(busy, ss.View(), [1], "Copy").design.clips])
    [0.0, 0.3, 0.5, 0.0]
    """
    chosen = chosen_clips(design, ids)
    length_s = max(clip.end_s for clip in chosen) - min(clip.onset_s for clip in chosen)
    # How far copies would have to be moved to meet another clip, and to be behind it.
    met = [
        (other.onset_s - clip.end_s + SAME_S, other.end_s - clip.onset_s)
        for clip in chosen
        for other in design.track_of(clip.id).clips
        if other.end_s - clip.onset_s > length_s + SAME_S
    ]
    by_s = length_s
    for from_s, behind_s in sorted(met):
        if from_s < by_s < behind_s - SAME_S:
            by_s = behind_s
    if max(clip.onset_s for clip in chosen) + by_s > ONSET.maximum:
        return Refusal(sentence=f"The copy would begin after {ONSET.maximum:g} s; copy others.")
    label = f"{verb} {clips_text(design, chosen)}"
    outcome = _with_new_clips(design, view, label, _moved(design, chosen, by_s, 0))
    if by_s == length_s:
        return outcome
    start_s = by_s + min(clip.onset_s for clip in chosen)
    return replace(outcome, said=f"The copy starts at {start_s * 1e3:.6g} ms: no room before")


@refusing
def set_clips(
    design: Design, view: View, ids: Iterable[int], name: str, value: Any
) -> Edit | Refusal:
    """Set onset, gain, label or mute of clips: the field is called ``name``.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.set_clips(design, ss.View(), [1, 2], "gain", 0.5)
    >>> print([clip.gain for clip in edit.design.clips])
    [0.5, 0.5]
    """
    chosen = chosen_clips(design, ids)
    if name not in _FIELDS:
        return Refusal(sentence=f"Clips have no such switch; choose one of {', '.join(_FIELDS)}.")
    after = change_clips(design, {clip.id: {name: value} for clip in chosen})
    verb = f"Change {_FIELDS[name].label.lower()} of"
    if name == "muted":
        verb = "Mute" if value else "Unmute"
    return Edit(label=f"{verb} {clips_text(design, chosen)}", design=after, view=view)


@refusing
def toggle_mute_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Mute clips; if all of them are muted, unmute them.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.toggle_mute_clips(design, ss.View(), [1])
    >>> print(edit.design.clips[0].muted)
    True
    """
    chosen = present_clips(design, ids)
    muted = not all(clip.muted for clip in chosen)
    return set_clips(design, view, (clip.id for clip in chosen), "muted", muted)


def present_clips(design: Design, ids: Iterable[int]) -> tuple[Clip, ...]:
    """Return those clips that ``design`` has, track by track."""
    wanted_ids = set(listed(ids))
    return tuple(clip for clip in design.clips if clip.id in wanted_ids)


def chosen_clips(design: Design, ids: Iterable[int]) -> tuple[Clip, ...]:
    """Return those clips that ``design`` has, track by track; `InvalidInputError` without any."""
    chosen = present_clips(design, ids)
    if not chosen:
        raise InvalidInputError("No clip is selected; click one in the timeline.")
    return chosen


@refusing
def of_each(
    edit: Callable[..., Edit | Refusal], design: Design, view: View, ids: Iterable[int], *more: Any
) -> Edit | Refusal:
    """Make an edit of one clip with each of several, or with none of them."""
    chosen, after, label = chosen_clips(design, ids), design, ""
    for clip in chosen:
        outcome = edit(after, view, clip.id, *more)
        if isinstance(outcome, Refusal):
            return outcome
        after, label = outcome.design, outcome.label
    label = f"{label.partition('clip at ')[0]}{clips_text(design, chosen)}"
    return Edit(label=label, design=after, view=view)


def clips_text(design: Design, chosen: tuple[Clip, ...]) -> str:
    """Return the name of clips in the history: "clip at 7 (II pad)", or "3 clips"."""
    if len(chosen) != 1:
        return f"{len(chosen)} clips"
    return f"clip at {location_text(design.track_of(chosen[0].id).location, design.limb)}"


def short(time_s: float) -> float:
    """Round a time to 15 digits, which removes what sums of decimal times leave behind."""
    return float(f"{float(time_s):.15g}")


def with_clips(design: Design, clips_of: Callable[[Input], Sequence[Clip]]) -> Design:
    """Return the design with other clips on its inputs; an input whose clips are the same stays.

    Raises
    ------
    InvalidInputError
        An input would have too many clips.
    """
    inputs = []
    for track in design.inputs:
        clips = clips_of(track)
        if len(clips) > MAX_CLIPS:
            raise InvalidInputError(
                f"A track holds at most {MAX_CLIPS} clips; put some of them on another track."
            )
        same = len(clips) == len(track.clips) and all(map(operator.is_, clips, track.clips))
        inputs.append(track if same else replace(track, clips=tuple(clips)))
    return replace(design, inputs=tuple(inputs))


def _with_new_clips(design: Design, view: View, label: str, new: list[tuple[int, Clip]]) -> Edit:
    """Put clips on tracks, given by id, and select them."""
    ids = numbered([*(clip.id for clip in design.clips), *(0 for _ in new)], "clips")
    new_ids = ids[len(ids) - len(new) :]
    on_track: dict[int, list[Clip]] = {}
    for (track_id, clip), id in zip(new, new_ids, strict=True):
        on_track.setdefault(track_id, []).append(replace(clip, id=id))
    after = with_clips(design, lambda track: (*track.clips, *on_track.get(track.id, ())))
    return Edit(label=label, design=after, view=clips_selected(after, view, new_ids))


def _with_moved_clips(
    design: Design, view: View, label: str, moved: list[tuple[int, Clip]]
) -> Edit:
    """Put clips of the design on tracks, given by id; a clip that was selected stays selected."""
    target = {clip.id: (track_id, clip) for track_id, clip in moved}

    def clips_of(track: Input) -> list[Clip]:
        # A clip that stays on its track keeps its place in the list.
        staying = [
            target[clip.id][1] if clip.id in target else clip
            for clip in track.clips
            if target.get(clip.id, (track.id, clip))[0] == track.id
        ]
        own_ids = {clip.id for clip in track.clips}
        coming = (
            clip for track_id, clip in moved if track_id == track.id and clip.id not in own_ids
        )
        return [*staying, *coming]

    after = with_clips(design, clips_of)
    selected = view.selected_clips
    if not target.keys() & set(selected):
        selected = tuple(target)
    return Edit(label=label, design=after, view=clips_selected(after, view, selected))


def _moved(
    design: Design, chosen: tuple[Clip, ...], by_s: float, by_tracks: int
) -> list[tuple[int, Clip]]:
    """Return clips at their new places, each with the id of its new track.

    All move by the same time and number of tracks, as far as all of them can.
    """
    if isinstance(by_tracks, bool) or not isinstance(by_tracks, int):
        raise InvalidInputError("Choose a whole number of tracks.")
    onsets = [clip.onset_s for clip in chosen]
    by_s = min(max(by_s, ONSET.minimum - min(onsets)), ONSET.maximum - max(onsets))
    row_of = {clip.id: row for row, track in enumerate(design.inputs) for clip in track.clips}
    rows = [row_of[clip.id] for clip in chosen]
    down = min(max(by_tracks, -min(rows)), len(design.inputs) - 1 - max(rows))
    return [
        (design.inputs[row + down].id, replace(clip, onset_s=_onset(clip.onset_s + by_s)))
        for row, clip in zip(rows, chosen, strict=True)
    ]


def _onset(time_s: float) -> float:
    return min(max(short(time_s), ONSET.minimum), ONSET.maximum)


def _without_clips(design: Design, view: View, ids: Iterable[int], verb: str, done: str) -> Edit:
    removed = chosen_clips(design, ids)
    gone = {clip.id for clip in removed}
    left = with_clips(design, lambda track: [clip for clip in track.clips if clip.id not in gone])
    return Edit(
        label=f"{verb} {clips_text(design, removed)}",
        design=left,
        view=replace(view, selected_clips=()),
        said=f"{counted(len(removed), 'clip')} {done}",
    )


@refusing
def move_clips_to_place(
    design: Design, view: View, ids: Iterable[int], location: int, copies: bool = False
) -> Edit | Refusal:
    """Move clips, or copies of them, to the track at an input place; their onsets stay.

    Of several tracks at the place the selected one gets them, else the first.  If there is none, a
    new track is made, with the amplitude of the track of the last clip.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.move_clips_to_place(design, ss.View(), [1], 12)
    >>> print(edit.label)
    Move clip at 7 (II pad) to 12 (II base)
    """
    chosen = chosen_clips(design, ids)
    track_ids = [track.id for track in design.inputs if track.location == location]
    selected = [id for id in view.selected_inputs if id in track_ids]
    target = next(iter(selected[-1:] or track_ids), None)
    if target is None:
        amplitude = design.track_of(chosen[-1].id).amplitude
        design = with_inputs_added(design, [Input(location=location, amplitude=amplitude)])
        target = design.ids[-1]
    verb = "Copy" if copies else "Move"
    label = f"{verb} {clips_text(design, chosen)} to {location_text(location, design.limb)}"
    if copies:
        return _with_new_clips(design, view, label, [(target, clip) for clip in chosen])
    return _with_moved_clips(design, view, label, [(target, clip) for clip in chosen])


#: Name of the format in the text of a fragment.
FORMAT = "skinsource clips"


@checking
def fragment_of(design: Design, ids: Iterable[int]) -> Fragment | None:
    """Copy the clips with these ids as a fragment; None where there are none.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> value = ss.edits.fragment_of(design, [1, 2])
    >>> print(len(value.lanes))
    2
    """
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


@refusing
def cut_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Remove clips that were copied as a fragment; no clip is selected afterwards.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.cut_clips(design, ss.View(), [1])
    >>> print(edit.label)
    Cut clip at 7 (II pad)
    """
    return _without_clips(design, view, ids, "Cut", "cut")


@refusing
def paste_fragment(design: Design, view: View, fragment: Fragment, at_s: float) -> Edit | Refusal:
    """Paste a fragment at a time: its first lane on the selected track, the others below.

    Of several selected tracks the uppermost counts, so that clips go back to the tracks that they
    were copied from.  A lane that has no track gets a new one at the place that it came from; so
    do all lanes if no track is selected.  The edit says how many clips were pasted and when,
    and over how many others, because a clip that lies exactly on its original cannot be seen.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.paste_fragment(design, ss.View(), ss.edits.fragment_of(design, [1]), 0.4)
    >>> print([clip.onset_s for clip in edit.design.clips])
    [0.0, 0.4, 0.0]
    """
    count = sum(len(lane.clips) for lane in fragment.lanes)
    label = "Paste clip" if count == 1 else f"Paste {count} clips"
    outcome = _with_fragment(design, view, fragment, at_s, label, _selected_row(design, view))
    over = over_text(outcome.design, design)
    n_new = len(outcome.design.inputs) - len(design.inputs)
    over += f", {counted(n_new, 'track')} added" if n_new else ""
    return replace(outcome, said=f"{counted(count, 'clip')} pasted at {at_s * 1e3:.6g} ms{over}")


def over_text(after: Design, before: Design) -> str:
    """Say how many old clips have a new one over them on their track; "" where none has."""
    old, count = {clip.id for clip in before.clips}, 0
    for track in after.inputs:
        spans = [(clip.onset_s, clip.end_s, clip.id in old) for clip in track.clips]
        new = [(start_s + SAME_S, end_s - SAME_S) for start_s, end_s, is_old in spans if not is_old]
        count += sum(
            any(start_s < until_s and from_s < end_s for from_s, until_s in new)
            for start_s, end_s, is_old in spans
            if is_old
        )
    return f", over {counted(count, 'other clip')}" if count else ""


@refusing
def place_fragment(
    design: Design,
    view: View,
    fragment: Fragment,
    name: str,
    at_s: float | None = None,
    input_id: int | None = None,
    location: int | None = None,
) -> Edit | Refusal:
    """Place a fragment of the library, and select its clips.

    Parameters
    ----------
    design, view
        The open design and its view.
    fragment
        The clips.
    name
        Name of the fragment.
    at_s
        Time of its start; None: at the playhead.
    input_id
        The track for its first lane; the tracks below get the others.  None: the selected track,
        of several the uppermost, for one lane; several lanes get new tracks at their own places.
    location
        Place of a new track for its first lane; the others get new tracks at the places that they
        came from.  It has precedence over ``input_id``.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.place_fragment(
    ...     design, ss.View(), ss.edits.fragment_of(design, [1]), "Tone"
    ... )
    >>> print(edit.label)
    Place Tone
    """
    at_s = view.playhead_s if at_s is None else at_s
    label = f"Place {name}"
    if location is not None:
        first, *others = fragment.lanes
        fragment = replace(fragment, lanes=(replace(first, location=location), *others))
        return _with_fragment(design, view, fragment, at_s, label, len(design.inputs))
    if input_id is None:
        own = len(fragment.lanes) > 1
        row = len(design.inputs) if own else _selected_row(design, view)
        return _with_fragment(design, view, fragment, at_s, label, row)
    if input_id not in design.ids:
        return _NO_TRACK
    return _with_fragment(design, view, fragment, at_s, label, design.index_of(input_id))


def _selected_row(design: Design, view: View) -> int:
    """Return the index of the uppermost selected track; without one the number of tracks."""
    chosen = (design.index_of(id) for id in view.selected_inputs if id in design.ids)
    return min(chosen, default=len(design.inputs))


def _with_fragment(
    design: Design, view: View, fragment: Fragment, at_s: float, label: str, row: int
) -> Edit:
    """Put a fragment on the tracks from ``row`` on, and on new ones after the last."""
    after = design
    new: list[tuple[int, Clip]] = []
    for lane in fragment.lanes:
        if row + lane.offset < len(design.inputs):
            track_id = design.inputs[row + lane.offset].id
        else:
            track = Input(location=lane.location, amplitude=lane.amplitude)
            after = with_inputs_added(after, [track])
            track_id = after.ids[-1]
        new += [
            (track_id, replace(clip, onset_s=short(at_s + clip.onset_s))) for clip in lane.clips
        ]
    return _with_new_clips(after, view, label, new)


@checking
def fragment_text(fragment: Fragment) -> str:
    """Write a fragment as a text for the clipboard; see `skinsource.specs.codec`.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> value = ss.edits.fragment_text(ss.edits.fragment_of(design, [1]))
    >>> print(value[:40])
    {"format":"skinsource clips","version":2
    """
    return codec.to_text(models.encode(fragment), FORMAT)


@checking
def fragment_from(words: str) -> Fragment:
    """Read a fragment that `fragment_text` wrote.

    Raises
    ------
    FileFormatError
        The text is something else, or damaged.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> value = ss.edits.fragment_from(ss.edits.fragment_text(ss.edits.fragment_of(design, [1])))
    >>> print(len(value.lanes))
    1
    """
    fragment: Fragment = models.decode(codec.from_text(words, FORMAT), (Fragment,), Address())
    return fragment
