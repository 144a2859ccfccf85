"""Other programs, and other windows, have a hand in files too."""

import os
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QApplication, QMessageBox, QWidget

from skinsource.base import files
from skinsource.design import design_file
from skinsource.design.design import Design, track
from skinsource.design.design_file import open_design, save_design
from skinsource_gui.pages.files import file_actions
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.state.document import Document

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
