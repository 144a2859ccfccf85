"""The panel of windows: maps in one scale, live, free while hidden, stepped through."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPointF, Qt

import skinsource as ss
from skinsource.design.design import Design, track
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from tests.gui.analysis.analysis_bench import analysis

TRAIN = Design(limb="synthetic-4", inputs=(track(7, WaveletTrain()),))


@pytest.fixture
def panel(open_window):
    window = open_window(TRAIN, ss.View(method="mag", windows_cut="length", window_s=0.12))
    panel = analysis(window, "windowed")
    window.catch_up()
    panel.window_of_test = window
    return panel


@pytest.fixture
def studio(panel):
    return panel.window_of_test


def settle(window, qtbot):
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)


def test_it_shows_what_was_computed_in_one_scale(panel, studio):
    content = panel.strip.content
    energies = ss.evaluate(TRAIN, "rms_of_windows", "extents_of_windows", view=studio.document.view)
    assert content.windows.count == 5
    assert (content.levels_db == ss.decibels(energies["rms_of_windows"])).all()
    assert content.extents == energies["extents_of_windows"]
    assert content.scale.range_db[1] >= content.levels_db.max() > content.scale.range_db[1] - 5.0
    assert content.synthetic


def test_windows_that_are_noise_are_hatched_and_have_no_extent(panel, studio):
    content = panel.strip.content
    assert content.shown_extents == content.extents
    assert content.map_of(0).noisy == ()
    noisy = replace(content, noisy=((4, 5), *[()] * 4), in_noise=(True, *[False] * 4))
    assert noisy.shown_extents == (None, *content.extents[1:])
    assert noisy.map_of(0).noisy == (4, 5)
    assert noisy.extent_text(0) == "Mostly noise of the measurement: its extent means nothing"
    assert "Mean distance" in noisy.extent_text(1)


def test_windows_are_cut_by_number_or_by_length(panel, studio, qtbot):
    cells = panel.cells
    assert cells["window_s"].isVisible()
    assert not cells["window_count"].isVisible()
    cells["windows_cut"].edited.emit("windows_cut", "count", None)
    settle(studio, qtbot)
    assert cells["window_count"].isVisible()
    assert not cells["window_s"].isVisible()
    cells["window_count"].edited.emit("window_count", 3, None)
    settle(studio, qtbot)
    assert panel.strip.content.windows.count == 3
    assert panel.strip.content.windows.window_samples == 260
    assert not studio.document.undo_stack.canUndo()


def test_a_click_on_a_window_and_arrow_keys_move_the_playhead_to_its_begin(panel, studio, qtbot):
    strip = panel.strip
    at = strip.places.cells[2].center().toPoint()
    qtbot.mouseClick(strip, Qt.MouseButton.LeftButton, pos=at)
    assert studio.document.view.playhead_s == pytest.approx(0.24)
    assert strip.chosen == 2
    qtbot.keyClick(strip, Qt.Key.Key_Right)
    assert studio.document.view.playhead_s == pytest.approx(0.36)
    for _ in range(9):
        qtbot.keyClick(strip, Qt.Key.Key_Left)
    assert studio.document.view.playhead_s == 0.0
    assert strip.chosen == 0
    qtbot.keyClick(strip, Qt.Key.Key_Left)
    assert studio.document.view.playhead_s == 0.0


def test_the_pointer_reads_times_and_extent(panel):
    cell = panel.strip.places.cells[1]
    text = panel.strip.text_at(cell.center())
    extent = panel.strip.content.extents[1]
    assert text.startswith("120–240 ms\n")
    assert f"{extent.mean_distance_mm:.1f} mm" in text
    assert f"{extent.d90_mm:.1f} mm" in text
    assert panel.strip.text_at(QPointF(1.0, 1.0)) == ""


@pytest.mark.parametrize(
    ("design", "view", "text"),
    [
        (Design(limb="synthetic-4"), {}, "No active input"),
        (TRAIN, {"windows_cut": "length", "window_s": 5.0}, "No whole window"),
    ],
)
def test_where_there_is_nothing_to_show_it_says_why(panel, studio, qtbot, design, view, text):
    studio.document.edit("Other", design)
    studio.document.look(replace(studio.document.view, **view))
    settle(studio, qtbot)
    assert text in panel.strip.message
    assert panel.strip.text_at(panel.strip.rect().toRectF().center()) == ""
    panel.strip.grab()
