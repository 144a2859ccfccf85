"""What panels of analysis read and copy is in the units that they say."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtGui import QGuiApplication

from skinsource.evaluation import evaluate
from skinsource_gui.panels.spectrogram.picture import scale_words

LINE = (29, 31, 33, 35)


@pytest.fixture
def show(window, settle):
    """Bring a panel forward, with outputs along digit II selected."""

    def bring(name, **changes):
        window.document.look(replace(window.document.view, outputs=LINE, **changes))
        window.docks[name].bring_forward()
        settle()
        panel = window.panel(name)
        panel.grab()
        return panel

    return bring


@pytest.mark.parametrize("removed", [False, True])
def test_the_spectrogram_reads_its_times_with_the_delay_and_without_it(show, removed):
    picture = show("spectrogram", delay_removed=removed).picture
    found = picture.shown.found
    assert picture.shown.first_s == pytest.approx(-0.052 if removed else 0.0)
    row, column = np.unravel_index(np.argmax(found.amplitude), found.amplitude.shape)
    time_s = found.time_s[column] + picture.shown.first_s
    place = picture.axes.to_screen(np.array([time_s]), found.frequency_hz[[row]])[0]
    words = picture.read(QPointF(*place))
    assert words.startswith(f"{time_s * 1e3:.1f} ms · {found.frequency_hz[row]:.1f} Hz")
    level_db = 20.0 * np.log10(found.amplitude.max())
    assert words.endswith(f"{level_db:.1f} dB re 1 m/s²".replace("-", "\N{MINUS SIGN}"))
    assert (picture.axes.x.title, picture.axes.x.factor) == ("Time (ms)", 1e3)


def test_the_scale_of_the_spectrogram_says_once_what_levels_are_relative_to():
    assert scale_words(-20.0, top=True) == ("\N{MINUS SIGN}20 dB", "re 1 m/s²")
    assert scale_words(-50.0, top=False) == ("\N{MINUS SIGN}50 dB",)


def test_the_wave_is_copied_in_millimetres_and_milliseconds(show, window):
    panel = show("wave")
    panel.copy.click()
    header, *below = QGuiApplication.clipboard().text().splitlines()
    lines = [line for line in below if not line.startswith("# ")]
    columns = np.array([line.split("\t") for line in lines]).T
    copied = dict(zip(header.split("\t"), columns, strict=True))
    document = window.document
    wave = evaluate(document.design, "line_wave", view=document.view)["line_wave"].wave
    assert copied["way_mm"].astype(float) == pytest.approx(1e3 * wave.distance_m)
    assert copied["delay_ms"].astype(float) == pytest.approx(1e3 * wave.delay_s)
    assert copied["level_z_db"].astype(float) == pytest.approx(wave.level_db)
    # About 95 mm along the finger and the hand.
    assert 50.0 < copied["way_mm"].astype(float)[-1] < 200.0
    for diagram, title in ((0, "Delay (ms)"), (1, "Level z (dB)")):
        axes = panel.picture._diagrams[diagram][0]
        assert (axes.x.factor, axes.y.title) == (1e3, title)


def test_where_there_is_no_main_axis_no_line_is_drawn(show):
    picture = show("main_axis").picture
    shown = picture.shown

    def dark_pixels():
        image = picture.grab().toImage()
        pixels = (
            image.pixelColor(x, y) for x in range(image.width()) for y in range(image.height())
        )
        text = picture.theme.text
        return sum(one.name() == text.lower() for one in pixels)

    none = np.ones(len(LINE), bool)
    with_lines = dark_pixels()
    picture.show_axes(replace(shown, found=replace(shown.found, none=none)))
    assert dark_pixels() < with_lines / 2
