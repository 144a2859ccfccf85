"""The hand panel, driven by real mouse and key events."""

from itertools import combinations

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt, QTimer
from PySide6.QtGui import QKeyEvent, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource import Clip, Input, track
from skinsource.design.waveforms import Tap
from tests.gui.hand.bench import CONTROL, KEY, LEFT, NONE, SHIFT, short
from tests.gui.menus import KEYBOARD


def test_each_site_is_hit_at_the_smallest_size_and_a_click_places_an_input_there(studio):
    points = [studio.diagram.site_centre(site) for site in range(1, 21)]
    for first, other in combinations(points, 2):
        offset = first - other
        assert offset.x() ** 2 + offset.y() ** 2 >= 22**2
    for site, point in enumerate(points, start=1):
        for off in (QPoint(0, 11), QPoint(0, -11), QPoint(11, 0), QPoint(-11, 0)):
            assert studio.diagram.stage.layout.site_at(QPointF(point + off)) == site
            assert studio.diagram.rect().contains(point + off)
        studio.put()
        studio.views.clear()
        studio.click(site)
        assert studio.sites == [site]
        assert studio.view.selected_input == 1
        assert studio.views == []
        assert studio.edits[-1][0].startswith(f"Place input at {site} (")


def test_repeated_clicks_cycle_through_the_inputs_of_a_site(studio):
    studio.put(track(location=7), track(location=3), track(location=3), track(location=3))
    selected = []
    for _ in range(5):
        studio.click(3)
        selected.append(studio.view.selected_input)
    assert selected == [4, 2, 3, 4, 2]
    assert studio.edits == []
    # It is the input that is meant then, and no clip.
    studio.show(selected_inputs=(1,), selected_clips=(1,))
    studio.click(7)
    assert studio.view.selected_clips == ()


@pytest.mark.parametrize("modifier", [SHIFT, CONTROL])
def test_shift_or_control_adds_a_site_to_the_selected_ones_or_takes_it_out(studio, modifier):
    studio.put(track(location=3), track(location=7), selected=0)
    studio.click(7, modifier)
    studio.click(9, modifier)
    assert studio.sites == [3, 7, 9]
    assert studio.view.selected_inputs == (1, 2, 3)
    assert [mark.chosen for mark in studio.diagram.stage.state.marks] == [True] * 3
    studio.click(7, modifier)
    assert studio.view.selected_inputs == (1, 3)
    studio.click(9, CONTROL | SHIFT)
    assert studio.sites == [3, 7, 9, 9]
    assert studio.view.selected_inputs == (4,)


def test_ctrl_a_selects_all_and_delete_removes_all_in_one_step(studio):
    studio.put(*(track(location=site) for site in (7, 8, 9)), selected=1)
    studio.keys(KEY.Key_A, modifier=CONTROL)
    assert studio.view.selected_inputs == (1, 3, 2)
    studio.keys(KEY.Key_Delete)
    assert studio.sites == []
    assert len(studio.edits) == 1


def test_delete_removes_the_selected_clips_and_only_without_any_the_inputs(studio):
    studio.put(Input(location=7, clips=(Clip(waveform=Tap()),) * 2), track(location=9))
    first, *others = (clip.id for clip in studio.design.clips)
    studio.show(selected_inputs=(1,), selected_clips=(first,))
    # A click beside the hand selects nothing else.
    QTest.mouseClick(studio.diagram, LEFT, NONE, QPoint(2, studio.diagram.height() - 2))
    studio.keys(KEY.Key_Delete)
    assert [clip.id for clip in studio.design.clips] == others
    assert studio.sites == [7, 9]
    # The menu of an input means the input, and so does Delete then.
    studio.show(selected_inputs=(1, 2), selected_clips=tuple(others))
    studio.menu(9)
    studio.keys(KEY.Key_Delete)
    assert studio.sites == [7]


def test_the_menu_of_a_site_selects_mutes_solos_removes_and_adds(studio):
    studio.put(track(location=7), track(location=3), selected=0)
    studio.keys(KEY.Key_3)
    studio.menu(3, KEYBOARD)["Mute"].trigger()
    assert studio.view.selected_input == 2
    assert studio.diagram.stage.state.marks[1].silent
    actions = studio.menu(3)
    assert actions["Mute"].isChecked()
    actions["Solo"].trigger()
    actions["Add input here"].trigger()
    assert studio.sites == [7, 3, 3]
    studio.click(7, CONTROL)
    actions = studio.menu(7)
    assert set(studio.view.selected_inputs) == {1, 3}
    actions["Mute 2 inputs"].trigger()
    assert [track.muted for track in studio.design.inputs] == [True, True, True]
    studio.menu(3)["Remove 2 inputs"].trigger()
    assert studio.sites == [3]
    # Elsewhere it only adds.
    actions = studio.menu(12)
    assert [text for text, action in actions.items() if action.isEnabled()] == ["Add input here"]


