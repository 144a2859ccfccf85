"""The panel of windows: maps in one scale, live, free while hidden, stepped through."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QImage, QPainter

import skinsource as ss
from skinsource.design.design import Design, track
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource_gui.panels.analysis import windowed
from skinsource_gui.panels.analysis.windowed import (
    least_height,
    strip_layout,
    window_titles,
)
from skinsource_gui.shell.appearance import LARGEST_TEXT
from tests.gui.analysis.analysis_bench import analysis
from tests.gui.shared_window import rest

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
    rest(studio)
    assert cells["window_count"].isVisible()
    assert not cells["window_s"].isVisible()
    cells["window_count"].edited.emit("window_count", 3, None)
    rest(studio)
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
    rest(studio)
    assert text in panel.strip.message
    assert panel.strip.text_at(panel.strip.rect().toRectF().center()) == ""
    panel.strip.grab()


def width_of(text):
    return 8.0 * len(text)


def bounds_s(count, length_s=0.05):
    return [(k * length_s, (k + 1) * length_s) for k in range(count)]


@pytest.mark.parametrize("count", [1, 5, 24, 60])
@pytest.mark.parametrize("width", [240.0, 1300.0])
def test_neither_two_maps_nor_two_times_lie_on_each_other(count, width):
    room = QRectF(0, 0, width, 400.0)
    layout = strip_layout(room, count, 16.0)
    places, areas = layout.cells, [*layout.cells, layout.scale, layout.plot]
    assert len(places) == count
    for k, area in enumerate(areas):
        assert room.contains(area)
        assert not any(area.adjusted(1, 1, -1, -1).intersects(other) for other in areas[k + 1 :])
    texts = window_titles(bounds_s(count, 0.6 / count), places, width_of)
    assert texts[0]
    ends = {}
    for cell, text in zip(places, texts, strict=True):
        half = width_of(text) / 2
        if text:
            assert cell.center().x() - half >= ends.get(cell.top(), -20.0)
            ends[cell.top()] = cell.center().x() + half


def test_how_long_windows_are_is_said_where_only_their_begins_are(open_window, qtbot):
    window = open_window(TRAIN, ss.View(method="mag", windows_cut="count", window_count=24))
    strip = analysis(window, "windowed").strip
    rest(window)
    assert "24.6 ms" in strip.head_text
    levels_db = strip.content.levels_db
    assert "traces" in strip.content.begin_phrases[0]
    window.document.look(replace(window.document.view, delay_removed=True))
    qtbot.waitUntil(lambda: not any("traces" in each for each in strip.content.begin_phrases))
    # Only texts change.
    assert strip.content.levels_db is levels_db


def test_all_letters_of_a_slide_are_a_thirtieth_of_its_height(panel, monkeypatch):
    lines_px = []
    note = lambda painter, *_: lines_px.append(painter.font().pixelSize())  # noqa: E731
    monkeypatch.setattr(windowed, "paint_strip", note)
    for height_px in (720, 2160):
        image = QImage(height_px * 16 // 9, height_px, QImage.Format.Format_RGB32)
        panel.draw_picture(QPainter(image), image.width(), height_px)
        assert lines_px.pop() >= height_px / 30


@pytest.fixture
def window(open_window):
    return open_window(TRAIN, ss.View(outputs=(29, 30)))


@pytest.fixture
def large(window, settle):
    window.resize(800, 600)
    window.appearance._scale_text(LARGEST_TEXT)
    settle()
    yield window
    window.appearance.reset_text()


def assert_apart(places, line):
    for cell in places.cells:
        assert cell.height() >= line + 60
        assert cell.bottom() <= places.scale.top()
    assert places.scale.bottom() <= places.plot.top() - line
    # Three numbers stand beside it, a line each.
    assert places.plot.height() >= 2 * line


@pytest.mark.parametrize("line", [15.0, 46.0])
@pytest.mark.parametrize("height", [0.0, 120.0, 290.0, 600.0])
def test_nothing_lies_on_anything_else_in_too_little_room(line, height):
    places = strip_layout(QRectF(0, 0, 600, height), 5, line)
    assert_apart(places, line)
    assert places.plot.bottom() <= max(height, least_height(line))


@pytest.mark.parametrize("arrangement", ["arrange_analysis", "arrange_presentation"])
def test_in_the_largest_letters_windows_are_drawn_and_the_rest_scrolls(
    large, settle, qtbot, arrangement
):
    large.do(arrangement)
    dock, strip = large.docks["analysis"], analysis(large, "windowed").strip
    settle()
    qtbot.waitUntil(lambda: strip.content is not None, timeout=30_000)
    assert_apart(strip.places, strip.fontMetrics().height())
    assert strip.places.plot.bottom() <= strip.height()
    assert dock.widget().verticalScrollBar().maximum() > 0
