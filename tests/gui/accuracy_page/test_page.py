"""Help > Accuracy and speed, driven by mouse and keyboard, with a made-up benchmark."""

import sys
from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QApplication,
    QFileDialog,
    QLabel,
    QMessageBox,
    QPushButton,
    QTableView,
    QTabWidget,
)

from skinsource.commands.command_line import _parser
from skinsource.method_comparison.table import read_table
from skinsource.rendering.check import TraceError
from skinsource_gui.accuracy_page import accuracy_figures, bench_job
from skinsource_gui.accuracy_page.picture_view import PictureView
from tests.gui.accuracy_page.bench import find, hang, measure, press, words


def test_the_page_leaves_the_window_free_and_fits_a_small_screen(window, page):
    assert page.isVisible()
    assert not page.isModal()
    assert page.width() <= 1366
    assert page.height() <= 700
    assert page.minimumSizeHint().width() <= 800


def test_the_command_that_is_started_exists():
    assert bench_job.COMMAND[:3] == (sys.executable, "-m", "skinsource")
    found = _parser().parse_args([*bench_job.COMMAND[3:], "folder"])
    assert (found.quick, found.progress, found.out) == (True, "lines", Path("folder"))


def test_the_page_opens_once(window, page):
    page.close()
    window.actions_by_name["show_accuracy"].trigger()
    assert window.pages.accuracy is page
    assert page.isVisible()


def test_present_figures_stand_beside_the_promised(window, page, qtbot):
    window.document.edit("a", window.document.design.with_input(0, amplitude=2.0))
    error = find(page, QLabel, "now_error")
    qtbot.waitUntil(lambda: error.text().startswith("≈ "), timeout=20_000)
    assert "at most" in error.text()
    for name in ("now_median", "now_most"):
        words, _, reason = find(page, QLabel, name).text().partition(" – ")
        assert words.endswith("ms (1 edit)")
        assert reason.startswith("above the promise") == bool(reason)
    assert "computing" in find(page, QLabel, "now_last").text()
    assert "of 216 channels" in find(page, QLabel, "now_scope").text()
    promised = [one.text() for one in page.findChildren(QLabel)]
    assert "1e-14 of the largest sample" in promised
    assert any("rounding errors" in text and "measurements" in text for text in promised)


def test_an_error_above_the_promise_is_amber_on_the_page(window, page):
    window.status_line.show_error(TraceError(estimate=1e-9, bound=1e-8))
    window.status_line.changed.emit()
    assert find(page, QLabel, "now_error").property("tone") == "warning"
    assert "above the promise" in find(page, QLabel, "now_error").text()


def test_a_figure_above_its_promise_says_what_the_promise_is_for(window, page, monkeypatch):
    def shown(memory, seconds, error):
        monkeypatch.setattr(accuracy_figures, "resident_bytes", lambda: memory)
        monkeypatch.setattr(window.status_line, "last_times", lambda: (None, seconds))
        window.status_line.show_error(TraceError(estimate=error, bound=1e-12))
        window.status_line.changed.emit()
        names = ("memory", "median", "most", "error")
        return [find(page, QLabel, f"now_{name}").text() for name in names]

    kept = shown(349_000_000, [0.008, 0.008], 1e-14)
    assert not any("above" in text for text in kept)
    assert kept[3] == "≈ 1e-14 estimated; by theory at most 1e-12"
    assert all(" – above" in text for text in shown(351_000_000, [0.017, 0.017], 2e-14))


