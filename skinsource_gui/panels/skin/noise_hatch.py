"""Strokes over what is mostly noise."""

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPainterPath

from skinsource_gui.panels.skin.map_layout import MapLayout
from skinsource_gui.widgets.outputs.picking import dorsal_outputs

# Around a sensor, in radii of its disc: about half of the way to its neighbours.
_REACH = 3.0
_DARK, _LIGHT = QColor(0, 0, 0, 150), QColor(255, 255, 255, 150)


def paint_hatch(
    painter: QPainter, noisy: tuple[int, ...], layout: MapLayout, outline: QPainterPath
) -> None:
    """Hatch the surroundings of noisy outputs, dark and light so that it shows on any colour.

    On the back of the hand inside of the outline; on the palm side their discs.
    """
    dorsal = dorsal_outputs(layout.points, layout.unplaced)
    area, discs = QPainterPath(), QPainterPath()
    # Where discs overlap they are one.
    for path in (area, discs):
        path.setFillRule(Qt.FillRule.WindingFill)
    for number in noisy:
        if number > len(layout.points):
            continue
        centre = QPointF(*layout.points[number - 1])
        if number in dorsal:
            reach = _REACH * layout.disc_radius
            area.addEllipse(centre, reach, reach)
        else:
            discs.addEllipse(centre, layout.palmar_radius, layout.palmar_radius)
    painter.save()
    painter.fillPath(discs, QBrush(_DARK, Qt.BrushStyle.BDiagPattern))
    painter.setClipPath(outline)
    painter.fillPath(area, QBrush(_LIGHT, Qt.BrushStyle.BDiagPattern))
    painter.setBrushOrigin(1, 0)
    painter.fillPath(area, QBrush(_DARK, Qt.BrushStyle.BDiagPattern))
    painter.restore()
