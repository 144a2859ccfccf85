"""The box around chosen points: its handles scale them."""

from dataclasses import dataclass
from math import hypot

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from skinsource.design.effects import breakpoints as algebra
from skinsource.design.effects.breakpoints import Points
from skinsource_gui.panels.clip_editor.content import EditorContent
from skinsource_gui.theme import Theme

#: How near the pointer takes hold of a handle, px.
CATCH_PX = 6.0
# Between the outermost points and the box, so that points and handles do not cover each other.
_BESIDE_PX = 14.0
_HANDLE_PX = 6.0
_SIDES = ((-1, 0), (1, 0), (0, -1), (0, 1), (-1, -1), (-1, 1), (1, -1), (1, 1))


@dataclass(frozen=True, slots=True)
class Handle:
    """A side or a corner: -1 is left or below, 1 right or above, 0 neither."""

    along: int
    up: int


def handle_at(
    content: EditorContent, points: Points, chosen: tuple[int, ...], at: QPointF
) -> Handle | None:
    """The handle that is within reach."""
    for handle, place in _handles(content, points, chosen):
        if hypot(place.x() - at.x(), place.y() - at.y()) <= CATCH_PX:
            return handle
    return None


def scaled_by(
    points: Points, chosen: tuple[int, ...], handle: Handle, by_s: float, by_value: float
) -> Points:
    """The points when a handle went so far: what is opposite to it stays where it is.

    Where all have the same value they are scaled about 0.
    """
    times, values = _places(points, chosen)
    from_s, factor_s = _about(min(times), max(times), handle.along, by_s)
    low, high = min(values), max(values)
    from_value, factor = _about(0.0 if low == high else low, high, handle.up, by_value)
    return algebra.scaled(points, chosen, (from_s, from_value), factor_s, factor)


def paint_box(
    painter: QPainter,
    content: EditorContent,
    points: Points,
    chosen: tuple[int, ...],
    theme: Theme,
) -> None:
    """Paint the box and its handles, where there is more than one point to scale."""
    box = _box(content, points, chosen)
    if box is None:
        return
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.accent), 1, Qt.PenStyle.DashLine))
    painter.drawRect(box)
    painter.setPen(QPen(QColor(theme.accent), 1))
    painter.setBrush(QColor(theme.base))
    for _, place in _handles(content, points, chosen):
        square = QRectF(0, 0, _HANDLE_PX, _HANDLE_PX)
        square.moveCenter(place)
        painter.drawRect(square)


def _about(low: float, high: float, side: int, by: float) -> tuple[float, float]:
    """What stays, and the factor, when one side of a range goes so far."""
    if side == 0 or low == high:
        return low, 1.0
    stays = low if side > 0 else high
    return stays, max(1.0 + side * by / (high - low), 0.0)


def _places(points: Points, chosen: tuple[int, ...]) -> tuple[list[float], list[float]]:
    """Times and values of the chosen points."""
    there = [points[k] for k in chosen if k < len(points)]
    return [one[0] for one in there], [one[1] for one in there]


def _box(content: EditorContent, points: Points, chosen: tuple[int, ...]) -> QRectF | None:
    times, values = _places(points, chosen)
    if len(times) < 2:
        return None
    places = list(map(content.at, times, values))
    x, y = [one.x() for one in places], [one.y() for one in places]
    tight = QRectF(QPointF(min(x), min(y)), QPointF(max(x), max(y)))
    box = tight.adjusted(-_BESIDE_PX, -_BESIDE_PX, _BESIDE_PX, _BESIDE_PX)
    # No handle lies where it could not be seen.
    return box.intersected(content.area.adjusted(3, 3, -3, -3))


def _handles(
    content: EditorContent, points: Points, chosen: tuple[int, ...]
) -> list[tuple[Handle, QPointF]]:
    box = _box(content, points, chosen)
    if box is None or box.isEmpty():
        return []
    times, values = map(set, _places(points, chosen))
    found = []
    for along, up in _SIDES:
        # Points of the same time cannot be drawn apart, those of the same value upwards alone.
        if (along and len(times) == 1) or (up < 0 and len(values) == 1):
            continue
        if up and values == {0.0}:
            continue
        x = box.center().x() + along * box.width() / 2
        y = box.center().y() - up * box.height() / 2
        found.append((Handle(along, up), QPointF(x, y)))
    return found
