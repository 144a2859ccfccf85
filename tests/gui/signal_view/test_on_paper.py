"""On paper, where dots are finer than pixels, curves are as they are."""

from dataclasses import replace
from functools import partial

import numpy as np
from PySide6.QtGui import QColor

from skinsource_gui.plots.pictures import drawn_image, save_drawing
from skinsource_gui.plots.ranges import wave_of
from skinsource_gui.plots.signal_view import draw_signals
from skinsource_gui.qt.theme import LIGHT
from tests.gui.signal_view.bench import TIME, waves

RATE_HZ = 1300.0
SIZE = 400, 300


def tone(n_points, frequency_hz=433.0):
    """As long as it takes for straight lines between its samples to beat."""
    x = np.arange(n_points) / RATE_HZ
    y = np.sin(2 * np.pi * frequency_hz * x)[np.newaxis]
    return replace(waves(1), x=x, y=y, wave=wave_of(x, y))


def ink(plot, dpi):
    """Where the first curve is, (n_rows, n_columns), in a picture of that many dots in an inch."""
    image = drawn_image(partial(draw_signals, plot=plot), *SIZE, dpi)
    dots = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1, 4)
    colour = QColor(LIGHT.outputs[0])
    channels = np.array([colour.blue(), colour.green(), colour.red()])
    return np.abs(dots[..., :3].astype(int) - channels).max(axis=-1) < 40


def test_the_wave_itself_is_drawn_not_lines_between_samples(signals):
    signals.set_view(TIME, None, stacked=False)
    signals.show_curves(tone(1000), synthetic=False)
    pixels = ink(signals.plot, 200)
    legend = pixels.shape[0] // 4
    columns = pixels[legend:, pixels.shape[1] // 4 : -pixels.shape[1] // 8]
    tops = np.argmax(columns, axis=0)
    # Lines between three samples in a period lose up to half of its height.
    assert np.ptp(tops) <= 0.03 * columns.shape[0]


def test_words_above_that_are_too_long_for_a_line_are_broken(signals, tmp_path):
    long = "made from files that are not the published ones: " + "responses.mat " * 4
    signals.show_curves(replace(waves(2), heading=("A", long)), synthetic=False)
    save_drawing(tmp_path / "a.svg", partial(draw_signals, plot=signals.plot), 250, 300)
    drawing = (tmp_path / "a.svg").read_text("utf-8").replace("\N{NO-BREAK SPACE}", " ")
    assert "published ones" in drawing
    assert long not in drawing
    assert drawing.count("responses.mat") == 4
