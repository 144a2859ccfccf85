"""Other programs, windows and studios have a hand in files too; settings lie in their folder."""

import os
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QByteArray, QEvent
from PySide6.QtWidgets import QApplication, QMessageBox, QWidget

from skinsource import Design, Input, open_design, save_design, track
from skinsource.base import files, lock
from skinsource.base.assets import config_folder
from skinsource.base.lock import Lock, read_owner, this_process, to_bytes
from skinsource.design import design_file
from skinsource_gui.pages.files import file_actions
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import Preferences, settings_path

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


def test_a_file_that_another_program_changed_is_not_replaced_unasked(window, opened, answers):
    save_design(opened, OTHER)
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


def test_two_windows_on_one_file_notice_each_other(window, opened, answers, preferences, qtbot):
    frame, document = QWidget(), Document(OTHER)
    qtbot.addWidget(frame)
    other = FileActions(document, preferences, frame, lambda: b"")
    other.open(opened)
    document.edit("Place", document.design.adding(track(location=9)))
    assert other.save()
    activate(window)
    assert "was changed by another program, or in another window" in window.notice.text
    assert not window.files.save()
    assert [track.location for track in open_design(opened).design.inputs] == [4, 9]


def test_a_design_whose_file_was_deleted_counts_as_modified(window, opened, answers):
    assert window.files.save()
    assert not window.document.modified
    opened.unlink()
    activate(window)
    assert window.document.modified
    assert window.isWindowModified()
    assert f"shared.skinsource is no longer in {opened.parent}" in window.notice.text
    window.files.new()
    assert len(answers["asked"]) == 1
    assert window.document.path == opened
    assert window.files.save()
    assert not window.document.modified
    assert opened.exists()


def test_closing_looks_once_more_whether_the_file_is_there(window, opened, answers):
    assert window.files.save()
    opened.unlink()
    window.close()
    assert len(answers["asked"]) == 1
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

    monkeypatch.setattr(lock, "still_runs", still_runs)
    monkeypatch.setattr("skinsource.base.lock.still_runs", still_runs)
    monkeypatch.setattr(file_actions, "still_runs", still_runs)
    return state


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
    Lock(path).path.write_bytes(to_bytes(HOLDER))
    window.files.open(path)
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
    Lock(path).path.write_bytes(to_bytes(HOLDER))
    window.files.open(path)
    place(window)
    other_runs["runs"] = False
    assert window.files.save()
    assert answers["asked"] == []
    assert open_design(path).design == window.document.design
    assert not window.document.read_only


def test_a_studio_elsewhere_may_have_ended_and_only_the_user_knows(
    window, path, other_runs, answers
):
    Lock(path).path.write_bytes(to_bytes(ELSEWHERE))
    window.files.open(path)
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


@pytest.fixture
def config(tmp_path, monkeypatch) -> Path:
    folder = tmp_path / "config"
    monkeypatch.setenv("SKINSOURCE_CONFIG", str(folder))
    return folder


def test_a_folder_for_settings_of_its_own_isolates_them(config):
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
