"""The vertical line that reads curves, and the points it reads."""

from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen

from skinsource_gui.theme import Theme

_DOT_PX = 2.5
#: How far the crosshair's picture reaches to each side.
REACH_PX = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class CrosshairPicture:
    """A crosshair in pixels.

    Attributes
    ----------
    x
        Column of the line.
    ys
        Height of the point on each curve, by rank.
    """

    x: float
    ys: tuple[float, ...]


def paint_crosshair(
    painter: QPainter, picture: CrosshairPicture, area: QRectF, theme: Theme
) -> None:
    """Paint the line over the height of ``area``, and a dot in the colour of each curve."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    painter.setPen(QPen(QColor(theme.dim), 1))
    painter.drawLine(QPointF(picture.x, area.top()), QPointF(picture.x, area.bottom()))
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    painter.setPen(QPen(QColor(theme.base), 1))
    for rank, y in enumerate(picture.ys):
        painter.setBrush(theme.output_colour(rank))
        painter.drawEllipse(QPointF(picture.x, y), _DOT_PX, _DOT_PX)
    painter.restore()


def paint_rubber_band(
    painter: QPainter, start_px: float, end_px: float, area: QRectF, theme: Theme
) -> None:
    """Paint the part of ``area`` that a drag would zoom to."""
    left, right = sorted((start_px, end_px))
    band = QRectF(left, area.top(), right - left, area.height()).intersected(area)
    colour = QColor(theme.accent)
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    painter.setPen(QPen(colour, 1))
    painter.drawLine(band.topLeft(), band.bottomLeft())
    painter.drawLine(band.topRight(), band.bottomRight())
    colour.setAlpha(48)
    painter.fillRect(band, colour)
    painter.restore()
