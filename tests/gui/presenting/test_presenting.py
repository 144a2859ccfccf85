"""Presenting: bars away, words over the window, a covered map, scenes in turn and their notes."""

import re
from dataclasses import replace
from unittest.mock import patch

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QWidget

from skinsource.base.lock import Lock
from skinsource.design.design import Snapshot, View
from skinsource.design.design_file import open_design
from skinsource.studies.scenes.scenes import all_scenes
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.qt.keys import KEYS, key_text
from skinsource_gui.qt.overlays import COVERED, Cover
from skinsource_gui.shell.conditions import ConditionsCard
from skinsource_gui.shell.presenting import NotesWindow, Step, steps_of_folder
from tests.gui.analysis.analysis_bench import analysis


def title(window):
    return window.document.design.title


def bars(window):
    return window.menuBar(), window.statusBar(), window.setup_bar


def test_presenting_takes_the_bars_away_and_gives_them_back(open_window, design):
    window = open_window(design)
    shown = {name for name, dock in window.docks.items() if not dock.isHidden()}
    window.activateWindow()
    window.panel("traces").setFocus()
    focused = window.focusWidget()
    window.do("present")
    assert not any(bar.isVisible() for bar in bars(window))
    assert window.isFullScreen()
    assert {panel.name for panel in window.panels if panel.isVisible()} == {"stage"}
    window.do("present")
    assert all(bar.isVisible() for bar in bars(window))
    assert not window.isFullScreen()
    assert {name for name, dock in window.docks.items() if not dock.isHidden()} == shown
    assert window.focusWidget() is focused


def test_another_snapshot_is_offered_where_there_is_one(studio):
    told = []
    studio.presenter.done.connect(told.append)
    studio.do("present")
    studio.do("present")
    document = studio.document
    stored = Snapshot(number=1, design=document.design)
    document.look(replace(document.view, snapshots=(stored,)))
    studio.do("present")
    assert ["X: other snapshot" in text for text in told if "Esc" in text] == [False, True]


def test_keys_work_while_the_menus_are_away(studio, qtbot):
    studio.do("present")
    studio.activateWindow()
    stage = studio.panel("stage")
    dial = stage.knob.dial
    assert studio.focusWidget() is dial
    QTest.keyClick(dial, Qt.Key.Key_PageDown)
    qtbot.waitUntil(lambda: title(studio) == "3 both")
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_PageUp)
    qtbot.waitUntil(lambda: title(studio) == "2 tone")
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_B)
    assert stage.findChildren(Cover)
    QTest.keyClick(dial, Qt.Key.Key_Space)
    assert stage.clock.held
    QTest.keyClick(dial, Qt.Key.Key_L)
    assert not stage.moves
    QTest.keyClick(dial, Qt.Key.Key_C)
    assert stage.switch.isChecked()
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_F9)
    qtbot.waitUntil(lambda: studio.menuBar().isVisible())
    # Out of presenting nothing stays covered, and clickers go on.
    assert not any(cover.isVisible() for cover in stage.findChildren(Cover))
    studio.do("arrange_presentation")
    QTest.keyClick(dial, Qt.Key.Key_PageDown)
    assert title(studio) == "3 both"


def test_what_is_turned_in_front_of_people_is_taken_back_and_can_be_redone(open_window, design):
    window = open_window(design)
    window.document.mark_saved(None)
    window.do("present")
    window.panel("stage").knob.dial.setValue(0)
    turned = window.document.design
    assert turned.clips[0].waveform.frequency_hz == 25.0
    window.do("present")
    assert window.document.design == design
    assert not window.document.modified
    assert "Redo" in window.statusBar().currentMessage()
    window.do("redo")
    assert window.document.design == turned


def test_what_was_saved_in_front_of_people_stays(studio):
    studio.do("present")
    studio.panel("stage").knob.dial.setValue(0)
    studio.do("save_design")
    saved = studio.document.design
    studio.panel("stage").knob.dial.setValue(500)
    studio.do("present")
    assert studio.document.design == saved
    assert not studio.document.modified


