"""The hand panel, driven by real mouse and key events."""

from itertools import combinations

import pytest
from PySide6.QtCore import QPoint, QPointF
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest

from skinsource.design.design import MAX_INPUTS, track
from skinsource.design.waveforms.pulses import Noise
from skinsource.design.waveforms.tones import Tone
from tests.gui.hand.bench import CONTROL, KEY, LEFT, NONE, SHIFT, short


@pytest.mark.parametrize("site", range(1, 21))
def test_a_click_on_an_empty_site_places_an_input_there_and_selects_it(studio, site):
    studio.click(site)
    assert studio.sites == [site]
    assert studio.view.selected_input == 1
    assert studio.order == ["design"]
    assert studio.edits[0][0].startswith(f"Place input at {site} (")


def test_sites_are_far_enough_apart_to_be_hit_at_the_smallest_size(studio):
    points = [studio.diagram.site_centre(site) for site in range(1, 21)]
    for first, other in combinations(points, 2):
        offset = first - other
        assert offset.x() ** 2 + offset.y() ** 2 >= 22**2
    for site, point in enumerate(points, start=1):
        for off in (QPoint(0, 11), QPoint(0, -11), QPoint(11, 0), QPoint(-11, 0)):
            assert studio.diagram.stage.layout.site_at(QPointF(point + off)) == site
            assert studio.diagram.rect().contains(point + off)


def test_a_click_beside_the_sites_does_nothing(studio):
    QTest.mouseClick(studio.diagram, LEFT, NONE, QPoint(2, 2))
    assert studio.edits == []


def test_a_new_input_copies_waveform_and_amplitude_of_the_selected_one(studio):
    first = track(location=7, waveform=Tone(frequency_hz=60.0))
    second = track(location=8, waveform=Noise(), amplitude=0.25, onset_s=0.5, muted=True)
    studio.show(first, second, selected=1)
    studio.click(18)
    new = studio.design.inputs[2]
    assert (new.clips[0].waveform, new.amplitude) == (Noise(seed=1), 0.25)
    assert (new.clips[0].onset_s, new.muted, new.colour) == (0.0, False, 2)


def test_a_new_input_is_plain_where_none_is_selected(studio):
    studio.show(track(location=8, waveform=Noise(), amplitude=0.25))
    studio.click(18)
    assert studio.design.inputs[1].clips[0].waveform == track(location=18).clips[0].waveform
    assert studio.design.inputs[1].amplitude == track(location=18).amplitude


def test_a_click_on_an_input_selects_it_and_edits_nothing(studio):
    studio.show(track(location=7), track(location=3), selected=0)
    studio.click(3)
    assert studio.view.selected_input == 2
    assert studio.edits == []


def test_repeated_clicks_cycle_through_the_inputs_of_a_site(studio):
    studio.show(track(location=7), track(location=3), track(location=3), track(location=3))
    selected = []
    for _ in range(5):
        studio.click(3)
        selected.append(studio.view.selected_input)
    assert selected == [4, 2, 3, 4, 2]
    assert studio.edits == []


def test_a_click_with_shift_and_control_adds_a_further_input(studio):
    studio.show(track(location=3), selected=0)
    studio.click(3, SHIFT | CONTROL)
    assert studio.sites == [3, 3]
    assert studio.view.selected_input == 2


@pytest.mark.parametrize("modifier", [SHIFT, CONTROL])
def test_a_click_with_shift_or_control_adds_to_the_selected_ones_or_takes_out(studio, modifier):
    studio.show(track(location=3), track(location=7), track(location=9), selected=0)
    studio.click(7, modifier)
    studio.click(9, modifier)
    assert studio.view.selected_inputs == (1, 2, 3)
    assert [mark.chosen for mark in studio.diagram.state.marks] == [True] * 3
    studio.click(7, modifier)
    assert studio.view.selected_inputs == (1, 3)
    assert studio.edits == []


@pytest.mark.parametrize("modifier", [SHIFT, CONTROL])
def test_on_an_empty_site_they_place_an_input_and_select_it_besides_the_others(studio, modifier):
    studio.click(3, modifier)
    assert studio.sites == [3]
    assert studio.view.selected_inputs == (1,)
    studio.click(8, modifier)
    assert studio.sites == [3, 8]
    assert studio.view.selected_inputs == (1, 2)
    studio.click(8, CONTROL | SHIFT)
    assert studio.view.selected_inputs == (3,)


def test_ctrl_a_selects_all_and_delete_removes_all_in_one_step(studio):
    studio.show(*(track(location=site) for site in (7, 8, 9)), selected=1)
    studio.keys(KEY.Key_A, modifier=CONTROL)
    assert studio.view.selected_inputs == (1, 3, 2)
    studio.keys(KEY.Key_Delete)
    assert studio.sites == []
    assert len(studio.edits) == 1


