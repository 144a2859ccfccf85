"""The ruler over the lanes."""

from collections.abc import Sequence

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen, QPolygonF

from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.fields.units import axis_unit
from skinsource_gui.widgets.plot.ticks import Tick, linear_ticks
from skinsource_gui.widgets.time.time_scale import Range, TimeScale

_TICK_PX = 64.0
_GAP_PX = 6.0
_LOOP_ALPHA = 60


def ticks_of(scale: TimeScale) -> tuple[str, tuple[Tick, ...]]:
    """Unit of the ruler, and its ticks."""
    unit, factor = axis_unit(scale.shown_s[1])
    return unit, linear_ticks(*scale.shown_s, max(scale.width_px / _TICK_PX, 2), factor)


def grid_lines(scale: TimeScale, room: QRectF) -> list[QLineF]:
    """Upright lines below the ticks."""
    return [
        QLineF(x, room.top(), x, room.bottom())
        for x in (scale.x(tick.value) for tick in ticks_of(scale)[1])
        if room.left() <= x <= room.right()
    ]


def paint_ruler(painter: QPainter, content: Content, room: QRectF, theme: Theme) -> None:
    """Paint ticks, loop region and markers."""
    painter.fillRect(room, QColor(theme.window))
    if content.design.loop_s is not None:
        _paint_loop(painter, content, content.design.loop_s, room, theme)
    taken = []
    for marker in content.design.markers:
        x = content.scale.x(marker.time_s)
        taken.append(_paint_marker(painter, x, marker.name, room, theme))
    _paint_ticks(painter, content.scale, room, theme, taken)
    painter.setPen(QPen(QColor(theme.border), 1))
    painter.drawLine(QLineF(room.left(), room.bottom() - 0.5, room.right(), room.bottom() - 0.5))


def _paint_ticks(
    painter: QPainter, scale: TimeScale, room: QRectF, theme: Theme, taken: Sequence[QRectF]
) -> None:
    """Paint ticks, and their numbers where no marker's name stands."""
    metrics = QFontMetricsF(painter.font())
    unit, ticks = ticks_of(scale)
    painter.setPen(QColor(theme.dim))
    unit_left = room.right() - metrics.horizontalAdvance(unit) - _GAP_PX
    painter.drawText(QPointF(unit_left, room.top() + metrics.ascent() + 1), unit)
    free_from = room.left()
    for tick in ticks:
        x = scale.x(tick.value)
        if not room.left() - 1 <= x <= room.right():
            continue
        painter.drawLine(QLineF(x, room.bottom() - 5, x, room.bottom()))
        width = metrics.horizontalAdvance(tick.label)
        left = max(x - width / 2, room.left() + 2)
        number = QRectF(left, room.top(), width, metrics.height())
        free = not any(name.intersects(number) for name in taken)
        if free and left >= free_from and left + width < unit_left - _GAP_PX:
            painter.drawText(QPointF(left, room.top() + metrics.ascent() + 1), tick.label)
            free_from = left + width + _GAP_PX


def _paint_loop(
    painter: QPainter, content: Content, loop_s: Range, room: QRectF, theme: Theme
) -> None:
    start, end = (content.scale.x(one) for one in loop_s)
    band = QRectF(start, room.bottom() - 9, end - start, 9).intersected(room)
    tint = QColor(theme.accent)
    tint.setAlpha(_LOOP_ALPHA)
    painter.fillRect(band, tint)
    painter.setPen(QPen(QColor(theme.accent), 2))
    for x in (start, end):
        if room.left() <= x <= room.right():
            painter.drawLine(QLineF(x, room.bottom() - 10, x, room.bottom()))


def _paint_marker(painter: QPainter, x: float, name: str, room: QRectF, theme: Theme) -> QRectF:
    """Paint a flag and a name; where they are."""
    if not room.left() - 200 <= x <= room.right():
        return QRectF()
    metrics = QFontMetricsF(painter.font())
    colour = QColor(theme.warning)
    painter.setPen(QPen(colour, 1))
    painter.drawLine(QLineF(x, room.top(), x, room.bottom()))
    painter.setBrush(colour)
    painter.drawPolygon(
        QPolygonF(
            (QPointF(x, room.top()), QPointF(x + 7, room.top() + 4), QPointF(x, room.top() + 8))
        )
    )
    shown = metrics.elidedText(name, Qt.TextElideMode.ElideRight, 110)
    ground = QRectF(x + 8, room.top(), metrics.horizontalAdvance(shown) + 4, metrics.height())
    painter.fillRect(ground, QColor(theme.window))
    painter.drawText(ground, Qt.AlignmentFlag.AlignCenter, shown)
    return ground.adjusted(-10, 0, 2, 0)
