"""Copies of unsaved work after something went wrong, and the file that is left for them."""

import shutil

import pytest

from skinsource.base.lock import Lock
from skinsource.design import design_file
from skinsource.design.design_file import save_design
from skinsource.design.recovery import Session
from skinsource_gui.pages.files import autosave
from tests.gui.keeping.bench import copies, edit, saved_amplitudes
from tests.gui.keeping.test_left_over import leave

__all__ = ["leave"]


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setenv("SKINSOURCE_AUTOSAVE_S", "0.05")


def test_a_copy_that_could_not_be_written_is_tried_again_though_nothing_is_edited(
    quick, make_window, qtbot, user_data
):
    window = make_window()
    (user_data / "unsaved").write_bytes(b"no folder")
    edit(window, 2.5)
    qtbot.waitUntil(lambda: "No copy of unsaved work" in window.notice.text, timeout=30_000)
    (user_data / "unsaved").unlink()
    qtbot.waitUntil(lambda: saved_amplitudes(user_data) == [2.5], timeout=30_000)


def test_a_mistake_while_a_copy_is_written_is_told(make_window, qtbot, monkeypatch):
    window = make_window()
    monkeypatch.setattr(autosave, "png_of", lambda _: 1 / 0)
    edit(window, 2.5)
    assert not window.keeping.autosave.keep_now()
    qtbot.waitUntil(lambda: "ZeroDivisionError" in window.notice.text)


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


def test_a_session_writes_again_what_somebody_deleted(user_data, window):
    session = Session(user_data)
    content = design_file.DesignFile(design=window.document.design)
    first = session.keep(content)
    first.unlink()
    assert session.keep(content).is_file()
