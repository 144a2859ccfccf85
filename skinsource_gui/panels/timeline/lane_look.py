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
    return (one.selected, one.silent) == (other.selected, other.silent)


def same_clips(before: Content, then: Lane, after: Content, now: Lane) -> bool:
    """Whether clips look alike on the same ground: the very same ones, with the same samples."""
    mine, theirs = now.track, then.track
    if mine is not theirs and not (
        mine.colour == theirs.colour
        and len(mine.clips) == len(theirs.clips)
        and all(map(is_, mine.clips, theirs.clips))
    ):
        return False
    ids = [clip.id for clip in mine.clips]
    if before.waveforms is not after.waveforms and not all(
        map(is_, map(before.waveforms.get, ids), map(after.waveforms.get, ids))
    ):
        return False
    return all(
        old is new or old.intersection(ids) == new.intersection(ids)
        for old, new in (
            (before.selected, after.selected),
            (frozenset(before.chosen), frozenset(after.chosen)),
        )
    )
