"""Presenting: bars away, words over the window, a map that can be covered."""

from dataclasses import replace

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

import skinsource as ss
from skinsource.design.design_file import save_design
from skinsource_gui.qt.overlays import COVERED
from skinsource_gui.qt.theme import CONTRAST, current_theme


def title(window):
    return window.document.design.title


def bars(window):
    return window.menuBar(), window.statusBar(), window.setup_bar


def test_presenting_takes_the_bars_away_and_gives_them_back(make_window, design):
    window = make_window(design)
    shown = {name for name, dock in window.docks.items() if not dock.isHidden()}
    window.activateWindow()
    window.panel("traces").setFocus()
    focused = window.focusWidget()
    window.do("present")
    assert not any(bar.isVisible() for bar in bars(window))
    assert window.isFullScreen()
    assert window.panel("skin").isVisible()
    assert window.panel("hand").isVisible()
    assert not window.panel("inspector").isVisible()
    window.do("present")
    assert all(bar.isVisible() for bar in bars(window))
    assert not window.isFullScreen()
    assert {name for name, dock in window.docks.items() if not dock.isHidden()} == shown
    assert window.focusWidget() is focused


def test_keys_work_while_the_menus_are_away(studio, qtbot):
    studio.do("present")
    studio.activateWindow()
    skin = studio.panel("skin")
    skin.setFocus()
    QTest.keyClick(skin.map, Qt.Key.Key_PageDown)
    qtbot.waitUntil(lambda: title(studio) == "3 both")
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_PageUp)
    qtbot.waitUntil(lambda: title(studio) == "2 tone")
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_B)
    qtbot.waitUntil(lambda: skin.map.content.message == COVERED)
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_F9)
    qtbot.waitUntil(lambda: studio.menuBar().isVisible())
    # Out of presenting nothing stays covered, and the keys mean what they did.
    assert skin.map.content.message != COVERED
    QTest.keyClick(skin.map, Qt.Key.Key_PageDown)
    assert title(studio) == "2 tone"


def test_clickers_step_scenes_whatever_has_the_keyboard(studio, qtbot):
    studio.activateWindow()
    qtbot.waitUntil(studio.isActiveWindow)
    panel = studio.panel("traces")
    studio.do("present")
    studio.docks["traces"].bring_forward()
    at_s = studio.document.view.playhead_s
    panel.setFocus()
    for key, expected in (("PageUp", "1 tap"), ("PageDown", "2 tone"), ("PageDown", "3 both")):
        panel.setFocus()
        assert panel.isAncestorOf(studio.focusWidget())
        QTest.keyClick(studio.focusWidget(), getattr(Qt.Key, f"Key_{key}"))
        assert title(studio) == expected
    assert studio.document.view.playhead_s == at_s
    studio.do("present")
    studio.docks["traces"].bring_forward()
    panel.setFocus()
    # Back among the bars the keys are those of the plot.
    QTest.keyClick(studio.focusWidget(), Qt.Key.Key_PageUp)
    assert title(studio) == "3 both"


def test_the_hand_names_the_place_of_the_scene_that_is_shown(studio, folder, qtbot, design):
    other = replace(design, inputs=(ss.track(8, ss.waveforms.Tap()),), title="3 both")
    save_design(folder / "3 both.skinsource", other, ss.View())
    studio.activateWindow()
    studio.do("present")
    hand = studio.panel("hand").diagram
    hand.setFocus(Qt.FocusReason.OtherFocusReason)
    qtbot.waitUntil(lambda: hand.state.cursor == 7)
    QTest.keyClick(hand, Qt.Key.Key_PageDown)
    assert title(studio) == "3 both"
    qtbot.waitUntil(lambda: hand.state.cursor == 8)
    assert hand.cursor_site == 8
    # Nor where a head of a track was pointed at when its panel went.
    studio.panel("hand").show_pointed_input(1)
    assert hand.state.target == 8
    QTest.keyClick(hand, Qt.Key.Key_PageUp)
    assert title(studio) == "2 tone"
    qtbot.waitUntil(lambda: hand.state.target == 7)


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


def test_the_theme_of_high_contrast_is_one_of_three(window):
    window.do("use_contrast_theme")
    assert current_theme() == CONTRAST
    window.do("use_light_theme")