def test_a_run_shows_table_plot_and_verdict(page, qtbot):
    measure(page, qtbot)
    assert words(page) == (
        "This program keeps its promises in 1 of 1 rows. 1 of 3 rows could not be measured."
    )
    assert find(page, QLabel, "now_window").text() == "1.0e-12 in the benchmark"
    table = find(page, QTableView, "bench_table")
    assert table.isVisible()
    assert table.model().rowCount() == 3
    assert find(page, PictureView, "bench_plot").words == ""
    find(page, QTabWidget, "accuracy_tabs").setCurrentIndex(2)
    QApplication.processEvents()
    plot = find(page, PictureView, "bench_plot")
    shown = plot.grab().toImage()
    assert shown.pixelColor(shown.width() // 2, shown.height() // 2).name() == "#ff0000"
    assert plot.verticalScrollBar().maximum() > 0


def test_what_was_measured_is_gone_once_another_benchmark_begins(page, child, qtbot):
    measure(page, qtbot)
    assert find(page, QPushButton, "save_report").isEnabled()
    hang(page, child, qtbot)
    assert find(page, QTableView, "bench_table").model().rowCount() == 0
    assert find(page, PictureView, "bench_plot").words.startswith("Nothing is measured yet.")
    assert not find(page, QPushButton, "save_report").isEnabled()
    press(page, "cancel_measuring")
    qtbot.waitUntil(lambda: not page.run.running, timeout=20_000)


def test_the_table_is_sorted_by_number_when_a_heading_is_clicked(page, qtbot):
    measure(page, qtbot)
    table = find(page, QTableView, "bench_table")
    header = table.horizontalHeader()
    place = header.sectionViewportPosition(4) + 20

    def fastest():
        return [table.model().index(row, 4).data() for row in range(3)]

    QTest.mouseClick(header.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(place, 5))
    assert fastest() == ["2", "10", ""]


def test_the_whole_page_is_worked_by_keyboard(page, qtbot, child, tmp_path, monkeypatch):
    chosen = tmp_path / "kept"
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(chosen))
    seen = set()
    page.activateWindow()
    for _ in range(20):
        QTest.keyClick(QApplication.focusWidget() or page, Qt.Key.Key_Tab)
        seen.add(QApplication.focusWidget().objectName())
    assert {"measure", "close_page"} <= seen
    find(page, QPushButton, "measure").setFocus()
    QTest.keyClick(find(page, QPushButton, "measure"), Qt.Key.Key_Space)
    assert QApplication.focusWidget() is find(page, QPushButton, "cancel_measuring")
    qtbot.waitUntil(lambda: not page.run.running, timeout=20_000)
    assert QApplication.focusWidget() is find(page, QTableView, "bench_table")
    find(page, QPushButton, "save_report").setFocus()
    QTest.keyClick(find(page, QPushButton, "save_report"), Qt.Key.Key_Space)
    assert sorted(path.name for path in chosen.iterdir()) == [
        "report.md",
        "work_precision.csv",
        "work_precision.png",
    ]
    assert len(read_table(chosen / "work_precision.csv")) == 3
    assert words(page).startswith(f"Saved in {chosen}: ")


def test_saving_asks_before_it_replaces(page, qtbot, tmp_path, monkeypatch):
    (tmp_path / "report.md").write_text("mine")
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(tmp_path))
    asked = []

    def refuse(*arguments):
        asked.append(arguments)
        return QMessageBox.StandardButton.Cancel

    monkeypatch.setattr(QMessageBox, "question", refuse)
    measure(page, qtbot)
    press(page, "save_report")
    assert len(asked) == 1
    assert (tmp_path / "report.md").read_text() == "mine"


def test_a_folder_that_cannot_be_written_is_one_sentence(page, qtbot, tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setattr(
        QFileDialog, "getExistingDirectory", lambda *_: str(tmp_path / "file" / "x")
    )
    measure(page, qtbot)
    press(page, "save_report")
    assert "cannot be written" in words(page)


def test_without_matplotlib_the_table_is_shown_and_the_line_to_type(page, child, qtbot):
    child("no plot")
    measure(page, qtbot)
    assert find(page, QTableView, "bench_table").model().rowCount() == 3
    plot = find(page, PictureView, "bench_plot")
    assert plot.words.startswith("The plot needs matplotlib")
    assert 'pip install "skinsource[bench]"' in plot.words
