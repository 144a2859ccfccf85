"""Copies of unsaved work, and what is done with those of ended studios."""

import os
from dataclasses import replace

import pytest
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QFileDialog, QMessageBox, QPushButton

from skinsource.design_file import open_design, save_design
from skinsource.job import Job
from skinsource.keeping import left_over
from skinsource.keeping.owner import this_process, to_bytes
from skinsource.keeping.session import OWNER
from skinsource_gui.shell.keeping.left_over_page import LeftOverPage
from skinsource_gui.state.preferences import AUTOSAVE_S, Preferences

ENDED = to_bytes(replace(this_process(), started_s=1000.0))


def edit(window, amplitude):
    window.document.edit("a", window.document.design.with_input(0, amplitude=amplitude))


def copies(folder):
    found = folder.glob("unsaved/*/*.skinsource")
    return sorted(found, key=lambda path: path.stat().st_mtime_ns)


def kept_amplitudes(folder):
    return [open_design(path).design.inputs[0].amplitude for path in copies(folder)]


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setenv("SKINSOURCE_AUTOSAVE_S", "0.05")


@pytest.fixture
def discard(monkeypatch):
    discard = QMessageBox.StandardButton.Discard
    monkeypatch.setattr(QMessageBox, "question", lambda *_: discard)


def choose(window, words):
    buttons = window.notice.buttons.findChildren(QPushButton)
    next(one for one in buttons if one.text() == words).click()


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
    assert content.layout == window.layout_of_docks.content()
    picture = QImage(str(copy.with_suffix(".png")))
    assert {picture.pixelColor(x, y).name() for x in range(120) for y in range(180)} > {"#ffffff"}
    edit(window, 3.5)
    qtbot.waitUntil(lambda: kept_amplitudes(user_data) == [2.5, 3.5], timeout=30_000)


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


def test_what_is_only_looked_at_is_not_kept(quick, make_window, user_data):
    window = make_window()
    window.document.look(replace(window.document.view, axes="z"))
    assert not window.keeping.autosave._timer.isActive()
    edit(window, 2.0)
    assert window.keeping.autosave._timer.isActive()


def test_a_copy_is_kept_before_another_file_is_read(window, user_data, tmp_path, discard):
    edit(window, 2.5)
    assert copies(user_data) == []
    path = tmp_path / "hostile.skinsource"
    path.write_bytes(b"hostile")
    window.files.open(path)
    assert kept_amplitudes(user_data) == [2.5]
    save_design(path, window.document.design)
    window.files.open(path)
    window.close()
    assert copies(user_data) == []


def test_a_copy_is_kept_before_a_job_and_before_another_limb(window, qtbot, user_data):
    edit(window, 2.5)
    seen = []
    window.runner.add(
        Job("Installing", lambda *, progress, stop: seen.extend(kept_amplitudes(user_data)))
    )
    qtbot.waitUntil(lambda: not window.runner.busy, timeout=30_000)
    assert seen == [2.5]
    edit(window, 3.5)
    window.document.edit("limb", replace(window.document.design, limb="synthetic-2"))
    assert kept_amplitudes(user_data) == [2.5, 3.5]
    assert open_design(copies(user_data)[-1]).design.limb == "synthetic-1"


def test_a_copy_is_kept_before_a_recording_is_read(window, user_data, tmp_path):
    edit(window, 2.5)
    (tmp_path / "a.csv").write_text("1\n2\n")
    window.imports.open_page(tmp_path / "a.csv")
    assert kept_amplitudes(user_data) == [2.5]
    window.imports.end()


def test_a_window_that_closes_leaves_no_copy(quick, make_window, qtbot, user_data, discard):
    window = make_window()
    edit(window, 2.5)
    qtbot.waitUntil(lambda: copies(user_data) != [], timeout=30_000)
    window.close()
    assert copies(user_data) == []


def test_a_folder_that_cannot_be_written_is_told_once(quick, make_window, qtbot, user_data):
    (user_data / "unsaved").write_text("a file stands there")
    window = make_window()
    told = []
    window.keeping.autosave.failed.connect(told.append)
    edit(window, 2.0)
    qtbot.waitUntil(lambda: len(told) == 1, timeout=30_000)
    assert "No copy of unsaved work could be kept" in window.notice.text
    for amplitude in (3.0, 4.0):
        edit(window, amplitude)
        assert not window.keeping.autosave.keep_now()
    (user_data / "unsaved").unlink()
    assert window.keeping.autosave.keep_now()
    assert len(told) == 1


@pytest.mark.parametrize(
    ("environment", "setting", "seconds"),
    [
        ("0.2", "7", 0.2),
        (None, "7", 7.0),
        ("never", "7", 7.0),
        ("0", "nan", AUTOSAVE_S),
        ("1e9", "-1", AUTOSAVE_S),
    ],
)
def test_the_interval_is_a_preference(tmp_path, monkeypatch, environment, setting, seconds):
    path = tmp_path / "studio.ini"
    path.write_text(f"[General]\nautosave_s={setting}\n")
    if environment:
        monkeypatch.setenv("SKINSOURCE_AUTOSAVE_S", environment)
    assert Preferences(path).autosave_s == seconds


@pytest.fixture
def leave(window, user_data):
    """Leave work in the folder of a studio that was killed; the window begins anew."""

    def killed(*amplitudes):
        before = set(user_data.glob("unsaved/*"))
        start = window.document.design
        for amplitude in amplitudes:
            edit(window, amplitude)
            assert window.keeping.autosave.keep_now()
        (folder,) = set(user_data.glob("unsaved/*")) - before
        left = folder.rename(folder.with_name(f"{folder.name}{len(before)}"))
        (left / OWNER).write_bytes(ENDED)
        window.document.start_over(start, window.document.view, None)
        return left

    return killed


