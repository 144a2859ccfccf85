"""What panels of analysis read and copy is in the units that they say."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPointF

from skinsource.engine.evaluation import evaluate
from tests.gui.analysis.analysis_bench import analysis, copied

LINE = (29, 31, 33, 35)


@pytest.fixture
def show(window, settle):
    """Bring a panel forward, with outputs along digit II selected."""

    def bring(name, **changes):
        window.document.look(replace(window.document.view, outputs=LINE, **changes))
        panel = analysis(window, name)
        settle()
        panel.grab()
        return panel

    return bring


@pytest.mark.parametrize("removed", [False, True])
def test_the_spectrogram_reads_its_times_with_the_delay_and_without_it(show, removed):
    picture = show("spectrogram", delay_removed=removed).picture
    spectrogram = picture.content.spectrogram
    assert picture.content.first_s == pytest.approx(-0.052 if removed else 0.0)
    row, column = np.unravel_index(np.argmax(spectrogram.amplitude), spectrogram.amplitude.shape)
    time_s = spectrogram.time_s[column] + picture.content.first_s
    place = picture.axes.to_screen(np.array([time_s]), spectrogram.frequency_hz[[row]])[0]
    text = picture.read(QPointF(*place))
    assert text.startswith(f"{time_s * 1e3:.1f} ms · {spectrogram.frequency_hz[row]:.1f} Hz")
    level_db = 20.0 * np.log10(spectrogram.amplitude.max())
    assert text.endswith(f"{level_db:.1f} dB re 1 m/s²".replace("-", "\N{MINUS SIGN}"))
    assert (picture.axes.x.title, picture.axes.x.factor) == ("Time (ms)", 1e3)


def test_the_wave_is_copied_in_millimetres_and_milliseconds(show, window):
    panel = show("wave")
    header, *below = copied(window).splitlines()
    lines = [line for line in below if not line.startswith("# ")]
    columns = np.array([line.split("\t") for line in lines]).T
    numbers = dict(zip(header.split("\t"), columns, strict=True))
    document = window.document
    wave = evaluate(document.design, "line_wave", view=document.view)["line_wave"].wave
    assert numbers["way_mm"].astype(float) == pytest.approx(1e3 * wave.distance_m)
    assert numbers["delay_ms"].astype(float) == pytest.approx(1e3 * wave.delay_s)
    assert numbers["level_z_db"].astype(float) == pytest.approx(wave.level_db)
    # About 95 mm along the finger and the hand.
    assert 50.0 < numbers["way_mm"].astype(float)[-1] < 200.0
    for diagram, title in ((0, "Delay (ms)"), (1, "Level z (dB)")):
        axes = panel.picture.placed[diagram][1]
        assert (axes.x.factor, axes.y.title) == (1e3, title)


def test_a_spectrogram_is_in_seconds_from_where_traces_are(show):
    picture = show("spectrogram").picture
    spectrogram = picture.content.spectrogram
    for last_s, title in ((0.9, "Time (ms)"), (1.1, "Time (s)")):
        time_s = np.linspace(0.0, last_s, spectrogram.time_s.size)
        picture.show_spectrogram(
            replace(picture.content, spectrogram=replace(spectrogram, time_s=time_s))
        )
        picture.grab()
        assert picture.axes.x.title == title
        text = picture.read(picture.axes.frame.center())
        assert title.endswith(f"({text.split()[1]})")
