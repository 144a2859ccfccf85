"""The preview of a waveform, pixel by pixel."""

import numpy as np
import pytest

from skinsource_gui.plots.preview import WaveformPreview


@pytest.fixture
def preview(qtbot):
    widget = WaveformPreview(axis=True)
    qtbot.addWidget(widget)
    widget.resize(420, 140)
    widget.set_look(0)
    widget.show()
    return widget


def test_one_loud_sample_in_a_minute_is_seen(preview):
    samples = np.zeros(78_000)
    samples[41_234] = 1.0
    preview.show_samples(samples, 1300.0)
    picture = preview.grab().toImage()
    # Right of the middle, just below the top.
    drawn = [column for column in range(420) if picture.pixelColor(column, 20).blue() > 150]
    inked = [column for column in drawn if picture.pixelColor(column, 20).red() < 120]
    assert inked
    assert all(215 <= column <= 225 for column in inked)


@pytest.mark.parametrize("n_samples", [600, 2600])
def test_a_tone_whose_samples_miss_its_peak_reaches_it(preview, n_samples):
    preview.show_samples(np.sin(0.5 * np.pi * np.arange(n_samples) + np.pi / 4), 1300.0)
    picture = preview.grab().toImage()
    # Samples alone end 18 px below the top.
    highest = 140 - 18 - 2
    for x in range(100, 300, 10):
        inked = [
            y
            for y in range(highest // 2)
            if any(picture.pixelColor(x + k, y).red() < 120 for k in range(5))
        ]
        assert min(inked) <= 8
