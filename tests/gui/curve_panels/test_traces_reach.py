"""Traces reach as far as the wave between samples, however they are projected and scaled."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.design.design import Design, track
from skinsource.design.panel_settings import with_settings
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.evaluation import evaluate
from skinsource.signals.resampling import EXTREMES_ERROR, finer
from skinsource_gui.panels.traces.panel import TracesPanel, TracesSettings

# A quarter of the rate.
TONE = Tone(frequency_hz=325.0, phase_rad=0.7853981633974483, duration_s=0.6)
OUTPUTS = 20, 26


@pytest.fixture
def panel(qtbot):
    made = TracesPanel()
    qtbot.addWidget(made)
    made.resize(240, 300)
    made.show()
    qtbot.waitExposed(made)
    return made


@pytest.mark.parametrize("method", ["mag", "pca"])
@pytest.mark.parametrize("layout", ["overlaid", "stacked"])
@pytest.mark.parametrize("relative", [False, True])
def test_curves_reach_as_far_as_the_wave(panel, method, layout, relative):
    design = Design(limb="synthetic-1", inputs=(track(location=8, waveform=TONE),))
    view = View(axes="xyz", method=method, outputs=OUTPUTS)
    settings = TracesSettings(layout=layout, relative=relative)
    view = with_settings(view, panel.name, settings)
    results = evaluate(design, *panel.needs, view=replace(view, outputs=OUTPUTS))
    panel.show_state(design, view)
    panel.show_results(results)
    plot = panel._plot.plot
    dense_s, axes = finer(results["response_time_s"], results["axis_traces"])
    dense = results["selected_projection"].signals(axes)
    if relative:
        dense = dense / np.abs(results["selected_traces"]).max(axis=-1, keepdims=True)
    drawn = [curve for row in plot.stack.rows for curve in row.curves[: row.n_curves]]
    low, high = plot.value_scale.values
    factor = plot.x_window.axis.factor
    near = (high - low) / plot.places.row(0).height()
    missed = 0.0
    for rank, curve in enumerate(drawn):
        heights = (curve.points.y - plot.value_scale.edge) / (1 - 2 * plot.value_scale.edge)
        values = low + heights * (high - low)
        for first_s in np.arange(0.2, 0.5, 0.02):
            ends = first_s, first_s + 0.02
            of_wave = (dense_s >= ends[0]) & (dense_s < ends[1])
            at_s = curve.points.x / factor
            top = values[(at_s >= ends[0]) & (at_s < ends[1])].max()
            expected = dense[rank, of_wave].max()
            peak = np.abs(dense[rank]).max()
            assert top == pytest.approx(expected, abs=EXTREMES_ERROR * peak + near)
            response_time_s = results["response_time_s"]
            samples = plot.curves.y[
                rank, (response_time_s >= ends[0]) & (response_time_s < ends[1])
            ]
            missed = max(missed, (expected - samples.max()) / peak)
    # Samples alone would lie.
    assert missed > 0.1
    assert high >= dense.max()
