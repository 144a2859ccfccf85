"""Work that ended studios left, offered at the next start."""

import re
from dataclasses import replace

import pytest
from PySide6.QtWidgets import QFileDialog, QPushButton

from skinsource.base.lock import this_process, to_bytes
from skinsource.design import recovery as left_over
from skinsource.design.recovery import OWNER
from skinsource_gui.shell.keeping import UnsavedWorkPage
from tests.gui.keeping.bench import copies, edit, saved_amplitudes

ENDED = to_bytes(replace(this_process(), started_s=1000.0))


def choose(window, text):
    buttons = window.notice.card.findChildren(QPushButton)
    next(button for button in buttons if button.text() == text).click()


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
    assert f"from {window.keeping.recovery.look().left[0].clock()};" in window.notice.text
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


def test_several_are_offered_in_a_list(window, leave, qtbot, user_data):
    leave(2.5)
    leave(3.5)
    window.keeping.offer(window.notice)
    assert "Copies were stored of 2 designs" in window.notice.text
    choose(window, "Show them…")
    (page,) = window.findChildren(UnsavedWorkPage)
    assert page.rows.count() == 2
    assert re.match(r"untitled, kept at \d\d:\d\d:\d\d\n", page.rows.item(0).text())
    assert not page.rows.item(0).icon().isNull()
    page.discard_button.click()
    assert page.rows.count() == 1
    page.open_button.click()
    assert window.document.design.inputs[0].amplitude == 2.5
    assert not page.isVisible()


def test_a_file_that_could_not_be_opened_at_the_start_is_said_with_the_offer(
    window, leave, tmp_path
):
    leave(2.5)
    window.files.open(tmp_path / "gone.skinsource")
    complaint = window.notice.text
    assert "gone.skinsource" in complaint
    window.keeping.offer(window.notice)
    assert window.notice.text.startswith(complaint)
    assert "Its copy is from" in window.notice.text
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


def test_the_log_of_a_crash_is_offered_once_and_saved(window, user_data, monkeypatch, tmp_path):
    (user_data / "logs").mkdir()
    log = user_data / "logs" / "studio-20260101-000000-1.log"
    log.write_text(f"SkinSource studio\n{ENDED.decode()}\n2026\nFatal Python error\n")
    window.keeping.offer(window.notice)
    assert "The studio crashed" in window.notice.text
    assert window.notice.text.endswith("No copy of unsaved work is left.")
    target = tmp_path / "saved.log"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(target), ""))
    choose(window, "Save the log…")
    assert "Fatal Python error" in target.read_text()
    window.keeping.offer(window.notice)
    assert window.notice.text == ""
