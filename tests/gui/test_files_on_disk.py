"""Files of designs, in which others have a hand too; settings lie in their folder."""

import os
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QByteArray, QEvent, QTimer
from PySide6.QtGui import QColor, QDragEnterEvent, QImage
from PySide6.QtWidgets import QApplication, QFileDialog, QMessageBox, QWidget

from skinsource import Design, Input, open_design, save_design, track
from skinsource.base import files, lock
from skinsource.base.assets import config_folder
from skinsource.base.lock import Lock, read_owner, this_process, to_bytes
from skinsource.design import design_file
from skinsource_gui.pages.files import file_actions
from skinsource_gui.plots.pictures import PictureOptions
from skinsource_gui.qt.questions import ask_to_save
from skinsource_gui.qt.theme import DARK
from skinsource_gui.state.preferences import Preferences, settings_path
from tests.gui.exporting import press, shown
from tests.gui.importing.test_import_page import drop

OTHER = Design(limb="synthetic-2", inputs=(track(location=13),))


@pytest.fixture
def opened(window, answers, tmp_path) -> Path:
    """A file that the window has open, with an edit that is not saved yet."""
    path = tmp_path / "shared.skinsource"
    save_design(path, Design(limb="synthetic-1", inputs=(track(location=4),)))
    window.files.open(path)
    place(window)
    return path


def place(window, location=3):
    window.document.edit("Place", window.document.design.adding(track(location=location)))


def activate(window):
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))


def test_opening_a_design_reads_its_file_once(window, tmp_path, monkeypatch):
    path, reads = tmp_path / "once.skinsource", []
    save_design(path, OTHER)

    def count(file, *, most):
        reads.append(file)
        return files.read_bytes(file, most=most)

    for module in (design_file, file_actions):
        monkeypatch.setattr(module, "read_bytes", count)
    window.files.open(path)
    assert window.document.design == OTHER
    window.files.look_at_disk()
    assert reads == [path]


def test_a_file_is_named_after_the_title_in_letters_that_all_systems_take(window, monkeypatch):
    asked = []
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *how: asked.append(Path(how[2]).name) or ("", "")
    )
    window.scenes.open("2A")
    names = {"": "design", "Über: Tap/tone, 2.5 Hz?": "Über Tap tone, 2.5 Hz", "..": "design"}
    for title in names:
        window.document.edit("", replace(window.document.design, title=title))
        assert not window.files.save()
    assert asked == [f"{name}.skinsource" for name in names.values()]


def test_a_file_that_another_program_changed_is_not_replaced_unasked(window, opened, answers):
    save_design(opened, OTHER)
    activate(window)
    assert "was changed by another program, or in another window" in window.notice.text
    assert not window.files.save()
    assert len(answers["asked"]) == 1
    assert "shared.skinsource was changed by another program" in answers["asked"][0]
    assert open_design(opened).design == OTHER
    assert window.document.modified
    answers["question"] = QMessageBox.StandardButton.Yes
    assert window.files.save()
    assert open_design(opened).design == window.document.design
    place(window)
    assert window.files.save()
    assert len(answers["asked"]) == 2


def test_a_file_that_was_only_touched_is_saved_unasked(window, opened, answers):
    content = opened.read_bytes()
    opened.unlink()
    opened.write_bytes(content)
    os.utime(opened, times=(1e9, 1e9))
    activate(window)
    assert window.files.save()
    assert answers["asked"] == []
    assert window.notice.text == ""


def test_a_design_whose_file_was_deleted_counts_as_modified(window, opened, answers):
    assert window.files.save()
    assert not window.document.modified
    opened.unlink()
    activate(window)
    assert window.isWindowModified()
    assert f"shared.skinsource is no longer in {opened.parent}" in window.notice.text
    window.files.new()
    assert len(answers["asked"]) == 1
    assert window.document.path == opened
    assert window.files.save()
    assert not window.document.modified
    # Closing looks once more whether it is there.
    opened.unlink()
    window.close()
    assert len(answers["asked"]) == 2
    assert window.isVisible()
    answers["question"] = QMessageBox.StandardButton.Discard
    window.close()
    assert not window.isVisible()


HOLDER = replace(this_process(), pid=4_000_000, user="ana")
ELSEWHERE = replace(HOLDER, host="lab-3")
SAVED = Design(limb="synthetic-1", inputs=(Input(location=4),))


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "tap.skinsource"
    save_design(path, SAVED)
    return path


