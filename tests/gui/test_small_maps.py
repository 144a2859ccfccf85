"""Maps in rows, lists and cards: their inputs, and on paper a bar of millimetres."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QBuffer, QRectF
from PySide6.QtGui import QColor, QImage, QPainter
from PySide6.QtSvg import QSvgGenerator

import skinsource as ss
from skinsource_gui.plots.small_map import SmallMap, paint_small_bar, paint_small_map
from skinsource_gui.qt.theme import LIGHT, on_paper


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


@pytest.mark.parametrize(("places", "inputs"), [((8, 13), 2), ((3,), 0), ((3, 8), 1)])
def test_an_input_without_a_place_on_the_map_has_no_ring(qapp, places, inputs):
    limb_map = ss.load_limb("synthetic-1").map
    positions = limb_map.input_positions.copy()
    positions[2] = np.nan
    # Each ring has a light edge below it.
    assert rings_of(replace(limb_map, input_positions=positions), *places) == 2 * inputs


@pytest.mark.parametrize(("limb", "hand_mm"), [("synthetic-1", 175.0), ("synthetic-3", 185.0)])
def test_the_bar_is_as_long_as_it_says_and_on_paper_alone(qapp, limb, hand_mm):
    limb_map = ss.load_limb(limb).map
    area = QRectF(0, 0, 300, 900)

    def painted():
        image = QImage(300, 900, QImage.Format.Format_RGB32)
        image.fill(QColor(LIGHT.base))
        painter = QPainter(image)
        paint_small_bar(painter, area, SmallMap(limb_map=limb_map), limb, LIGHT)
        painter.end()
        return [
            x for x in range(300) if QColor(image.pixel(x, 897)).name() == QColor(LIGHT.text).name()
        ]

    assert painted() == []
    with on_paper():
        dark = painted()
    # The arm is as wide as the area.
    px_per_mm = 300 / np.ptp(limb_map.outline[:, 0]) * limb_map.hand_length_px / hand_mm
    lengths_mm = np.array([100, 50, 20, 10])
    assert np.abs(lengths_mm * px_per_mm - len(dark)).min() <= 1.5
    assert 20 < len(dark) <= 75
