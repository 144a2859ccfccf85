"""A clip shows the wave through its samples, zoomed in and out."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QSizeF
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QApplication

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.timeline.painting import ClipPictures, ClipStyle
from tests.gui.timeline.bench import results_of
from tests.gui.timeline.lanes_bench import LanesBench

RATE_HZ, TONE_HZ = 1300.0, 433.0
BLUE = QColor("blue").rgba()
HEIGHT = 201


def tone(n_samples):
    return np.sin(2 * np.pi * TONE_HZ * np.arange(n_samples) / RATE_HZ)


def tops_of(pixmap):
    """The highest row of each column that has ink."""
    image = pixmap.toImage()
    pixels = np.frombuffer(image.constBits(), np.uint32).reshape(image.height(), -1)
    return np.argmax(pixels >> 24 > 100, axis=0)


@pytest.mark.parametrize("reach", [0.5, -0.5])
def test_crests_between_samples_are_as_high_as_they_are(reach):
    pictures = ClipPictures()
    look = ClipStyle(RATE_HZ, BLUE, reach, part=(0.4, 0.6))
    tops = tops_of(pictures.picture(tone(260), QSizeF(520, HEIGHT), look))
    # Each period, of 30 px, has its crest at half of the upper half.
    crests = tops[10:-10].reshape(-1, 50).min(axis=1)
    assert np.abs(crests - HEIGHT / 4).max() <= 3
    assert pictures.waves == 1


@pytest.mark.parametrize("n_samples", [600, 2600, 13_000])
def test_zoomed_out_it_reaches_as_far_as_its_wave_whatever_its_samples_miss(n_samples):
    samples = 0.7 * np.sin(0.5 * np.pi * np.arange(n_samples) + np.pi / 4)
    assert samples.max() < 0.5
    picture = ClipPictures().picture(samples, QSizeF(520, HEIGHT), ClipStyle(RATE_HZ, BLUE, 1.0))
    # Each four columns hold a crest.
    tops = tops_of(picture)[8:-8].reshape(-1, 4).min(axis=1)
    assert np.abs(tops - 0.3 * HEIGHT / 2).max() <= 3


@pytest.mark.parametrize("seen_s", [(0.0, 2.0), (0.1, 0.2)])
def test_the_timeline_draws_the_wave_of_what_is_seen(qtbot, seen_s):
    bench = LanesBench(qtbot)
    clip = Clip(waveform=Tone(TONE_HZ, 0.0, 0.5))
    bench.view = replace(bench.view, time_range_s=seen_s)
    bench.show(Design(limb="synthetic-1", inputs=(Input(location=7, clips=(clip,)),)))
    bench.panel.show_results(results_of(bench.design))
    QApplication.processEvents()
    bench.lanes.viewport().repaint()
    assert bench.lanes.item.pictures.waves == bench.lanes.item.pictures.painted > 0