@pytest.fixture
def other_runs(monkeypatch):
    """Let the other process run, as long as the value is true."""
    state = {"runs": True}

    def still_runs(holder):
        return {HOLDER.pid: state["runs"]}.get(holder.pid) if holder.host == HOLDER.host else None

    for module in (lock, file_actions):
        monkeypatch.setattr(module, "still_runs", still_runs)
    return state


def open_held(window, path, holder):
    Lock(path).path.write_bytes(to_bytes(holder))
    window.files.open(path)


def test_an_open_file_is_held_until_another_is_opened_or_the_window_closes(window, path, tmp_path):
    second = tmp_path / "second.skinsource"
    save_design(second, SAVED)
    window.files.open(path)
    assert read_owner(Lock(path).path) == this_process()
    window.files.open(second)
    assert not Lock(path).path.exists()
    assert read_owner(Lock(second).path) == this_process()
    window.close()
    assert not Lock(second).path.exists()


def test_the_second_studio_opens_it_read_only_and_says_who_has_it(
    window, path, other_runs, answers, tmp_path
):
    open_held(window, path, HOLDER)
    assert window.document.design == SAVED
    assert window.document.read_only
    assert "read-only" in window.windowTitle()
    assert f"tap.skinsource is open in another studio (ana on {HOLDER.host}" in window.notice.text
    place(window)
    answers["save"] = str(tmp_path / "mine.skinsource")
    assert window.files.save()
    assert open_design(path).design == SAVED
    assert open_design(tmp_path / "mine.skinsource").design == window.document.design
    assert not window.document.read_only
    assert "read-only" not in window.windowTitle()
    assert read_owner(Lock(path).path) == HOLDER


def test_once_the_other_studio_has_ended_the_file_is_ours(window, path, other_runs, answers):
    open_held(window, path, HOLDER)
    place(window)
    other_runs["runs"] = False
    assert window.files.save()
    assert answers["asked"] == []
    assert open_design(path).design == window.document.design
    assert not window.document.read_only


def test_a_studio_elsewhere_may_have_ended_and_only_the_user_knows(
    window, path, other_runs, answers
):
    open_held(window, path, ELSEWHERE)
    place(window)
    answers["save"] = str(path)
    assert not window.files.save()
    assert "ana on lab-3" in answers["asked"][0]
    assert read_owner(Lock(path).path) == ELSEWHERE
    answers["question"] = QMessageBox.StandardButton.Yes
    assert window.files.save()
    assert read_owner(Lock(path).path) == this_process()
    assert open_design(path).design == window.document.design


def test_a_file_that_cannot_be_saved_keeps_the_lock_of_the_one_that_is_open(
    window, path, answers, tmp_path
):
    window.files.open(path)
    place(window)
    answers["save"] = str(tmp_path / "absent" / "a.skinsource")
    assert not window.files.ask_and_save()
    assert read_owner(Lock(path).path) == this_process()


def test_a_folder_for_settings_of_its_own_isolates_them(tmp_path, monkeypatch):
    config = tmp_path / "config"
    monkeypatch.setenv("SKINSOURCE_CONFIG", str(config))
    assert settings_path() == config / "studio.ini"
    assert not config.exists()


def test_whoever_sets_the_data_folder_has_everything_in_it(user_data, monkeypatch):
    monkeypatch.delenv("SKINSOURCE_CONFIG", raising=False)
    assert user_data in config_folder().parents
    monkeypatch.delenv("SKINSOURCE_DATA")
    assert config_folder().name == "skinsource"


@pytest.mark.parametrize("stored", [QByteArray(b"abc"), 5, {"a": 1}, None])
def test_recent_files_that_are_no_list_of_names_are_none(tmp_path, stored):
    preferences = Preferences(tmp_path / "studio.ini")
    preferences.settings.setValue("recent", stored)
    assert all(isinstance(name, str) for name in preferences.recent_names)
    assert len(preferences.recent_names) <= 1


def test_a_saved_design_comes_back_with_its_view_in_ones_panels(window, settle, answers, tmp_path):
    place(window)
    panels = (("skin", (("map_range_db", (-40.0, 0.0)),)),)
    window.document.look(replace(window.document.view, outputs=(1, 61), panels=panels))
    window.docks["spectra"].hide()
    design, view = window.document.design, window.document.view
    answers["save"] = str(tmp_path / "tap")
    window.do("save_design")
    assert not window.document.modified
    assert window.document.path == tmp_path / "tap.skinsource"
    answers["question"] = QMessageBox.StandardButton.Discard
    window.do("new_design")
    assert window.document.design.inputs == ()
    window.docks["spectra"].show()
    window.docks["traces"].hide()
    answers["open"] = str(tmp_path / "tap.skinsource")
    window.do("open_design")
    settle()
    assert window.document.design == design
    assert window.document.view == view
    assert window.docks["traces"].isHidden()
    assert not window.docks["spectra"].isHidden()
    assert window.windowTitle().startswith("tap")
    assert not window.document.undo_stack.canUndo()


