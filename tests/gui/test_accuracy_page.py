"""Help > Accuracy and speed on one short case, and the error of what is on screen."""

import csv
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from skinsource.base.job import stop_if
from skinsource.studies.accuracy.cases import Resampling, stored_cases
from skinsource.studies.accuracy.measuring import WAYS
from skinsource_gui.pages import accuracy as page_module
from skinsource_gui.shell.status import rounded_up

CASE = "1300 to 48000 Hz"


N_ROWS = sum(way.kind is Resampling for way in WAYS)


@pytest.fixture
def page(window, monkeypatch):
    chosen = [case for case in stored_cases() if case.name == CASE]
    monkeypatch.setattr(page_module, "cases_of", lambda *_, **__: chosen)
    window.actions_by_name["show_accuracy"].trigger()
    return window.pages.accuracy


def press(page, name):
    QTest.mouseClick(page.findChild(QPushButton, name), Qt.MouseButton.LeftButton)


def measure(page, qtbot):
    press(page, "measure")
    assert page.run.busy
    qtbot.waitUntil(lambda: not page.run.busy, timeout=20_000)


def never_ending(cases, *, repeats, progress, stop):
    progress(0, 3, "a case: a way")
    while True:
        stop_if(stop)
    yield


def test_every_row_stands_in_table_and_plot(page, qtbot):
    measure(page, qtbot)
    assert page.table.rowCount() == len(page.rows) == N_ROWS
    for line, row in enumerate(page.rows):
        texts = [page.table.item(line, column).text() for column in range(4)]
        assert texts[:3] == [CASE, row.way, f"{row.error:.1e}"]
        assert float(texts[3]) == pytest.approx(1e3 * row.time_s, rel=0.01)
    page.plot.repaint()
    points = page.plot._points(page.plot.axes)
    for row, point in zip(page.rows, points, strict=True):
        page.plot.move_cursor(point)
        assert page.message.text().startswith(f"{CASE}, {row.way}: error {row.error:.1e} in ")
    # What errs more is higher, what takes longer is further right.
    by_error = sorted(zip(page.rows, points, strict=True), key=lambda pair: pair[0].error)
    assert [point.y() for _, point in by_error] == sorted(
        (point.y() for point in points), reverse=True
    )
    by_time = sorted(zip(page.rows, points, strict=True), key=lambda pair: pair[0].time_s)
    assert [point.x() for _, point in by_time] == sorted(point.x() for point in points)


def test_times_of_edits_and_the_error_of_the_traces_stand_above(window, page, qtbot):
    assert page.now.text().startswith("No edit yet.")
    window.document.edit("a", window.document.design.with_input(0, amplitude=2.0))
    qtbot.waitUntil(lambda: page.now.text().startswith("Last edit: median "), timeout=20_000)
    qtbot.waitUntil(lambda: "error ≈ " in page.now.text(), timeout=20_000)


@pytest.mark.parametrize("how", ["cancel", "close", "window"])
def test_measuring_ends_with_whoever_wanted_it(window, page, qtbot, monkeypatch, how):
    monkeypatch.setattr(page_module, "measure", never_ending)
    press(page, "measure")
    qtbot.waitUntil(lambda: "0 of 3: a case: a way" in page.message.text(), timeout=20_000)
    if how == "cancel":
        press(page, "measure")
    elif how == "close":
        press(page, "close_page")
    else:
        window.close_unasked()
    qtbot.waitUntil(lambda: not window.runner.unfinished and not page.run.busy, timeout=20_000)
    assert page.rows == ()
    assert page.isVisible() == (how == "cancel")
    if how == "cancel":
        assert page.message.text() == "Cancelled. Nothing was stored."
        assert page.findChild(QPushButton, "measure").text() == "Measure now"


def test_the_table_is_saved_as_numbers(page, qtbot, tmp_path, answers):
    measure(page, qtbot)
    answers["save"] = str(tmp_path / "table.csv")
    press(page, "save_table")
    assert page.message.text() == "Saved table.csv."
    with (tmp_path / "table.csv").open(encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(file))
    assert [float(line["error"]) for line in lines] == [row.error for row in page.rows]
    page.save(Path(tmp_path / "table.csv" / "x.csv"))
    assert "cannot be written" in page.message.text()


@pytest.fixture
def checked(window):
    checks = []
    window.accuracy.checked.connect(checks.append)
    return checks


def known(checked):
    return bool(checked) and checked[-1] is not None


def test_when_edits_pause_the_error_is_checked(qtbot, window, checked):
    window.document.edit("a", window.document.design.with_input(0, amplitude=2.0))
    qtbot.waitUntil(lambda: known(checked), timeout=5000)
    assert 0 < checked[-1].estimate < 1e-14
    assert checked[-1].estimate < checked[-1].bound < 1e-10
    assert window.status_line.error is checked[-1]


def test_an_edit_takes_the_old_error_away_at_once(qtbot, window, checked):
    qtbot.waitUntil(lambda: known(checked), timeout=5000)
    window.document.edit("a", window.document.design.with_input(0, amplitude=3.0))
    qtbot.waitUntil(lambda: checked[-1] is None)
    assert window.status_line.error is None


def test_without_traces_nothing_is_checked(qtbot, window, checked):
    window.docks["traces"].close()
    qtbot.waitUntil(lambda: not window.engine.busy)
    window.document.edit("a", window.document.design.with_input(0, amplitude=4.0))
    qtbot.waitUntil(lambda: not window.engine.busy)
    assert window.accuracy._shown is None


@pytest.mark.parametrize(
    ("error", "shown"),
    [
        (1.2e-15, "2e-15"),
        (2e-15, "2e-15"),
        (9.3e-15, "1e-14"),
        (0.0, "3e-16"),
        (0.04, "4e-2"),
        (1.0, "1e0"),
    ],
)
def test_an_error_is_never_shown_smaller_than_it_is(error, shown):
    assert rounded_up(error) == shown
    assert float(shown) >= error
