"""Maps in rows, lists and cards mark inputs that have a place on them."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QBuffer, QRectF
from PySide6.QtGui import QPainter
from PySide6.QtSvg import QSvgGenerator

import skinsource as ss
from skinsource_gui.plots.small_map import SmallMap, paint_small_map
from skinsource_gui.qt.theme import LIGHT


def rings_of(limb_map, *places):
    design = ss.Design(limb="synthetic-1", inputs=tuple(ss.track(place) for place in places))
    buffer = QBuffer()
    buffer.open(QBuffer.OpenModeFlag.WriteOnly)
    picture = QSvgGenerator()
    picture.setOutputDevice(buffer)
    painter = QPainter(picture)
    paint_small_map(painter, QRectF(0, 0, 120, 280), SmallMap(limb_map=limb_map), design, LIGHT)
    painter.end()
    drawn = bytes(buffer.data().data())
    assert b"nan" not in drawn
    return drawn.count(b"<circle") + drawn.count(b"<ellipse")


@pytest.mark.parametrize(("places", "inputs"), [((8,), 1), ((8, 13), 2), ((3,), 0), ((3, 8), 1)])
def test_an_input_without_a_place_on_the_map_has_no_ring(qapp, places, inputs):
    limb_map = ss.load_limb("synthetic-1").map
    positions = limb_map.input_positions.copy()
    positions[2] = np.nan
    # Each ring has a light edge below it.
    assert rings_of(replace(limb_map, input_positions=positions), *places) == 2 * inputs
