"""Copies of unsaved work: when they are kept, and when they go."""

import shutil
from dataclasses import replace
from types import SimpleNamespace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QMessageBox

from skinsource.base.job import Job
from skinsource.base.lock import Lock
from skinsource.design import edits
from skinsource.design.design import Design, track
from skinsource.design.design_file import open_design, save_design
from skinsource_gui.pages.files.autosave import Autosave
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import start_design
from tests.gui.keeping.bench import copies, edit, saved_amplitudes
from tests.gui.keeping.test_left_over import leave

__all__ = ["leave"]

WAIT = {"timeout": 30_000}


@pytest.fixture
def make_work(qapp, user_data):
    """A document whose work is kept, without a window."""
    kept = []

    def make(design=None, interval_s=0.05, first_s=0.05, pause_s=60.0):
        document = Document(design or start_design("synthetic-1"))
        parts = lambda: b"", lambda _: QImage()
        autosave = Autosave(document, user_data, interval_s, *parts, document, first_s, pause_s)
        kept.append(autosave)
        return SimpleNamespace(document=document, autosave=autosave)

    yield make
    for autosave in kept:
        autosave.end()


@pytest.fixture
def work(make_work):
    return make_work()


def test_work_is_kept_within_the_interval_with_arrangement_and_picture(
    make_window, qtbot, user_data, monkeypatch
):
    monkeypatch.setenv("SKINSOURCE_AUTOSAVE_S", "0.05")
    window = make_window()
    edit(window, 2.5)
    qtbot.waitUntil(lambda: len(list(user_data.glob("unsaved/*/*.png"))) == 1, **WAIT)
    (copy,) = copies(user_data)
    content = open_design(copy)
    assert content.design == window.document.design
    assert content.view == window.document.view
    assert content.layout == window.workspaces.content()
    picture = QImage(str(copy.with_suffix(".png")))
    assert {picture.pixelColor(x, y).name() for x in range(120) for y in range(180)} > {"#ffffff"}
    edit(window, 3.5)
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [2.5, 3.5], **WAIT)


def test_saved_or_taken_back_work_has_no_copies(work, qtbot, user_data, tmp_path):
    edit(work, 2.5)
    qtbot.waitUntil(lambda: copies(user_data) != [], **WAIT)
    work.document.undo_stack.undo()
    qtbot.waitUntil(lambda: copies(user_data) == [], **WAIT)
    work.document.undo_stack.redo()
    qtbot.waitUntil(lambda: copies(user_data) != [], **WAIT)
    work.document.mark_saved(tmp_path / "a.skinsource")
    qtbot.waitUntil(lambda: copies(user_data) == [], **WAIT)


def test_a_copy_is_kept_before_another_file_is_read_and_a_window_that_closes_leaves_none(
    window, qtbot, user_data, tmp_path, answers
):
    answers["question"] = QMessageBox.StandardButton.Discard
    edit(window, 2.5)
    assert copies(user_data) == []
    path = tmp_path / "hostile.skinsource"
    path.write_bytes(b"hostile")
    window.files.open(path)
    assert saved_amplitudes(user_data) == [2.5]
    edit(window, 3.0)
    amplitudes = []
    window.runner.add(
        Job("Installing", lambda *, progress, stop: amplitudes.extend(saved_amplitudes(user_data)))
    )
    qtbot.waitUntil(lambda: not window.runner.busy, **WAIT)
    assert amplitudes[-1] == 3.0
    window.close()
    assert copies(user_data) == []


def test_a_copy_is_kept_before_another_limb(make_work, user_data):
    work = make_work(interval_s=60.0, first_s=60.0)
    edit(work, 3.5)
    work.document.edit("limb", replace(work.document.design, limb="synthetic-2"))
    assert saved_amplitudes(user_data) == [3.5]
    assert open_design(copies(user_data)[-1]).design.limb == "synthetic-1"


def test_a_folder_that_cannot_be_written_is_told_once_and_tried_again(work, qtbot, user_data):
    (user_data / "unsaved").write_text("a file stands there")
    messages = []
    work.autosave.failed.connect(messages.append)
    edit(work, 2.0)
    qtbot.waitUntil(lambda: len(messages) == 1, **WAIT)
    assert "No copy of unsaved work could be stored" in messages[0]
    edit(work, 3.0)
    assert not work.autosave.keep_now()
    # Nothing is edited meanwhile.
    (user_data / "unsaved").unlink()
    qtbot.waitUntil(lambda: saved_amplitudes(user_data)[-1:] == [3.0], **WAIT)
    assert len(messages) == 1


def test_the_first_copy_is_kept_soon_and_the_next_ones_by_the_interval(make_work, qtbot, user_data):
    work = make_work(interval_s=60.0)
    edit(work, 2.5)
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [2.5], **WAIT)
    edit(work, 3.5)
    assert work.autosave._timer.remainingTime() > 30_000
    # What is taken back is no work any more; what comes then is new.
    work.document.go_to(0)
    qtbot.waitUntil(lambda: copies(user_data) == [], **WAIT)
    edit(work, 4.5)
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [4.5], **WAIT)


def test_a_copy_is_kept_when_edits_pause_but_not_while_the_mouse_is_down(
    make_work, qtbot, user_data, monkeypatch
):
    work = make_work(interval_s=60.0, first_s=60.0, pause_s=0.05)
    edit(work, 2.5)
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [2.5], **WAIT)
    edit(work, 3.5)
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [2.5, 3.5], **WAIT)
    asked, down = [], Qt.MouseButton.LeftButton
    monkeypatch.setattr(QApplication, "mouseButtons", lambda: asked.append(True) or down)
    edit(work, 4.5)
    qtbot.waitUntil(lambda: len(asked) > 1, **WAIT)
    assert saved_amplitudes(user_data) == [2.5, 3.5]
    monkeypatch.setattr(QApplication, "mouseButtons", lambda: Qt.MouseButton.NoButton)
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [2.5, 3.5, 4.5], **WAIT)


def test_copies_of_a_design_that_was_emptied_by_hand_stay(make_work, qtbot, user_data):
    document = make_work(Design(limb="synthetic-1")).document
    document.edit("add", document.design.adding(track(7)))
    qtbot.waitUntil(lambda: copies(user_data) != [], **WAIT)
    (copy,) = copies(user_data)
    document.apply(edits.clear_inputs(document.design, document.view))
    qtbot.waitUntil(lambda: len(copies(user_data)) == 2, **WAIT)
    assert copy in copies(user_data)


def test_copies_go_on_where_their_folder_was_deleted(work, user_data):
    edit(work, 2.5)
    assert work.autosave.keep_now()
    shutil.rmtree(user_data / "unsaved")
    edit(work, 3.5)
    assert work.autosave.keep_now()
    assert saved_amplitudes(user_data) == [3.5]
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
