"""Cards of snapshots, and the map of how they differ."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

import skinsource as ss
from skinsource.design.comparing import Snapshot, scale_end_db
from skinsource.design.design import Design, track
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.compare.card import equal_captions, matching_text
from skinsource_gui.state.compared import ELSEWHERE, SILENCE, Compared
from tests.core.own_limbs.lab_bench import installed
from tests.gui.compare.compare_bench import KEY, cards, edit, levels, shown_levels, two_places


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


def test_the_map_shows_how_much_louder_the_design_is(window, panel, settle):
    window.do("store_snapshot_1")
    stored = levels(window.document.design)
    two_places(window)
    settle()
    difference = panel.map.difference
    assert difference.heading == "Edited minus snapshot 1"
    assert difference.text == "dB, as stored, synthetic limb"
    present = levels(window.document.design)
    floor = max(present.max(), stored.max()) - 60.0
    expected = np.maximum(present, floor) - np.maximum(stored, floor)
    np.testing.assert_allclose(difference.shown.levels_db, expected, rtol=0, atol=1e-6)
    assert difference.reached_db == (
        pytest.approx(expected.min(), abs=1e-6),
        pytest.approx(expected.max(), abs=1e-6),
    )
    assert difference.end_db == scale_end_db(difference.shown.levels_db)
    window.do("match_levels")
    settle()
    matched = stored + present.max() - stored.max()
    expected = np.maximum(present, floor) - np.maximum(matched, floor)
    difference = panel.map.difference
    by_db = f"{present.max() - stored.max():+.1f} dB".replace("-", "\N{MINUS SIGN}")
    assert difference.text == f"dB, 1: {by_db}, matched, synthetic limb"
    np.testing.assert_allclose(difference.shown.levels_db, expected, rtol=0, atol=1e-6)
    field = difference.shown.field_levels_db
    assert np.nanmax(np.abs(field)) <= np.abs(expected).max() + 1e-6


def test_the_map_compares_snapshots_as_they_are_played(window, panel, settle):
    window.do("match_levels")
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
    assert [(snapshot.number, snapshot.gain < 0.9) for snapshot in stored] == [
        (1, False),
        (2, True),
    ]
    assert window.document.design == stored[1].design
    mine, theirs = shown_levels(window), levels(stored[0].design)
    floor = mine.max() - 60.0
    assert (theirs < floor).any()
    expected = np.maximum(mine, floor) - np.maximum(theirs, floor)
    assert panel.map.difference.heading == "Snapshot 2 minus snapshot 1"
    levels_db = panel.map.difference.shown.levels_db
    np.testing.assert_allclose(levels_db, expected, rtol=0, atol=1e-6)


def test_cards_show_each_snapshot_its_level_and_what_is_in_the_window(window, panel, settle):
    assert set(cards(panel)) == {0, 1, 2, 3, 4}
    window.do("match_levels")
    window.do("store_snapshot_2")
    two_places(window)
    settle()
    shown_cards = cards(panel)
    assert shown_cards[0].present
    assert not shown_cards[2].present
    # The colours of the card are those of the large map.
    assert shown_cards[0]._scale.range_db == window.panel("skin").colour_bar.range_db
    assert shown_cards[1].compared is None
    assert "nothing stored" in shown_cards[1].accessibleName()
    loudest = levels(window.document.design).max()
    assert f"loudest output {loudest:.1f} dB".replace("-", "−") in shown_cards[2].accessibleName()
    assert "Alike at the loudest output" in panel.text_label.text()
    assert f"{loudest:.1f} dB re 1 m/s²".replace("-", "−") in panel.text_label.text()
    shown_cards[2].click()
    settle()
    assert cards(panel)[2].present
    assert len(window.document.design.inputs) == 1
    window.do("match_levels")
    assert panel.text_label.text() == "As loud as they were stored"


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
    assert [snapshot.number for snapshot in window.document.view.snapshots] == [0]
    window.do("undo")
    assert [snapshot.number for snapshot in window.document.view.snapshots] == [0, 1]


def test_a_snapshot_of_a_limb_that_is_not_here_says_so(window, panel, settle):
    here = window.document.design
    window.document.edit("limb", replace(here, limb="measured-1"))
    settle()
    window.do("store_snapshot_1")
    window.document.edit("limb", here)
    settle()
    card = cards(panel)[1]
    assert "not" in card.accessibleName()
    assert "measured" in panel.map.difference.text
    assert panel.map.difference.shown is None


def test_designs_on_two_limbs_differ_output_by_output_and_the_limbs_are_said(window, panel, settle):
    first = window.document.design
    window.do("store_snapshot_1")
    second = replace(first, limb="synthetic-2")
    window.document.edit("limb", second)
    settle()
    difference = panel.map.difference
    assert difference.text == "dB, as stored, Synthetic 2 minus Synthetic 1, synthetic limb"
    assert difference.shown.levels_db == pytest.approx(levels(second) - levels(first), abs=1e-6)
    there = ss.evaluate(second, "surface", "surface_levels_db")
    field = there["surface"].interpolate(difference.shown.levels_db)
    assert difference.shown.field_levels_db == pytest.approx(field, abs=1e-6, nan_ok=True)


def test_designs_whose_outputs_are_at_other_places_have_no_difference_map(
    window, panel, settle, user_data
):
    installed()
    window.limbs.look()
    window.do("store_snapshot_1")
    window.document.edit("limb", Design(limb="lab-1", inputs=(track(3),)))
    settle()
    assert panel.map.difference.text == ELSEWHERE
    assert panel.map.difference.shown is None


@pytest.fixture
def panel(window, settle):
    window.docks["compare"].bring_forward()
    settle()
    return window.panel("compare")


def card(panel, number):
    return next(card for card in panel.cards if card.number == number)


def test_a_snapshot_on_a_limb_that_was_missing_is_predicted_once_it_is_installed(
    window, settle, panel, qtbot, synthetic_installed
):
    away = synthetic_installed.with_suffix(".away")
    synthetic_installed.rename(away)
    start = window.document.design
    window.document.edit("a", Design(limb="measured-2", inputs=(track(7),)))
    window.do("store_snapshot_1")
    window.document.edit("b", start)
    settle()
    qtbot.waitUntil(lambda: bool(card(panel, 1).compared.problem))
    away.rename(synthetic_installed)
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))
    settle()
    qtbot.waitUntil(lambda: card(panel, 1).compared.problem == "", timeout=5000)
    assert card(panel, 1).compared.values is not None


def test_what_cannot_be_predicted_is_not_said_to_be_as_loud(window, settle, panel):
    here = window.document.design
    window.do("match_levels")
    window.do("store_snapshot_2")
    window.document.edit("a", replace(here, inputs=(track(18),)))
    window.do("store_snapshot_3")
    window.document.edit("b", Design(limb="measured-2", inputs=(track(7),)))
    window.do("store_snapshot_1")
    settle()
    assert (
        panel.text_label.text() == "Snapshot 1 cannot be predicted: levels cannot be matched to it"
    )


def test_what_is_silent_is_not_said_to_be_as_loud(window, settle, panel):
    window.do("match_levels")
    window.document.edit("a", Design(limb="synthetic-1"))
    window.do("store_snapshot_1")
    window.document.edit("b", Design(limb="synthetic-1", inputs=(track(7),)))
    window.do("store_snapshot_2")
    settle()
    text = panel.text_label.text()
    assert "sil " not in text
    assert text == "Snapshot 1 is silent: levels cannot be matched to it"
    # 60 dB below the other one, as if that were its level, would be said of it.
    assert panel.map.difference.shown is None
    assert panel.map.difference.text == SILENCE
    assert matching_text((), matched=True) == ""
    # Nor is what sounds 60 dB above the one that is silent.
    window.do("toggle_snapshots")
    settle()
    assert window.document.design.inputs == ()
    assert (panel.map.difference.shown, panel.map.difference.text) == (None, SILENCE)
    # Two that are silent are alike.
    window.do("store_snapshot_2")
    settle()
    assert panel.map.difference.text != SILENCE


def test_the_largest_amplitude_is_compared_with_what_is_matched_to_it():
    loud, soft = (
        Design(limb="synthetic-1", inputs=(track(7, amplitude=size),)) for size in (1000.0, 500.0)
    )
    first, second = Snapshot(number=1, design=loud), Snapshot(number=2, design=soft)
    for gains in ((2.0, 4.0), (0.5, 1.0)):
        sides = [
            Compared(snapshot=side, gain=gain)
            for side, gain in zip((first, second), gains, strict=True)
        ]
        assert "once levels match" in equal_captions(*sides)[1]
        assert "once levels match" in equal_captions(*sides[::-1])[1]
