"""A design of a limb whose file is gone, in the whole window."""

import pytest
from PySide6.QtCore import QEvent, QPoint
from PySide6.QtWidgets import QApplication, QLabel

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.limbs.own_limbs import facts_of, remove_limb
from skinsource_gui.fields.choice_field import ChoiceField
from tests.core.own_limbs.lab_bench import installed

GONE = Design(limb="lab-9", inputs=(track(6),))


def rested(window, qtbot):
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    window.catch_up()


@pytest.fixture
def gone(user_data, window, qtbot):
    """A window that showed a limb, and now a design of one that is missing."""
    rested(window, qtbot)
    assert window.panel("skin").map.content.limb_map is not None
    window.document.start_over(GONE, View(outputs=(3,)), None)
    rested(window, qtbot)
    return window


def test_nothing_of_another_limb_is_shown_and_the_window_says_what_is_missing(gone):
    hand = gone.panel("hand")
    assert not hand.diagram.isVisibleTo(hand)
    assert hand.findChild(QLabel, "hand_missing").text() == "The limb 'lab-9' is missing"
    assert hand.drop_place(QPoint(50, 50)) is None
    assert "Place 6" in gone.panel("inspector").findChild(QLabel, "inspector_heading").toolTip()
    content = gone.panel("skin").map.content
    assert (content.limb_map, content.limb) == (None, "lab-9")
    assert "lab-9" in content.message
    assert not gone.panel("skin").grab().isNull()
    limb = gone.setup_bar.findChild(ChoiceField, "limb")
    assert limb.shown_text == "lab-9 (not available)"
    assert "not here" in limb.toolTip()


def test_a_new_design_on_a_limb_whose_file_has_come_back_tells_its_name(user_data, window, qtbot):
    installed()
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))
    design = Design(limb="lab-1", limb_digest=facts_of("lab-1").digest, inputs=(track(6),))
    window.document.start_over(design, View(axes="xz", outputs=(3,)), None)
    rested(window, qtbot)
    box = window.setup_bar.findChild(ChoiceField, "limb")
    there = box.shown_text
    remove_limb("lab-1")
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))
    rested(window, qtbot)
    assert box.shown_text == "lab-1 (not available)"
    # Nobody left the window in between.
    installed()
    window.files.new()
    rested(window, qtbot)
    assert window.document.design.limb == "lab-1"
    assert box.shown_text == there