def test_while_the_bars_are_away_words_lie_over_the_window(studio):
    document = studio.document
    stored = Snapshot(number=1, design=document.design)
    document.look(replace(document.view, snapshots=(stored,)))
    studio.do("present")
    assert "F9 or Esc: leave" in studio.notice.text
    # There, or at its control, every key of the stage is named.
    tips = [part.toolTip() for part in studio.panel("stage").findChildren(QWidget)]
    assert "other" in KEYS["presenting"].gestures
    for key in (key_text("presenting", name) for name in KEYS["presenting"].gestures):
        assert re.search(rf"\b{key}(:|\)| or)", f"{studio.notice.text} {tips}")
    studio.do("next_scene")
    assert studio.notice.text == "Scene 3 of 3: 3 both"
    studio.do("next_scene")
    assert studio.notice.text == "This is the last scene"
    studio.do("present")
    studio.do("previous_scene")
    assert studio.statusBar().currentMessage() == "Scene 2 of 3: 2 tone"
    for _ in range(2):
        studio.do("previous_scene")
    assert (title(studio), studio.notice.text) == ("1 tap", "")


@pytest.mark.parametrize(
    ("name", "own"),
    [("analysis", {"window_strip"}), ("compare", {"compared_maps", "compare_words"})],
)
def test_all_that_draws_maps_is_covered_together_and_revealed(
    open_window, design, qtbot, name, own
):
    window = open_window(design)
    window.docks[name].bring_forward()
    panel = analysis(window, "windowed") if name == "analysis" else window.panel(name)
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    assert own <= {part.objectName() for part in panel.guessed}
    assert not panel.findChildren(Cover)
    window.do("cover_map")
    louder(window, 2.0)
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    skin = window.panel("skin").map
    assert (skin.content.message, skin.readout()) == (COVERED, "")
    assert skin.content.coloured_values is skin.content.shown_field is None
    for part in panel.guessed:
        (cover,) = part.findChildren(Cover)
        assert cover.geometry() == part.rect()
    window.do("cover_map")
    assert skin.content.coloured_values is not None
    assert not any(cover.isVisible() for cover in panel.findChildren(Cover))


@pytest.mark.parametrize("name", ["arrange_presentation", "present", "next_scene"])
def test_the_stage_has_the_keyboard_however_it_is_opened(studio, qtbot, name):
    studio.activateWindow()
    studio.setup_bar.findChild(QWidget, "limb").setFocus()
    studio.do(name)
    dial = studio.panel("stage").knob.dial
    qtbot.waitUntil(lambda: QApplication.focusWidget() is dial)
    if not studio.presenter.presenting:
        studio.do("present")
    at = QPoint(2, 2)
    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, at, dial.mapToGlobal(at))
    QApplication.sendEvent(studio.panel("stage"), event)
    assert not studio.docks["stage"].findChildren(QMenu, "dock_menu")
    # Since a dialog was hidden under it, a button may count as pressed that is up.
    QTest.mousePress(QWidget(), Qt.MouseButton.LeftButton)
    QTest.keyClick(dial, Qt.Key.Key_Escape)
    assert not studio.presenter.presenting


def test_escape_gives_up_what_is_typed_and_then_leaves(studio):
    studio.do("present")
    studio.activateWindow()
    number = studio.panel("stage").knob.field
    number.setFocus()
    for key in (Qt.Key.Key_5, Qt.Key.Key_Escape):
        QTest.keyClick(number, key)
    assert not number.editing
    assert studio.presenter.presenting
    QTest.keyClick(number, Qt.Key.Key_Escape)
    assert not studio.presenter.presenting


OTHERS = "next_scene", "undo", "show_snapshot_1", "open"


