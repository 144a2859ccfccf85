"""Hand and skin side by side: the palm seen through the hand, and one ring on both."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF
from PySide6.QtTest import QTest

import skinsource as ss
from skinsource.limbs.catalog import load_limb
from skinsource_gui.panels.hand.settings import HandSettings
from skinsource_gui.qt.theme import current_theme
from tests.gui.hand.bench import LEFT


def mirror(studio):
    QTest.mouseClick(studio.panel.mirror, LEFT)


def test_a_switch_shows_the_palm_through_the_hand_and_is_stored_in_the_view(studio):
    layout = studio.diagram.stage.layout
    thumb, fifth = layout.centre(6).x(), layout.centre(10).x()
    mirror(studio)
    assert studio.view.panels == (("hand", (("mirrored", True),)),)
    layout = studio.diagram.stage.layout
    assert (layout.centre(6).x() < layout.centre(10).x()) != (thumb < fifth)
    assert "through" in studio.diagram.stage.drawing.side
    studio.click(7)
    assert studio.sites == [7]
    mirror(studio)
    assert studio.diagram.stage.layout.centre(6).x() == pytest.approx(thumb)
    assert HandSettings() == HandSettings(mirrored=False)


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("limb", ["synthetic-1", "synthetic-3"])
def test_a_place_under_the_pointer_is_marked_on_hand_and_skin(studio, limb, mirrored):
    if mirrored:
        mirror(studio)
    studio.show(type(studio.design)(limb=limb))
    limb_data, told = load_limb(limb), []
    studio.panel.place_pointed_at.connect(told.append)
    QTest.mouseMove(studio.diagram, studio.diagram.site_centre(13))
    # Nothing is known of the map yet.
    assert told == [None]
    studio.panel.show_results({"limb_data": limb_data})
    for site in (16, 3, 20):
        QTest.mouseMove(studio.diagram, studio.diagram.site_centre(site))
        assert told[-1] == pytest.approx(tuple(limb_data.map.input_positions[site - 1]), abs=1e-6)
        assert studio.diagram.state.ring is None
    for site in (8, 16, 20):
        studio.panel.show_pointed_place(tuple(limb_data.map.input_positions[site - 1]))
        drawing, ring = studio.diagram.stage.drawing, studio.diagram.state.ring
        assert np.allclose(ring, drawing.sites[site - 1], atol=1e-6)
    QTest.mouseMove(studio.diagram, QPoint(2, studio.diagram.height() - 2))
    assert told[-1] is None
    assert studio.diagram.state.ring is None


def test_between_places_the_ring_is_where_the_pointer_is(studio):
    limb_data, told = load_limb("synthetic-1"), []
    studio.panel.show_results({"limb_data": limb_data})
    studio.panel.place_pointed_at.connect(told.append)
    layout = studio.diagram.stage.layout
    between = (layout.centre(18) + layout.centre(20)) / 2.0
    QTest.mouseMove(studio.diagram, between.toPoint())
    at = QPointF(*studio.diagram.state.ring)
    assert (layout.transform.map(at) - between).manhattanLength() < 2.0
    positions = limb_data.map.input_positions
    assert told[-1] == pytest.approx(tuple((positions[17] + positions[19]) / 2.0), abs=12.0)


def colours_around(studio, site):
    at, picture = studio.diagram.site_centre(site), studio.diagram.grab().toImage()
    reach = range(-16, 17)
    return {picture.pixelColor(at.x() + x, at.y() + y).name() for x in reach for y in reach}


def test_pointed_at_and_selected_look_different(studio):
    studio.click(7)
    accent = current_theme().accent.lower()
    QTest.mouseMove(studio.diagram, studio.diagram.site_centre(16))
    assert accent in colours_around(studio, 7)
    assert accent not in colours_around(studio, 16)


DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tone()),))


def test_the_place_under_the_pointer_is_marked_on_the_other_drawing_and_read(open_window):
    window = open_window(DESIGN)
    skin, hand = window.panel("skin"), window.panel("hand").diagram
    positions = skin.map.content.limb_map.input_positions
    [palm] = skin.map.stage.layout.frame.to_screen(positions[15:16])
    QTest.mouseMove(skin.map, QPointF(*palm).toPoint())
    ring = hand.stage.layout.transform.map(QPointF(*hand.state.ring))
    assert (ring - hand.stage.layout.centre(16)).manhattanLength() < 3.0
    QTest.mouseMove(skin.map, QPoint(2, skin.map.height() // 2))
    assert hand.state.ring is None
    QTest.mouseMove(hand, hand.site_centre(16))
    assert np.allclose(skin.map.ring, positions[15])
    assert skin.readout.toolTip().startswith("−")
    assert "dB re 1 m/s²" in skin.readout.toolTip()
    QTest.mouseMove(hand, QPoint(2, hand.height() - 2))
    assert skin.map.ring is None
    assert "selected" in skin.readout.toolTip()
