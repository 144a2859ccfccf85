"""Copies of unsaved work: when they are kept, when they go, and what ended studios left."""

import re
import shutil
from contextlib import suppress
from dataclasses import replace
from types import SimpleNamespace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QFileDialog, QMessageBox

from skinsource import Design, edits, open_design, save_design, track
from skinsource.base.job import Job
from skinsource.base.lock import Lock, this_process, to_bytes
from skinsource.design import recovery as left_over
from skinsource.design.recovery import OWNER
from skinsource_gui.pages.files.autosave import Autosave
from skinsource_gui.shell.keeping import UnsavedWorkPage
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import start_design

ENDED = to_bytes(replace(this_process(), started_s=1000.0))


def choice(window, text):
    QApplication.processEvents()
    return next(button for button in window.notice._choices if button.text() == text)


def choose(window, text):
    choice(window, text).click()


@pytest.fixture
def leave(window, user_data):
    """Leave work and a snapshot of it, as a studio that was killed; the window begins anew."""

    def killed(*amplitudes):
        before = set(user_data.glob("unsaved/*"))
        start = window.document.design
        for amplitude in amplitudes:
            edit(window, amplitude)
            window.do("store_snapshot_1")
            assert window.keeping.autosave.keep_now()
        (folder,) = set(user_data.glob("unsaved/*")) - before
        left = folder.rename(folder.with_name(f"{folder.name}{len(before)}"))
        (left / OWNER).write_bytes(ENDED)
        window.document.start_over(start, window.document.view, None)
        return left

    return killed


def test_left_over_work_is_offered_with_its_picture_and_unsaved_until_it_is_saved(
    window, leave, qtbot, user_data, tmp_path
):
    leave(2.5)
    window.docks["spectra"].hide()
    window.keeping.offer(window.notice)
    assert "before your work on untitled was saved" in window.notice.text
    assert f"from {window.keeping.recovery.look().left[0].clock()}; it may" in window.notice.text
    picture = window.notice._picture
    assert picture.isVisible()
    assert picture.pixmap().height() == 90
    # The card stands above the status bar.
    assert window.rect().contains(picture.geometry())
    assert window.notice.card.geometry().bottom() < window.statusBar().y()
    choose(window, "Open it")
    assert window.document.design.inputs[0].amplitude == 2.5
    assert window.document.modified
    assert window.docks["spectra"].isVisible()
    assert not picture.isVisible()
    # Once it is on the screen this studio's own copy takes its place.
    qtbot.waitUntil(lambda: list(user_data.rglob("*.opening")) == [], timeout=30_000)
    assert left_over.find(user_data).left == ()
    assert saved_amplitudes(user_data) == [2.5]
    edit(window, 3.5)
    window.document.go_to(0)
    assert window.document.design.inputs[0].amplitude == 2.5
    assert window.isWindowModified()
    window.document.mark_saved(tmp_path / "a.skinsource")
    assert not window.isWindowModified()


def test_a_mark_lies_beside_a_copy_until_its_results_are_shown(window, leave, user_data):
    leave(2.5)
    window.keeping.recovery.open(window.keeping.recovery.look().left[0])
    assert len(list(user_data.rglob("*.opening"))) == 1
    window.close_unasked()
    assert list(user_data.rglob("*.opening")) == []


def test_where_nothing_can_be_kept_the_left_over_stays(window, leave, qtbot, user_data):
    leave(2.5)
    recovery = window.keeping.recovery
    recovery._keep_now = lambda: False
    recovery.open(recovery.look().left[0])
    qtbot.waitUntil(lambda: list(user_data.rglob("*.opening")) == [], timeout=30_000)
    assert len(left_over.find(user_data).left) == 1


def test_left_over_work_takes_the_place_of_the_open_file_and_is_saved_to_that_of_its_own(
    window, leave, tmp_path, monkeypatch
):
    (leave(2.5) / "file").write_bytes(str(tmp_path / "tap.skinsource").encode())
    path = tmp_path / "a.skinsource"
    save_design(path, window.document.design)
    window.files.open(path)
    lock = Lock(path).path
    assert lock.exists()
    window.keeping.recovery.open(window.keeping.recovery.look().left[0])
    assert window.document.path is None
    assert not lock.exists()
    asked = []
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *arguments: (asked.append(arguments[2]), ("", ""))[1]
    )
    window.do("save_design")
    assert asked == [str(tmp_path / "tap.skinsource")]
    # It has its name, and so has what would be left over of it again.
    assert window.windowTitle().startswith("tap (recovered)[*]")
    assert window.keeping.autosave._look().path == tmp_path / "tap.skinsource"
    window.document.mark_saved(window.document.path)
    window.do("new_design")
    window.do("save_design")
    assert asked[1].endswith("design.skinsource")


