"""How a benchmark ends: done, failed, unwanted; or waits."""

import sys
import threading
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QMessageBox,
    QPushButton,
    QTableView,
)

from skinsource.job import Job
from skinsource_gui.accuracy_page import bench_job
from tests.gui.accuracy_page.bench import find, hang, is_alive, measure, press, words


def test_a_failure_is_one_sentence_and_leaves_nothing(page, child, qtbot):
    note = child("fail")
    measure(page, qtbot)
    assert words(page).startswith("The measurement gave no results: the disk is full. Make room. ")
    assert not Path(note.read_text().partition(" ")[2]).exists()
    assert not find(page, QPushButton, "save_report").isEnabled()
    assert find(page, QPushButton, "measure").isVisible()


def test_a_program_that_cannot_be_started_is_one_sentence(page, monkeypatch, tmp_path, qtbot):
    monkeypatch.setattr(bench_job, "COMMAND", (str(tmp_path / "nothing"),))
    measure(page, qtbot)
    assert words(page).startswith("The measurement gave no results: ")
    assert not find(page, QPushButton, "cancel_measuring").isVisible()


@pytest.mark.skipif(sys.platform == "win32", reason="asks for processes as POSIX does")
@pytest.mark.parametrize("how", ["cancel", "escape", "close", "bar", "window"])
def test_a_benchmark_ends_with_whoever_wanted_it(window, page, child, qtbot, how, monkeypatch):
    number, folder = hang(page, child, qtbot)
    assert is_alive(number)
    if how == "cancel":
        press(page, "cancel_measuring")
    elif how == "escape":
        QTest.keyClick(page, Qt.Key.Key_Escape)
    elif how == "close":
        press(page, "close_page")
    elif how == "bar":
        press(window, "cancel_running_job")
    else:
        yes = QMessageBox.StandardButton.Yes
        monkeypatch.setattr(QMessageBox, "question", lambda *_: yes)
        window.close()
        # At once, not some time later.
        assert not is_alive(number)
    qtbot.waitUntil(lambda: not window.runner.busy, timeout=20_000)
    assert not is_alive(number)
    assert not folder.exists()
    assert not page.run.running
    if how == "cancel":
        assert words(page) == "Cancelled. Nothing was kept."
        assert find(page, QPushButton, "measure").hasFocus()


def test_a_benchmark_waits_until_other_work_is_done(window, page, child, qtbot):
    go_on = threading.Event()

    def work(*, progress, stop):
        go_on.wait()

    window.runner.add(Job("Exporting levels.csv", work))
    press(page, "measure")
    assert words(page) == "Waiting until this is done: Exporting levels.csv."
    assert page.run.running
    go_on.set()
    qtbot.waitUntil(lambda: not page.run.running, timeout=20_000)
    assert find(page, QTableView, "bench_table").model().rowCount() == 3


def test_a_benchmark_that_waits_can_be_taken_back(window, page, child, qtbot):
    go_on = threading.Event()

    def work(*, progress, stop):
        go_on.wait()

    window.runner.add(Job("Exporting levels.csv", work))
    press(page, "measure")
    press(page, "cancel_measuring")
    assert words(page) == "Cancelled. Nothing was kept."
    go_on.set()
    qtbot.waitUntil(lambda: not window.runner.busy)


def test_closing_the_window_removes_what_was_measured(window, page, child, qtbot):
    note = child("work")
    measure(page, qtbot)
    folder = Path(note.read_text().partition(" ")[2])
    page.close()
    assert folder.exists()
    window.close()
    assert not folder.exists()
