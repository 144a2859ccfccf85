"""However many windows there are, it is said when they are."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QRectF

import skinsource as ss
from skinsource.design.design import Design, track
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource_gui.panels.analysis.window_strip import strip_layout, window_titles
from skinsource_gui.plots.pictures import save_drawing
from tests.gui.analysis.analysis_bench import analysis

TRAIN = Design(limb="synthetic-4", inputs=(track(7, WaveletTrain()),))


def width_of(text):
    return 8.0 * len(text)


def bounds_s(count, length_s=0.05):
    return [(k * length_s, (k + 1) * length_s) for k in range(count)]


def cells(count, width, columns=None):
    columns = columns or count
    return [QRectF(width * (k % columns), 90.0 * (k // columns), width, 90.0) for k in range(count)]


def test_above_each_map_stands_when_its_window_begins():
    assert window_titles(bounds_s(3), cells(3, 40.0), width_of) == ("0", "50", "100")


def test_where_begins_have_no_room_each_second_or_third_of_a_row_has_one():
    assert window_titles(bounds_s(5), cells(5, 20.0), width_of) == ("0", "", "100", "", "200")
    rows = window_titles(bounds_s(8), cells(8, 12.0, columns=4), width_of)
    assert rows == ("0", "", "", "150", "200", "", "", "350")


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


@pytest.fixture
def studio(open_window, qtbot):
    window = open_window(TRAIN, ss.View(method="mag", windows_cut="count", window_count=5))
    analysis(window, "windowed")

    def show(count, **looks):
        view = replace(window.document.view, window_count=count, **looks)
        window.document.look(view)
        strip = window.panel("analysis").view.strip
        qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
        qtbot.waitUntil(lambda: strip.content.windows.count == count, timeout=30_000)
        return window.panel("analysis").view

    return show


def test_how_long_windows_are_is_said_where_only_their_begins_are(studio, tmp_path):
    count, length = 24, "24.6 ms"
    panel = studio(count)
    assert length in panel.strip.head_text
    assert "traces" in panel.strip.head_text
    save_drawing(tmp_path / "a.svg", panel.draw_picture, 1400, 900)
    printed = (tmp_path / "a.svg").read_text("utf-8")
    assert f"Windows of {length}; above each when it begins, in ms of the stimulus; " in printed
    assert "the traces show it about 52 ms later" in printed
    levels_db = panel.strip.content.levels_db
    content = studio(count, delay_removed=True).strip.content
    # Only texts change.
    assert content.levels_db is levels_db
    assert "52 ms" not in panel.strip.head_text
    assert not any("traces" in begin_phrase for begin_phrase in content.begin_phrases)


def test_with_several_places_distances_are_from_the_nearest_input(studio, tmp_path):
    panel = studio(5)
    content = panel.strip.content
    assert "Mean distance from the input" in content.extent_text(0)
    design = replace(TRAIN, inputs=(*TRAIN.inputs, track(12, WaveletTrain())))
    several = replace(content, design=design)
    assert "Mean distance from the nearest input" in several.extent_text(0)
    twice = tuple(replace(TRAIN.inputs[0], id=id, clips=()) for id in (1, 2))
    again = replace(content, design=replace(TRAIN, inputs=twice))
    assert "Mean distance from the input" in again.extent_text(0)
    panel.strip.content = several
    save_drawing(tmp_path / "a.svg", panel.draw_picture, 1400, 900)
    assert "mm from the nearest input" in (tmp_path / "a.svg").read_text("utf-8")
