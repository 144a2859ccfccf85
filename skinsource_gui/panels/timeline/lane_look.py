"""What the picture of the lanes depends on: where two contents look alike, nothing is painted."""

from collections.abc import Hashable
from operator import is_

from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.panels.timeline.lane import Lane


def frame_of(content: Content) -> Hashable:
    """What all lanes and the ruler depend on; not what is in the lanes."""
    design = content.design
    places = tuple((lane.track.id, lane.top_px, lane.height_px) for lane in content.lanes)
    return content.scale, content.ruler_px, design.loop_s, design.markers, places


def same_ground(one: Lane, other: Lane) -> bool:
    """Whether a lane looks alike but for its clips."""
    return (one.selected, one.silent, one.problem) == (other.selected, other.silent, other.problem)


def same_chosen(before: Content, after: Content) -> bool:
    """Whether the same clips are selected, and shown elsewhere, in all lanes."""
    return (before.selected, before.chosen) == (after.selected, after.chosen)


def same_clips(before: Content, then: Lane, after: Content, now: Lane) -> bool:
    """Whether clips look alike on the same ground: the very same ones, with the same samples.

    Which of them are selected, or shown elsewhere, is another question.
    """
    mine, theirs = now.track, then.track
    if before.awaited != after.awaited:
        return False
    if mine is not theirs and not (
        mine.colour == theirs.colour
        and len(mine.clips) == len(theirs.clips)
        and all(map(is_, mine.clips, theirs.clips))
    ):
        return False
    then_played, now_played = before.waveforms, after.waveforms
    return then_played is now_played or all(
        then_played.get(clip.id) is now_played.get(clip.id) for clip in mine.clips
    )


def same_choice(before: Content, after: Content, lane: Lane) -> bool:
    """Whether the same clips of a lane are selected, and shown elsewhere."""
    ids = frozenset(clip.id for clip in lane.track.clips)
    return all(
        ids.intersection(old) == ids.intersection(new)
        for old, new in ((before.selected, after.selected), (before.chosen, after.chosen))
    )
