"""The spectra, as a user meets them: of a signal, relative to their peaks, and along each axis."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QFontMetricsF

from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.signals.spectra import MEAN_OF_BINS, magnitude_spectrum
from skinsource_gui.panels.spectra.panel import SpectraPanel, SpectraSettings
from skinsource_gui.plots.signal_view import SignalView, save_table
from skinsource_gui.qt.theme import current_theme
from skinsource_gui.state.preferences import start_design
from tests.gui.curve_panels import bench
from tests.gui.signal_view.test_navigation import choose


@pytest.fixture
def show(qtbot):
    return bench.opener(qtbot, SpectraPanel, bench.LINEAR, bench.spectra_for)


def settings(view):
    return settings_of(view, "spectra", SpectraSettings)


@pytest.mark.parametrize("span", bench.SPECTRA)
def test_spectra_are_those_of_the_chosen_span_and_say_so_where_there_is_room(show, span):
    # A response may be longer than the record.
    panel = show(replace(bench.LINEAR, span=span), n_times=1300)
    assert panel.needs >= {bench.SPECTRA[span][0], "span"}
    metrics, header = QFontMetricsF(bench.plot_of(panel).text_font), bench.header_of(panel)
    assert header.scaling[0] in header.fitted(metrics, 10_000.0)[0]
    assert header.scaling[0].endswith("record, 0.5 s") == (span == "record")
    assert header.fitted(metrics, 10.0) == ("m/s²", "")


def test_the_level_switch_shows_db_of_the_same_results_at_once(show):
    panel = show()
    plot, legend = bench.plot_of(panel), panel.findChild(SignalView).legend
    plot.crosshair.put(plot.curves.nearest(100.0))
    button = bench.click(panel, "log-magnitude")
    assert settings(panel.views[-1]).log_magnitude
    assert button.isChecked()
    assert bench.header_of(panel).unit == "dB re 1 m/s²"
    assert legend.text.readings == ("−6.0", "−26.0")
    assert legend.text.unit == "dB"
    assert plot.value_scale.values == (-85.0, -5.0)
    bench.click(panel, "log-magnitude")
    assert bench.header_of(panel).unit == "m/s²"
    assert plot.value_scale.values[0] == 0.0


def test_frequency_goes_from_0_or_from_10_to_650_hz(show):
    panel = show()
    window = bench.plot_of(panel).x_window
    assert window.values(window.shown) == pytest.approx((0.0, 650.0))
    choose(panel.findChild(SignalView), "Log frequency")
    assert settings(panel.views[-1]).log_frequency
    window = bench.plot_of(panel).x_window
    assert window.values(window.shown) == pytest.approx((10.0, 650.0))
    labels = {text for _, text in bench.plot_of(panel).stack.x_axis.ticks()}
    assert {"10", "100", "500"} <= labels


def test_the_measured_band_is_told_from_what_lies_outside(show):
    panel = show()
    axis, area = bench.plot_of(panel).stack.x_axis, bench.plot_of(panel).places.area
    below, above = (axis.mapRectToScene(part) for part in axis.shaded())
    assert (below.left(), below.width()) == pytest.approx((area.left(), area.width() * 25 / 650))
    assert above.left() == pytest.approx(area.left() + area.width() * 600 / 650)
    assert above.width() == pytest.approx(area.width() * 50 / 650)
    assert (below.top(), below.height()) == pytest.approx((area.top(), area.height()))
    zoomed = replace(settings(bench.LINEAR), frequency_range_hz=(50.0, 300.0))
    panel.show_state(start_design("synthetic-1"), with_settings(bench.LINEAR, "spectra", zoomed))
    assert axis.shaded() == []


@pytest.mark.parametrize(
    ("axes", "method", "noted"), [("xy", "mag", True), ("z", "mag", False), ("xyz", "pca", False)]
)
def test_the_spectrum_of_a_magnitude_says_that_it_is_rectified(show, axes, method, noted):
    panel = show(replace(bench.LINEAR, axes=axes, method=method))
    notes = bench.header_of(panel).notes
    assert bool(notes) == noted
    if noted:
        assert notes[0] == "spectrum of a magnitude: rectified, shows doubled frequencies"


def test_a_spectrum_can_be_drawn_as_the_mean_of_neighbouring_bins(show):
    panel = show()
    _, magnitude = noisy = magnitude_spectrum(
        np.random.default_rng(3).standard_normal((2, 650)), 1300.0
    )
    panel.show_results({**bench.spectra_for(bench.LINEAR), "selected_spectra": noisy})
    choose(panel.findChild(SignalView), "Mean of 10 bins")
    assert settings_of(panel.views[-1], "spectra", SpectraSettings).averaged
    drawn = bench.plot_of(panel).curves.y
    k = 100
    window = slice(k - MEAN_OF_BINS // 2, k + (MEAN_OF_BINS + 1) // 2)
    assert drawn[:, k] == pytest.approx(magnitude[:, window].mean(axis=-1))
    bench.click(panel, "log-magnitude")
    assert bench.plot_of(panel).curves.y == pytest.approx(20.0 * np.log10(drawn))
    bench.click(panel, "log-magnitude")
    bench.click(panel, "relative")
    assert bench.plot_of(panel).curves.y.max(axis=-1) == pytest.approx([1.0, 1.0], rel=0.2)
    bench.click(panel, "relative")
    choose(panel.findChild(SignalView), "Mean of 10 bins")
    assert bench.plot_of(panel).curves.y == pytest.approx(magnitude)


PEAKS = np.array([[0.5, 0.25, 0.1], [0.01, 0.02, 0.04]])


def along_axes(view, peaks=PEAKS):
    """Results of two outputs that move at 100 Hz by ``peaks`` along x, y and z."""
    time_s = np.arange(650) / 1300
    spectra = magnitude_spectrum(peaks[..., None] * np.sin(2 * np.pi * 100 * time_s), 1300.0)
    return {**bench.spectra_for(view), "selected_axis_spectra": spectra}


@pytest.fixture
def panel(show):
    """On the axes of both outputs."""
    panel = show()
    bench.click(panel, "axes")
    panel.show_results(along_axes(panel.views[-1]))
    return panel


def test_a_peak_is_one_of_the_measured_band(show):
    panel = show()
    time_s = np.arange(650) / 1300
    drift, vibration = (np.sin(2 * np.pi * hz * time_s) for hz in (10.0, 100.0))
    traces = np.stack((9.0 * drift + vibration, 0.1 * vibration))
    panel.show_results(
        {**bench.spectra_for(bench.LINEAR), "selected_spectra": magnitude_spectrum(traces, 1300.0)}
    )
    bench.click(panel, "relative")
    plot = bench.plot_of(panel)
    assert plot.curves.y[:, plot.curves.nearest(100.0)] == pytest.approx([1.0, 1.0])
    assert plot.curves.y.max() == pytest.approx(9.0)
    assert plot.value_scale.values == (0.0, 1.1)


def test_scales_need_nothing_that_was_not_there(show):
    panel = show()
    needed = panel.needs
    for name in ("relative", "log-magnitude", "stacked"):
        bench.click(panel, name)
        assert panel.needs == needed
    bench.click(panel, "axes")
    assert panel.needs - needed == {"selected_axis_spectra"}
    assert needed - panel.needs == {"selected_spectra"}
    panel.show_state(None, replace(panel.views[-1], span="loudest"))
    assert "selected_axis_peak_spectra" in panel.needs


def test_rows_have_a_curve_for_each_axis_in_colours_that_no_output_has(panel):
    plot = bench.plot_of(panel)
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
    plot, legend = bench.plot_of(panel), panel.findChild(SignalView).legend
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
    assert bench.header_of(panel).notes == ()
    curves = bench.plot_of(panel).curves
    assert "along each axis of the sensors" in curves.heading
    assert "axes: each axis of the sensors, by itself" in curves.about()
    save_table(tmp_path / "spectra.csv", bench.plot_of(panel), "Spectra")
    table = (tmp_path / "spectra.csv").read_text("utf-8")
    assert "frequency_hz,output_29_x_m_per_s2,output_29_y_m_per_s2" in table
    for name, unit in (("relative", "of_its_peak"), ("log-magnitude", "db_re_its_peak")):
        bench.click(panel, name)
        panel.show_results(along_axes(panel.views[-1]))
        save_table(tmp_path / "spectra.csv", bench.plot_of(panel), "Spectra")
        table = (tmp_path / "spectra.csv").read_text("utf-8")
        assert f"output_52_z_{unit}" in table
        assert "relative to its largest magnitude" in table
