"""Where on a field the points of a curve are seen."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF

from skinsource.design.effects.breakpoints import Points, curve_at

# How far from a point or the curve it is still meant.
_NEAR_PX = 8.0


@dataclass(frozen=True, slots=True)
class CurveScale:
    """Values from 0 to ``x`` and 0 to ``y`` fill an area."""

    x: float
    y: float

    @classmethod
    def around(cls, points: Points) -> "CurveScale":
        """With room for all points, and some to move them to."""
        last, highest = points[-1][0], max(point[1] for point in points)
        return cls(1.1 * last if last > 0.0 else 0.1, 1.1 * max(highest, 1.0))

    def place(self, x: float, y: float, area: QRectF) -> QPointF:
        """Where a value is seen."""
        return QPointF(
            area.left() + area.width() * x / self.x, area.bottom() - area.height() * y / self.y
        )

    def value(self, at: QPointF, area: QRectF) -> tuple[float, float]:
        """The value that is seen at a place."""
        return (
            self.x * (at.x() - area.left()) / area.width(),
            self.y * (area.bottom() - at.y()) / area.height(),
        )

    def point_at(self, points: Points, at: QPointF, area: QRectF) -> int | None:
        """Number of the point that is seen at a place."""
        gaps = [(self.place(x, y, area) - at).manhattanLength() for x, y, _ in points]
        nearest = min(range(len(gaps)), key=gaps.__getitem__)
        return nearest if gaps[nearest] <= _NEAR_PX else None

    def is_on_curve(self, points: Points, x: float, at: QPointF, area: QRectF) -> bool:
        """Whether the curve is seen at a place whose value is ``x``."""
        y = float(curve_at(points, np.array([x]))[0])
        return abs(self.place(x, y, area).y() - at.y()) <= _NEAR_PX

    def course(self, points: Points, area: QRectF) -> list[QPointF]:
        """The curve, at each pixel and at each point; a jump is upright."""
        pixels = np.linspace(0.0, self.x, max(int(area.width()), 2))
        own = np.array([x for x, _, _ in points])
        # Just before each point, too, for what jumps there.
        x = np.sort(np.concatenate((pixels, own, np.maximum(own - 1e-9, 0.0))))
        return [self.place(*pair, area) for pair in zip(x, curve_at(points, x), strict=True)]
