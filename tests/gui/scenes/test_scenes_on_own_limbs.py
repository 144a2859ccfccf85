"""The gallery where a lab has imported a limb: on which limb a scene opens, and why not."""

import pytest
from PySide6.QtWidgets import QDialogButtonBox

import skinsource as ss
from tests.core.own_limbs.lab_bench import installed

OPEN = QDialogButtonBox.StandardButton.Open


@pytest.fixture
def lab_window(user_data, open_window):
    installed()
    return open_window(ss.Design(limb="synthetic-1"))


def selected(page, name):
    page.list.setCurrentRow(ss.scenes.names().index(name))


def test_a_scene_is_opened_on_a_limb_of_ones_own(lab_window, qtbot):
    window, messages = lab_window, []
    window.scenes.done.connect(messages.append)
    page = window.scenes.show()
    assert page.played_on.shown_text == "The limbs of the paper"
    page.played_on.choose("lab-1")
    selected(page, "2F")
    assert "Opens on Lab 1." in page.text.text()
    assert "played at its places 1 in place of 8, 2 in place of 13" in page.text.text()
    page.buttons.button(OPEN).click()
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    window.catch_up()
    opened = ss.scenes.open_scene("2F", limb="lab-1")
    assert window.document.design == opened.design
    assert window.document.view == opened.view
    assert not window.document.modified
    assert window.notice.text == ""
    assert messages[-1] == "Opened 2F · Two inputs interfere, on Lab 1"
    again = window.scenes.show()
    assert (again.played_on.value, again.scene.name) == ("lab-1", "2F")
    again.reject()


def test_a_scene_that_does_not_apply_says_why_and_is_not_opened(lab_window):
    before = lab_window.document.design
    page = lab_window.scenes.show()
    page.played_on.choose("lab-1")
    selected(page, "1G")
    assert "Does not apply on Lab 1: It compares 4 people" in page.text.text()
    assert not page.buttons.button(OPEN).isEnabled()
    page._choose()
    assert lab_window.document.design is before
    rows = {name: page.list.item(row) for row, name in enumerate(ss.scenes.names())}
    assert rows["1G"].foreground().color() != rows["1F"].foreground().color()
    assert "It compares 4 people" in rows["1G"].toolTip()
    page.played_on.choose("")
    assert page.buttons.button(OPEN).isEnabled()
    assert "Opens on Synthetic 1" in page.text.text()
    page.reject()
