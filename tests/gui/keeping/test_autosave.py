"""Copies of unsaved work: when they are kept, and when they go."""

import shutil
from dataclasses import replace

import pytest
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QMessageBox

from skinsource.base.job import Job
from skinsource.base.lock import Lock
from skinsource.design.design import Design, track
from skinsource.design.design_file import open_design, save_design
from skinsource_gui.pages.files.autosave import FIRST_S
from skinsource_gui.state.preferences import AUTOSAVE_S
from tests.gui.keeping.bench import copies, edit, saved_amplitudes
from tests.gui.keeping.test_left_over import leave


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setenv("SKINSOURCE_AUTOSAVE_S", "0.05")


@pytest.fixture
def discard(monkeypatch):
    discard = QMessageBox.StandardButton.Discard
    monkeypatch.setattr(QMessageBox, "question", lambda *_: discard)


def test_work_is_kept_within_the_interval_with_arrangement_and_picture(
    quick, make_window, qtbot, user_data
):
    window = make_window()
    edit(window, 2.5)
    qtbot.waitUntil(lambda: len(list(user_data.glob("unsaved/*/*.png"))) == 1, timeout=30_000)
    (copy,) = copies(user_data)
    content = open_design(copy)
    assert content.design == window.document.design
    assert content.view == window.document.view
    assert content.layout == window.workspaces.content()
    picture = QImage(str(copy.with_suffix(".png")))
    assert {picture.pixelColor(x, y).name() for x in range(120) for y in range(180)} > {"#ffffff"}
    edit(window, 3.5)
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [2.5, 3.5], timeout=30_000)


def test_saved_or_taken_back_work_has_no_copies(quick, make_window, qtbot, user_data, tmp_path):
    window = make_window()
    edit(window, 2.5)
    qtbot.waitUntil(lambda: copies(user_data) != [], timeout=30_000)
    window.document.undo_stack.undo()
    qtbot.waitUntil(lambda: copies(user_data) == [], timeout=30_000)
    window.document.undo_stack.redo()
    qtbot.waitUntil(lambda: copies(user_data) != [], timeout=30_000)
    window.document.mark_saved(tmp_path / "a.skinsource")
    qtbot.waitUntil(lambda: copies(user_data) == [], timeout=30_000)


def test_a_copy_is_kept_before_another_file_is_read(window, user_data, tmp_path, discard):
    edit(window, 2.5)
    assert copies(user_data) == []
    path = tmp_path / "hostile.skinsource"
    path.write_bytes(b"hostile")
    window.files.open(path)
    assert saved_amplitudes(user_data) == [2.5]
    save_design(path, window.document.design)
    window.files.open(path)
    window.close()
    assert copies(user_data) == []


def test_a_copy_is_kept_before_a_job_and_before_another_limb(window, qtbot, user_data):
    edit(window, 2.5)
    amplitudes = []
    window.runner.add(
        Job("Installing", lambda *, progress, stop: amplitudes.extend(saved_amplitudes(user_data)))
    )
    qtbot.waitUntil(lambda: not window.runner.busy, timeout=30_000)
    assert amplitudes == [2.5]
    edit(window, 3.5)
    window.document.edit("limb", replace(window.document.design, limb="synthetic-2"))
    assert saved_amplitudes(user_data) == [2.5, 3.5]
    assert open_design(copies(user_data)[-1]).design.limb == "synthetic-1"


def test_a_window_that_closes_leaves_no_copy(quick, make_window, qtbot, user_data, discard):
    window = make_window()
    edit(window, 2.5)
    qtbot.waitUntil(lambda: copies(user_data) != [], timeout=30_000)
    window.close()
    assert copies(user_data) == []


def test_a_folder_that_cannot_be_written_is_told_once(quick, make_window, qtbot, user_data):
    (user_data / "unsaved").write_text("a file stands there")
    window = make_window()
    messages = []
    window.keeping.autosave.failed.connect(messages.append)
    edit(window, 2.0)
    qtbot.waitUntil(lambda: len(messages) == 1, timeout=30_000)
    assert "No copy of unsaved work could be kept" in window.notice.text
    for amplitude in (3.0, 4.0):
        edit(window, amplitude)
        assert not window.keeping.autosave.keep_now()
    (user_data / "unsaved").unlink()
    assert window.keeping.autosave.keep_now()
    assert len(messages) == 1


def test_the_first_copy_is_kept_soon_and_the_next_ones_by_the_interval(
    make_window, qtbot, user_data
):
    window = make_window()
    autosave = window.keeping.autosave
    assert autosave._intervals_s == (FIRST_S, AUTOSAVE_S)
    autosave._intervals_s = (0.05, AUTOSAVE_S)
    edit(window, 2.5)
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [2.5], timeout=30_000)
    edit(window, 3.5)
    assert autosave._timer.remainingTime() > 1000 * AUTOSAVE_S / 2
    # What is taken back is no work any more; what comes then is new.
    window.document.go_to(0)
    qtbot.waitUntil(lambda: copies(user_data) == [], timeout=30_000)
    edit(window, 4.5)
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [4.5], timeout=30_000)


def test_a_design_that_was_emptied_by_hand_is_asked_about_and_its_copies_stay(
    quick, make_window, qtbot, user_data, monkeypatch
):
    window = make_window(Design(limb="synthetic-1"))
    window.document.edit("add", window.document.design.adding(track(7)))
    qtbot.waitUntil(lambda: copies(user_data) != [], timeout=30_000)
    (copy,) = copies(user_data)
    window.do("clear_inputs")
    assert window.isWindowModified()
    qtbot.waitUntil(lambda: len(copies(user_data)) == 2, timeout=30_000)
    assert copy in copies(user_data)
    asked = []
    cancel = QMessageBox.StandardButton.Cancel
    monkeypatch.setattr(
        QMessageBox, "question", lambda *arguments: asked.append(arguments[1]) or cancel
    )
    assert not window.close()
    assert asked == ["Unsaved design"]


__all__ = ["leave"]


def test_a_copy_that_could_not_be_written_is_tried_again_though_nothing_is_edited(
    quick, make_window, qtbot, user_data
):
    window = make_window()
    (user_data / "unsaved").write_bytes(b"no folder")
    edit(window, 2.5)
    qtbot.waitUntil(lambda: "No copy of unsaved work" in window.notice.text, timeout=30_000)
    (user_data / "unsaved").unlink()
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [2.5], timeout=30_000)


def test_copies_go_on_where_their_folder_was_deleted(window, user_data):
    edit(window, 2.5)
    assert window.keeping.autosave.keep_now()
    shutil.rmtree(user_data / "unsaved")
    assert window.keeping.autosave.keep_now()
    assert saved_amplitudes(user_data) == [2.5]
    shutil.rmtree(user_data / "unsaved")
    edit(window, 3.5)
    assert window.keeping.autosave.keep_now()
    (copy,) = copies(user_data)
    assert (copy.parent / "owner").is_file()


def test_a_file_is_given_up_when_left_over_work_takes_its_place(window, leave, tmp_path):
    leave(2.5)
    path = tmp_path / "a.skinsource"
    save_design(path, window.document.design)
    window.files.open(path)
    lock = Lock(path).path
    assert lock.exists()
    window.keeping.recovery.open(window.keeping.recovery.look().left[0])
    assert window.document.path is None
    assert not lock.exists()
