"""Spectra relative to their peaks, and along each axis: what is drawn, said, read and copied."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.design.panel_settings import settings_of
from skinsource.signals.spectra import magnitude_spectrum
from skinsource_gui.panels.spectra.panel import SpectraPanel, SpectraSettings
from skinsource_gui.plots.signal_view import SignalView, save_table
from skinsource_gui.qt.theme import current_theme
from tests.gui.curve_panels.bench import LINEAR, click, header_of, opener, plot_of, spectra_for

PEAKS = np.array([[0.5, 0.25, 0.1], [0.01, 0.02, 0.04]])


@pytest.fixture
def show(qtbot):
    return opener(qtbot, SpectraPanel, LINEAR, spectra_for)


def settings(panel):
    return settings_of(panel.views[-1], "spectra", SpectraSettings)


def along_axes(view, peaks=PEAKS):
    """Results of two outputs that move at 100 Hz by ``peaks`` along x, y and z."""
    time_s = np.arange(650) / 1300
    spectra = magnitude_spectrum(peaks[..., None] * np.sin(2 * np.pi * 100 * time_s), 1300.0)
    return {**spectra_for(view), "selected_axis_spectra": spectra}


@pytest.fixture
def panel(show):
    """On the axes of both outputs."""
    panel = show()
    click(panel, "axes")
    panel.show_results(along_axes(panel.views[-1]))
    return panel


def test_a_peak_is_one_of_the_measured_band(show):
    panel = show()
    time_s = np.arange(650) / 1300
    drift, vibration = (np.sin(2 * np.pi * hz * time_s) for hz in (10.0, 100.0))
    traces = np.stack((9.0 * drift + vibration, 0.1 * vibration))
    panel.show_results(
        {**spectra_for(LINEAR), "selected_spectra": magnitude_spectrum(traces, 1300.0)}
    )
    click(panel, "relative")
    plot = plot_of(panel)
    assert plot.curves.y[:, plot.curves.nearest(100.0)] == pytest.approx([1.0, 1.0])
    assert plot.curves.y.max() == pytest.approx(9.0)
    assert plot.value_scale.values == (0.0, 1.1)


def test_scales_need_nothing_that_was_not_there(show):
    panel = show()
    needed = panel.needs
    for name in ("relative", "log-magnitude", "stacked"):
        click(panel, name)
        assert panel.needs == needed
    click(panel, "axes")
    assert panel.needs - needed == {"selected_axis_spectra"}
    assert needed - panel.needs == {"selected_spectra"}
    panel.show_state(None, replace(panel.views[-1], span="loudest"))
    assert "selected_axis_peak_spectra" in panel.needs


def test_rows_have_a_curve_for_each_axis_in_colours_that_no_output_has(panel):
    plot = plot_of(panel)
    assert len(plot.stack.rows) == 2
    assert [row.n_curves for row in plot.stack.rows] == [3, 3]
    assert plot.curves.y.max(axis=-1) == pytest.approx(PEAKS.ravel())
    pens = [[curve.pen.color() for curve in row.curves[:3]] for row in plot.stack.rows]
    assert pens[0] == pens[1] == [current_theme().axis_colour(k) for k in range(3)]
    assert not {pen.name() for pen in pens[0]} & {
        current_theme().output_colour(k).name() for k in range(8)
    }
    assert [row.number.text for row in plot.stack.rows] == ["29", "52"]


def test_the_legend_names_the_axes_and_reads_all_outputs_along_each(panel):
    plot, legend = plot_of(panel), panel.findChild(SignalView).legend
    assert [name.short for name in legend.text.names] == ["x", "y", "z"]
    plot.crosshair.put(plot.curves.nearest(100.0))
    assert legend.text.readings == ("0.5000  0.0100", "0.2500  0.0200", "0.1000  0.0400")
    assert "x: along x at 29, 52: 0.5000  0.0100 m/s²" in legend.text.lines()
    for width in (900, 300, 150):
        panel.resize(width, 300)
        layout = legend.text_layout
        assert all(x + 20 <= layout.width_px for x, _ in layout.lines()[:-1])
        panel.grab()


def test_axes_say_so_whatever_was_chosen_and_nothing_of_rectified_magnitudes(panel, tmp_path):
    view = replace(panel.views[-1], method="mag", axes="xyz")
    panel.show_state(None, view)
    panel.show_results(along_axes(view))
    assert header_of(panel).notes == ()
    curves = plot_of(panel).curves
    assert "along each axis of the sensors" in curves.heading
    assert "axes: each axis of the sensors, by itself" in curves.about()
    save_table(tmp_path / "spectra.csv", plot_of(panel), "Spectra")
    table = (tmp_path / "spectra.csv").read_text("utf-8")
    assert "frequency_hz,output_29_x_m_per_s2,output_29_y_m_per_s2" in table
    for name, unit in (("relative", "of_its_peak"), ("log-magnitude", "db_re_its_peak")):
        click(panel, name)
        panel.show_results(along_axes(panel.views[-1]))
        save_table(tmp_path / "spectra.csv", plot_of(panel), "Spectra")
        table = (tmp_path / "spectra.csv").read_text("utf-8")
        assert f"output_52_z_{unit}" in table
        assert "relative to its largest magnitude" in table
