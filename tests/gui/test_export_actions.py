import os
import threading
from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QMessageBox, QProgressBar, QPushButton

from skinsource.base.errors import Stopped
from skinsource.design.design import track
from skinsource.engine import trace_rules
from skinsource.engine.gains import TraceError
from skinsource.export.stimulus_export.preparing import size_text
from skinsource_gui.pages.files.export_parts import preview_of
from tests.gui.exporting import export, press, shown

YES = QMessageBox.StandardButton.Yes


@pytest.fixture
def wait(qtbot, window):
    """Wait until nothing is exported."""

    def until_done():
        qtbot.waitUntil(lambda: not window.runner.busy, timeout=20_000)

    return until_done


@pytest.fixture
def gate(write_with):
    """Hold exports of the field and of the film until they are let go, or stopped."""
    gate = threading.Event()
    gate.started = threading.Event()

    def write(path, design, view, *, progress, stop, largest_error, **_):
        progress(340, 1000, "Writing")
        gate.started.set()
        while not gate.wait(0.001):
            if stop():
                raise Stopped
        path.write_text(str(len(design.inputs)))

    for name in ("field", "animation"):
        write_with(name, write)
    return gate


def test_a_preview_begins_as_the_file_and_lists_what_an_archive_holds(
    qtbot, window, wait, answers, tmp_path
):
    def preview(name):
        part = shown(window, name)
        qtbot.waitUntil(lambda: bool(part.text.toPlainText()), timeout=20_000)
        return part

    part = preview("levels")
    answers["save"] = str(tmp_path / "levels.csv")
    text, summary = part.text.toPlainText(), part.findChild(QLabel, "file_summary").text()
    press(part)
    wait()
    assert (tmp_path / "levels.csv").read_text(encoding="utf-8").startswith(text.rstrip("…"))
    assert summary == f"rms-levels.csv, {size_text((tmp_path / 'levels.csv').stat().st_size)}."
    assert "acceleration_m_per_s2: float64, (72, 3, " in preview("field").text.toPlainText()
    assert "stimulus.wav.json, " in preview("pack").text.toPlainText()
    # Of a web page, how it was computed, and no code.
    assert preview("page").text.toPlainText().startswith("SkinSource studio\n")
    window.exports.end()


def test_what_is_large_is_not_written_for_a_preview(tmp_path):
    def write(path, *, progress, stop, largest_error):
        for _ in range(100):
            with path.open("ab") as file:
                file.write(b"0" * 1_000_000)
            if stop():
                raise Stopped
        raise AssertionError("all of it was written")

    with pytest.raises(Stopped):
        preview_of(write, "a.csv", lambda: False)


def test_where_nothing_can_be_exported_the_dialog_says_why(window):
    window.document.look(replace(window.document.view, outputs=()))
    part = shown(window, "traces")
    assert not part.ready
    assert part.findChild(QLabel, "file_problem").text().startswith("No output is selected.")
    window.exports.end()


def test_the_part_in_sight_may_change_while_the_next_one_waits_for_a_prediction(window):
    before, page = shown(window, "stimulus"), window.exports.page
    pictures = page._drawer_of
    page._drawer_of = lambda name: (before.changed.emit(), pictures(name))[1]
    page.show_export("picture")
    assert page.part.name == "picture"
    window.exports.end()


def test_the_dialog_stays_open_and_opens_where_the_last_export_was(window, wait, answers, tmp_path):
    answers["save"] = str(tmp_path / "levels.csv")
    export(window, "levels")
    wait()
    assert window.exports.page.message.text() == f"Saved {tmp_path / 'levels.csv'}"
    # What was only looked at does not count.
    shown(window, "picture")
    window.do("export")
    assert window.exports.page.windowTitle() == "Export table"
    assert window.exports.page.part.name == "levels"
    window.exports.end()


def test_the_design_of_the_moment_is_exported_while_editing_goes_on(
    qtbot, window, wait, gate, answers, tmp_path
):
    answers["save"] = str(tmp_path / "field.npz")
    export(window, "field")
    assert gate.started.wait(5)
    window.document.edit("Place", window.document.design.adding(track(location=3)))
    qtbot.waitUntil(lambda: not window.engine.busy)
    assert window.runner.busy
    gate.set()
    wait()
    assert (tmp_path / "field.npz").read_text() == "1"


