"""Snapshots: keys, levels that match, and a map of the difference."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

import skinsource as ss
from skinsource.comparing import loudest_db
from skinsource.design import track
from skinsource.design_file import open_design
from skinsource.waveforms import Tone
from skinsource_gui.state.engine import FIRST_SLOT
from skinsource_gui.widgets.map.small_map import small_frame

KEY, CTRL, ALT = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier


def edit(window, amplitude):
    window.document.edit("a", window.document.design.with_input(0, amplitude=amplitude))


def levels(design):
    return ss.evaluate(design, "output_levels_db")["output_levels_db"]


def two_places(window):
    """Another place as well, louder than what there was."""
    design = window.document.design.adding(track(location=18, amplitude=3.0))
    window.document.edit("Place", design)


@pytest.fixture
def panel(window, settle):
    window.docks["compare"].bring_forward()
    settle()
    return window.panel("compare")


@pytest.fixture
def requests(window, monkeypatch):
    """Slots of what is asked of the engine from now on."""
    asked = []
    ask = window.engine.request
    monkeypatch.setattr(
        window.engine, "request", lambda one: (asked.append(one.slot.name), ask(one))
    )
    return asked


def cards(panel):
    return {card.number: card for card in panel.cards if not card.isHidden()}


def test_keys_store_and_toggle_and_arrangements_have_moved(window, qtbot, settle):
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    first = window.document.design
    QTest.keyClick(window, KEY.Key_1, CTRL)
    edit(window, 2.0)
    QTest.keyClick(window, KEY.Key_4, CTRL)
    settle()
    assert [one.number for one in window.document.view.snapshots] == [1, 4]
    window.do("match_levels")
    QTest.keyClick(window, KEY.Key_X)
    assert window.document.design == first
    QTest.keyClick(window, KEY.Key_X)
    assert window.document.design.inputs[0].amplitude == 2.0
    assert window.docks["hand"].isVisible()
    QTest.keyClick(window, KEY.Key_2, ALT)
    assert not window.docks["hand"].isVisible()


def test_snapshots_are_shown_as_loud_as_each_other(window, settle):
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
    matched = loudest_db(levels(window.document.design))
    assert matched == pytest.approx(loudest_db(levels(stored[0].design)), abs=1e-6)
    # To and fro changes nothing more.
    shown = window.document.design
    for _ in range(2):
        window.do("toggle_snapshots")
        settle()
    assert window.document.design == shown


def test_what_is_edited_is_matched_by_the_others_and_comes_back_as_it_was(window, settle):
    window.do("store_snapshot_1")
    two_places(window)
    settle()
    edited = window.document.design
    window.do("toggle_snapshots")
    settle()
    assert len(window.document.design.inputs) == 1
    assert loudest_db(levels(window.document.design)) == pytest.approx(
        loudest_db(levels(edited)), abs=1e-6
    )
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
    assert difference.words.startswith("dB, the same inputs, scaling and limb")
    assert not difference.shown.levels_db.any()
    panel.toggle.click()
    settle()
    assert panel.map.difference.heading == "Snapshot 1 and snapshot 2 are equal"
    assert cards(panel)[1].present


def test_snapshots_that_differ_in_level_alone_are_equal_once_levels_match(window, panel, settle):
    window.do("store_snapshot_1")
    edit(window, 2.0)
    window.do("store_snapshot_2")
    settle()
    for _ in range(3):
        panel.toggle.click()
        settle()
    difference = panel.map.difference
    assert difference.heading == "Snapshot 1 and snapshot 2 are equal"
    assert difference.words.startswith("dB, the same inputs once levels match")
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
    assert difference.words.startswith("dB, the same levels by other inputs")


def test_a_hidden_panel_costs_nothing(window, settle, requests):
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


def test_the_map_shows_how_much_louder_the_design_is(window, panel, settle):
    window.do("match_levels")
    window.do("store_snapshot_1")
    stored = levels(window.document.design)
    two_places(window)
    settle()
    difference = panel.map.difference
    assert difference.heading == "Edited minus snapshot 1"
    assert difference.words == "dB, as stored, synthetic limb"
    present = levels(window.document.design)
    floor = max(present.max(), stored.max()) - 60.0
    expected = np.maximum(present, floor) - np.maximum(stored, floor)
    np.testing.assert_allclose(difference.shown.levels_db, expected, rtol=0, atol=1e-6)
    assert difference.end_db >= np.abs(expected).max()
    window.do("match_levels")
    settle()
    matched = stored + present.max() - stored.max()
    expected = np.maximum(present, floor) - np.maximum(matched, floor)
    difference = panel.map.difference
    np.testing.assert_allclose(difference.shown.levels_db, expected, rtol=0, atol=1e-6)
    field = difference.shown.field_levels_db
    assert np.nanmax(np.abs(field)) <= np.abs(expected).max() + 1e-6


def test_the_map_compares_snapshots_as_they_are_played(window, panel, settle):
    # Far from a high tone the skin hardly moves: 60 dB below the loudest, nothing counts.
    window.document.edit(
        "f", window.document.design.with_clip(1, waveform=Tone(frequency_hz=500.0))
    )
    window.do("store_snapshot_1")
    two_places(window)
    window.do("store_snapshot_2")
    window.do("toggle_snapshots")
    settle()
    window.do("toggle_snapshots")
    settle()
    stored = window.document.view.snapshots
    assert [(one.number, one.gain < 0.9) for one in stored] == [(1, False), (2, True)]
    mine, theirs = levels(window.document.design), levels(stored[0].design)
    floor = mine.max() - 60.0
    assert (theirs < floor).any()
    expected = np.maximum(mine, floor) - np.maximum(theirs, floor)
    assert panel.map.difference.heading == "Snapshot 2 minus snapshot 1"
    found = panel.map.difference.shown.levels_db
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-6)


def test_words_under_the_pointer_name_the_output_and_its_difference(window, panel, settle):
    window.do("store_snapshot_1")
    two_places(window)
    settle()
    shown = panel.map.difference.shown
    area = panel.map._areas()[1]
    places = small_frame(shown.limb_map, area).to_screen(shown.limb_map.output_positions)
    words = panel.map.words_at(QPointF(*places[28]))
    assert words.startswith("Output 29, ")
    assert words.endswith(f"{shown.levels_db[28]:+.1f} dB".replace("-", "−"))
    assert panel.map.words_at(QPointF(-500, -500)) == ""


def test_cards_show_each_snapshot_its_level_and_what_is_in_the_window(window, panel, settle):
    assert set(cards(panel)) == {0, 1, 2, 3, 4}
    window.do("store_snapshot_2")
    two_places(window)
    settle()
    found = cards(panel)
    assert found[0].present
    assert not found[2].present
    assert found[1].compared is None
    assert "nothing stored" in found[1].accessibleName()
    loudest = levels(window.document.design).max()
    assert f"loudest output {loudest:.1f} dB".replace("-", "−") in found[2].accessibleName()
    assert "Alike at the loudest output" in panel.words.text()
    assert f"{loudest:.1f} dB re 1 m/s²".replace("-", "−") in panel.words.text()
    found[2].click()
    settle()
    assert cards(panel)[2].present
    assert len(window.document.design.inputs) == 1
    window.do("match_levels")
    assert panel.words.text() == "As loud as they were stored"


def test_cards_are_used_with_the_keyboard(window, panel, settle, qtbot):
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    first = window.document.design
    panel.setFocus()
    card = QApplication.focusWidget()
    assert card.number == 1
    QTest.keyClick(card, KEY.Key_Return)
    settle()
    assert window.document.view.snapshots[0].design == first
    edit(window, 2.0)
    settle()
    QTest.keyClick(card, KEY.Key_Space)
    settle()
    assert window.document.view.snapshots[-1].number == 1
    QTest.keyClick(card, KEY.Key_Delete)
    assert [one.number for one in window.document.view.snapshots] == [0]
    window.do("undo")
    assert [one.number for one in window.document.view.snapshots] == [0, 1]


def test_storing_is_a_step_and_is_saved_with_the_file(window, settle, tmp_path):
    window.files._save_to(tmp_path / "a.skinsource")
    assert not window.document.modified
    window.do("store_snapshot_1")
    assert window.document.modified
    window.do("undo")
    assert window.document.view.snapshots == ()
    assert not window.document.modified
    window.do("redo")
    window.files.save()
    assert not window.document.modified
    assert open_design(tmp_path / "a.skinsource").view.snapshots[0].design == window.document.design


def test_a_snapshot_of_a_limb_that_is_not_here_says_so(window, panel, settle):
    here = window.document.design
    window.document.edit("limb", replace(here, limb="measured-1"))
    settle()
    window.do("store_snapshot_1")
    window.document.edit("limb", here)
    settle()
    card = cards(panel)[1]
    assert "not" in card.accessibleName()
    assert "measured" in panel.map.difference.words
    assert panel.map.difference.shown is None


def test_designs_on_two_limbs_have_no_difference_map(window, panel, settle):
    window.do("store_snapshot_1")
    window.document.edit("limb", replace(window.document.design, limb="synthetic-2"))
    settle()
    assert "different limbs" in panel.map.difference.words
