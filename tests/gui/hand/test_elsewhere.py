"""Inputs at places that are not on the hand that is drawn."""

from PySide6.QtTest import QTest

from skinsource.design.design import track
from tests.gui.hand.bench import KEY, SHIFT


def test_an_input_that_is_not_on_this_hand_is_named_and_not_drawn(studio):
    studio.show(track(location=7), selected=0)
    on_hand = studio.diagram.grab().toImage()
    studio.show(track(location=7), track(location=25), selected=1)
    assert studio.diagram.state.selected == 1
    assert studio.diagram.grab().toImage() != on_hand, "the caption names it"
    assert studio.diagram.stage.layout.has(studio.diagram.cursor_site)


def test_keys_bring_it_to_the_hand_or_remove_it(studio):
    studio.show(track(location=10_000), selected=0)
    studio.diagram.setFocus()
    QTest.keyClick(studio.diagram, KEY.Key_7)
    QTest.keyClick(studio.diagram, KEY.Key_Right, SHIFT)
    assert studio.sites == [7]
    studio.show(track(location=10_000), selected=0)
    QTest.keyClick(studio.diagram, KEY.Key_Delete)
    assert studio.sites == []


def test_end_goes_to_the_last_site_that_is_drawn(studio):
    studio.diagram.setFocus()
    QTest.keyClick(studio.diagram, KEY.Key_End)
    assert studio.diagram.cursor_site == len(studio.diagram.stage.layout.centres)
    QTest.keyClick(studio.diagram, KEY.Key_Home)
    assert studio.diagram.cursor_site == 1
