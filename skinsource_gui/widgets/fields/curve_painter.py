"""Paints breakpoints and the curve through them."""

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from skinsource.design.effects.breakpoints import Points
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.fields.curve_scale import CurveScale

_POINT_PX = 3.5


def paint_frame(painter: QPainter, whole: QRectF, theme: Theme, *, focused: bool) -> None:
    """Paint the ground of a field, which shows whether it has the keyboard."""
    painter.setPen(QPen(QColor(theme.accent if focused else theme.border), 1))
    painter.setBrush(QColor(theme.base))
    painter.drawRoundedRect(whole.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)


def paint_curve(
    painter: QPainter,
    inside: QRectF,
    scale: CurveScale,
    points: Points,
    chosen: int | None,
    theme: Theme,
) -> None:
    """Paint a line at 1, the curve and its points, of which the ``chosen`` one is filled."""
    one = scale.place(0.0, 1.0, inside).y()
    painter.setPen(QPen(QColor(theme.grid), 1))
    painter.drawLine(QPointF(inside.left(), one), QPointF(inside.right(), one))
    painter.setPen(QPen(QColor(theme.accent), 1.5))
    painter.drawPolyline(QPolygonF(scale.course(points, inside)))
    for k, (x, y, _) in enumerate(points):
        painter.setBrush(QColor(theme.accent if k == chosen else theme.base))
        painter.drawEllipse(scale.place(x, y, inside), _POINT_PX, _POINT_PX)
