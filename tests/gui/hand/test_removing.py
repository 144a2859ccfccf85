"""The hand panel, driven by real mouse and key events."""

import pytest
from PySide6.QtGui import QContextMenuEvent

from skinsource.design.design import track
from tests.gui.hand.bench import CONTROL, KEY

# Removing, muting


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


def test_removing_the_last_input_selects_none(studio):
    studio.show(track(location=7), selected=0)
    studio.keys(KEY.Key_Delete)
    assert studio.sites == []
    assert studio.view.selected_input is None


def test_the_selection_names_an_existing_input_at_every_moment(studio):
    def check(*_):
        assert set(studio.view.selected_inputs) <= set(studio.design.ids)

    studio.panel.edited.connect(check)
    studio.panel.view_changed.connect(check)
    studio.show(track(location=7), track(location=8), selected=1)
    studio.keys(KEY.Key_Delete, KEY.Key_Delete)
    assert studio.order == ["design", "design"]


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
