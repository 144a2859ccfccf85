"""Where a drawing lies on the screen."""

from dataclasses import dataclass, replace

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPolygonF, QTransform

from skinsource.base.arrays import Floats

# So far from the middle of the room the nearest of an outline may be, in smaller sides of it.
_REACH = 0.2


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """From a drawing to screen pixels.

    Attributes
    ----------
    scale
        Screen pixels in a unit of the drawing.
    left, top
        Screen place of the drawing's origin.
    up
        Whether y of the drawing points up; on the screen it points down.
    """

    scale: float
    left: float
    top: float
    up: bool = False

    def transform(self) -> QTransform:
        """The same as a transformation."""
        return QTransform(self.scale, 0, 0, self._y_scale, self.left, self.top)

    def to_screen(self, places: Floats) -> Floats:
        """Screen places, (n, 2), of places of the drawing, (n, 2)."""
        return places * (self.scale, self._y_scale) + (self.left, self.top)

    def to_drawing(self, point: QPointF) -> tuple[float, float]:
        """Place of the drawing at a screen point."""
        return (point.x() - self.left) / self.scale, (point.y() - self.top) / self._y_scale

    def zoomed(self, factor: float, about: QPointF) -> "Frame":
        """Frame magnified around a screen point that stays where it is."""
        return replace(
            self,
            scale=self.scale * factor,
            left=about.x() + (self.left - about.x()) * factor,
            top=about.y() + (self.top - about.y()) * factor,
        )

    def moved(self, dx: float, dy: float) -> "Frame":
        """Frame shifted by screen pixels."""
        return replace(self, left=self.left + dx, top=self.top + dy)

    def kept_in_sight(self, outline: Floats, room: QRectF) -> "Frame":
        """Frame shifted as little as it takes to see the outline, or its inside, in ``room``.

        Parameters
        ----------
        outline : (n, 2)
            Polygon, in the drawing's units.
        room
            On the screen.
        """
        middle = QPointF(*self.to_drawing(room.center()))
        polygon = QPolygonF([QPointF(x, y) for x, y in outline])
        if polygon.containsPoint(middle, Qt.FillRule.OddEvenFill):
            return self
        ways = self.to_screen(outline) - (room.center().x(), room.center().y())
        distances = np.hypot(*ways.T)
        nearest = int(np.argmin(distances))
        reach = _REACH * min(room.width(), room.height())
        if distances[nearest] <= reach:
            return self
        back = ways[nearest] * (reach / distances[nearest] - 1.0)
        return self.moved(float(back[0]), float(back[1]))

    @property
    def _y_scale(self) -> float:
        return -self.scale if self.up else self.scale


def fitted(bounds: QRectF, room: QRectF, *, up: bool = False) -> Frame:
    """The frame in which ``bounds`` fills ``room``, centred."""
    scale = max(min(room.width() / bounds.width(), room.height() / bounds.height()), 1e-3)
    return Frame(
        scale=scale,
        left=room.center().x() - scale * bounds.center().x(),
        top=room.center().y() + (scale if up else -scale) * bounds.center().y(),
        up=up,
    )