def test_a_running_export_is_seen_and_cancelled_with_a_click(
    qtbot, window, wait, gate, answers, tmp_path
):
    answers["save"] = str(tmp_path / "field.npz")
    bar = window.findChild(QPushButton, "cancel_running_job")
    assert not bar.isVisible()
    assert not window.actions_by_name["cancel_job"].isEnabled()
    export(window, "field")
    export(window, "field")
    qtbot.waitUntil(lambda: window.findChild(QLabel, "job_percent").text() == "34 %")
    assert window.findChild(QLabel, "job_name").text() == "Exporting field.npz (+1)"
    assert window.findChild(QProgressBar, "job_progress").value() == 340
    assert window.actions_by_name["cancel_job"].isEnabled()
    for left in (1, 0):
        gate.started.wait(5)
        QTest.mouseClick(bar, Qt.MouseButton.LeftButton)
        qtbot.waitUntil(lambda n=left: len(window.runner.unfinished) == n)
    wait()
    assert not bar.isVisible()
    assert not window.actions_by_name["cancel_job"].isEnabled()
    assert "cancelled" in window.statusBar().currentMessage()
    assert os.listdir(tmp_path) == []


def test_a_table_does_not_wait_for_a_film_and_exports_are_cancelled_in_the_dialog(
    qtbot, window, wait, gate, answers, tmp_path
):
    pytest.importorskip("imageio_ffmpeg")
    window.document.look(replace(window.document.view, slow_motion=20.0))
    for name in ("film.mp4", "next.mp4"):
        answers["save"] = str(tmp_path / name)
        export(window, "animation")
    page = window.exports.page
    assert page.message.text() == "next.mp4 waits for film.mp4. Close lets it go on."
    answers["save"] = str(tmp_path / "levels.csv")
    export(window, "levels")
    page = window.exports.page
    assert page.message.text() == "levels.csv is being written. Close lets it go on."
    qtbot.waitUntil((tmp_path / "levels.csv").exists, timeout=20_000)
    for name in ("film.mp4", "next.mp4"):
        qtbot.waitUntil(lambda n=name: page.cancel.text() == f"Cancel {n}")
        page.cancel.click()
    wait()
    assert page.cancel.isHidden()
    assert os.listdir(tmp_path) == ["levels.csv"]
    window.exports.end()


def test_what_is_too_inaccurate_is_written_only_if_the_user_agrees(
    qtbot, window, wait, answers, tmp_path, monkeypatch
):
    poor = TraceError(estimate=2e-3, bound=1.0)
    monkeypatch.setattr(trace_rules, "trace_error_of", lambda *_: poor)
    answers["save"] = str(tmp_path / "levels.csv")
    export(window, "levels")
    qtbot.waitUntil(lambda: len(answers["asked"]) == 1)
    wait()
    assert "2.0e-03" in answers["asked"][0]
    assert os.listdir(tmp_path) == []
    answers["question"] = YES
    export(window, "levels")
    qtbot.waitUntil(lambda: (tmp_path / "levels.csv").exists())
    wait()
    assert len(answers["asked"]) == 2
    assert "about 0.002" in (tmp_path / "levels.csv").read_text(encoding="utf-8")


def test_a_mistake_of_the_studio_is_told_and_the_studio_lives(
    window, wait, answers, tmp_path, write_with, caplog
):
    def fail(*_, **__):
        raise ZeroDivisionError("oh")

    write_with("levels", fail)
    answers["save"] = str(tmp_path / "levels.csv")
    export(window, "levels")
    wait()
    assert "ZeroDivisionError: oh" in window.notice.text
    assert "ZeroDivisionError: oh" in window.exports.page.message.text()
    assert "an export failed" in caplog.text


def test_closing_during_an_export_asks_first_and_then_leaves_nothing(
    window, gate, answers, tmp_path
):
    answers["save"] = str(tmp_path / "field.npz")
    export(window, "field")
    assert gate.started.wait(5)
    window.close()
    assert window.isVisible()
    assert "field.npz" in answers["asked"][0]
    assert window.runner.busy
    answers["question"] = YES
    window.close()
    assert not window.isVisible()
    assert os.listdir(tmp_path) == []