@pytest.mark.parametrize("other", OTHERS)
def test_what_is_typed_never_reaches_another_design(studio, folder, monkeypatch, other):
    monkeypatch.setattr(FileActions, "may_lose_changes", lambda _: True)
    studio.do("store_snapshot_1")
    studio.document.edit("", studio.document.design.with_input(1, amplitude=2.0))
    if other == "next_scene":
        studio.do("present")
    inspected = studio.panel("inspector").findChild(NumberField, "duration_s_field")
    field = studio.panel("stage").knob.field if studio.presenter.presenting else inspected
    studio.activateWindow()
    field.setFocus()
    QTest.keyClick(field, Qt.Key.Key_5)
    assert field.editing
    studio.files.open(folder / "1 tap.skinsource") if other == "open" else studio.do(other)
    studio.panel("skin").setFocus()
    assert not field.editing
    tone = studio.document.design.clips[0].waveform
    assert (tone.frequency_hz, tone.duration_s) == (100.0, 0.2)


def test_files_of_a_folder_come_in_natural_order(tmp_path):
    for name in ("10 sweep", "2 two", "1 tap"):
        (tmp_path / f"{name}.skinsource").touch()
    assert [step.title for step in steps_of_folder(tmp_path)] == ["1 tap", "2 two", "10 sweep"]


def test_a_file_of_the_folder_is_saved_to_after_it_was_presented(studio, folder, monkeypatch):
    monkeypatch.setattr(FileActions, "ask_and_save", lambda _: pytest.fail("asked for a name"))
    studio.do("present")
    studio.do("next_scene")
    studio.do("present")
    path = folder / "3 both.skinsource"
    assert studio.document.path == path
    assert studio.keeping.autosave._look().path == path
    # Another studio finds it locked, and those before it free.
    assert list(studio.files.held._locks) == [Lock(path).file]
    studio.document.edit("", studio.document.design.with_input(0, amplitude=3.0))
    studio.do("save_design")
    assert open_design(path).design.inputs[0].amplitude == 3.0
    assert not studio.document.modified
    studio.do("next_scene")
    assert studio.document.path == path


def test_a_file_that_does_not_open_is_passed_by(studio, folder):
    (folder / "3 both.skinsource").write_text("damaged")
    (folder / "4 tap.skinsource").write_bytes((folder / "1 tap.skinsource").read_bytes())
    studio.do("present")
    for _ in range(2):
        studio.do("next_scene")
    # It is called by its title.
    assert studio.notice.text == "Scene 4 of 4: 1 tap"


@pytest.mark.parametrize("by_key", [False, True])
def test_keys_of_the_stage_work_wherever_the_keyboard_is_on_its_page(studio, qtbot, by_key):
    studio.do("arrange_presentation")
    studio.activateWindow()
    chip, stage = studio.conditions.chip, studio.panel("stage")
    before = chip if by_key else stage.knob.dial
    before.setFocus()
    QTest.mouseClick(chip, Qt.MouseButton.LeftButton)
    QTest.keyClick(studio.findChild(ConditionsCard), Qt.Key.Key_Escape)
    studio.activateWindow()
    qtbot.waitUntil(lambda: QApplication.focusWidget() is before)
    QTest.keyClick(before, Qt.Key.Key_Space)
    assert stage.clock.held
    assert not [each for each in studio.findChildren(ConditionsCard) if each.isVisible()]
    QTest.keyClick(before, Qt.Key.Key_PageDown)
    assert title(studio) == "3 both"


def test_a_notice_gives_the_keyboard_back(studio):
    studio.activateWindow()
    notice = studio.notice
    notice.say("Text")
    studio.panel("skin").setFocus()
    focused, button = studio.focusWidget(), notice.card.findChild(QWidget, "close_notice")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    assert studio.focusWidget() is focused
    notice.say("Text")
    button.setFocus()
    notice.be_quiet()
    assert studio.focusWidget() is focused


def test_a_pause_on_the_page_of_the_stage_ends_with_its_scene(studio, settle):
    studio.do("arrange_presentation")
    settle()
    stage = studio.panel("stage")
    stage.hold()
    # As where its maps are there at once, so that the motion never stops.
    with patch.object(stage.clock, "run"):
        studio.do("next_scene")
    assert not stage.clock.held


