"""Presenting: bars away, words over the window, a map that can be covered."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.panels.skin.painting import marks_at
from skinsource_gui.qt.overlays import COVERED, Cover
from tests.gui.analysis.analysis_bench import analysis


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


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


def test_inputs_are_marked_on_the_map_where_they_are_behind(open_window, design):
    window = open_window(design)
    skin = window.panel("skin")
    content, layout = skin.map.content, skin.map.stage.layout
    assert [mark.location for mark in content.inputs] == [7, 13]
    place = layout.frame.to_screen(content.limb_map.input_positions[[12]])[0]
    [mark_at_place] = marks_at(content.inputs, content.limb_map, layout, QPointF(*place))
    assert mark_at_place.location == 13
    assert marks_at(content.inputs, content.limb_map, layout, QPointF(1.0, 1.0)) == ()


def test_hand_and_map_point_at_the_same_input(open_window, design):
    window = open_window(design)
    hand, skin = window.panel("hand"), window.panel("skin")
    first, second = window.document.design.ids
    hand.diagram.stage.change(hovered=13)
    assert skin.map.content.pointed_at == second
    hand.diagram.stage.change(hovered=20)
    assert skin.map.content.pointed_at is None
    content, layout = skin.map.content, skin.map.stage.layout
    [x, y] = layout.frame.to_screen(content.limb_map.input_positions[[6]])[0]
    QTest.mouseMove(skin.map, QPointF(float(x), float(y)).toPoint())
    assert hand.diagram.state.target == 7
    skin.map.inputs_chosen.emit((second,))
    assert window.document.view.selected_inputs == (second,)
    assert first in window.document.design.ids


MAPS = {
    "analysis": ("window_strip",),
    "compare": ("compared_maps", "compare_words"),
}


@pytest.fixture
def plain_studio(open_window, design):
    return open_window(design)


def parts(panel):
    return {part.objectName(): part for part in panel.guessed}


def colours(part):
    image = part.grab().toImage()
    steps = range(0, image.height(), 3), range(0, image.width(), 3)
    return {image.pixelColor(x, y).name() for y in steps[0] for x in steps[1]}


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


def test_nothing_is_seen_through_a_cover_however_large_it_gets(plain_studio, qtbot):
    analysis(plain_studio, "windowed")
    wait(plain_studio, qtbot)
    strip = plain_studio.panel("analysis").view.strip
    qtbot.waitUntil(lambda: strip.content is not None, timeout=30_000)
    assert len(colours(strip)) > 50
    plain_studio.do("cover_map")
    strip.resize(strip.width() + 60, strip.height() + 40)
    # Words alone, in greys between two colours.
    ground = strip.palette().window().color()
    assert all(QColor(colour).hsvSaturation() < 80 for colour in colours(strip))
    assert ground.name() in colours(strip)


def test_a_panel_that_is_first_seen_while_maps_are_covered_is_covered(plain_studio, qtbot):
    assert "analysis" not in plain_studio.panels
    plain_studio.do("cover_map")
    panel = analysis(plain_studio, "windowed")
    wait(plain_studio, qtbot)
    assert panel.strip.findChildren(Cover)
    plain_studio.do("cover_map")
    assert not any(cover.isVisible() for cover in panel.findChildren(Cover))


def test_nothing_stays_covered_once_presenting_ends(plain_studio, qtbot):
    analysis(plain_studio, "windowed")
    wait(plain_studio, qtbot)
    plain_studio.do("present")
    plain_studio.do("cover_map")
    plain_studio.do("present")
    covers = plain_studio.panel("analysis").view.findChildren(Cover)
    assert not any(cover.isVisible() for cover in covers)


@pytest.fixture
def presented(open_window, design, qtbot):
    window = open_window(design)
    window.document.look(replace(window.document.view, outputs=(29, 30)))
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    window.do("present")
    return window


@pytest.fixture
def played(presented):
    """How often playing was asked for."""
    asked = []
    action = presented.actions_by_name["play"]
    action.triggered.disconnect()
    action.triggered.connect(lambda: asked.append(True))
    return asked


def turn_list(window):
    return window.panel("frequency_and_amplitude").findChild(ChoiceField, "control_field")


def press(window, key):
    QTest.keyClick(window.focusWidget() or window, key)


def test_space_plays_where_the_keyboard_came_to_a_list_by_chance(presented, played):
    field = turn_list(presented)
    field.setFocus(Qt.FocusReason.OtherFocusReason)
    assert presented.focusWidget() is field
    press(presented, Qt.Key.Key_Space)
    assert played == [True]
    assert QApplication.activePopupWidget() is None
    # Out of presenting, Space on a list opens it.
    presented.do("present")
    presented.docks["frequency_and_amplitude"].bring_forward()
    field.setFocus(Qt.FocusReason.TabFocusReason)
    press(presented, Qt.Key.Key_Space)
    assert played == [True]
    field.hidePopup()


def test_escape_leaves_and_the_outputs_stay_selected(presented):
    presented.panel("skin").map.setFocus()
    press(presented, Qt.Key.Key_Escape)
    assert not presented.presenter.presenting
    assert presented.document.view.outputs == (29, 30)
    # Back among the bars the key is that of the map.
    presented.panel("skin").map.setFocus()
    press(presented, Qt.Key.Key_Escape)
    assert presented.document.view.outputs == ()


@pytest.mark.parametrize("name", ["hand", "traces", "frequency_and_amplitude"])
def test_escape_leaves_from_any_panel(presented, name):
    presented.docks[name].bring_forward()
    presented.panel(name).setFocus()
    press(presented, Qt.Key.Key_Escape)
    assert not presented.presenter.presenting


def test_escape_gives_up_what_is_typed_first(presented):
    number = presented.panel("frequency_and_amplitude")._amplitude.field
    number.setFocus()
    press(presented, Qt.Key.Key_5)
    assert number.editing
    press(presented, Qt.Key.Key_Escape)
    assert not number.editing
    assert presented.presenter.presenting
    press(presented, Qt.Key.Key_Escape)
    assert not presented.presenter.presenting


def test_escape_gives_up_what_is_dragged_first(presented):
    skin = presented.panel("skin").map
    skin.setFocus()
    at = skin.rect().center()
    QTest.mousePress(skin, Qt.MouseButton.LeftButton, pos=at)
    QTest.mouseMove(skin, at + at / 8)
    press(presented, Qt.Key.Key_Escape)
    QTest.mouseRelease(skin, Qt.MouseButton.LeftButton, pos=at + at / 8)
    assert presented.presenter.presenting
    assert presented.document.view.outputs == (29, 30)
