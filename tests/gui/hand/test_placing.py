"""The hand panel, driven by real mouse and key events."""

from itertools import combinations

import pytest
from PySide6.QtCore import QPoint, QPointF

from skinsource.design.design import track
from tests.gui.hand.bench import CONTROL, KEY, SHIFT, short
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


@pytest.mark.parametrize("modifier", [SHIFT, CONTROL])
def test_shift_or_control_adds_a_site_to_the_selected_ones_or_takes_it_out(studio, modifier):
    studio.put(track(location=3), track(location=7), selected=0)
    studio.click(7, modifier)
    studio.click(9, modifier)
    assert studio.sites == [3, 7, 9]
    assert studio.view.selected_inputs == (1, 2, 3)
    assert [mark.chosen for mark in studio.diagram.state.marks] == [True] * 3
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


def test_the_menu_of_a_site_selects_mutes_solos_removes_and_adds(studio):
    studio.put(track(location=7), track(location=3), selected=0)
    studio.keys(KEY.Key_3)
    studio.menu(3, KEYBOARD)["Mute"].trigger()
    assert studio.view.selected_input == 2
    assert studio.diagram.state.marks[1].silent
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
    assert studio.diagram.state.moving == 1
    studio.drag_to(studio.diagram.site_centre(13))
    assert studio.sites == [7, 13]
    studio.release(studio.diagram.site_centre(13))
    assert studio.diagram.state.moving is None
    assert studio.view.selected_input == 2
    assert [label for label, _, _ in studio.edits] == [
        f"Move input to 16 ({short(16)})",
        f"Move input to 13 ({short(13)})",
    ]
    gestures = {gesture for _, _, gesture in studio.edits}
    assert len(gestures) == 1
    assert None not in gestures


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
    assert studio.diagram.state.ghost is None
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
    assert studio.diagram.state.moving is None


def test_a_shaky_click_is_no_drag(studio):
    studio.put(track(location=18), selected=0)
    point = studio.diagram.site_centre(18)
    studio.press(18)
    studio.drag_to(point + QPoint(2, 2))
    studio.release(point + QPoint(2, 2))
    assert studio.edits == []