def test_unsaved_work_is_not_lost_by_opening_closing_a_scene_or_starting_over(
    window, answers, tmp_path
):
    place(window)
    assert window.isWindowModified()
    design = window.document.design
    save_design(tmp_path / "other.skinsource", design)
    window.do("new_design")
    window.files.open(tmp_path / "other.skinsource")
    window.scenes.open("2F")
    window.close()
    assert len(answers["asked"]) == 4
    assert window.document.design == design
    assert window.isVisible()
    answers["question"] = QMessageBox.StandardButton.Save
    answers["save"] = str(tmp_path / "kept.skinsource")
    window.close()
    assert not window.isVisible()
    assert open_design(tmp_path / "kept.skinsource").design == design


def test_a_file_that_is_no_design_is_refused_and_what_is_open_stays(window, answers, tmp_path):
    path = tmp_path / "song.skinsource"
    path.write_bytes(b"not a design")
    design = window.document.design
    window.files.open(path)
    assert "song.skinsource" in window.notice.text
    assert window.document.design is design


def test_recent_files_are_offered_newest_first_and_missing_ones_dropped(
    window, answers, tmp_path, preferences
):
    for name in ("one", "two"):
        place(window)
        answers["save"] = str(tmp_path / f"{name}.skinsource")
        window.do("save_design_as")
    assert [Path(name).stem for name in window.preferences.recent_names] == ["two", "one"]
    (tmp_path / "one.skinsource").unlink()
    window.files.open(tmp_path / "one.skinsource")
    assert [Path(name).stem for name in window.preferences.recent_names] == ["two"]
    menu = window.findChild(type(window.menuBar().addMenu("x")), "open_recent")
    menu.aboutToShow.emit()
    assert [entry.text() for entry in menu.actions()] == ["two.skinsource"]


def test_the_picture_has_the_size_and_colours_asked_for_and_they_are_kept(
    window, answers, tmp_path
):
    answers["save"] = str(tmp_path / "map.png")
    part = shown(window, "picture")
    for name, value in (("width_px", 500.0), ("height_px", 400.0), ("colours", "dark")):
        part.form._edit(name, value, None)
    preview = part.image.image
    assert QColor(preview.pixel(2, 2)).name() == DARK.base
    assert preview.width() / preview.height() == pytest.approx(1.25, rel=0.01)
    press(part)
    picture = QImage(answers["save"])
    assert (picture.width(), picture.height()) == (500, 400)
    assert QColor(picture.pixel(2, 2)).name() == DARK.base
    kept = PictureOptions(width_px=500, height_px=400, colours="dark")
    assert shown(window, "picture").form.options == kept
    window.exports.end()
    assert answers["asked"] == []


def test_an_existing_file_is_not_replaced_behind_the_dialog(window, answers, tmp_path):
    (tmp_path / "old.skinsource").write_bytes(b"precious")
    place(window)
    answers["save"] = str(tmp_path / "old")
    window.do("save_design")
    assert len(answers["asked"]) == 1
    assert (tmp_path / "old.skinsource").read_bytes() == b"precious"
    assert window.document.modified


def test_a_file_dropped_on_the_window_is_opened(window, settle, answers, tmp_path):
    place(window)
    answers["save"] = str(tmp_path / "a.skinsource")
    window.do("save_design")
    design = window.document.design
    window.do("new_design")
    middle = window.panel("traces").mapTo(window, window.panel("traces").rect().center())
    assert drop(window, tmp_path / "a.skinsource", middle, QDragEnterEvent).isAccepted()
    drop(window, tmp_path / "a.skinsource", middle)
    assert window.document.design == design


def test_a_key_discards(qtbot):
    owner, keys = QWidget(), []
    qtbot.addWidget(owner)

    def look():
        box = QApplication.activeModalWidget()
        keys.append(box.button(QMessageBox.StandardButton.Discard).shortcut().toString())
        box.reject()

    # After what the question does when it opens.
    QTimer.singleShot(0, lambda: QTimer.singleShot(0, look))
    assert not ask_to_save(owner, "Unsaved design", "Save?", lambda: False)
    assert keys == ["Alt+D"]
