"""Where clips of a track lie over each other, and which of them are at a place."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter

from skinsource.design.clips import Clip
from skinsource.design.design import Input
from skinsource_gui.panels.timeline.lane import MARGIN_PX, Box, Lane
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.fields.units import value_text
from skinsource_gui.widgets.time.time_scale import TimeScale

_MARK_PX = 4.0
_ALPHA = 190
# What is shorter is rounding of two clips that follow each other, s.
_LEAST_S = 1e-9


@dataclass(frozen=True, slots=True)
class Stretch:
    """From when to when clips overlap, s."""

    start_s: float
    end_s: float


class Overlaps:
    """Finds where clips of tracks overlap; of a track that stays the same, once."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[Input, tuple[Stretch, ...]]] = {}

    def of(self, track: Input) -> tuple[Stretch, ...]:
        """Stretches of time with two clips or more, rising."""
        known = self._known.get(track.id)
        if known is None or known[0] is not track:
            known = self._known[track.id] = (track, stretches(track.clips))
        return known[1]


def stretches(clips: Iterable[Clip]) -> tuple[Stretch, ...]:
    """Stretches of time in which two of these clips or more play."""
    found: list[Stretch] = []
    last_s = float("-inf")
    for start_s, end_s in sorted((one.onset_s, one.end_s) for one in clips):
        if min(last_s, end_s) - start_s > _LEAST_S:
            both = Stretch(start_s, min(last_s, end_s))
            if found and both.start_s <= found[-1].end_s:
                both = Stretch(found[-1].start_s, max(found[-1].end_s, both.end_s))
                found.pop()
            found.append(both)
        last_s = max(last_s, end_s)
    return tuple(found)


def paint_overlaps(
    painter: QPainter, lane: Lane, found: Sequence[Stretch], scale: TimeScale, theme: Theme
) -> None:
    """Mark at the foot of a lane where its clips overlap."""
    colour = QColor(theme.text)
    colour.setAlpha(_ALPHA)
    top = lane.bottom_px - MARGIN_PX - _MARK_PX
    for one in found:
        left, right = max(scale.x(one.start_s), -10.0), min(scale.x(one.end_s), 1e5)
        if right > left:
            painter.fillRect(QRectF(left, top, max(right - left, 2.0), _MARK_PX), colour)


def boxes_at(boxes: Sequence[Box], at: QPointF) -> list[Box]:
    """All clips at a place, in the order in which their track lists them."""
    found = [box for box in boxes if box.rect.contains(at)]
    return sorted(found, key=lambda box: box.lane.track.clips.index(box.clip))


def after(ids: Sequence[int], one: int | None) -> int | None:
    """The next of several, the first after the last; None where there is no other."""
    if len(ids) < 2:
        return None
    return ids[(ids.index(one) + 1) % len(ids)] if one in ids else ids[0]


def overlapping(track: Input, clip: Clip) -> tuple[int, ...]:
    """Ids of the clips of a track that play while one of them does, with that one."""
    return tuple(
        one.id
        for one in sorted(track.clips, key=lambda each: (each.onset_s, each.id))
        if min(one.end_s, clip.end_s) - max(one.onset_s, clip.onset_s) > _LEAST_S or one is clip
    )


def clip_words(clip: Clip) -> str:
    """A clip in a list: ``"Tone · 120 ms"``."""
    return f"{clip.label or clip.waveform.title} · {value_text(clip.onset_s, 's', digits=5)}"
