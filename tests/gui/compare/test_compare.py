"""Snapshots: keys, levels that match, and a map of the difference."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFontMetricsF
from PySide6.QtTest import QTest

from skinsource.design import edits
from skinsource.design.comparing import loudest_db
from skinsource.design.design_file import open_design
from skinsource_gui.plots.small_map import number_areas, small_frame
from skinsource_gui.state.engine import FIRST_SLOT
from tests.gui.compare.compare_bench import (
    ALT,
    CTRL,
    KEY,
    cards,
    edit,
    levels,
    shown_levels,
    two_places,
)


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


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


OUTPUTS = (19, 21, 24, 32)


@pytest.fixture
def compared(window, panel, settle):
    window.do("store_snapshot_1")
    two_places(window)
    window.document.look(replace(window.document.view, outputs=OUTPUTS))
    settle()
    return panel.map


@pytest.mark.parametrize("size", [(240, 90), (180, 200), (400, 600)])
def test_numbers_stand_beside_their_rings_and_on_nothing_else(compared, size):
    small, area = compared.difference.shown, QRectF(0, 0, *size)
    metrics = QFontMetricsF(compared.font())
    places = number_areas(small, area, OUTPUTS, metrics)
    assert {number for number, _ in places} == set(OUTPUTS)
    points = small_frame(small.limb_map, area).to_screen(small.limb_map.output_positions)
    for number, place in places:
        x, y = points[number - 1]
        assert abs(place.center().x() - x) + abs(place.center().y() - y) < 6 * metrics.height()
        others = [other_place for other, other_place in places if other != number]
        assert not any(place.intersects(other_place) for other_place in others)


def test_storing_is_no_step_and_is_saved_with_the_file(window, settle, tmp_path):
    window.files._save_to(tmp_path / "a.skinsource")
    titles = []
    window.document.title_changed.connect(lambda: titles.append(window.document.modified))
    edit(window, 2.0)
    window.do("store_snapshot_1")
    assert (window.document.modified, titles) == (True, [True])
    assert window.document.undo_stack.count() == 1
    window.do("undo")
    # What is in no file yet would be lost.
    assert (window.document.modified, titles) == (True, [True])
    assert not window.document.undo_stack.canUndo()
    window.do("redo")
    window.document.undo_stack.clear()
    assert not window.document.undo_stack.canUndo()
    window.files.save()
    assert (window.document.modified, titles[-1]) == (False, False)
    assert open_design(tmp_path / "a.skinsource").view.snapshots[0].design == window.document.design


def test_a_snapshot_of_what_was_saved_is_nothing_that_could_be_lost(window, tmp_path):
    document = window.document
    window.files._save_to(tmp_path / "a.skinsource")
    window.do("store_snapshot_1")
    assert not document.modified
    edit(window, 2.0)
    assert document.modified
    window.do("undo")
    assert not document.modified
    window.files.save()
    window.document.apply(edits.forget_snapshot(document.design, document.view, 1))
    assert document.modified


def test_what_is_undone_later_takes_no_snapshot_away(window):
    document = window.document
    edit(window, 2.0)
    window.do("store_snapshot_1")
    window.do("undo")
    assert [snapshot.number for snapshot in document.view.snapshots] == [1]
    assert document.view.snapshots[0].design.inputs[0].amplitude == 2.0
    window.do("redo")
    assert len(document.view.snapshots) == 1
    assert document.undo_stack.count() == 1


def test_a_snapshot_that_another_replaces_comes_back_with_undo_and_later_ones_stay(window):
    document = window.document
    window.do("store_snapshot_1")
    first = document.view.snapshots
    edit(window, 2.0)
    window.do("store_snapshot_1")
    assert document.undo_stack.count() == 2
    assert "Undo brings back" in window.notice.text or "Undo brings back" in (
        window.statusBar().currentMessage()
    )
    window.do("store_snapshot_3")
    window.do("undo")
    assert document.view.snapshots[0] == first[0]
    assert [snapshot.number for snapshot in document.view.snapshots] == [1, 3]
    window.do("redo")
    assert document.view.snapshots[0].design.inputs[0].amplitude == 2.0
    assert {snapshot.number for snapshot in document.view.snapshots} == {1, 3}
