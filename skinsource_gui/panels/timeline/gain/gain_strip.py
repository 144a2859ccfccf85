"""Where the gain curve of a track is on its lane."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF

from skinsource.base.decibels import decibels
from skinsource.design.effects.breakpoints import Points, curve_at
from skinsource_gui.panels.timeline.lane import Lane
from skinsource_gui.widgets.fields.units import value_text
from skinsource_gui.widgets.plot.ticks import number_text
from skinsource_gui.widgets.time.time_scale import TimeScale

Curve = tuple[tuple[float, float], ...]

#: How far away from a point, and from the line, the pointer catches it, px.
POINT_PX, LINE_PX = 8.0, 5.0
# Gains up to this have room at least; free space above and below, px.
_LEAST_TOP, _ROOM = 2.0, 1.15
_MARGIN_PX = 4.0


@dataclass(frozen=True, slots=True, kw_only=True)
class GainStrip:
    """A gain curve, and where its values lie.

    Attributes
    ----------
    lane, scale
        Where it is.
    top
        The gain at the upper edge of the lane.
    shown
        Whether it is shown for editing; else it is only hinted at.
    """

    lane: Lane
    scale: TimeScale
    top: float
    shown: bool

    @property
    def points(self) -> Points:
        """Its breakpoints."""
        return points_of(self.lane.track.gain_curve)

    @property
    def height_px(self) -> float:
        """From a gain of 0 up to the largest one, px."""
        return max(self.lane.height_px - 2 * _MARGIN_PX, 1.0)

    def at(self, time_s: float, gain: float) -> QPointF:
        """Where a gain at a time lies, px."""
        return QPointF(self.scale.x(time_s), self.y(gain))

    def y(self, gain: float) -> float:
        """Where a gain lies, px."""
        return self.lane.bottom_px - _MARGIN_PX - gain / self.top * self.height_px

    def gain_at(self, time_s: float) -> float:
        """The gain at a time."""
        points = self.points or ((0.0, 1.0, "straight"),)
        return float(curve_at(points, np.array([time_s]))[0])

    def point_at(self, at: QPointF) -> int | None:
        """The point within reach."""
        away = [
            (max(abs(one.x() - at.x()), abs(one.y() - at.y())), k)
            for k, one in enumerate(self.at(x, y) for x, y, _ in self.points)
        ]
        found = min(away, default=None)
        return None if found is None or found[0] > POINT_PX else found[1]

    def is_on_line(self, at: QPointF) -> bool:
        """Whether the curve passes here."""
        return abs(self.y(self.gain_at(self.scale.time(at.x()))) - at.y()) <= LINE_PX

    def around(self, time_s: float) -> tuple[int, ...]:
        """The points between which the curve is at a time; beyond its ends the one there."""
        points = self.points
        before = sum(x <= time_s for x, _, _ in points)
        return tuple(k for k in (before - 1, before) if 0 <= k < len(points))


def points_of(curve: Curve) -> Points:
    """A gain curve as breakpoints."""
    return tuple((x, y, "straight") for x, y in curve)


def curve_of(points: Points) -> Curve:
    """Breakpoints as a gain curve, with no more digits than anybody wants to read."""
    return tuple((round(x, 9), round(y, 6)) for x, y, _ in points)


def top_of(curve: Curve) -> float:
    """The largest gain that a lane has room for."""
    return max(_LEAST_TOP, _ROOM * max((y for _, y in curve), default=0.0))


def gain_words(time_s: float, gain: float) -> str:
    """A point in words: ``"120 ms · × 0.5 · −6.0 dB"``."""
    level = f"{number_text(float(decibels(np.array([gain]))[0]), 1)} dB" if gain > 0.0 else "silent"
    return f"{value_text(time_s, 's', digits=5)} · × {gain:.4g} · {level}"
