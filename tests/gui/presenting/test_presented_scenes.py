"""Scenes that follow one another, and the notes beside them."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.base.lock import Lock
from skinsource.design.design_file import open_design
from skinsource.studies.scenes.catalog import all_scenes
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.shell.presenting import NotesWindow, steps_of_folder


def title(window):
    return window.document.design.title


def test_scenes_are_the_designs_of_the_folder_in_their_order(studio):
    titles = []
    for name in ("next_scene", "next_scene", "previous_scene", "previous_scene", "previous_scene"):
        studio.do(name)
        titles.append(title(studio))
    assert titles == ["3 both", "3 both", "2 tone", "1 tap", "1 tap"]


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


def louder(window, amplitude):
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=amplitude))
    return window.document.design


def test_what_is_turned_while_a_scene_is_presented_is_not_asked_about(open_window, answers, design):
    window = open_window(design)
    window.do("next_scene")
    window.do("present")
    first = louder(window, 2.0)
    window.do("next_scene")
    assert window.document.design != first
    louder(window, 3.0)
    window.do("next_scene")
    assert all_scenes()[2].name in title(window)
    assert not answers["asked"]


def test_of_a_scene_that_was_turned_it_is_said_that_it_is_left_as_it_was(open_window, design):
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
    # What was turned back is nothing that could be kept.
    louder(window, 2.0)
    window.do("undo")
    window.do("next_scene")
    assert "kept" not in window.notice.text
    # By hand, too.
    before = window.document.design.inputs[0].amplitude
    louder(window, 2.0 * before)
    louder(window, before)
    window.do("next_scene")
    assert "kept" not in window.notice.text


@pytest.mark.parametrize("presented", ["afterwards", "before"])
def test_work_that_was_done_in_a_scene_is_not_lost_unasked(open_window, answers, presented, design):
    window = open_window(design)
    window.do("next_scene")
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
    (notes,) = [
        widget for widget in QApplication.topLevelWidgets() if isinstance(widget, NotesWindow)
    ]
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
    (notes,) = [
        widget for widget in QApplication.topLevelWidgets() if isinstance(widget, NotesWindow)
    ]
    notes.activateWindow()
    notes.notes.setFocus()
    qtbot.waitUntil(notes.isActiveWindow)
    QTest.keyClick(notes.notes, Qt.Key.Key_B)
    assert studio.presenter.covered
    QTest.keyClick(notes.notes, leave)
    assert not studio.presenter.presenting
    assert not notes.isVisible()
