"""Strokes over what is mostly noise."""

from PySide6.QtCore import QPointF
from PySide6.QtGui import QPainter, QPainterPath

from skinsource_gui.panels.skin.stage.map_layout import MapLayout
from skinsource_gui.widgets.map.noise_strokes import paint_dark_strokes, paint_strokes
from skinsource_gui.widgets.outputs.picking import dorsal_outputs

# Around a sensor, in radii of its disc: about half of the way to its neighbours.
_REACH = 3.0


def paint_hatch(
    painter: QPainter, noisy: tuple[int, ...], layout: MapLayout, outline: QPainterPath
) -> None:
    """Hatch the surroundings of noisy outputs, dark and light so that it shows on any colour.

    On the back of the hand inside of the outline; on the palm side their discs.
    """
    dorsal = dorsal_outputs(layout.points, layout.unplaced)
    known = [number for number in noisy if number <= len(layout.points)]
    places = {number: QPointF(*layout.points[number - 1]) for number in known}
    aside = [place for number, place in places.items() if number not in dorsal]
    paint_dark_strokes(painter, aside, layout.palmar_radius)
    on_map = [place for number, place in places.items() if number in dorsal]
    paint_strokes(painter, on_map, _REACH * layout.disc_radius, outline)
