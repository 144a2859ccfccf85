"""Colours of levels that were chosen for the skin map, on every map of levels."""

import numpy as np
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication

from skinsource.design.panel_settings import with_settings
from skinsource.design.view import View
from skinsource_gui.panels.compare.settings import CompareSettings
from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.plots.pictures import drawn_image
from skinsource_gui.plots.small_map import LevelStyle, level_style, with_colours_of
from tests.gui.analysis.analysis_bench import analysis

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
