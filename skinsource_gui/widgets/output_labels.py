"""Numbers beside the selected outputs, where there is room for them."""

from collections.abc import Iterable
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QFontMetricsF

from skinsource_gui.widgets.map_layout import MapLayout


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputLabel:
    """A number and the area it is written in."""

    number: int
    area: QRectF


def output_labels(
    numbers: Iterable[int], layout: MapLayout, radius: float, metrics: QFontMetricsF
) -> tuple[OutputLabel, ...]:
    """Labels of dorsal outputs, each beside its ring; one that would cover another is left out.

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
    placed: list[OutputLabel] = []
    for number in numbers:
        x, y = layout.points[number - 1]
        width = metrics.horizontalAdvance(str(number)) + 6 * layout.unit
        height = metrics.height()
        for area in _around(QPointF(x, y), width, height, radius + 3 * layout.unit):
            if layout.room.contains(area) and not any(area.intersects(p.area) for p in placed):
                placed.append(OutputLabel(number=number, area=area))
                break
    return tuple(placed)


def _around(centre: QPointF, width: float, height: float, away: float) -> tuple[QRectF, ...]:
    """Areas to the right, to the left, above and below."""
    x, y = centre.x(), centre.y()
    return (
        QRectF(x + away, y - height / 2, width, height),
        QRectF(x - away - width, y - height / 2, width, height),
        QRectF(x - width / 2, y - away - height, width, height),
        QRectF(x - width / 2, y + away, width, height),
    )
