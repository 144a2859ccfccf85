"""Zoomed out, a plot over time shows how far the wave reaches, on the screen as in its picture."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from PySide6.QtCore import QSize

from skinsource.signals.resampling import EXTREMES_ERROR
from skinsource_gui.plots.curves import Curves, output_names
from skinsource_gui.plots.ranges import wave_of
from skinsource_gui.plots.signal_view import copy_of
from tests.gui.signal_view.bench import TIME, waves

RATE_HZ = 1300.0


def tone(at_s, frequency_hz):
    return np.sin(2 * np.pi * frequency_hz * at_s + np.pi / 4)


def curves_of(signal, n_points, n_curves=1):
    x = np.arange(n_points) / RATE_HZ
    y = np.outer(1.0 / (1 + np.arange(n_curves)), signal(x))
    names = output_names(tuple(range(1, n_curves + 1)), "synthetic-1")
    return Curves(x=x, y=y, names=names, wave=wave_of(x, y))


def test_the_extremes_of_a_wave_are_found_once_for_all_who_draw_it():
    x = np.arange(300) / RATE_HZ
    y = tone(x, 90.0)[np.newaxis]
    first, again, part, other = (
        wave_of(x, signals).extremes(start, 300)
        for signals, start in ((y, 0), (y.copy(), 0), (y, 1), (2 * y, 0))
    )
    assert again is first
    assert part.low.shape == (1, 299)
    assert other.sizes[0, 0] == pytest.approx(2 * first.sizes[0, 0])


def envelope(plot, rank, n_windows=40):
    """Highest value in each of some parts of the visible width.

    Not where the record begins and ends hard: there it rings.
    """
    rows = plot.stack.rows
    curve = [curve for row in rows for curve in row.curves[: row.n_curves]][rank]
    scale, (low, high) = plot.value_scale, plot.value_scale.values
    parts = (curve.points.y - scale.edge) / (1 - 2 * scale.edge)
    begin, end = plot.x_window.shown
    at = np.floor((curve.points.x - begin) / (end - begin) * n_windows).astype(int)
    values = low + parts * (high - low)
    return np.array(
        [values[at == k].max() for k in range(n_windows // 5, n_windows - n_windows // 5)]
    )


@pytest.mark.parametrize(
    ("frequency_hz", "per_px", "stacked"),
    [(325.0, 0.6, False), (1300 / 3, 1.5, True), (325.0, 3.0, True), (1300 / 3, 60.0, False)],
)
def test_a_tone_reaches_its_peak_everywhere_whatever_its_samples_miss(
    signals, frequency_hz, per_px, stacked
):
    signals.show_curves(waves(), synthetic=False)
    width = signals.plot.places.row(0).width()
    signals.plot.reset_range()
    curves = curves_of(partial(tone, frequency_hz=frequency_hz), int(per_px * width), n_curves=2)
    signals.set_view(TIME, None, stacked=stacked)
    signals.show_curves(curves, synthetic=False)
    for rank in range(2):
        peak = 1.0 / (1 + rank)
        # Blocks end with a whole row of pixels.
        low, high = signals.plot.value_scale.values
        near = EXTREMES_ERROR * peak + (high - low) / signals.plot.places.row(0).height()
        tops = envelope(signals.plot, rank)
        assert peak - near <= tops.min() <= tops.max() <= peak + near
    # On paper, where dots are finer, the range is the same.
    paper = copy_of(signals.plot, QSize(900, 600))
    assert paper.value_scale.values == signals.plot.value_scale.values
    paper.deleteLater()


def test_curves_whose_wave_is_not_known_are_joined_as_they_are(signals):
    curves = replace(curves_of(partial(tone, frequency_hz=325.0), 6500), wave=None)
    signals.show_curves(curves, synthetic=False)
    assert envelope(signals.plot, 0).max() < 0.75
