"""Zoomed in, a plot over time shows the wave through the samples, and marks them."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from skinsource.design.view import View
from skinsource.engine.evaluation import evaluate
from skinsource.signals.resampling import FINER, finer
from skinsource_gui.panels.traces.panel import TracesPanel
from skinsource_gui.plots.curves import Curves, output_names
from skinsource_gui.plots.ranges import wave_of
from skinsource_gui.qt.theme import current_theme
from skinsource_gui.state.preferences import start_design
from tests.gui.signal_view.bench import TIME, drawn

RATE_HZ = 1300.0
CLOSE = (0.4, 0.43)


def tone(at_s, frequency_hz=400.0, phase=0.3):
    return np.sin(2 * np.pi * frequency_hz * at_s + phase)


def sampled(asked, signal=tone, n_points=1300, n_curves=2):
    """Samples of a tone and of half of it, which note what is asked between them."""
    x = np.arange(n_points) / RATE_HZ
    y = np.outer(1.0 / (1 + np.arange(n_curves)), signal(x))

    def points(first, end):
        asked.append((first, end))
        return finer(x, y, first, end)

    wave = replace(wave_of(x, y), points=points)

    names = output_names(tuple(range(1, n_curves + 1)), "synthetic-1")
    return Curves(x=x, y=y, names=names, wave=wave)


def values(signals, heights):
    scale = signals.plot.value_scale
    low, high = scale.values
    return low + (np.asarray(heights) - scale.edge) / (1 - 2 * scale.edge) * (high - low)


@pytest.mark.parametrize("stacked", [False, True])
def test_zoomed_in_it_draws_the_tone_itself_through_every_sample(signals, stacked):
    asked = []
    curves = sampled(asked)
    signals.show_curves(curves, synthetic=False)
    signals.set_view(TIME, CLOSE, stacked=stacked)
    for rank, curve in enumerate(drawn(signals)):
        at_s, levels = curve.points.x, values(signals, curve.points.y)
        assert at_s[0] <= CLOSE[0] <= CLOSE[1] <= at_s[-1]
        np.testing.assert_allclose(levels, tone(at_s) / (1 + rank), rtol=0, atol=1e-4)
        first = round(at_s[0] * RATE_HZ)
        samples = curves.y[rank, first : first + at_s[::FINER].size]
        np.testing.assert_allclose(levels[::FINER], samples, rtol=0, atol=1e-12)
    # Straight lines would miss much of it.
    assert np.abs(np.interp(at_s, curves.x, curves.y[0]) - tone(at_s)).max() > 0.2


def test_its_points_are_not_computed_until_there_are_two_pixels_for_each_sample(signals):
    asked = []
    curves = sampled(asked)
    signals.show_curves(curves, synthetic=False)
    width = signals.plot.places.row(0).width()
    signals.set_view(TIME, (0.1, 0.1 + (0.5 * width + 10) / RATE_HZ), stacked=False)
    assert asked == []
    assert set(np.diff(drawn(signals)[0].points.x).round(6)) == {round(1 / RATE_HZ, 6)}
    n_seen = int(0.5 * width - 10)
    signals.set_view(TIME, (0.1, 0.1 + n_seen / RATE_HZ), stacked=False)
    [(first, end)] = asked
    # Of the visible stretch alone.
    assert (first, end) == (129, 129 + end - first)
    assert end - first <= n_seen + 4


def test_samples_are_marked_where_eight_pixels_lie_between_them(signals):
    curves = sampled([])
    signals.show_curves(curves, synthetic=False)
    width = signals.plot.places.row(0).width()
    signals.set_view(TIME, (0.1, 0.1 + width / 7 / RATE_HZ), stacked=False)
    assert all(curve.dots is None for curve in drawn(signals))
    plain = signals.plot.grab().toImage()
    signals.set_view(TIME, (0.1, 0.1 + width / 20 / RATE_HZ), stacked=False)
    for rank, curve in enumerate(drawn(signals)):
        dots = [(curve.dots.at(k).x(), curve.dots.at(k).y()) for k in range(curve.dots.count())]
        at_s, heights = np.array(dots).T
        first = round(at_s[0] * RATE_HZ)
        samples = slice(first, first + len(dots))
        np.testing.assert_allclose(at_s, curves.x[samples], atol=1e-9)
        np.testing.assert_allclose(values(signals, heights), curves.y[rank, samples], atol=1e-12)
    # As wide as they are high, whatever is stretched: a sample at a crest, and what is around it.
    picture, row = signals.plot.grab().toImage(), signals.plot.stack.rows[0]
    best = int(np.argmax(curves.y[0, samples]))
    at = row.view.mapViewToScene(drawn(signals)[0].dots.at(best))
    colour = current_theme().output_colour(0).name()

    def inked(dx, dy):
        return picture.pixelColor(round(at.x() + dx), round(at.y() + dy)).name() == colour

    assert inked(0, 0)
    for far in (-5, 5):
        assert not inked(far, -3)
    assert picture != plain


def test_peaks_between_samples_are_in_the_range_and_readings_stay_those_of_samples(signals):
    # Four samples a period, none of them at a peak.
    curves = sampled([], partial(tone, frequency_hz=325.0, phase=np.pi / 4))
    assert curves.y.max() < 0.75
    signals.show_curves(curves, synthetic=False)
    whole = signals.plot.value_scale.values
    assert whole[1] >= 1.0
    signals.set_view(TIME, CLOSE, stacked=False)
    assert signals.plot.value_scale.values == whole
    assert values(signals, drawn(signals)[0].points.y).max() == pytest.approx(1.0, abs=1e-3)
    signals.plot.crosshair.put(curves.nearest(0.4102))
    index = signals.plot.crosshair.index
    assert index == round(0.4102 * RATE_HZ)
    reading = float(signals.legend.text.readings[0].replace("−", "-"))
    assert reading == pytest.approx(curves.y[0, index], abs=1e-3)


def test_a_magnitude_is_the_length_of_the_vector_between_samples_too(qtbot):
    design = start_design("synthetic-1")
    view = View(axes="xyz", method="mag", outputs=(29, 52), time_range_s=(0.06, 0.1))
    panel = TracesPanel()
    qtbot.addWidget(panel)
    panel.resize(500, 200)
    panel.show()
    panel.show_state(design, view)
    panel.show_results(evaluate(design, *panel.needs, view=view))
    plot = panel._plot.plot
    traces = evaluate(design, "axis_traces", "response_time_s", view=view)
    at_s, dense = finer(traces["response_time_s"], traces["axis_traces"])
    length = np.sqrt(np.square(dense).sum(axis=1))
    for rank, curve in enumerate(drawn(panel._plot)):
        expected = np.interp(curve.points.x, at_s, length[rank])
        np.testing.assert_allclose(
            values(panel._plot, curve.points.y), expected, atol=1e-9 * length.max()
        )
    assert plot.value_scale.values[0] == 0.0