def test_left_over_work_is_offered_with_its_age_and_picture_and_opened_as_not_saved(
    window, leave, qtbot, user_data
):
    leave(2.5)
    window.docks["spectra"].hide()
    window.keeping.offer(window.notice)
    assert "before your work on untitled was saved" in window.notice.text
    assert "A copy was kept less than a minute ago" in window.notice.text
    picture = window.notice._picture
    assert picture.isVisible()
    assert picture.pixmap().height() == 90
    assert picture.geometry().bottom() < window.statusBar().y()
    choose(window, "Open it")
    assert window.document.design.inputs[0].amplitude == 2.5
    assert window.document.modified
    assert window.docks["spectra"].isVisible()
    assert not picture.isVisible()
    # Once it is on the screen this studio's own copy takes its place.
    qtbot.waitUntil(lambda: list(user_data.rglob("*.opening")) == [], timeout=30_000)
    assert left_over.find(user_data).left == ()
    assert kept_amplitudes(user_data) == [2.5]


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


def test_saving_left_over_work_suggests_the_file_that_it_belonged_to(
    window, leave, user_data, tmp_path, monkeypatch
):
    (leave(2.5) / "file").write_bytes(str(tmp_path / "tap.skinsource").encode())
    window.keeping.recovery.open(window.keeping.recovery.look().left[0])
    asked = []
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *words: (asked.append(words[2]), ("", ""))[1]
    )
    window.do("save_design")
    assert asked == [str(tmp_path / "tap.skinsource")]
    window.document.undo_stack.setClean()
    window.do("new_design")
    window.do("save_design")
    assert asked[1].endswith("design.skinsource")


def test_a_copy_of_ten_gigabytes_is_refused_unread(window, leave, user_data):
    newest = sorted(leave(2.5, 3.5).glob("*.skinsource"))[-1]
    os.truncate(newest, 10 * 2**30)
    window.keeping.recovery.open(window.keeping.recovery.look().left[0])
    assert window.document.design.inputs[0].amplitude == 2.5
    (aside,) = (user_data / "unsaved" / left_over.ASIDE).iterdir()
    assert aside.stat().st_size == 10 * 2**30


def test_left_over_work_can_be_given_up(window, leave, user_data):
    leave(2.5)
    window.keeping.offer(window.notice)
    choose(window, "Discard it")
    assert left_over.find(user_data).left == ()
    assert window.document.design.inputs[0].amplitude == 1.0


def test_a_bad_copy_is_set_aside_and_named_and_the_one_before_is_opened(window, leave, user_data):
    newest = copies(user_data.parent / leave(2.5, 3.5).parents[1].name)[-1]
    newest.write_bytes(b"damaged")
    window.keeping.offer(window.notice)
    choose(window, "Open it")
    assert window.document.design.inputs[0].amplitude == 2.5
    assert newest.name in window.notice.text
    assert "An earlier copy was opened instead" in window.notice.text
    (aside,) = (user_data / "unsaved" / left_over.ASIDE).iterdir()
    assert aside.read_bytes() == b"damaged"


def test_where_every_copy_is_bad_the_present_work_stays(window, leave, user_data):
    for copy in leave(2.5, 3.5).glob("*.skinsource"):
        copy.write_bytes(b"damaged")
    design = window.document.design
    window.keeping.recovery.open(window.keeping.recovery.look().left[0])
    assert window.document.design is design
    assert len(list((user_data / "unsaved" / left_over.ASIDE).iterdir())) == 2


def test_a_copy_that_stopped_the_last_studio_is_named_and_not_opened(window, leave, user_data):
    folder = leave(2.5)
    (copy,) = folder.glob("*.skinsource")
    copy.with_name(f"{copy.name}.opening").write_bytes(ENDED)
    window.keeping.offer(window.notice)
    assert f"{copy.name} stopped the studio when it was opened" in window.notice.text
    assert window.notice.buttons.findChildren(QPushButton) == []
    assert not copy.exists()


def test_several_are_offered_in_a_list(window, leave, qtbot, user_data):
    leave(2.5)
    leave(3.5)
    window.keeping.offer(window.notice)
    assert "Copies were kept of 2 designs" in window.notice.text
    choose(window, "Show them…")
    (page,) = window.findChildren(LeftOverPage)
    assert page.rows.count() == 2
    assert "untitled, kept less than a minute ago" in page.rows.item(0).text()
    assert not page.rows.item(0).icon().isNull()
    page.discard_button.click()
    assert page.rows.count() == 1
    page.open_button.click()
    assert window.document.design.inputs[0].amplitude == 2.5
    assert not page.isVisible()


def test_without_left_over_work_the_page_says_so(window):
    window.do("show_left_over")
    (page,) = window.findChildren(LeftOverPage)
    assert not page.open_button.isEnabled()
    assert "no unsaved work" in page._words.text()
    page.close()


def test_without_left_over_work_nothing_is_offered(window):
    window.keeping.offer(window.notice)
    assert window.notice.text == ""


def test_the_log_of_a_crash_is_offered_once_and_saved(window, user_data, monkeypatch, tmp_path):
    (user_data / "logs").mkdir()
    log = user_data / "logs" / "studio-20260101-000000-1.log"
    log.write_text(f"SkinSource studio\n{ENDED.decode()}\n2026\nFatal Python error\n")
    window.keeping.offer(window.notice)
    assert "The studio crashed" in window.notice.text
    target = tmp_path / "saved.log"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(target), ""))
    choose(window, "Save the log…")
    assert "Fatal Python error" in target.read_text()
    window.keeping.offer(window.notice)
    assert window.notice.text == ""
