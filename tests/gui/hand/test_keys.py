"""The hand panel, driven by real mouse and key events."""

import pytest
from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtGui import QKeyEvent, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QVBoxLayout, QWidget

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource_gui.panels.hand.panel import HandPanel
from tests.gui.hand.bench import KEY, NONE, SHIFT


def test_tab_reaches_the_diagram_and_shows_the_cursor_on_the_selected_input(qtbot):
    window = QWidget()
    qtbot.addWidget(window)
    field, panel = QLineEdit(), HandPanel()
    layout = QVBoxLayout(window)
    layout.addWidget(field)
    layout.addWidget(panel)
    panel.show_state(
        Design(limb="synthetic-1", inputs=(track(location=13),)), View(selected_inputs=(1,))
    )
    with qtbot.waitActive(window):
        window.show()
        window.activateWindow()
    field.setFocus()
    assert panel.diagram.state.cursor is None
    QTest.keyClick(field, KEY.Key_Tab)
    assert panel.diagram.hasFocus()
    assert panel.diagram.state.cursor == 13
    QTest.keyClick(panel.diagram, KEY.Key_Backtab)
    assert field.hasFocus()
    assert panel.diagram.state.cursor is None


def test_arrow_keys_reach_every_site_from_every_site(studio):
    hand = studio.diagram.stage.layout
    for start in range(1, 21):
        reached, waiting = {start}, [start]
        while waiting:
            site = waiting.pop()
            for way in ((1, 0), (-1, 0), (0, 1), (0, -1)):
                beside = hand.neighbour(site, way)
                if beside not in reached:
                    reached.add(beside)
                    waiting.append(beside)
        assert reached == set(range(1, 21)), f"from {start}"


@pytest.mark.parametrize(
    ("keys", "sites"),
    [
        ((KEY.Key_8, KEY.Key_Up, KEY.Key_Right, KEY.Key_Down), (8, 3, 2, 7)),
        ((KEY.Key_7, KEY.Key_Left, KEY.Key_Down, KEY.Key_Down), (7, 8, 13, 16)),
        ((KEY.Key_End, KEY.Key_Home), (20, 1)),
        ((KEY.Key_1, KEY.Key_7, KEY.Key_4), (1, 17, 4)),
    ],
)
def test_keys_go_where_they_point(studio, keys, sites):
    for key, site in zip(keys, sites, strict=True):
        studio.keys(key)
        assert studio.diagram.cursor_site == studio.diagram.state.cursor == site
    assert studio.edits == []


def test_a_number_is_typed_within_a_pause(studio):
    pause = studio.diagram.findChild(QTimer, "typing")
    assert pause.interval() == 800
    studio.keys(KEY.Key_1)
    pause.timeout.emit()
    studio.keys(KEY.Key_5)
    assert studio.diagram.cursor_site == 5


def test_the_cursor_follows_what_is_selected_elsewhere_unless_keys_are_used_here(studio, qtbot):
    first, second = track(location=7), track(location=13)
    studio.put(first, second, selected=0)
    assert studio.diagram.cursor_site == 7
    with qtbot.waitActive(studio.panel):
        studio.panel.activateWindow()
    studio.diagram.setFocus()
    assert studio.diagram.hasFocus()
    studio.keys(KEY.Key_8)
    studio.show(selected_inputs=(2,))
    assert studio.diagram.cursor_site == 8
    studio.diagram.clearFocus()
    studio.show(selected_inputs=(1,))
    assert studio.diagram.cursor_site == 7


@pytest.mark.parametrize("key", [KEY.Key_Return, KEY.Key_Enter, KEY.Key_Space])
def test_enter_and_space_place_and_then_select(studio, key):
    studio.put(track(location=7), selected=0)
    studio.keys(KEY.Key_1, KEY.Key_2, key)
    assert studio.sites == [7, 12]
    assert studio.view.selected_input == 2
    studio.keys(KEY.Key_7, key)
    assert studio.view.selected_input == 1
    assert studio.sites == [7, 12]


@pytest.mark.parametrize(
    ("key", "modifier"),
    [(KEY.Key_Insert, NONE), (KEY.Key_Plus, NONE), (KEY.Key_Plus, SHIFT), (KEY.Key_Return, SHIFT)],
)
def test_a_further_input_can_be_added_by_keyboard(studio, key, modifier):
    studio.put(track(location=7), selected=0)
    studio.keys(KEY.Key_7)
    studio.keys(key, modifier=modifier)
    assert studio.sites == [7, 7]


def test_shift_and_arrows_move_the_selected_input_in_one_gesture_per_hold(studio):
    studio.put(track(location=18), track(location=8), selected=1)
    QTest.keyPress(studio.diagram, KEY.Key_Shift)
    for _ in range(2):
        event = QKeyEvent(QEvent.Type.KeyPress, KEY.Key_Down, SHIFT)
        QApplication.sendEvent(studio.diagram, event)
    QTest.keyRelease(studio.diagram, KEY.Key_Shift)
    assert studio.sites == [18, 16]
    assert studio.diagram.cursor_site == 16
    studio.keys(KEY.Key_Up, modifier=SHIFT)
    assert studio.sites == [18, 13]
    first, second, third = (gesture for _, _, gesture in studio.edits)
    assert first == second != third


def test_space_is_left_to_the_window_until_keys_are_used_here(studio, qtbot):
    played = []
    shortcut = QShortcut(Qt.Key.Key_Space, studio.panel)
    shortcut.activated.connect(lambda: played.append(True))
    with qtbot.waitActive(studio.panel):
        studio.panel.activateWindow()
    studio.click(18)
    QTest.keyClick(studio.panel.windowHandle(), KEY.Key_Space)
    assert played == [True]
    studio.keys(KEY.Key_8)
    QTest.keyClick(studio.panel.windowHandle(), KEY.Key_Space)
    assert played == [True]
    assert studio.sites == [18, 8]


def test_an_input_that_is_not_on_this_hand_is_named_and_keys_bring_it_there_or_remove_it(studio):
    studio.put(track(location=7), selected=0)
    on_hand = studio.diagram.grab().toImage()
    studio.put(track(location=7), track(location=25), selected=1)
    assert studio.diagram.grab().toImage() != on_hand, "the caption names it"
    assert studio.diagram.stage.layout.has(studio.diagram.cursor_site)
    studio.keys(KEY.Key_3)
    studio.keys(KEY.Key_Right, modifier=SHIFT)
    assert studio.sites == [7, 3]
    studio.put(track(location=10_000), selected=0)
    studio.keys(KEY.Key_Delete)
    assert studio.sites == []
