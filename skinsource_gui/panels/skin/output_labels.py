"""Numbers beside the selected outputs, where there is room for them."""

from collections.abc import Iterable
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QFontMetricsF

from skinsource_gui.panels.skin.map_layout import MapLayout


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputLabel:
    """A number and the area it is written in."""

    number: int
    area: QRectF


def output_labels(
    numbers: Iterable[int], layout: MapLayout, radius: float, metrics: QFontMetricsF
) -> tuple[OutputLabel, ...]:
    """Labels of dorsal outputs, each beside its ring, rather not on another one's ring.

    One that would cover another label is left out.

    Parameters
    ----------
    numbers
        The earlier ones are placed first.
    layout
        Places of the outputs.
    radius
        Of the rings, px.
    metrics
        Of the font of the labels.
    """
    wanted = tuple(numbers)
    rings = [square(QPointF(*layout.points[number - 1]), radius) for number in wanted]
    placed: list[OutputLabel] = []
    for number in wanted:
        x, y = layout.points[number - 1]
        width = metrics.horizontalAdvance(str(number)) + 6 * layout.unit
        height = metrics.height()
        areas = _around(QPointF(x, y), width, height, radius + 3 * layout.unit)
        free = [
            area
            for area in areas
            if layout.room.contains(area) and not any(area.intersects(p.area) for p in placed)
        ]
        if free:
            clear = (area for area in free if not any(area.intersects(ring) for ring in rings))
            placed.append(OutputLabel(number=number, area=next(clear, free[0])))
    return tuple(placed)


def square(centre: QPointF, radius: float) -> QRectF:
    """The square around a circle."""
    return QRectF(centre.x() - radius, centre.y() - radius, 2 * radius, 2 * radius)


def _around(centre: QPointF, width: float, height: float, away: float) -> tuple[QRectF, ...]:
    """Areas to the right, to the left, above and below."""
    x, y = centre.x(), centre.y()
    return (
        QRectF(x + away, y - height / 2, width, height),
        QRectF(x - away - width, y - height / 2, width, height),
        QRectF(x - width / 2, y - away - height, width, height),
        QRectF(x - width / 2, y + away, width, height),
    )
