"""However many windows there are, it is said when they are."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QRectF

import skinsource as ss
from skinsource.design.design import Design, track
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource_gui.panels.analysis.windowed import strip_layout, window_titles
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


def test_how_long_windows_are_is_said_where_only_their_begins_are(open_window, qtbot):
    window = open_window(TRAIN, ss.View(method="mag", windows_cut="count", window_count=24))
    strip = analysis(window, "windowed").strip
    qtbot.waitUntil(lambda: strip.content is not None, timeout=30_000)
    assert "24.6 ms" in strip.head_text
    levels_db = strip.content.levels_db
    assert "traces" in strip.content.begin_phrases[0]
    window.document.look(replace(window.document.view, delay_removed=True))
    qtbot.waitUntil(lambda: not any("traces" in each for each in strip.content.begin_phrases))
    # Only texts change.
    assert strip.content.levels_db is levels_db
