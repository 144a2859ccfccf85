"""Lanes and the clips in them, in pixels."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF

from skinsource.design.clips import Clip
from skinsource.design.design import Input
from skinsource.design.edits.cutting import fades_of
from skinsource_gui.widgets.time.time_scale import TimeScale

#: Free space above and below a clip, px.
MARGIN_PX = 3.0
#: No clip is painted narrower, so that one can be seen and caught.
NARROWEST_PX = 3.0
#: How far outside a clip its ends can be caught, px.
REACH_PX = 4.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Lane:
    """The strip of one track.

    Attributes
    ----------
    track
        The track.
    top_px, height_px
        Where it lies.
    silent
        Why it is not heard, or "".
    problem
        Why it cannot be played, or "".
    selected
        Whether its track is selected.
    """

    track: Input
    top_px: float
    height_px: float
    silent: str
    selected: bool
    problem: str = ""

    @property
    def bottom_px(self) -> float:
        """Where the next one begins."""
        return self.top_px + self.height_px


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """A clip where it is painted, and how far its fades reach, px."""

    clip: Clip
    lane: Lane
    rect: QRectF
    fades_px: tuple[float, float] = (0.0, 0.0)


def boxes_of(
    lanes: Sequence[Lane], scale: TimeScale, durations_s: Mapping[int, float]
) -> list[Box]:
    """The clips that can be seen between the ends of ``scale``, lane by lane, in painting order.

    Parameters
    ----------
    lanes
        Lanes that can be seen.
    durations_s
        Length of each clip, by its id.
    """
    found = []
    first, last = scale.left_px, scale.right_px
    for lane in lanes:
        top, height = lane.top_px + MARGIN_PX, lane.height_px - 2 * MARGIN_PX
        for clip in lane.track.clips:
            left = scale.x(clip.onset_s)
            width = max(durations_s[clip.id] * scale.px_per_s, NARROWEST_PX)
            if left < last and left + width > first:
                rect = QRectF(left, top, width, height)
                in_s, out_s = fades_of(clip) if clip.effects else (0.0, 0.0)
                fades_px = (in_s * scale.px_per_s, out_s * scale.px_per_s)
                found.append(Box(clip=clip, lane=lane, rect=rect, fades_px=fades_px))
    return found


def lane_at(lanes: Sequence[Lane], y_px: float) -> Lane | None:
    """The lane at this height."""
    return next((lane for lane in lanes if lane.top_px <= y_px < lane.bottom_px), None)


def box_at(boxes: Sequence[Box], at: QPointF) -> Box | None:
    """The uppermost clip at this place, or else one of which an end is within reach."""
    for reach in (0.0, REACH_PX):
        for box in reversed(boxes):
            if box.rect.adjusted(-reach, 0, reach, 0).contains(at):
                return box
    return None