def test_a_drag_moves_the_input_live_in_one_gesture(studio):
    studio.put(track(location=7), track(location=18), selected=0)
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(16))
    assert studio.sites == [7, 16]
    assert studio.diagram.stage.state.moving == 1
    studio.drag_to(studio.diagram.site_centre(13))
    assert studio.sites == [7, 13]
    studio.release(studio.diagram.site_centre(13))
    assert studio.diagram.stage.state.moving is None
    assert studio.view.selected_input == 2
    assert [label for label, _, _ in studio.edits] == [
        f"Move input to 16 ({short(16)})",
        f"Move input to 13 ({short(13)})",
    ]
    (gesture,) = {gesture for _, _, gesture in studio.edits}
    assert gesture is not None


@pytest.mark.parametrize("end", ["escape", "away", "hidden"])
def test_a_drag_that_is_given_up_restores_the_design(studio, end):
    studio.put(track(location=18), selected=0)
    before, away = studio.design, QPoint(4, 300)
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    assert studio.design != before
    if end == "escape":
        studio.keys(KEY.Key_Escape)
        away = studio.diagram.site_centre(8)
    if end == "hidden":
        studio.panel.hide()
    else:
        studio.drag_to(away)
        studio.release(away)
    assert studio.design == before
    assert studio.diagram.stage.state.ghost is None
    assert len({gesture for _, _, gesture in studio.edits}) == 1


@pytest.mark.parametrize("tracks", [(), (track(location=3),)])
def test_a_drag_ends_when_its_input_is_taken_away_or_moved(studio, tracks):
    studio.put(track(location=18), selected=0)
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    studio.put(*tracks)
    edits = len(studio.edits)
    studio.drag_to(studio.diagram.site_centre(8))
    studio.release(studio.diagram.site_centre(8))
    assert len(studio.edits) == edits
    assert studio.diagram.stage.state.moving is None


def test_a_shaky_click_is_no_drag(studio):
    studio.put(track(location=18), selected=0)
    point = studio.diagram.site_centre(18)
    studio.press(18)
    studio.drag_to(point + QPoint(2, 2))
    studio.release(point + QPoint(2, 2))
    assert studio.edits == []


def test_the_cursor_is_on_the_selected_input_once_tab_reaches_the_diagram(studio, qtbot):
    studio.put(track(location=13), selected=0)
    with qtbot.waitActive(studio.panel):
        studio.panel.activateWindow()
    studio.diagram.clearFocus()
    assert studio.diagram.stage.state.cursor is None
    studio.diagram.setFocus(Qt.FocusReason.TabFocusReason)
    assert studio.diagram.stage.state.cursor == 13


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
        assert studio.diagram.site_cursor.site == studio.diagram.stage.state.cursor == site
    assert studio.edits == []


def test_a_number_is_typed_within_a_pause(studio):
    pause = studio.diagram.findChild(QTimer, "typing")
    assert pause.interval() == 800
    studio.keys(KEY.Key_1)
    pause.timeout.emit()
    studio.keys(KEY.Key_5)
    assert studio.diagram.site_cursor.site == 5


def test_the_cursor_follows_what_is_selected_elsewhere_unless_keys_are_used_here(studio, qtbot):
    first, second = track(location=7), track(location=13)
    studio.put(first, second, selected=0)
    assert studio.diagram.site_cursor.site == 7
    with qtbot.waitActive(studio.panel):
        studio.panel.activateWindow()
    studio.diagram.setFocus()
    studio.keys(KEY.Key_8)
    studio.show(selected_inputs=(2,))
    assert studio.diagram.site_cursor.site == 8
    studio.diagram.clearFocus()
    studio.show(selected_inputs=(1,))
    assert studio.diagram.site_cursor.site == 7


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
    assert studio.diagram.site_cursor.site == 16
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
    assert studio.diagram.stage.layout.has(studio.diagram.site_cursor.site)
    studio.keys(KEY.Key_3)
    studio.keys(KEY.Key_Right, modifier=SHIFT)
    assert studio.sites == [7, 3]
    studio.put(track(location=10_000), selected=0)
    studio.keys(KEY.Key_Delete)
    assert studio.sites == []
