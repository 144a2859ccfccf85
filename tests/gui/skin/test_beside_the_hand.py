"""The skin map in the studio: one ring on hand and skin, colours that stay between snapshots."""

from dataclasses import replace

import numpy as np
from PySide6.QtCore import QPoint, QPointF
from PySide6.QtTest import QTest

import skinsource as ss
from skinsource.design.edits.edit import Edit
from tests.gui.shared_window import rest

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


def test_colours_stay_while_snapshots_are_shown_in_turn(open_window):
    window = open_window(DESIGN)
    window.comparison.store("1")
    louder = replace(DESIGN, inputs=(replace(DESIGN.inputs[0], amplitude=10.0),))
    window.document.apply(Edit(label="Louder", design=louder, view=window.document.view))
    window.comparison.store("2")
    rest(window)
    ranges, loudest_db = set(), set()
    for _ in range(4):
        window.comparison.toggle()
        rest(window)
        content = window.panel("skin").map.content
        ranges.add(content.value_range)
        loudest_db.add(round(float(content.values.max())))
    assert len(loudest_db) == 2
    assert len(ranges) == 1
