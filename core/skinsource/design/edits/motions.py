"""Add motions, and change those that stand in a design as a group of clips.

A group stays while its clips are those that its motion writes: moved in time or given another
waveform as a whole, it is that motion.  Each track has an amplitude of its own, and clips may be
muted.  Otherwise edited by hand it is dissolved, and its clips are called after what they play.
"""

from collections.abc import Iterable
from dataclasses import replace
from statistics import mode
from typing import Any

from skinsource.base.errors import InvalidInputError, counted, quoted, sentence
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, MotionGroup, View
from skinsource.design.edits.clips import clips_selected
from skinsource.design.edits.edit import Edit, Refusal, refusing, with_inputs_added
from skinsource.design.motions import Motion, with_motion_field
from skinsource.design.target import Target


@refusing
def add_motion(design: Design, view: View, motion: Motion) -> Edit | Refusal:
    """Add the tracks of a motion at the end, and select its clips.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.add_motion(design, ss.View(), ss.motions.Sweep(path=(7, 12, 17)))
    >>> print(len(edit.design.inputs), edit.label)
    5 Add sweep at 3 places
    """
    return _with_motion(design, view, motion, None)


@refusing
def change_motion(design: Design, view: View, index: int, motion: Motion) -> Edit | Refusal:
    """Replace the ``index``-th motion of a design; tracks at places that stay keep what is theirs.

    A track that only the motion before had clips on is removed.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> sweep = ss.motions.Sweep(path=(7, 12, 17))
    >>> moving = ss.edits.add_motion(design, ss.View(), sweep).design
    >>> edit = ss.edits.change_motion(moving, ss.View(), 0, ss.motions.Sweep(path=(7, 12)))
    >>> print(edit.label)
    Change sweep at 2 places
    """
    if index not in range(len(design.motions)):
        return Refusal(sentence="That motion is no longer there; add it again.")
    return _with_motion(design, view, motion, index)


def _with_motion(design: Design, view: View, motion: Motion, index: int | None) -> Edit | Refusal:
    if not isinstance(motion, Motion):
        return Refusal(
            sentence=f"{quoted(motion)} is not a motion; make one of skinsource.design.motions."
        )
    written = motion.tracks()
    group = None if index is None else design.motions[index]
    old = set() if group is None else set(group.clips)
    as_before = {} if group is None else {each.location: each for each in group.motion.tracks()}
    fresh = {track.location: track for track in written}
    # By place: the track that gets the clips of the motion there.
    holders: dict[int, int] = {}
    inputs: list[Input] = []
    for track in design.inputs:
        others = tuple(clip for clip in track.clips if clip.id not in old)
        if len(others) == len(track.clips):
            inputs.append(track)
        elif (new := fresh.pop(track.location, None)) is not None:
            holders[track.location] = track.id
            muted = [clip.muted for clip in track.clips if clip.id in old]
            clips = (
                replace(clip, muted=k < len(muted) and muted[k]) for k, clip in enumerate(new.clips)
            )
            own = _ratio(track.amplitude, as_before.get(track.location, track).amplitude)
            louder = replace(track, clips=(*others, *clips), amplitude=new.amplitude * own)
            inputs.append(louder)
        elif others:
            inputs.append(replace(track, clips=others))
    after = with_inputs_added(replace(design, inputs=tuple(inputs)), tuple(fresh.values()))
    holders |= {track.location: track.id for track in after.inputs[len(inputs) :]}
    ids = [
        clip.id
        for track in written
        for clip in after.input(holders[track.location]).clips[-len(track.clips) :]
    ]
    motions = list(design.motions)
    new_group = MotionGroup(motion=motion, clips=tuple(ids))
    motions[slice(len(motions), None) if index is None else slice(index, index + 1)] = [new_group]
    return Edit(
        label=f"{'Add' if index is None else 'Change'} {motion.title.lower()} at "
        f"{counted(len(written), 'place')}",
        design=replace(after, motions=tuple(motions)),
        view=clips_selected(after, view, ids),
    )


