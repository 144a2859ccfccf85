"""Peaks to which traces are relative, in their legend."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.design.panel_settings import with_settings
from skinsource_gui.panels.traces.panel import TracesSettings
from skinsource_gui.plots.curves import Curves, output_names
from skinsource_gui.plots.signal_view import SignalView, _legend_lines
from skinsource_gui.state.preferences import start_design
from tests.gui.curve_panels.bench import click, plot_of
from tests.gui.curve_panels.traces_bench import SIGNED, opener


@pytest.fixture
def show(qtbot):
    return opener(qtbot)


def test_the_peaks_to_which_curves_are_relative_are_said_with_their_unit(show):
    panel = show()
    plot, legend = plot_of(panel), panel.findChild(SignalView).legend
    numbers = [name.number for name in plot.curves.names]
    peaks = np.abs(plot.curves.y).max(axis=-1)
    assert legend.text.readings == ()
    click(panel, "relative")
    assert (legend.text.where, legend.text.unit) == ("peak", "m/s²")
    read = [float(reading.replace("\N{THIN SPACE}", "")) for reading in legend.text.readings]
    assert read == pytest.approx(peaks, rel=5e-3)
    first, second, *_ = legend.text.lines().splitlines()
    assert first == "peak"
    assert second.startswith(f"{numbers[0]}  ")
    assert second.endswith(f": {legend.text.readings[0]} m/s²")
    # In a picture too, where nothing is read.
    texts = [text for line in _legend_lines(plot) for _, _, text in line]
    assert texts[0].endswith(f", peak {legend.text.readings[0]} m/s²")
    # Where the crosshair is, parts of the peaks are read.
    plot.crosshair.put(100)
    assert legend.text.unit == "of its peak"
    plot.crosshair.put(None)
    click(panel, "relative")
    assert legend.text.readings == ()


def test_peaks_in_a_narrow_panel_have_two_lines_and_keep_them_while_one_reads(show):
    panel = show(replace(SIGNED, outputs=(20, 24, 26, 27)))
    plot, legend = plot_of(panel), panel.findChild(SignalView).legend
    one_line = legend.sizeHint().height()
    legend.let_fold(True)
    click(panel, "relative")
    folded = legend.sizeHint().height()
    assert folded > one_line
    plot.crosshair.put(100)
    assert legend.text.where.endswith("ms")
    assert legend.sizeHint().height() == folded
    # Where the plot is low there is one line again, and no peak without its output.
    legend.let_fold(False)
    plot.crosshair.put(None)
    assert legend.sizeHint().height() == one_line
    legend.let_fold(True)
    click(panel, "relative")
    assert legend.sizeHint().height() == one_line


def test_curves_before_a_problem_do_not_come_back_relative_to_their_peaks(show):
    panel = show()
    panel.show_problem("There is no such thing.")
    relative = with_settings(SIGNED, "traces", TracesSettings(relative=True))
    panel.show_state(start_design("synthetic-1"), relative)
    assert plot_of(panel).curves is None
    assert plot_of(panel).message == "There is no such thing."


def test_peaks_that_differ_much_have_three_digits_each():
    curves = Curves(
        x=np.arange(2.0),
        y=np.ones((3, 2)),
        names=output_names((1, 2, 3), "synthetic-1"),
        kind="relative",
        peaks=(12.345, 0.0312345, 0.0),
    )
    assert curves.peak_texts == ("12.3", "0.0312", "0")
    assert curves.peak_unit.symbol == "m/s²"
