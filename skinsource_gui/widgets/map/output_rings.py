"""Rings around outputs of a small map, and their numbers where these have room."""

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from skinsource_gui.theme import Theme
from skinsource_gui.widgets.map.small_map import SmallMap, small_frame, spacing_px
from skinsource_gui.widgets.outputs.picking import is_placed

_RING_PX, _WIDE_PX = 4.0, 7.0
_FEW_RINGS = 12
_EDGE_PX, _GROUND = 2.0, 0.85
# How far from its ring a number may stand, in rings.
_FARTHEST = 6


def ring_size(n: int, spacing_px: float) -> tuple[float, float]:
    """Radius and width of ``n`` rings, px: of many of them so small that the map is seen."""
    if n <= _FEW_RINGS:
        return _RING_PX, 2.0
    return min(max(0.3 * spacing_px, 1.5), _RING_PX), 1.0


def paint_rings(
    painter: QPainter,
    small: SmallMap,
    area: QRectF,
    outputs: tuple[int, ...],
    theme: Theme,
    pointed_at: int | None = None,
) -> None:
    """Selected outputs in the colours of their curves, and the one that is pointed at."""
    limb_map = small.limb_map
    frame = small_frame(limb_map, area)
    points = frame.to_screen(limb_map.output_positions)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    radius, width = ring_size(len(outputs), spacing_px(limb_map, frame))
    rings = [(number, theme.output_pen(rank, width), radius) for rank, number in enumerate(outputs)]
    if pointed_at is not None:
        rings.append((pointed_at, QPen(QColor(theme.text), 1.5), _WIDE_PX))
    for number, pen, radius in rings:
        if not is_placed(points, number):
            continue  # not on this map
        centre = QPointF(*points[number - 1])
        painter.setPen(QPen(QColor(theme.base), 2.0 * pen.widthF()))
        painter.drawEllipse(centre, radius, radius)
        painter.setPen(pen)
        painter.drawEllipse(centre, radius, radius)


def number_places(
    small: SmallMap, area: QRectF, outputs: tuple[int, ...], metrics: QFontMetricsF
) -> list[tuple[int, QRectF]]:
    """Where numbers stand beside the rings of few outputs: on no other number and on no ring.

    Where rings are close some stand farther off.
    """
    points = small_frame(small.limb_map, area).to_screen(small.limb_map.output_positions)
    placed = [one for one in outputs if is_placed(points, one)]
    if len(outputs) > _FEW_RINGS:
        return []
    side = 2.0 * _RING_PX + _EDGE_PX
    taken = [
        QRectF(x - side / 2, y - side / 2, side, side)
        for x, y in (points[number - 1] for number in placed)
    ]
    found: list[tuple[int, QRectF]] = []
    for number in placed:
        x, y = (float(one) for one in points[number - 1])
        wide = metrics.horizontalAdvance(str(number)) + 2.0 * _EDGE_PX
        high = metrics.height()
        corners = [
            (left, y - high / 2 + down * high / 2)
            for away in (side / 2, *(rank * side for rank in range(1, _FARTHEST)))
            for down in (0, -1, 1, -2, 2, -3, 3)
            for left in (x + away, x - away - wide)
        ]
        for left, top in corners:
            place = QRectF(left, top, wide, high)
            if area.contains(place) and not any(place.intersects(one) for one in taken):
                taken.append(place)
                found.append((number, place))
                break
    return found


def paint_numbers(
    painter: QPainter, small: SmallMap, area: QRectF, outputs: tuple[int, ...], theme: Theme
) -> None:
    """Write the numbers of outputs beside their rings, each on a line in its colour."""
    ground = QColor(theme.base)
    ground.setAlphaF(_GROUND)
    points = small_frame(small.limb_map, area).to_screen(small.limb_map.output_positions)
    for number, place in number_places(small, area, outputs, QFontMetricsF(painter.font())):
        x, y = (float(one) for one in points[number - 1])
        right = place.left() > x
        edge = QPointF(place.left() if right else place.right(), place.center().y())
        painter.setPen(theme.output_pen(outputs.index(number), 1.0))
        painter.drawLine(QPointF(x + (_RING_PX if right else -_RING_PX), y), edge)
        painter.fillRect(place, ground)
        painter.setPen(QColor(theme.text))
        painter.drawText(place, Qt.AlignmentFlag.AlignCenter, str(number))