def test_left_over_work_can_be_given_up_by_who_agrees(window, leave, user_data, answers):
    leave(2.5)
    window.keeping.offer(window.notice)
    choose(window, "Discard it")
    assert "was saved" in window.notice.text
    answers["question"] = QMessageBox.StandardButton.Yes
    choose(window, "Discard it")
    assert left_over.find(user_data).left == ()
    assert window.document.design.inputs[0].amplitude == 1.0


def test_a_bad_copy_and_one_that_ended_the_studio_are_set_aside_and_named(window, leave, user_data):
    leave(2.5, 3.5, 4.5)
    _, bad, newest = copies(user_data)
    newest.with_name(f"{newest.name}.opening").write_bytes(b"")
    bad.write_bytes(b"damaged")
    window.keeping.offer(window.notice)
    assert f"{newest.name} stopped the studio when it was opened" in window.notice.text
    choose(window, "Open it")
    assert window.document.design.inputs[0].amplitude == 2.5
    assert bad.name in window.notice.text
    assert "An earlier copy was opened instead" in window.notice.text
    assert (user_data / "unsaved" / left_over.ASIDE / bad.name).read_bytes() == b"damaged"


def test_several_are_offered_in_a_list(window, leave, answers):
    leave(2.5)
    window.document.edit("", replace(window.document.design, title="A: tone/2"))
    leave(3.5)
    window.keeping.offer(window.notice)
    assert "Copies were stored of 2 designs" in window.notice.text
    choose(window, "Show them…")
    (page,) = window.findChildren(UnsavedWorkPage)
    assert page.rows.count() == 2
    assert page.rows.item(0).text().startswith("A tone2, copied")
    assert re.match(r"untitled, copied at \d\d:\d\d:\d\d\n", page.rows.item(1).text())
    assert not page.rows.item(0).icon().isNull()
    answers["question"] = QMessageBox.StandardButton.Yes
    page.discard_button.click()
    assert page.rows.count() == 1
    page.open_button.click()
    assert window.document.design.inputs[0].amplitude == 2.5
    assert not page.isVisible()


def test_a_file_that_could_not_be_opened_at_start_is_said_with_the_offer(window, leave, tmp_path):
    leave(2.5)
    window.files.open(tmp_path / "gone.skinsource")
    complaint = window.notice.text
    assert "gone.skinsource" in complaint
    window.notice.say(complaint.rstrip("."))
    window.keeping.offer(window.notice)
    assert f"{complaint.rstrip('.')}. The studio ended" in window.notice.text
    choose(window, "Open it")
    assert window.document.design.inputs[0].amplitude == 2.5


def test_without_left_over_work_nothing_is_offered_and_the_page_says_so(window):
    window.do("show_left_over")
    (page,) = window.findChildren(UnsavedWorkPage)
    assert not page.open_button.isEnabled()
    assert "No earlier session" in page.message.text()
    page.close()
    window.keeping.offer(window.notice)
    assert window.notice.text == ""


def test_the_log_of_a_crash_is_offered_once_and_moves_not_what_discards_work(
    window, leave, user_data, monkeypatch, tmp_path
):
    log = user_data / "logs" / "studio-20260101-000000-1.log"
    log.parent.mkdir()
    text = f"SkinSource studio\n{ENDED.decode()}\n2026\nFatal Python error\n"
    log.write_text(text)
    window.keeping.offer(window.notice)
    assert "The studio crashed" in window.notice.text
    assert window.notice.text.endswith("No copy of unsaved work is left.")
    target = tmp_path / "saved.log"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(target), ""))
    choose(window, "Save the log…")
    assert target.read_text().startswith(text)
    window.keeping.offer(window.notice)
    assert window.notice.text == ""
    leave(2.5)
    window.keeping.offer(window.notice)
    before = choice(window, "Discard it").x()
    log.write_text(text)
    window.keeping.offer(window.notice)
    assert choice(window, "Save the log…")
    assert choice(window, "Discard it").x() == before


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
    assert 30_000 < work.autosave._timer.remainingTime() < 70_000
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


def edit(window, amplitude):
    window.document.edit("a", window.document.design.with_input(0, amplitude=amplitude))


def copies(folder):
    while True:
        # One may be deleted while they are looked at: look again.
        with suppress(FileNotFoundError):
            copies = folder.glob("unsaved/*/*.skinsource")
            return sorted(copies, key=lambda path: path.stat().st_mtime_ns)


def saved_amplitudes(folder):
    return [open_design(path).design.inputs[0].amplitude for path in copies(folder)]


@pytest.fixture
def window(new_window):
    return new_window
