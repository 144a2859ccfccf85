"""Spectra as means over neighbouring bins: what is drawn, said and copied."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QMenu, QToolButton

from skinsource.design.panel_settings import settings_of
from skinsource.signals.spectra import MEAN_OF_BINS, magnitude_spectrum, mean_of_bins
from skinsource_gui.panels.spectra.panel import SpectraSettings
from skinsource_gui.plots.signal_view import SignalView, save_table
from tests.gui.curve_panels.bench import click, header_of, plot_of
from tests.gui.curve_panels.spectra_bench import LINEAR, opener, results_for


@pytest.fixture
def show(qtbot):
    return opener(qtbot)


def average(panel):
    """Choose it in the menu of the plot."""
    panel.findChild(SignalView)._open_menu(QPoint(0, 0))
    menu = panel.findChild(QMenu, "plot-menu")
    next(action for action in menu.actions() if action.text() == "Mean of 10 bins").trigger()
    menu.close()


def noisy(n_times=650):
    noise = np.random.default_rng(3).standard_normal((2, n_times))
    return magnitude_spectrum(noise, 1300.0)


def test_a_spectrum_can_be_drawn_as_the_mean_of_neighbouring_bins(show):
    panel = show()
    frequency_hz, magnitude = noisy()
    panel.show_results({**results_for(LINEAR), "selected_spectra": (frequency_hz, magnitude)})
    average(panel)
    assert settings_of(panel.views[-1], "spectra", SpectraSettings).averaged
    drawn = plot_of(panel).curves.y
    k = 100
    window = slice(k - MEAN_OF_BINS // 2, k + (MEAN_OF_BINS + 1) // 2)
    assert drawn[:, k] == pytest.approx(magnitude[:, window].mean(axis=-1))
    click(panel, "log-magnitude")
    assert plot_of(panel).curves.y == pytest.approx(20.0 * np.log10(drawn))
    click(panel, "log-magnitude")
    click(panel, "relative")
    assert plot_of(panel).curves.y.max(axis=-1) == pytest.approx([1.0, 1.0], rel=0.2)
    click(panel, "relative")
    average(panel)
    assert plot_of(panel).curves.y == pytest.approx(magnitude)


def test_peaks_are_those_of_the_means_that_are_drawn(show):
    panel = show()
    spectra = noisy()
    panel.show_results({**results_for(LINEAR), "selected_spectra": spectra})
    average(panel)
    click(panel, "relative")
    within = (spectra[0] >= 25.0) & (spectra[0] <= 600.0)
    peaks = mean_of_bins(spectra[1], MEAN_OF_BINS)[:, within].max(axis=-1)
    assert plot_of(panel).curves.peaks == pytest.approx(peaks)


def test_a_mean_is_said_above_and_in_what_is_copied(show, tmp_path):
    panel = show()
    average(panel)
    assert all(text.endswith("mean of 10 bins") for text in header_of(panel).scaling)
    save_table(tmp_path / "spectra.csv", plot_of(panel), "Spectra")
    text = (tmp_path / "spectra.csv").read_text("utf-8")
    # 650 samples at 1300 Hz: bins of 2 Hz.
    assert "over the whole record, mean of 10 bins, 20 Hz" in text
    average(panel)
    save_table(tmp_path / "spectra.csv", plot_of(panel), "Spectra")
    assert "mean of" not in (tmp_path / "spectra.csv").read_text("utf-8")


def test_its_switch_stands_above_the_plot_while_it_is_on(show):
    panel = show()
    switch = panel.findChild(QToolButton, "averaged")
    assert not switch.isVisible()
    average(panel)
    assert switch.isVisible()
    assert switch.isChecked()
    switch.setFocus(Qt.FocusReason.TabFocusReason)
    click(panel, "averaged")
    assert not settings_of(panel.views[-1], "spectra", SpectraSettings).averaged
    assert not switch.isVisible()
    assert panel.isAncestorOf(panel.focusWidget())


def test_the_scene_of_noise_shows_means(window, settle, qtbot):
    window.scenes.open("2D")
    settle()
    plot = plot_of(window.panel("spectra"))
    qtbot.waitUntil(lambda: plot.curves is not None and plot.curves.axes == ("x", "y", "z"))
    assert all(text.endswith("mean of 10 bins") for text in plot.curves.scaling)
    assert "bins" not in window.document.design.notes
