"""Presenting: bars away, words over the window, a map that can be covered."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from skinsource_gui.qt.overlays import COVERED, Cover
from tests.gui.analysis.analysis_bench import analysis


def title(window):
    return window.document.design.title


def bars(window):
    return window.menuBar(), window.statusBar(), window.setup_bar


def test_presenting_takes_the_bars_away_and_gives_them_back(open_window, design):
    window = open_window(design)
    shown = {name for name, dock in window.docks.items() if not dock.isHidden()}
    window.activateWindow()
    window.panel("traces").setFocus()
    focused = window.focusWidget()
    window.do("present")
    assert not any(bar.isVisible() for bar in bars(window))
    assert window.isFullScreen()
    assert {panel.name for panel in window.panels if panel.isVisible()} == {"stage"}
    window.do("present")
    assert all(bar.isVisible() for bar in bars(window))
    assert not window.isFullScreen()
    assert {name for name, dock in window.docks.items() if not dock.isHidden()} == shown
    assert window.focusWidget() is focused


def test_keys_work_while_the_menus_are_away(studio, qtbot):
    studio.do("present")
    studio.activateWindow()
    stage = studio.panel("stage")
    dial = stage.knob.dial
    assert studio.focusWidget() is dial
    QTest.keyClick(dial, Qt.Key.Key_PageDown)
    qtbot.waitUntil(lambda: title(studio) == "3 both")
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_PageUp)
    qtbot.waitUntil(lambda: title(studio) == "2 tone")
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_B)
    assert stage.findChildren(Cover)
    QTest.keyClick(dial, Qt.Key.Key_Space)
    assert stage.clock.held
    QTest.keyClick(dial, Qt.Key.Key_L)
    assert not stage.moves
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_F9)
    qtbot.waitUntil(lambda: studio.menuBar().isVisible())
    # Out of presenting nothing stays covered, and the keys mean what they did.
    assert not any(cover.isVisible() for cover in stage.findChildren(Cover))
    QTest.keyClick(dial, Qt.Key.Key_PageDown)
    assert title(studio) == "2 tone"


def test_what_is_turned_in_front_of_people_is_taken_back_and_can_be_redone(open_window, design):
    window = open_window(design)
    window.document.mark_saved(None)
    window.do("present")
    window.panel("stage").knob.dial.setValue(0)
    turned = window.document.design
    assert turned.clips[0].waveform.frequency_hz == 25.0
    window.do("present")
    assert window.document.design == design
    assert not window.document.modified
    window.do("redo")
    assert window.document.design == turned


def test_what_was_saved_in_front_of_people_stays(studio):
    studio.do("present")
    studio.panel("stage").knob.dial.setValue(0)
    studio.do("save_design")
    saved = studio.document.design
    studio.panel("stage").knob.dial.setValue(500)
    studio.do("present")
    assert studio.document.design == saved
    assert not studio.document.modified


def test_a_covered_map_shows_nothing_that_was_computed(window, settle):
    skin = window.panel("skin")
    window.do("cover_map")
    content = skin.map.content
    assert content.coloured_values is None
    assert content.shown_field is None
    assert skin.map.readout() == ""
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=2.0))
    settle()
    assert skin.map.content.message == COVERED
    window.do("cover_map")
    assert skin.map.content.coloured_values is not None


def test_while_the_bars_are_away_words_lie_over_the_window(studio):
    studio.do("present")
    assert "F9 or Esc: leave" in studio.notice.text
    studio.do("next_scene")
    assert studio.notice.text == "Scene 3 of 3: 3 both"
    studio.do("next_scene")
    assert studio.notice.text == "This is the last scene"
    studio.do("present")
    studio.do("previous_scene")
    assert studio.statusBar().currentMessage() == "Scene 2 of 3: 2 tone"
    assert not studio.notice.text


MAPS = {
    "analysis": ("window_strip",),
    "compare": ("compared_maps", "compare_words"),
}


@pytest.fixture
def plain_studio(open_window, design):
    return open_window(design)


def parts(panel):
    return {part.objectName(): part for part in panel.guessed}


def wait(plain_studio, qtbot):
    qtbot.waitUntil(lambda: not plain_studio.engine.busy, timeout=30_000)


@pytest.mark.parametrize("name", MAPS)
def test_all_that_draws_maps_is_covered_together_and_revealed(plain_studio, qtbot, name):
    plain_studio.docks[name].bring_forward()
    panel = plain_studio.panel(name)
    if name == "analysis":
        panel = analysis(plain_studio, "windowed")
    wait(plain_studio, qtbot)
    assert set(MAPS[name]) <= parts(panel).keys()
    assert not panel.findChildren(Cover)
    plain_studio.do("cover_map")
    assert plain_studio.panel("skin").map.content.message == COVERED
    for part in panel.guessed:
        (cover,) = part.findChildren(Cover)
        assert cover.geometry() == part.rect()
    plain_studio.do("cover_map")
    assert plain_studio.panel("skin").map.content.message != COVERED
    assert not any(cover.isVisible() for cover in panel.findChildren(Cover))


def test_escape_gives_up_what_is_typed_and_then_leaves(studio):
    studio.do("present")
    studio.activateWindow()
    number = studio.panel("stage").knob.field
    number.setFocus()
    for key in (Qt.Key.Key_5, Qt.Key.Key_Escape):
        QTest.keyClick(number, key)
    assert not number.editing
    assert studio.presenter.presenting
    QTest.keyClick(number, Qt.Key.Key_Escape)
    assert not studio.presenter.presenting
