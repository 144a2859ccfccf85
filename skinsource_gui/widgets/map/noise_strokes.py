"""Strokes over what is mostly noise."""

from collections.abc import Sequence

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPainterPath

_DARK, _LIGHT = QColor(0, 0, 0, 150), QColor(255, 255, 255, 150)


def paint_strokes(
    painter: QPainter, places: Sequence[QPointF], reach_px: float, outline: QPainterPath
) -> None:
    """Hatch the surroundings of places inside an outline, so that it shows on any colour."""
    area = around(places, reach_px)
    painter.save()
    painter.setClipPath(outline, Qt.ClipOperation.IntersectClip)
    painter.fillPath(area, QBrush(_LIGHT, Qt.BrushStyle.BDiagPattern))
    painter.setBrushOrigin(1, 0)
    painter.fillPath(area, QBrush(_DARK, Qt.BrushStyle.BDiagPattern))
    painter.restore()


def paint_dark_strokes(painter: QPainter, places: Sequence[QPointF], reach_px: float) -> None:
    """Hatch discs."""
    painter.fillPath(around(places, reach_px), QBrush(_DARK, Qt.BrushStyle.BDiagPattern))


def around(places: Sequence[QPointF], reach_px: float) -> QPainterPath:
    """All that is no farther from one of the places; where discs overlap they are one."""
    area = QPainterPath()
    area.setFillRule(Qt.FillRule.WindingFill)
    for place in places:
        area.addEllipse(place, reach_px, reach_px)
    return area
