"""Which way the sensors' axes point."""

from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from skinsource.design.labels import TRIAD
from skinsource_gui.theme import Theme

#: Under the drawing: x and y point another way at each sensor.
CAPTION = ("x, y differ", "by sensor")
TITLE = "Axes"

# Angle of the x arrow, degrees counter-clockwise: no direction that means something on the map.
_TURNED = 28.0
# Size of the drawing, and of its parts, in lines of text.
_DRAWING_LINES, _ARM_LINES, _RING_LINES, _FOOT_LINES = 2.7, 1.15, 0.3, 0.4


def triad_size(metrics: QFontMetricsF) -> QSizeF:
    """Size of the card."""
    line = metrics.height()
    width = max(map(metrics.horizontalAdvance, (TITLE, *CAPTION))) + 0.9 * line
    return QSizeF(width, (1.3 + _DRAWING_LINES + len(CAPTION) + _FOOT_LINES) * line)


def paint_triad(painter: QPainter, card: QRectF, theme: Theme) -> None:
    """Draw z out of the skin, x and y along it, dashed, and what there is to know of them."""
    line = painter.fontMetrics().height()
    centred = Qt.AlignmentFlag.AlignCenter
    painter.setPen(QColor(theme.dim))
    top = QRectF(card.left(), card.top(), card.width(), 1.3 * line)
    painter.drawText(top, centred, TITLE)
    middle = QPointF(card.center().x() - 0.3 * line, top.bottom() + 0.62 * _DRAWING_LINES * line)
    colour = QColor(theme.text)
    for axis, angle in ((TRIAD[0], _TURNED), (TRIAD[1], _TURNED + 90.0)):
        _paint_arrow(painter, middle, angle, line, axis.title, colour)
    ring = _RING_LINES * line
    painter.setPen(QPen(colour, 0.1 * line))
    painter.setBrush(QColor(theme.base))
    painter.drawEllipse(middle, ring, ring)
    painter.setBrush(colour)
    painter.drawEllipse(middle, 0.07 * line, 0.07 * line)
    beside = QRectF(middle.x() - 1.1 * line, middle.y() - 0.1 * line, 0.8 * line, line)
    painter.drawText(beside, centred, TRIAD[2].title)
    painter.setPen(QColor(theme.dim))
    below = QRectF(
        card.left(), card.bottom() - (len(CAPTION) + _FOOT_LINES) * line, card.width(), 2 * line
    )
    # The tails of letters may reach below two lines.
    painter.drawText(below, centred | Qt.TextFlag.TextDontClip, "\n".join(CAPTION))


def _paint_arrow(
    painter: QPainter, middle: QPointF, angle: float, line: float, name: str, colour: QColor
) -> None:
    shaft = QLineF.fromPolar(_ARM_LINES * line, angle).translated(middle)
    pen = QPen(colour, 0.09 * line)
    pen.setDashPattern([3.0, 2.0])
    painter.setPen(pen)
    painter.drawLine(shaft)
    painter.setPen(QPen(colour, 0.09 * line))
    for side in (150.0, -150.0):
        barb = QLineF.fromPolar(0.32 * line, angle + side).translated(shaft.p2())
        painter.drawLine(barb)
    at = QLineF.fromPolar((_ARM_LINES + 0.45) * line, angle).translated(middle).p2()
    area = QRectF(at.x() - line / 2, at.y() - line / 2, line, line)
    painter.drawText(area, Qt.AlignmentFlag.AlignCenter, name)
