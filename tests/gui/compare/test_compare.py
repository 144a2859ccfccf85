"""Snapshots: keys, levels that match, and a map of the difference."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtTest import QTest

from skinsource.design.comparing import loudest_db
from skinsource_gui.state.engine import FIRST_SLOT
from tests.gui.compare.compare_bench import (
    ALT,
    CTRL,
    KEY,
    cards,
    edit,
    levels,
    show_matched,
    shown_levels,
    two_places,
)


def test_keys_store_and_toggle_and_arrangements_have_moved(window, qtbot, settle):
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    first = window.document.design
    QTest.keyClick(window, KEY.Key_1, CTRL)
    edit(window, 2.0)
    QTest.keyClick(window, KEY.Key_4, CTRL)
    settle()
    assert [snapshot.number for snapshot in window.document.view.snapshots] == [1, 4]
    QTest.keyClick(window, KEY.Key_X)
    assert window.document.design == first
    QTest.keyClick(window, KEY.Key_X)
    assert window.document.design.inputs[0].amplitude == 2.0
    assert window.docks["hand"].isVisible()
    QTest.keyClick(window, KEY.Key_2, ALT)
    assert not window.docks["hand"].isVisible()


def test_snapshots_are_shown_as_they_were_stored_unless_that_is_asked_for(window, settle):
    window.do("store_snapshot_1")
    two_places(window)
    window.do("store_snapshot_2")
    for _ in range(2):
        window.do("toggle_snapshots")
        settle()
        stored = levels(window.document.design)
        np.testing.assert_allclose(shown_levels(window), stored, rtol=0, atol=1e-9)


def test_snapshots_are_shown_as_loud_as_each_other(window, settle):
    window.do("match_levels")
    window.do("store_snapshot_1")
    two_places(window)
    window.do("store_snapshot_2")
    settle()
    assert loudest_db(levels(window.document.design)) > -5.0
    stored = window.document.view.snapshots
    window.do("toggle_snapshots")
    settle()
    assert window.document.design == stored[0].design
    window.do("toggle_snapshots")
    settle()
    assert len(window.document.design.inputs) == 2
    matched = loudest_db(shown_levels(window))
    assert matched == pytest.approx(loudest_db(levels(stored[0].design)), abs=1e-6)
    by_db = round(matched - loudest_db(levels(stored[1].design)), 1)
    message = f"Snapshot 2 is shown \N{MINUS SIGN}{-by_db:.1f} dB, matched. "
    assert window.statusBar().currentMessage().startswith(message)
    # To and fro changes nothing more.
    shown = window.document.design
    for _ in range(2):
        window.do("toggle_snapshots")
        settle()
    assert window.document.design == shown


def test_what_is_edited_is_matched_by_the_others_and_comes_back_as_it_was(window, settle):
    window.do("match_levels")
    window.do("store_snapshot_1")
    two_places(window)
    settle()
    edited = window.document.design
    window.do("toggle_snapshots")
    settle()
    assert len(window.document.design.inputs) == 1
    assert loudest_db(shown_levels(window)) == pytest.approx(loudest_db(levels(edited)), abs=1e-6)
    window.do("toggle_snapshots")
    settle()
    assert window.document.design == edited


def test_an_edit_while_levels_are_predicted_is_not_lost(window, settle):
    window.do("store_snapshot_1")
    edit(window, 2.0)
    window.do("toggle_snapshots")
    edit(window, 5.0)
    settle()
    assert window.document.design.inputs[0].amplitude == 5.0


@pytest.mark.parametrize("matched", [False, True])
def test_however_often_one_goes_to_and_fro_it_is_one_step_or_none_at_all(window, settle, matched):
    document, stack = window.document, window.document.undo_stack
    if document.view.levels_matched != matched:
        window.do("match_levels")
    window.do("store_snapshot_1")
    two_places(window)
    edited, chosen = document.design, document.view.selected_inputs
    settle()
    counts = []
    for _ in range(5):
        window.do("toggle_snapshots")
        settle()
        counts.append(stack.count())
    assert counts == [2, 1, 2, 1, 2]
    assert len(document.design.inputs) == 1
    window.do("undo")
    assert (document.design, document.view.selected_inputs) == (edited, chosen)
    window.do("redo")
    assert len(document.design.inputs) == 1
    # What is edited between is a step of its own, and so is what is shown after it.
    edit(window, 2.0)
    settle()
    window.do("toggle_snapshots")
    settle()
    assert stack.count() == 4
    for _ in range(3):
        window.do("undo")
    assert document.design == edited


def test_without_a_snapshot_one_is_told_how_to_store_one(window):
    assert not window.actions_by_name["toggle_snapshots"].isEnabled()
    window.comparison.toggle()
    assert "Ctrl+1 to Ctrl+4" in window.notice.text
    window.do("store_snapshot_2")
    window.comparison.toggle()
    assert "The design in the window is snapshot 2" in window.notice.text


def test_equal_snapshots_are_said_to_be_equal_and_their_map_is_zero(window, panel, settle):
    window.do("store_snapshot_1")
    window.do("store_snapshot_2")
    settle()
    assert panel.toggle.isEnabled()
    difference = panel.map.difference
    assert difference.heading == "Snapshot 2 and snapshot 1 are equal"
    assert difference.text.startswith("dB, the same inputs, scaling and limb")
    assert not difference.shown.levels_db.any()
    panel.toggle.click()
    settle()
    assert panel.map.difference.heading == "Snapshot 1 and snapshot 2 are equal"
    assert cards(panel)[1].present


def test_snapshots_that_differ_in_level_alone_are_equal_once_levels_match(window, panel, settle):
    window.do("match_levels")
    window.do("store_snapshot_1")
    edit(window, 2.0)
    window.do("store_snapshot_2")
    settle()
    for _ in range(3):
        panel.toggle.click()
        settle()
    difference = panel.map.difference
    assert difference.heading == "Snapshot 1 and snapshot 2 are equal"
    assert difference.text.startswith("dB, the same inputs once levels match")
    window.do("match_levels")
    settle()
    difference = panel.map.difference
    assert "minus" in difference.heading
    assert np.abs(difference.shown.levels_db).max() == pytest.approx(20 * np.log10(2), abs=1e-6)


def test_other_inputs_of_the_same_levels_are_equal_in_these(window, panel, settle):
    window.do("store_snapshot_1")
    window.document.edit("turn", window.document.design.with_input(0, amplitude=-1.0))
    settle()
    difference = panel.map.difference
    assert difference.heading == "Edited and snapshot 1 are equal"
    assert difference.text.startswith("dB, the same levels by other inputs")


def test_a_panel_that_comes_after_levels_were_predicted_waits_for_its_maps(window, settle):
    show_matched(window, settle)
    window.docks["compare"].bring_forward()
    settle()
    shown = cards(window.panel("compare"))
    assert all(shown[number]._map is not None for number in (1, 2))


def test_a_hidden_panel_costs_nothing(window, settle, requests):
    window.do("match_levels")
    window.do("store_snapshot_1")
    edit(window, 2.0)
    window.do("store_snapshot_2")
    edit(window, 3.0)
    settle()
    assert set(requests) == {FIRST_SLOT.name}
    window.do("toggle_snapshots")
    settle()
    assert {"snapshot 1"} < set(requests) | {FIRST_SLOT.name}
    edit(window, 4.0)
    settle()
    assert list(window.engine._graphs) == [FIRST_SLOT]


def test_a_snapshot_is_predicted_once_however_long_one_edits(window, panel, settle, requests):
    window.do("store_snapshot_1")
    for amplitude in (2.0, 3.0, 4.0):
        edit(window, amplitude)
        settle()
    assert requests.count("snapshot 1") <= 1
    assert requests.count("snapshot 0") == 0
    window.document.look(replace(window.document.view, outputs=(1, 2)))
    settle()
    assert requests.count("snapshot 1") <= 1
    window.document.look(replace(window.document.view, axes="z"))
    settle()
    assert requests.count("snapshot 1") <= 2


@pytest.mark.parametrize("matched", [True, False])
def test_what_is_said_after_going_to_and_fro_is_of_the_snapshot_that_is_shown_now(
    window, settle, matched
):
    window.do("store_snapshot_1")
    edit(window, 2.0)
    window.do("store_snapshot_2")
    if matched:
        window.do("match_levels")
    settle()
    window.do("toggle_snapshots")
    settle()
    # The one that others are matched to is shown as it is.
    assert window.statusBar().currentMessage() == "Snapshot 1 is shown; X shows snapshot 2"
    window.do("toggle_snapshots")
    settle()
    message = (
        "Snapshot 2 is shown \N{MINUS SIGN}"
        if matched
        else "Snapshot 2 is shown; X shows snapshot 1"
    )
    assert window.statusBar().currentMessage().startswith(message)