def test_a_full_design_says_so_and_takes_no_more(studio):
    studio.show(*[track(location=3)] * MAX_INPUTS)
    studio.click(7)
    assert studio.edits == []
    assert str(MAX_INPUTS) in studio.refusals[-1]


@pytest.mark.parametrize("key", [KEY.Key_Delete, KEY.Key_Backspace])
@pytest.mark.parametrize(
    ("selected", "left", "then"), [(0, [8, 9], 2), (1, [7, 9], 3), (2, [7, 8], 2)]
)
def test_delete_removes_the_selected_input_and_selects_a_neighbour(
    studio, key, selected, left, then
):
    studio.show(*(track(location=site) for site in (7, 8, 9)), selected=selected)
    studio.keys(key)
    assert studio.sites == left
    assert studio.view.selected_input == then
    assert len(studio.edits) == 1


@pytest.mark.parametrize(
    "reason", [QContextMenuEvent.Reason.Mouse, QContextMenuEvent.Reason.Keyboard]
)
def test_the_menu_of_a_site_selects_mutes_solos_removes_and_adds(studio, reason):
    studio.show(track(location=7), track(location=3), selected=0)
    studio.keys(KEY.Key_3)
    actions = studio.menu(3, reason)
    assert studio.view.selected_input == 2
    actions["Mute"].trigger()
    assert studio.design.inputs[1].muted
    assert studio.diagram.state.marks[1].silent
    studio.close_menu()
    actions = studio.menu(3, reason)
    assert actions["Mute"].isChecked()
    actions["Mute"].trigger()
    actions["Solo"].trigger()
    assert (studio.design.inputs[1].muted, studio.design.inputs[1].solo) == (False, True)
    assert studio.diagram.state.marks[0].silent
    actions["Add input here"].trigger()
    assert studio.sites == [7, 3, 3]
    studio.close_menu()
    studio.menu(3, reason)["Remove"].trigger()
    assert studio.sites == [7, 3]
    studio.close_menu()


def test_the_menu_of_an_empty_site_only_adds(studio):
    actions = studio.menu(12, QContextMenuEvent.Reason.Mouse)
    assert [text for text, action in actions.items() if action.isEnabled()] == ["Add input here"]
    actions["Add input here"].trigger()
    assert studio.sites == [12]
    studio.close_menu()


def test_the_menu_of_one_of_several_acts_on_all(studio):
    studio.show(*(track(location=site) for site in (7, 8, 9)), selected=0)
    studio.click(8, CONTROL)
    actions = studio.menu(7, QContextMenuEvent.Reason.Mouse)
    assert studio.view.selected_inputs == (1, 2)
    actions["Mute 2 inputs"].trigger()
    assert [track.muted for track in studio.design.inputs] == [True, True, False]
    studio.close_menu()
    assert studio.menu(8, QContextMenuEvent.Reason.Mouse)["Mute 2 inputs"].isChecked()
    studio.close_menu()
    # Elsewhere, it is about the one below it.
    studio.menu(9, QContextMenuEvent.Reason.Mouse)["Remove"].trigger()
    assert studio.sites == [7, 8]
    studio.close_menu()


def test_a_drag_moves_the_input_live_in_one_gesture(studio):
    studio.show(track(location=7), track(location=18), selected=0)
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


def test_escape_during_a_drag_restores_the_design(studio):
    studio.show(track(location=18), selected=0)
    before = studio.design
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    studio.keys(KEY.Key_Escape)
    assert studio.design == before
    studio.drag_to(studio.diagram.site_centre(8))
    studio.release(studio.diagram.site_centre(8))
    assert studio.design == before
    assert len({gesture for _, _, gesture in studio.edits}) == 1


def test_dropping_away_from_every_site_restores_the_design(studio):
    studio.show(track(location=18), selected=0)
    before = studio.design
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    assert studio.design != before
    studio.drag_to(QPoint(4, 300))
    studio.release(QPoint(4, 300))
    assert studio.design == before
    assert studio.diagram.state.ghost is None


def test_hiding_the_panel_during_a_drag_restores_the_design(studio):
    studio.show(track(location=18), selected=0)
    before = studio.design
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    studio.panel.hide()
    assert studio.design == before


def test_a_drag_ends_when_its_input_is_taken_away(studio):
    studio.show(track(location=18), selected=0)
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    studio.show()
    edits = len(studio.edits)
    studio.drag_to(studio.diagram.site_centre(8))
    studio.release(studio.diagram.site_centre(8))
    assert len(studio.edits) == edits
    assert studio.diagram.state.moving is None


def test_a_shaky_click_is_no_drag(studio):
    studio.show(track(location=18), selected=0)
    point = studio.diagram.site_centre(18)
    studio.press(18)
    studio.drag_to(point + QPoint(2, 2))
    studio.release(point + QPoint(2, 2))
    assert studio.edits == []
