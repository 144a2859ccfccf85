"""The Analysis panel: its chooser, two of them beside each other, and the units that it says."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtWidgets import QApplication

from skinsource.design.panel_settings import settings_of
from skinsource.engine.evaluation import evaluate
from skinsource_gui.panels.analysis.settings import VIEWS, AnalysisSettings
from skinsource_gui.plots.pictures import save_drawing
from tests.gui.analysis.analysis_bench import analysis, copied


@pytest.fixture
def window(open_window, settle_on):
    window = open_window()
    window.document.look(replace(window.document.view, outputs=(20, 26)))
    settle_on(window)
    return window


@pytest.fixture
def settle_on(qtbot):
    def settle(window):
        qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
        QApplication.processEvents()

    return settle


def test_what_is_chosen_is_shown_with_what_it_answers_and_saved(window, settle_on):
    analysis(window, "statistics")
    panel = window.panel("analysis")
    for spec in VIEWS:
        panel.choice.choose(spec.name)
        settle_on(window)
        assert settings_of(window.document.view, "analysis", AnalysisSettings).shown == spec.name
        assert (panel.view.name, panel.view.title) == (spec.name, spec.title)
        assert panel.answer.whole == spec.answer
        assert [view.isVisible() for view in panel._views.values()].count(True) == 1
        assert panel.copy.isVisible() == panel.view.copies
        assert not panel.view.is_stale
    # What was chosen before shows the present design when it is chosen again.
    panel.choice.choose("statistics")
    settle_on(window)
    before = panel.view.rows
    panel.choice.choose("regions")
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=5.0))
    settle_on(window)
    panel.choice.choose("statistics")
    settle_on(window)
    assert panel.view.rows[0].values[0] == pytest.approx(5.0 * before[0].values[0])
    assert panel.copy.isEnabled()
    # What an audience is to guess is covered in each view that is chosen.
    panel.show_covered(True)
    panel.choice.choose("windowed")
    assert panel.view._covers
    panel.show_covered(False)
    assert not panel.view._covers


def test_a_second_one_beside_the_first_shows_another_view_or_the_same(window, settle_on):
    window.do("arrange_analysis")
    first = analysis(window, "statistics")
    second = analysis(window, "main_axis", "analysis_2")
    settle_on(window)
    assert first.isVisible()
    assert second.isVisible()
    assert first.rows
    assert second.message == ""
    panel = window.panel("analysis_2")
    panel.choice.choose("statistics")
    settle_on(window)
    assert window.panel("analysis").view is first
    assert [row.values for row in panel.view.rows] == [row.values for row in first.rows]
    assert not panel.view.is_stale


@pytest.mark.parametrize("visible", [True, False])
def test_a_picture_of_another_view_leaves_the_chosen_one(window, settle_on, tmp_path, visible):
    panel, shown = window.panel("analysis"), analysis(window, "statistics")
    window.docks["analysis"].setVisible(visible)
    settle_on(window)
    picture = window.pictures.picture_of("analysis/windowed")
    save_drawing(tmp_path / "a.svg", picture.draw, 900, 700)
    text = (tmp_path / "a.svg").read_text("utf-8")
    assert " in windows" in text
    assert (panel.view, panel.choice.value) == (shown, "statistics")
    window.docks["analysis"].bring_forward()
    settle_on(window)
    assert shown.rows
    assert not shown.is_stale


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
    assert picture.axes.x.shown[0] == pytest.approx(-0.005 if removed else 0.0)
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