def motion_of(design: Design, clip_id: int) -> int | None:
    """Return the index of the motion that a clip belongs to; None: it stands alone."""
    groups = enumerate(design.motions)
    return next((index for index, group in groups if clip_id in group.clips), None)


def with_whole_motions(before: Design, edit: Edit) -> Edit:
    """Dissolve the motions whose clips an edit has changed, and say so where they were whole."""
    design = edit.design
    if not design.motions:
        return edit
    known, now = _places(before), _places(design)
    groups = [
        _as_moved(group, known if group in before.motions else {}, now) for group in design.motions
    ]
    whole = tuple(filter(None, groups))
    kept = {group.clips for group in whole}
    gone = {group.clips: group.motion for group in design.motions if group.clips not in kept}
    lost = [group for group in before.motions if group.clips in gone]
    said = edit.said
    if lost:
        apart = f"{lost[0].motion.title} is now single clips; Undo brings it back."
        said = f"{sentence(said)} {apart}" if said else apart
    if gone:
        design = _without_labels(design, gone.values(), set().union(*kept))
    return replace(edit, design=replace(design, motions=whole), said=said)


def _without_labels(design: Design, gone: Iterable[Motion], kept: set[int]) -> Design:
    """Return a design whose clips, but for those kept, are not called after motions."""
    labels = {place[0].label for motion in gone for place in _written_by(motion)}

    def plain(clip: Clip) -> Clip:
        return replace(clip, label="") if clip.label in labels and clip.id not in kept else clip

    tracks = (replace(track, clips=tuple(map(plain, track.clips))) for track in design.inputs)
    return replace(design, inputs=tuple(tracks))


_Place = tuple[Clip, int, float]
# Of onsets and ratios that are compared.
_DECIMALS = 9


def _places(design: Design) -> dict[int, _Place]:
    return {
        clip.id: (clip, track.location, track.amplitude)
        for track in design.inputs
        for clip in track.clips
    }


def _as_moved(
    group: MotionGroup, known: dict[int, _Place], now: dict[int, _Place]
) -> MotionGroup | None:
    """Return a group whose clips are those that its motion writes, maybe later or louder.

    Its amplitude stays as long as a track has it; else it is the one that most tracks have.
    """
    present = list(filter(None, map(now.get, group.clips)))
    if len(present) < len(group.clips):
        return None
    if not present or present == [known.get(id) for id in group.clips]:
        return group
    first = present[0][0]
    before: Any = group.motion
    try:
        motion = group.motion
        if not isinstance(motion, Target):  # its waveform is that of the skin, not of a clip
            motion = with_motion_field(motion, "waveform", first.waveform)
        motion = with_motion_field(motion, "onset_s", round(first.onset_s, _DECIMALS))
        written = _written_by(with_motion_field(motion, "amplitude", 1.0))
        pairs = zip(present, written, strict=False)
        own = [abs(_ratio(here[2], there[2])) for here, there in pairs if here[2] and there[2]]
        if before.amplitude not in own:
            motion = with_motion_field(motion, "amplitude", mode(own or [0.0]))
    except InvalidInputError:
        return None
    same = list(map(_compared, written)) == list(map(_compared, present))
    return replace(group, motion=motion) if same else None


def _ratio(amplitude: float, written: float) -> float:
    """Return how much louder a track is than a motion wrote it."""
    return round(amplitude / written, _DECIMALS) if written else 1.0


def _written_by(motion: Motion) -> list[_Place]:
    return [
        (clip, track.location, track.amplitude) for track in motion.tracks() for clip in track.clips
    ]


def _compared(place: _Place) -> tuple[Clip, int]:
    """Return a clip as its motion writes it, without what sums leave behind, and its place."""
    clip, location, _ = place
    return replace(clip, id=0, muted=False, onset_s=round(clip.onset_s, _DECIMALS)), location
