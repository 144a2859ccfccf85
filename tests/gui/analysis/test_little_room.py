"""Maps, scale and extent can be told apart in letters of any size; what has no room is scrolled."""

import pytest
from PySide6.QtCore import QRectF

import skinsource as ss
from skinsource.design.design import Design, track
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource_gui.panels.analysis.windowed import CURVES, curve_names, least_height, strip_layout
from skinsource_gui.shell.appearance import LARGEST_TEXT
from tests.gui.analysis.analysis_bench import analysis

TRAIN = Design(limb="synthetic-4", inputs=(track(7, WaveletTrain()),))


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


def test_names_of_curves_are_as_long_as_they_fit():
    for room, names in ((500.0, ("mean distance", "90 % of the energy within")), (9.0, CURVES[1])):
        assert curve_names(room, lambda text: 10.0 * len(text), 20.0) == names
