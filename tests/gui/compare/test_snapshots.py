"""Snapshots: keys and cards, levels that match, maps of their levels and differences."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog

import skinsource as ss
from skinsource import Design, View, edits, open_design, save_design, track
from skinsource.design.comparing import other_snapshot, with_edited
from skinsource.design.edits.view import rename_snapshot
from skinsource.design.motions import Sweep
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.compare.content import snapshot_names, tab_separated
from skinsource_gui.state.compared import ELSEWHERE, SILENCE, Compared
from tests.core.own_limbs.lab_bench import installed
from tests.gui.compare.compare_bench import (
    ALT,
    CTRL,
    KEY,
    SHIFT,
    cards,
    choose,
    edit,
    levels,
    shown,
    two_places,
)


@pytest.fixture
def panel(window, active, settle):
    """Compare, in front."""
    window.docks["compare"].bring_forward()
    settle()
    return window.panel("compare")


def names_of(requests):
    return [request.slot for request in requests]


def test_keys_store_show_and_toggle_and_arrangements_have_moved(window, active, settle):
    first = window.document.design
    QTest.keyClick(window, KEY.Key_1, CTRL | SHIFT)
    edit(window, 2.0)
    QTest.keyClick(window, KEY.Key_4, CTRL | SHIFT)
    settle()
    assert [snapshot.number for snapshot in window.document.view.snapshots] == [1, 4]
    QTest.keyClick(window, KEY.Key_X)
    assert window.document.design == first
    QTest.keyClick(window, KEY.Key_4, CTRL)
    assert window.document.design.inputs[0].amplitude == 2.0
    QTest.keyClick(window, KEY.Key_1, CTRL)
    assert window.document.design == first
    assert window.docks["hand"].isVisible()
    QTest.keyClick(window, KEY.Key_2, ALT)
    assert not window.docks["hand"].isVisible()


def test_an_edit_of_a_shown_snapshot_keeps_the_working_design_as_a_snapshot(window):
    document, said, refused = window.document, [], []
    document.message.connect(said.append)
    document.refused.connect(refused.append)
    bare = replace(document.design, inputs=())
    document.edit("Sweep", edits.add_motion(bare, View(), Sweep(path=(16, 18))).design)
    window.do("store_snapshot_1")
    edit(window, 2.0)
    window.do("toggle_snapshots")
    document.apply(rename_snapshot(document.design, document.view, 1, "Soft"))
    gesture = document.undo_stack.index()
    moved = edits.move_inputs(document.design, document.view, document.design.ids[:1], 5)
    document.apply(moved, gesture)
    edit(window, 6.0)
    held = {each.number: each.design.inputs[0].amplitude for each in document.view.snapshots}
    assert (document.design.inputs[0].amplitude, held) == (6.0, {1: 1.0, 2: 2.0})
    assert [("snapshot 2" in text, "single clips" in text) for text in said] == [(True, True)]
    # X leads to the one that was edited, and undo to where both were.
    assert other_snapshot(document.view.snapshots, document.design).number == 1
    document.go_to(gesture)
    assert {each.number for each in document.view.snapshots} == {0, 1}
    window.do("toggle_snapshots")
    assert document.design.inputs[0].amplitude == 2.0
    # Where another snapshot holds it, or no number is free, no further one is stored.
    for number in (2, 3, 4):
        window.do(f"store_snapshot_{number}")
    window.do("show_snapshot_1")
    edit(window, 6.0)
    assert {each.number for each in document.view.snapshots} == {1, 2, 3, 4}
    window.do("show_snapshot_1")
    shown, count = document.design, document.undo_stack.count()
    field = window.panel("inspector").findChild(NumberField, "amplitude_field")
    for key in ("7", "\r"):
        QTest.keyClicks(field, key)
    assert (document.design, document.undo_stack.count(), len(refused)) == (shown, count, 1)
    assert field.text() == "1"
    # Without the shown one, the working design is back.
    document.apply(edits.forget_snapshot(document.design, document.view, 1))
    assert document.design.inputs[0].amplitude == 6.0
    window.do("undo")
    assert document.design == shown


def test_a_shown_snapshot_is_named_in_title_and_status_bar_as_long_as_it_is_shown(
    window, settle, tmp_path
):
    window.do("store_snapshot_1")
    edit(window, 2.0)
    window.files._save_to(tmp_path / "a.skinsource")

    def signs():
        settle()
        window.statusBar().clearMessage()
        window.status_line._pause.timeout.emit()
        return window.windowTitle().count("(snapshot 1)"), window.status_line.text()[:19]

    assert signs() == (0, "Predicted accelerat")
    window.do("show_snapshot_1")
    assert signs() == (1, "Snapshot 1 is shown")
    window.files.save()
    window.files.open(tmp_path / "a.skinsource")
    assert signs() == (1, "Snapshot 1 is shown")
    edit(window, 3.0)
    window.files.save()
    window.files.open(tmp_path / "a.skinsource")
    assert signs() == (0, "Predicted accelerat")
    kept = {each.number: each.design.inputs[0].amplitude for each in window.document.view.snapshots}
    assert kept == {1: 1.0, 2: 2.0}


def test_without_a_snapshot_one_is_told_how_to_store_one(window, panel):
    assert "Ctrl+Shift+1 to 4" in panel.maps.content.message
    assert not window.actions_by_name["toggle_snapshots"].isEnabled()
    window.comparison.toggle()
    assert "Ctrl+Shift+1 to 4" in window.notice.text
    assert not window.actions_by_name["show_snapshot_2"].isEnabled()
    window.do("store_snapshot_2")
    window.comparison.toggle()
    assert "The design in the window is snapshot 2" in window.notice.text


def test_cards_show_each_snapshot_its_level_and_what_is_in_the_window(window, panel, settle):
    assert set(cards(panel)) == {0, 1, 2, 3, 4}
    window.do("match_levels")
    window.do("store_snapshot_2")
    two_places(window)
    settle()
    shown_cards = cards(panel)
    assert (shown_cards[0].present, shown_cards[2].present) == (True, False)
    assert shown_cards[1].compared is None
    assert "nothing stored" in shown_cards[1].accessibleName()
    level = f"{levels(window.document.design).max():.1f} dB".replace("-", "−")
    assert f"loudest output {level}" in shown_cards[2].accessibleName()
    assert panel.text_label.whole.endswith(" · levels matched in the loudest 100 ms")
    shown_cards[2].click()
    settle()
    assert cards(panel)[2].present
    assert len(window.document.design.inputs) == 1
    panel.bar.match.click()
    assert not window.document.view.levels_matched
    assert "matched" not in panel.text_label.whole


def test_cards_are_used_with_the_keyboard(window, panel, settle):
    first = window.document.design
    card = cards(panel)[1]
    QTest.keyClick(card, KEY.Key_Return)
    settle()
    assert window.document.view.snapshots[0].design == first
    edit(window, 2.0)
    settle()
    card.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(card, KEY.Key_Space)
    settle()
    assert window.document.view.snapshots[-1].number == 1
    QTest.keyClick(card, KEY.Key_Delete)
    assert [snapshot.number for snapshot in window.document.view.snapshots] == [0]
    window.do("undo")
    assert [snapshot.number for snapshot in window.document.view.snapshots] == [0, 1]


def test_the_title_of_a_snapshot_is_typed_over_its_card_and_is_its_own(
    window, panel, settle, tmp_path
):
    document = window.document
    document.edit("t", replace(document.design, title="Mine"))
    window.do("store_snapshot_1")
    settle()
    card = cards(panel)[1]
    for begin, typed, end in (
        (partial(QTest.keyClick, card, KEY.Key_F2), "Soft", KEY.Key_Return),
        (partial(QTest.mouseDClick, card, Qt.MouseButton.LeftButton), "x", KEY.Key_Escape),
    ):
        begin()
        QApplication.focusWidget().insert(typed)
        QTest.keyClick(QApplication.focusWidget(), end)
    assert (card.text()[:7], card.present) == ("1 Soft:", True)
    edit(window, 2.0)
    window.do("store_snapshot_2")
    edit(window, 3.0)
    settle()
    # "Mine" is the title of two, and tells neither.
    called = [each.text().partition(":")[0] for each in cards(panel).values()]
    assert called == ["1 Soft", "2", "3", "4", "Working"]
    heads = [cell.heading for cell in panel.maps.content.cells]
    assert heads == ["Snapshot 1 · Soft", "Snapshot 2", "Working design"]
    QTest.keyClick(cards(panel)[0], KEY.Key_F2)
    assert window.windowTitle().startswith("Mine[*]")
    window.files._save_to(tmp_path / "a.skinsource")
    opened = open_design(tmp_path / "a.skinsource")
    assert [each.title for each in opened.view.snapshots] == ["Soft", ""]
    outcome = rename_snapshot(document.design, document.view, 2, "Long" * 10)
    document.apply(outcome)
    assert document.modified
    window.do("undo")
    assert cards(panel)[2].text().startswith("2:")
    first, second = outcome.view.snapshots
    several = first, second, replace(first, number=3)
    names = snapshot_names([Compared(snapshot=each) for each in several], "xyz")
    assert [each[1] for each in names] == ["1 · Soft", "2 · " + "Long" * 10, "3 · Soft"]
    assert names[1][-3:-1] == ("2 · LongLongLongL…", "Snapshot 2")


def test_maps_show_snapshots_as_loud_as_they_are_shown_and_how_they_differ(window, panel, settle):
    window.do("match_levels")
    # Far from a high tone the skin hardly moves: 60 dB below the loudest, nothing counts.
    window.document.edit(
        "f", window.document.design.with_clip(1, waveform=Tone(frequency_hz=500.0))
    )
    window.do("store_snapshot_1")
    two_places(window)
    window.do("store_snapshot_2")
    settle()
    first, second = panel.maps.content.cells
    assert (first.heading, second.heading) == ("Snapshot 1", "Snapshot 2")
    by_db = second.values_db.max() - first.values_db.max()
    assert abs(by_db) < 0.1  # levels are matched in the loudest 100 ms
    assert np.nanmax(second.small.field_levels_db) <= second.values_db.max() + 1e-9
    assert panel.maps.content.common_scale.text_below.startswith("dB re 1 m/s², 2: \N{MINUS SIGN}")
    choose(window, shown="difference")
    settle()
    [cell] = panel.maps.content.cells
    one, two = (levels(snapshot.design) for snapshot in window.document.view.snapshots)
    two = two + one.max() + by_db - two.max()
    floor = max(one.max(), two.max()) - 60.0
    assert (one < floor).any()
    assert cell.heading == "Snapshot 1 minus Snapshot 2"
    expected = np.maximum(one, floor) - np.maximum(two, floor)
    np.testing.assert_allclose(cell.values_db, expected, rtol=0, atol=1e-6)
    window.do("match_levels")
    settle()
    expected = levels(window.document.view.snapshots[0].design)
    choose(window, shown="levels")
    settle()
    np.testing.assert_allclose(panel.maps.content.cells[0].values_db, expected, atol=1e-9)


def test_what_is_silent_has_no_level_that_is_matched_compared_or_averaged(window, panel, settle):
    window.do("match_levels")
    window.document.edit("a", Design(limb="synthetic-1"))
    window.do("store_snapshot_1")
    designs = [Design(limb="synthetic-1", inputs=(track(place),)) for place in (7, 18)]
    for number, design in enumerate(designs, 2):
        window.document.edit("b", design)
        window.do(f"store_snapshot_{number}")
    settle()
    content = panel.maps.content
    assert content.about.endswith(" · snapshot 1 is silent: levels cannot be matched to it")
    silent, first, second = content.cells
    assert silent.value_text(None) == silent.value_text(3) == "silent"
    assert first.value_texts(3)[0] == f"Output 3: {first.value_text(3)}"
    readout = content.readout(3).rpartition(": ")[2]
    assert readout.split(" · ") == ["silent", first.value_text(3), second.value_text(3)]
    rows = [line.split("\t") for line in tab_separated(content).splitlines()[1:]]
    assert all(row[1] == "" and row[2] and row[3] for row in rows)
    choose(window, own_maximum=True)
    assert [cell.maximum_db is None for cell in panel.maps.content.cells] == [True, False, False]
    choose(window, shown="difference")
    # 60 dB below the other one, as if that were its level, would be said of it.
    assert panel.maps.content.cells[0].text == SILENCE
    assert panel.maps.content.cells[0].small is None
    choose(window, shown="mean")
    mean, spread = panel.maps.content.cells
    levels_db = np.array([levels(design) for design in designs])
    levels_db = np.maximum(levels_db, levels_db.max() - 60.0)
    np.testing.assert_allclose(mean.values_db, levels_db.mean(axis=0), atol=1e-9)
    np.testing.assert_allclose(spread.values_db, levels_db.std(axis=0, ddof=1), atol=1e-9)
    assert mean.headings[-2] == "Mean of 2 of 3"


def test_a_snapshot_on_a_limb_that_is_missing_says_so_until_it_is_installed(
    window, settle, panel, qtbot, synthetic_installed
):
    away = synthetic_installed.with_suffix(".away")
    synthetic_installed.rename(away)
    start = window.document.design
    window.do("match_levels")
    window.document.edit("a", Design(limb="measured-2", inputs=(track(7),)))
    window.do("store_snapshot_1")
    window.document.edit("b", start)
    window.do("store_snapshot_2")
    two_places(window)
    window.do("store_snapshot_3")
    choose(window, shown="difference")
    settle()
    qtbot.waitUntil(lambda: bool(cards(panel)[1].compared.problem))
    assert "not" in cards(panel)[1].accessibleName()
    assert "measured" in panel.maps.content.cells[0].text
    assert panel.maps.content.about.endswith(
        "snapshot 1 cannot be predicted: levels cannot be matched to it"
    )
    away.rename(synthetic_installed)
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))
    settle()
    qtbot.waitUntil(lambda: cards(panel)[1].compared.problem == "", timeout=5000)
    assert cards(panel)[1].compared.values is not None


def test_designs_on_other_limbs_are_compared_where_their_outputs_are_the_same(
    window, panel, settle, user_data
):
    choose(window, shown="difference")
    first = window.document.design
    window.do("store_snapshot_1")
    second = replace(first, limb="synthetic-2")
    window.document.edit("limb", second)
    settle()
    [cell] = panel.maps.content.cells
    assert cell.headings[-1] == "1 on Synthetic 1 minus Working on Synthetic 2"
    assert cell.values_db == pytest.approx(levels(first) - levels(second), abs=1e-6)
    field = ss.evaluate(first, "surface")["surface"].interpolate(cell.values_db)
    assert cell.small.field_levels_db == pytest.approx(field, abs=1e-6, nan_ok=True)
    installed()
    window.limbs.look()
    window.document.edit("limb", Design(limb="lab-1", inputs=(track(3),)))
    settle()
    [cell] = panel.maps.content.cells
    assert (cell.text, cell.small) == (ELSEWHERE, None)


def test_snapshots_of_several_people_say_on_whom_each_is(window, panel, settle):
    first = window.document.design
    window.do("store_snapshot_1")
    edit(window, 2.0)
    window.do("store_snapshot_2")
    for what in ("levels", "motion"):
        choose(window, shown=what)
        settle()
        assert [cell.heading for cell in panel.maps.content.cells] == ["Snapshot 1", "Snapshot 2"]
        assert " on " not in cards(panel)[1].toolTip()
    window.document.edit("limb", replace(first, limb="synthetic-2"))
    window.do("store_snapshot_2")
    for what in ("levels", "motion"):
        choose(window, shown=what)
        settle()
        heads = [cell.heading for cell in panel.maps.content.cells]
        assert heads == ["Snapshot 1 on Synthetic 1", "Snapshot 2 on Synthetic 2"]
        assert cards(panel)[1].toolTip().startswith("Snapshot 1 on Synthetic 1, ")


def test_a_design_of_a_file_is_kept_as_a_snapshot_and_the_present_one_stays_open(
    window, panel, qtbot, tmp_path, monkeypatch
):
    def answer(name):
        path = str(tmp_path / name), ""
        monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: path)

    saved = Design(limb="synthetic-2", inputs=(track(13, Tone(frequency_hz=200.0), amplitude=3.0),))
    document = window.document
    save_design(tmp_path / "two hundred.skinsource", saved, View())
    answer("two hundred.skinsource")
    before = document.design
    panel.bar.file.click()
    cells = shown(panel, qtbot, 2)
    assert (document.design, document.path) == (before, None)
    heads = {cell.limb: cell.heading.partition(" on ")[0] for cell in cells}
    assert heads == {"synthetic-1": "Working design", "synthetic-2": "Snapshot 1 · two hundred"}
    [other] = [cell for cell in cells if cell.limb == saved.limb]
    assert other.values_db == pytest.approx(levels(saved), abs=1e-9)
    # It is beside the history, as every snapshot.
    assert document.undo_stack.count() == 0
    # What cannot be read, and a fifth one, change nothing and say why.
    (tmp_path / "broken.skinsource").write_text("{")
    answer("broken.skinsource")
    window.do("take_snapshot")
    assert "broken.skinsource" in window.notice.text
    answer("two hundred.skinsource")
    for _ in range(4):
        window.do("take_snapshot")
    snapshots = document.view.snapshots
    assert [snapshot.number for snapshot in snapshots] == [1, 2, 3, 4]
    window.do("take_snapshot")
    assert "Remove one first" in window.notice.text
    assert document.view.snapshots == snapshots


def test_a_snapshot_is_predicted_once_however_long_one_edits(window, panel, settle, requests):
    window.do("store_snapshot_1")
    for amplitude in (2.0, 3.0, 4.0):
        edit(window, amplitude)
        settle()
    window.document.look(replace(window.document.view, outputs=(1, 2)))
    settle()
    assert names_of(requests).count("snapshot 1") <= 1
    assert names_of(requests).count("snapshot 0") == 0
    window.document.look(replace(window.document.view, axes="z"))
    settle()
    assert names_of(requests).count("snapshot 1") <= 2


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


def test_a_replaced_snapshot_that_undo_brings_back_is_predicted_again(window, settle, qtbot):
    panel = window.panel("compare")
    window.do("store_snapshot_1")
    two_places(window)
    window.do("store_snapshot_2")
    edit(window, 2.0)
    settle()
    window.docks["compare"].bring_forward()
    shown(panel, qtbot, 3)
    window.do("store_snapshot_2")
    shown(panel, qtbot, 2)
    window.do("undo")
    shown(panel, qtbot, 3)
    assert "…" not in cards(panel)[2].text()
    assert panel.copy.isEnabled()


def test_undo_takes_no_snapshot_away_and_brings_back_those_that_were_replaced(window):
    document = window.document
    edit(window, 2.0)
    window.do("store_snapshot_1")
    window.do("undo")
    first = document.view.snapshots
    assert [snapshot.design.inputs[0].amplitude for snapshot in first] == [2.0]
    window.do("redo")
    assert document.undo_stack.count() == 1
    edit(window, 3.0)
    window.do("store_snapshot_1")
    assert document.undo_stack.count() == 3
    assert "Undo brings back" in f"{window.notice.text} {window.statusBar().currentMessage()}"
    window.do("store_snapshot_3")
    window.do("undo")
    assert document.view.snapshots[0] == first[0]
    assert [snapshot.number for snapshot in document.view.snapshots] == [1, 3]
    window.do("redo")
    assert document.view.snapshots[0].design.inputs[0].amplitude == 3.0
    assert {snapshot.number for snapshot in document.view.snapshots} == {1, 3}


def test_the_working_design_is_told_by_its_title_until_a_scene_is_changed():
    scene = ss.scenes.open_scene("5B", available=())
    changed = scene.design.with_input(0, amplitude=1.0)
    for design, name in ((scene.design, "80 mm/s"), (changed, "Working design")):
        sides = [Compared(snapshot=each) for each in with_edited(scene.view.snapshots, design)]
        names = snapshot_names(sides, "z")
        assert names[0][0] == "Snapshot 1 · 5 mm/s"
        assert names[-1][-1 if name == "80 mm/s" else 0] == name
