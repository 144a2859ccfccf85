"""Maps in rows, lists and cards: their inputs, their colours of levels, millimetres on paper."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QBuffer, QRectF
from PySide6.QtGui import QColor, QImage, QPainter
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QApplication

import skinsource as ss
from skinsource.design.panel_settings import with_settings
from skinsource.design.view import View
from skinsource_gui.panels.compare.settings import CompareSettings
from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.plots.pictures import drawn_image
from skinsource_gui.plots.small_map import (
    LevelStyle,
    SmallMap,
    level_style,
    paint_small_bar,
    paint_small_map,
    with_colours_of,
)
from skinsource_gui.qt.theme import LIGHT, on_paper
from tests.gui.analysis.analysis_bench import analysis


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


#: Pixels of a small map, and of words that happen to have its colours.
MANY, FEW = 100, 20
MAPS = ("skin", "analysis/windowed", "compare")


def n_in(image, colours):
    """How many pixels of a picture have colours of a map; its ends may be those of words."""
    argb = image.convertToFormat(QImage.Format.Format_RGB32)
    pixels = np.frombuffer(argb.constBits(), np.uint32).reshape(argb.height(), -1)
    pixels = pixels[:, : argb.width()] | np.uint32(0xFF000000)
    return int(np.isin(pixels, colour_table(colours)[8:-8]).sum())


def look_at(window, qtbot, name):
    """Bring a panel into sight, and wait until it has maps."""
    if name == "compare":
        limbs = with_settings(window.document.view, "compare", CompareSettings(of="limbs"))
        window.document.look(limbs)
    name, _, view = name.partition("/")
    if view:
        analysis(window, view)
    window.docks[name].bring_forward()
    panel = window.panel(name)
    qtbot.waitUntil(panel.isVisible)
    if view:
        qtbot.waitUntil(lambda: panel.view.strip.content is not None, timeout=60_000)
    elif name == "compare":
        cells = lambda: panel.maps.content.cells  # noqa: E731
        qtbot.waitUntil(
            lambda: bool(cells()) and all(cell.small for cell in cells()), timeout=60_000
        )
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=60_000)
    QApplication.processEvents()
    return panel


def picture_of(window, name):
    return drawn_image(window.pictures.picture_of(name).draw, 700, 700)


def test_colours_chosen_in_the_menu_are_those_of_every_map_of_levels(window, qtbot):
    for name in MAPS:
        window.do("use_magma_colours")
        panel = look_at(window, qtbot, name)
        for image in (panel.grab().toImage(), picture_of(window, name)):
            assert n_in(image, "magma") > MANY, name
            assert n_in(image, "viridis") < FEW, name
        window.do("use_viridis_colours")
        QApplication.processEvents()
        assert n_in(panel.grab().toImage(), "viridis") > MANY, name


def test_a_view_that_has_chosen_colours_itself_keeps_them():
    def in_colours(colours):
        return with_settings(View(), "skin", LevelStyle(colours=colours))

    assert level_style(with_colours_of(View(), in_colours("magma"))).colours == "magma"
    own = in_colours("cividis")
    assert with_colours_of(own, in_colours("magma")) is own
