"""The traces, as a user meets them."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from skinsource import Design, View, evaluate, track
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.waveforms.tones import Tone
from skinsource.signals.resampling import finer
from skinsource_gui.panels.traces.panel import TracesPanel, TracesSettings
from skinsource_gui.plots.signal_view import SignalView, _legend_lines, copy_of
from skinsource_gui.state.preferences import start_design
from tests.gui.curve_panels.bench import SIGNED, click, header_of, opener, plot_of, traces_for
from tests.gui.signal_view.test_navigation import choose
from tests.gui.skin.bench import drag


@pytest.fixture
def show(qtbot):
    return opener(qtbot, TracesPanel, SIGNED, traces_for)


def test_curves_are_named_after_the_outputs_they_belong_to(show):
    panel = show()
    names = panel.findChild(SignalView).legend.text.names
    assert [(name.number, name.short) for name in names] == [
        (29, "II nail rad."),
        (52, "wrist 1 rad."),
        (7, "mid hand 1"),
    ]
    # The view is ahead of the results: the old names stay with the old curves.
    panel.show_state(start_design("synthetic-1"), replace(SIGNED, outputs=(1, 2, 3)))
    assert panel.findChild(SignalView).legend.text.names == names


def test_time_begins_just_before_the_pulse_unless_the_pre_trigger_record_is_asked_for(show):
    panel = show(replace(SIGNED, delay_removed=True))
    plot, switch = plot_of(panel), panel.findChild(QToolButton, "pre-trigger")
    assert plot.stack.x_axis.titles == ("Time (ms)",)
    assert plot.x_window.shown[0] == pytest.approx(-0.005)
    assert not switch.isVisible()
    choose(panel.findChild(SignalView), "Show pre-trigger")
    assert not panel.views[-1].delay_removed
    assert plot.stack.x_axis.titles[0] == (
        "Time (ms) · responses start ~52 ms late (pre-trigger of the measurement)"
    )
    assert plot.x_window.shown[0] == 0.0
    assert switch.isVisible()
    click(panel, "pre-trigger")
    assert panel.views[-1].delay_removed


def test_what_an_equaliser_of_linear_phase_rings_before_0_is_not_shown_and_said(show):
    panel = show()
    plot = plot_of(panel)
    results = traces_for(SIGNED)
    time_s = results["response_time_s"]
    panel.show_results({**results, "response_time_s": time_s - 0.3})
    assert plot.x_window.shown == pytest.approx((0.0, time_s[-1] - 0.3))
    assert "not shown: 0.3 s before 0, where filters ring" in plot.stack.x_axis.titles[0]
    # Without such an equaliser nothing is left out, and nothing said.
    panel.show_results(results)
    assert plot.x_window.shown[0] == time_s[0]
    assert "not shown" not in plot.stack.x_axis.titles[0]


def test_stacked_and_overlaid_are_chosen_by_mouse_and_by_arrow_keys(show, qtbot):
    panel = show()
    panel.activateWindow()
    qtbot.waitUntil(panel.isActiveWindow)
    click(panel, "stacked")
    assert settings_of(panel.views[-1], "traces", TracesSettings).layout == "stacked"
    assert len(plot_of(panel).stack.rows) == 3
    stacked = panel.findChild(QToolButton, "stacked")
    stacked.setFocus()
    QTest.keyClick(stacked, Qt.Key.Key_Left)
    assert settings_of(panel.views[-1], "traces", TracesSettings).layout == "overlaid"
    assert len(plot_of(panel).stack.rows) == 1


def test_a_zoom_survives_new_data_and_is_left_by_the_button(show):
    panel = show()
    plot = plot_of(panel)
    leave = panel.findChild(QToolButton, "show-all")
    assert not leave.isVisible()
    drag(plot.viewport(), QPoint(120, 60), QPoint(220, 60))
    zoom = panel.views[-1].time_range_s
    assert plot.x_window.shown == pytest.approx(zoom)
    panel.show_results(traces_for(panel.views[-1], n_times=2000, amplitude=3.0))
    assert plot.x_window.shown == pytest.approx(zoom)
    assert leave.isVisible()
    QTest.mouseClick(leave, Qt.MouseButton.LeftButton)
    assert panel.views[-1].time_range_s is None
    assert plot.x_window.shown == pytest.approx((0.0, 650 / 1300))
    assert not leave.isVisible()


def test_a_problem_empties_the_picture_until_there_are_results(show):
    panel = show()
    panel.show_problem("input 3 has no samples")
    plot, legend = plot_of(panel), panel.findChild(SignalView).legend
    assert plot.message == "input 3 has no samples"
    assert plot.stack.rows == []
    assert legend.text.names == ()
    panel.show_state(start_design("synthetic-1"), replace(SIGNED, time_range_s=(0.0, 0.1)))
    assert plot.message == "input 3 has no samples"
    panel.show_results(traces_for(SIGNED))
    assert plot.message == ""
    assert plot.stack.rows[0].n_curves == 3


def test_outputs_without_a_main_axis_are_named_in_the_plot(show):
    panel = show(View(axes="xyz", method="pca", outputs=(29, 52)), without_axis=(29,))
    assert "selected_without_main_axis" in panel.needs
    assert "no principal axis at 29" in header_of(panel).notes[0]


@pytest.mark.parametrize(("until_s", "unit"), [(0.999, "ms"), (1.0, "s")])
def test_times_are_in_seconds_from_one_second_on(show, until_s, unit):
    panel = show(n_times=round(1300 * until_s) + 1)
    axis = plot_of(panel).x_window.axis
    assert axis.unit == unit
    assert axis.titles[0].startswith(f"Time ({unit}) · responses start ~52 ms late")
    assert axis.reading(0.123077) == {"ms": "123.08 ms", "s": "0.12308 s"}[unit]
    ticks = [tick.label for tick in axis.ticks(0.0, until_s, 400.0)]
    assert float(ticks[-1]) == pytest.approx(until_s * (1 if unit == "s" else 1000), rel=0.2)


def test_zoomed_in_values_fit_what_is_seen_if_that_is_chosen(show):
    panel = show(SIGNED)
    plot = plot_of(panel)
    results = traces_for(SIGNED)
    results["selected_traces"] = results["selected_traces"] * np.linspace(1.0, 1e-3, 651)
    panel.show_results(results)
    whole, late = plot.value_scale.values, (0.45, 0.5)
    panel.show_state(panel._design, replace(panel._view, time_range_s=late))
    assert plot.value_scale.values == whole
    settings = replace(settings_of(panel._view, "traces", TracesSettings), fitted=True)
    panel.show_state(panel._design, with_settings(panel._view, "traces", settings))
    largest = np.abs(plot.curves.y[:, plot.curves.x >= late[0]]).max()
    assert largest <= plot.value_scale.values[1] < 2.0 * largest < 0.2 * whole[1]
    heights = [curve.points.y for row in plot.stack.rows for curve in row.curves[: row.n_curves]]
    assert np.ptp(np.concatenate(heights)) > 0.5
    # A picture has the same range; new results and the whole have theirs.
    copy = copy_of(plot, plot.size())
    assert copy.value_scale.values == plot.value_scale.values
    copy.deleteLater()
    panel.show_results(results)
    assert plot.value_scale.values == copy.value_scale.values
    panel.show_state(panel._design, replace(panel._view, time_range_s=None))
    assert plot.value_scale.values == whole


def test_the_peaks_to_which_curves_are_relative_are_said_with_their_unit(show):
    panel = show()
    plot, legend = plot_of(panel), panel.findChild(SignalView).legend
    peaks = np.abs(plot.curves.wave.points(0, plot.curves.x.size)[1]).max(axis=-1)
    assert legend.text.readings == ()
    click(panel, "relative")
    assert (legend.text.where, legend.text.unit) == ("peak", "m/s²")
    read = [float(reading.replace("\N{THIN SPACE}", "")) for reading in legend.text.readings]
    assert read == pytest.approx(peaks, rel=5e-3)
    # In a picture too, where nothing is read.
    texts = [text for line in _legend_lines(plot, plot.width()) for _, _, text in line]
    assert texts[0].endswith(f", peak {legend.text.readings[0]} m/s²")
    # Where the crosshair is, parts of the peaks are read.
    plot.crosshair.put(100)
    assert legend.text.unit == "of its peak"
    plot.crosshair.put(None)
    click(panel, "relative")
    assert legend.text.readings == ()


# A quarter of the rate.
TONE = Tone(frequency_hz=325.0, phase_rad=0.7853981633974483, duration_s=0.6)


@pytest.mark.parametrize(
    ("method", "layout", "relative"),
    [("mag", "overlaid", True), ("mag", "stacked", False), ("pca", "stacked", True)],
)
def test_curves_reach_as_far_as_the_wave(show, method, layout, relative):
    panel = show()
    design = Design(limb="synthetic-1", inputs=(track(location=8, waveform=TONE),))
    view = View(axes="xyz", method=method, outputs=(20, 26))
    view = with_settings(view, panel.name, TracesSettings(layout=layout, relative=relative))
    panel.show_state(design, view)
    results = evaluate(design, *panel.needs, view=view)
    panel.show_results(results)
    plot = panel._plot.plot
    dense_s, axes = finer(results["response_time_s"], results["axis_traces"])
    dense = results["selected_projection"].signals(axes)
    at_s, waves = plot.curves.wave.points(0, plot.curves.x.size)
    if relative:
        peaks = np.abs(waves).max(axis=-1, keepdims=True)
        assert peaks == pytest.approx(1.0, abs=0.005)
        dense = peaks * dense / np.abs(dense).max(axis=-1, keepdims=True)
    np.testing.assert_allclose(at_s, dense_s)
    np.testing.assert_allclose(waves, dense, rtol=0, atol=1e-9)
    low, high = plot.curves.wave.extremes(0, plot.curves.x.size).range
    assert (low, high) == pytest.approx((dense.min(), dense.max()), abs=0.01 * dense.max())
    # Samples alone would lie.
    assert (dense.max(axis=-1) > 1.1 * plot.curves.y.max(axis=-1)).any()
    assert plot.value_scale.values[1] >= dense.max()