def louder(window, amplitude):
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=amplitude))
    return window.document.design


def test_a_scene_that_was_turned_is_left_unasked_and_it_is_said(open_window, answers, design):
    window = open_window(design)
    window.do("next_scene")
    window.do("present")
    first = window.document.design
    louder(window, 2.0)
    window.do("next_scene")
    assert window.notice.text.endswith(f"; changes to {first.title} are not saved")
    window.do("previous_scene")
    assert window.notice.text == f"Scene 1 of {len(all_scenes())}: {first.title}"
    assert window.document.design == first
    # What was turned back is nothing that could be saved.
    louder(window, 2.0)
    window.do("undo")
    window.do("next_scene")
    assert "saved" not in window.notice.text
    # By hand, too.
    before = window.document.design.inputs[0].amplitude
    louder(window, 2.0 * before)
    louder(window, before)
    window.do("next_scene")
    assert "saved" not in window.notice.text
    assert not answers["asked"]


def test_of_a_scene_only_what_is_turned_on_its_page_is_left_unasked(open_window, answers, design):
    window = open_window(design)
    window.do("next_scene")
    first = window.document.design
    window.panel("stage").knob.dial.setValue(0)
    assert window.document.design != first
    # In front of people nothing is asked either.
    for _ in range(2):
        window.do("present")
    window.do("next_scene")
    assert not answers["asked"]
    said = window.statusBar().currentMessage()
    assert said.endswith(f"; changes to {first.title} are not saved")


def test_a_snapshot_that_is_shown_is_no_change_of_the_scene(open_window, answers, design):
    window = open_window(design)
    other = replace(design, title="Other")
    show = tuple(Snapshot(number=k, design=each) for k, each in enumerate((design, other), 1))
    window.presenter._steps = [Step("A", lambda: (design, View(snapshots=show)))] * 2
    window.do("next_scene")
    window.do("toggle_snapshots")
    assert window.document.design == other
    assert not window.document.modified
    window.do("next_scene")
    assert window.statusBar().currentMessage() == "Scene 2 of 2: A"
    assert not answers["asked"]


@pytest.mark.parametrize("presented", ["afterwards", "before"])
def test_work_that_was_done_in_a_scene_is_not_lost_unasked(open_window, answers, presented, design):
    window = open_window(design)
    window.do("next_scene")
    window.do("arrange_design")
    if presented == "before":
        window.do("present")
        window.do("present")
    edited = louder(window, 2.0)
    if presented == "afterwards":
        window.do("present")
    window.do("next_scene")
    assert len(answers["asked"]) == 1
    assert window.document.design == edited
    window.document.mark_saved(window.document.path)


def test_notes_follow_the_scenes(studio):
    studio.do("show_notes")
    notes = studio.findChild(NotesWindow)
    assert notes.notes.toPlainText() == "Say 2 tone"
    studio.do("next_scene")
    assert notes.heading.text() == "3 both"
    assert notes.notes.toPlainText() == "Say 3 both"
    assert notes.next.text() == "This is the last one."
    studio.do("previous_scene")
    assert notes.next.text() == "Next: 3 both"
    notes.close()


@pytest.mark.parametrize(
    ("first", "leave"), [("show_notes", Qt.Key.Key_F9), ("present", Qt.Key.Key_Escape)]
)
def test_keys_of_presenting_work_on_the_notes_too_whichever_came_first(studio, qtbot, first, leave):
    for name in (first, *({"show_notes", "present"} - {first})):
        studio.do(name)
    notes = studio.findChild(NotesWindow)
    notes.activateWindow()
    notes.notes.setFocus()
    qtbot.waitUntil(notes.isActiveWindow)
    QTest.keyClick(notes.notes, Qt.Key.Key_B)
    assert studio.presenter.covered
    QTest.keyClick(notes.notes, leave)
    assert not studio.presenter.presenting
    assert not notes.isVisible()
