"""What the status bar tells of cost, scope and error of the last edit."""

from dataclasses import replace
from itertools import pairwise

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QApplication, QLabel

from skinsource.base.work import Work
from skinsource.design.clips import Clip
from skinsource.design.design import track
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.gains import TraceError
from skinsource.engine.transforms import BLOCK_FFT
from skinsource_gui.qt.theme import DARK, LIGHT
from skinsource_gui.shell.status import Scope, Sparkline
from skinsource_gui.state.edit_times import EditTimes, most_within, summary


def label(window, name):
    return window.findChild(QLabel, name)


def work_text(window):
    return label(window, "work").text()


def details(window):
    return label(window, "work").toolTip()


def edit(window, **changes):
    window.document.edit("a", window.document.design.with_input(0, **changes))


def scope(**changes):
    given = {
        "inputs": 20,
        "audible": 4,
        "channels": 6,
        "all_channels": 216,
        "has_map": True,
        "streamed": False,
        "work": Work(inverse_transforms=12),
    }
    return Scope(**{**given, **changes})


def test_inputs_channels_and_method_are_told(window, qtbot):
    inputs = (track(location=3, muted=True), track(location=4, colour=1))
    window.document.edit("a", replace(window.document.design, inputs=inputs))
    window.document.look(View(outputs=(29, 30, 52), axes="xz"))
    qtbot.waitUntil(lambda: work_text(window) == "1 of 2 inputs felt · up to date")
    qtbot.waitUntil(lambda: "6 of 216 channels" in details(window))
    assert "0 inverse transforms" in details(window)
    assert "float64, spectra" in details(window)


def test_while_results_are_awaited_nothing_is_called_up_to_date(window, qtbot, monkeypatch):
    edit(window, amplitude=2.0)
    error = window.status_line.error
    qtbot.waitUntil(lambda: error.text().startswith("· error") and error.isVisible())
    asked = []
    with monkeypatch.context() as patch:
        patch.setattr(window.engine, "request", asked.append)
        edit(window, amplitude=3.0)
        qtbot.waitUntil(lambda: work_text(window) == "1 input · computing…")
        assert not error.isVisible()
        assert not label(window, "timing").isVisible()
    window.engine.request(asked[-1])
    qtbot.waitUntil(lambda: work_text(window) == "1 input · up to date")
    assert error.isVisible()
    assert label(window, "timing").isVisible()


def test_a_long_scene_is_told_to_be_computed_block_by_block(window, qtbot):
    edit(window, clips=(Clip(waveform=Tone(duration_s=14.0)),))
    qtbot.waitUntil(lambda: f"float64, overlap-save {BLOCK_FFT}" in details(window))
    qtbot.waitUntil(lambda: work_text(window).endswith("long scene, summed piece by piece"))


def test_an_empty_design_has_no_inputs(window, qtbot):
    window.document.edit("a", replace(window.document.design, inputs=()))
    qtbot.waitUntil(lambda: work_text(window) == "No input yet")


def test_where_nothing_can_be_computed_there_is_no_speed(window, qtbot):
    window.document.edit("a", replace(window.document.design, limb="measured-1"))
    qtbot.waitUntil(lambda: work_text(window) == "1 input")
    assert label(window, "timing").text() == ""
    assert window.status_line.timing.last is None


def test_an_edit_is_timed_from_hand_to_screen(window, qtbot):
    timing = window.status_line.timing
    before = len(timing.times.seconds())
    edit(window, amplitude=2.0)
    qtbot.waitUntil(lambda: len(timing.times.seconds()) > before)
    last, seconds = timing.last, timing.times.seconds()
    assert seconds[-1] == last.total_s
    assert 0.0 < last.compute_s < last.total_s
    assert 0.0 < last.draw_s < last.total_s
    assert last.queue_s + last.compute_s + last.draw_s == pytest.approx(last.total_s)
    qtbot.waitUntil(lambda: "waiting" in label(window, "timing").toolTip())
    qtbot.waitUntil(lambda: "Last" in label(window, "timing").toolTip())


@pytest.mark.parametrize("size", [(1366, 768), (1920, 1080)])
def test_nothing_in_the_status_bar_is_clipped(window, qtbot, size):
    window.resize(*size)
    edit(window, amplitude=2.0)
    qtbot.waitUntil(lambda: window.status_line.error.text() != "", timeout=5000)
    window.status_line.show_error(TraceError(estimate=9e-16, bound=3e-13))
    QApplication.processEvents()
    shown = [label for label in window.statusBar().findChildren(QLabel) if label.isVisible()]
    assert {label.objectName() for label in shown} == {"timing", "work", "trace_error", "limb_note"}
    for status_label in shown:
        if status_label.objectName() != "limb_note":
            assert (
                status_label.fontMetrics().horizontalAdvance(status_label.text())
                <= status_label.contentsRect().width()
            )
        else:
            assert status_label.sizeHint().width() <= status_label.width()
    places = sorted((label.mapTo(window, QPoint()).x(), label.width()) for label in shown)
    for (left, width), (following, _) in pairwise(places):
        assert left + width <= following
    assert work_text(window) == "1 input · up to date"


def test_the_error_stands_with_its_bound(window):
    window.status_line.show_error(TraceError(estimate=1.2e-15, bound=3.4e-13))
    QApplication.processEvents()  # it gets the room that it asks for
    assert window.status_line.error.text() == "· error ≈ 2e-15, at most 4e-13"
    window.status_line.show_error(TraceError(estimate=1.2e-5, bound=3.4e-3))
    assert "more than the 1e-14 that is promised" in window.status_line.error.toolTip()


def test_transforms_beyond_those_of_channels_and_search_are_the_maps():
    assert scope().map_transforms == 0
    assert scope(work=Work(inverse_transforms=40, search_transforms=28)).map_transforms == 0
    assert scope(work=Work(inverse_transforms=216)).map_transforms == 204
    assert (
        "The map took 1 inverse transform:" in scope(work=Work(inverse_transforms=13)).sentences()
    )


def test_only_the_last_hundred_edits_are_remembered():
    times = EditTimes()
    for k in range(250):
        times.note(k * 1e-3)
    assert times.seconds() == tuple(k * 1e-3 for k in range(150, 250))


def test_of_a_hundred_times_at_most_five_are_slower_than_the_95_percent():
    assert most_within(tuple(range(100))) == 94
    assert most_within((3.0,)) == 3.0
    assert most_within(tuple(range(20))) == 18


def test_the_summary_names_median_95_percent_and_slowest():
    seconds = (0.004, 0.008, 0.3)
    assert summary(seconds) == ("Last 3 edits: median 8.0 ms, 95 % within 300 ms, slowest 300 ms.")
    assert summary(()) == ""


@pytest.fixture
def sparkline(qtbot):
    sparkline = Sparkline(lambda: "about them")
    qtbot.addWidget(sparkline)
    sparkline.resize(sparkline.sizeHint())
    sparkline.show()
    qtbot.waitExposed(sparkline)
    QApplication.processEvents()
    return sparkline


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_a_slow_edit_is_a_high_amber_bar_and_a_quick_one_a_low_bar(sparkline, theme, use_theme):
    use_theme(theme)
    sparkline.show_times((0.3, 0.008))
    QApplication.processEvents()
    picture = sparkline.grab().toImage()
    last = picture.width() - 1
    assert picture.pixelColor(last - 1, 1).name() == theme.warning
    assert picture.pixelColor(last, 13).name() == theme.accent
    assert picture.pixelColor(last, 10).name() not in (theme.accent, theme.warning)
    assert picture.pixelColor(3, 8).name() == theme.dim
