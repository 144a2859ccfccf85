"""Ranges, ticks and points of the plots: numbers, without a window."""

import numpy as np
import pytest

from skinsource_gui.plots import ranges
from skinsource_gui.plots.curves import Curves, output_names


def test_a_range_grows_at_once_and_shrinks_only_below_60_percent():
    held = ranges.SteadyRange()
    assert held.follow(-1.0, 0.5, "amplitude") == (-1.25, 1.25)
    assert held.follow(-0.9, 0.9, "amplitude") == (-1.25, 1.25)
    assert held.follow(-0.8, 0.3, "amplitude") == (-1.25, 1.25)
    assert held.follow(-1.26, 0.5, "amplitude")[1] == pytest.approx(1.6)
    assert held.follow(-0.9, 0.5, "amplitude")[1] == pytest.approx(1.6)
    assert held.follow(-0.4, 0.2, "amplitude")[1] == pytest.approx(0.5)


def test_magnitudes_start_at_zero_and_signed_values_are_symmetric():
    assert ranges.SteadyRange().follow(0.0, 0.9, "amplitude") == (0.0, 1.0)
    assert ranges.SteadyRange().follow(-0.1, 0.9, "amplitude") == (-1.0, 1.0)


def test_silence_keeps_the_range():
    held = ranges.SteadyRange()
    before = held.follow(-0.3, 0.3, "amplitude")
    assert held.follow(0.0, 0.0, "amplitude") == before
    loud = held.follow(-140.0, 12.0, "level")
    assert held.follow(-200.0, -200.0, "level") == loud


def test_levels_span_80_db_below_a_top_that_holds_still():
    held = ranges.SteadyRange()
    low, high = held.follow(-200.0, -12.0, "level")
    assert (low, high) == (-90.0, -10.0)
    assert held.follow(-200.0, -17.0, "level") == (-90.0, -10.0)
    assert held.follow(-200.0, -9.0, "level") == (-85.0, -5.0)
    assert held.follow(-200.0, -31.0, "level") == (-110.0, -30.0)


@pytest.mark.parametrize("peak", [5e-324, 1e-300, 3.7, 1e300])
def test_every_peak_fits_into_its_range_and_has_ticks_that_can_be_read(peak):
    low, high = ranges.SteadyRange().follow(-peak, peak, "amplitude")
    assert low <= -peak < peak <= high
    heights = ranges.ValueScale(values=(low, high)).heights(np.array([-peak, 0.0, peak]))
    assert 0 <= heights[0] < heights[1] == 0.5 < heights[2] <= 1
    unit = ranges.value_unit("amplitude", low, high)
    ticks = ranges.linear_ticks(low, high, 5, unit.factor)
    assert all(low * 1.001 <= tick.value <= high * 1.001 for tick in ticks)
    assert len({tick.label for tick in ticks}) == len(ticks)


@pytest.mark.parametrize(
    ("top", "symbol", "labels"),
    [
        (0.1, "m/s²", ["−0.10", "−0.05", "0.00", "0.05", "0.10"]),
        (0.005, "mm/s²", ["−4", "−2", "0", "2", "4"]),
        (2e-6, "µm/s²", ["−2", "−1", "0", "1", "2"]),
        (50.0, "m/s²", ["−40", "−20", "0", "20", "40"]),
    ],
)
def test_amplitude_ticks_are_plain_numbers_in_a_fitting_unit(top, symbol, labels):
    unit = ranges.value_unit("amplitude", -top, top)
    assert unit.symbol == symbol
    assert [tick.label for tick in ranges.linear_ticks(-top, top, 5, unit.factor)] == labels


def test_a_logarithmic_axis_labels_1_2_5_and_falls_back_to_even_steps_in_a_close_zoom():
    ticks = ranges.log_ticks(10, 650, 8)
    assert [tick.label for tick in ticks if tick.label] == ["10", "20", "50", "100", "200", "500"]
    assert {30.0, 40.0, 60.0} <= {round(tick.value, 6) for tick in ticks}
    assert [tick.label for tick in ranges.log_ticks(95, 125, 4)] == ["100", "110", "120"]


def test_thousands_stand_apart_and_there_is_no_negative_zero():
    assert ranges.number_text(1200.0, 0) == "1\u202f200"
    assert ranges.number_text(-1234567.5, 1) == "−1\u202f234\u202f567.5"
    assert ranges.number_text(-1e-9, 2) == "0.00"


def test_a_zoom_keeps_the_place_under_the_pointer_and_stays_inside():
    assert ranges.zoomed((0.0, 1.0), 0.25, 2.0) == (0.125, 0.625)
    assert ranges.within((-0.1, 0.3), (0.0, 1.0), 0.01) == pytest.approx((0.0, 0.4))
    assert ranges.within((0.5, 0.5001), (0.0, 1.0), 0.01) == pytest.approx((0.49505, 0.50505))
    assert ranges.within((-1.0, 2.0), (0.0, 1.0), 0.01) is None


@pytest.mark.parametrize(("columns", "size"), [(64, 2600), (325, 13_000), (333, 78_000)])
def test_every_column_has_its_stroke_even_where_samples_lie_on_its_edge(columns, size):
    samples = np.random.default_rng(size + columns).uniform(-1, 1, (1, size))
    few = ranges.columns_of(np.arange(size) / size, (0.0, 1.0), columns).points(samples)
    # The last sample stands alone at the end.
    assert np.allclose(few.x[:-2:2] * columns, np.arange(columns) + 0.5)
    assert few.y[0, -1] == samples[0, -1]
    assert (few.y.min(), few.y.max()) == (samples.min(), samples.max())


@pytest.mark.parametrize("seed", range(3))
def test_the_crosshair_snaps_to_the_nearest_sample(seed):
    random = np.random.default_rng(seed)
    x = np.sort(random.uniform(0, 1, random.integers(1, 40)))
    curves = Curves(x=x, y=np.zeros((1, x.size)), names=output_names((1,), "synthetic-1"))
    for at in random.uniform(-0.2, 1.2, 20):
        nearest = curves.nearest(at)
        assert abs(x[nearest] - at) == abs(x - at).min(), f"seed {seed}, x {at}"


def strokes_of(y, per_column):
    points = ranges.columns_of(np.arange(y.size), (0, y.size), y.size // per_column).points(y[None])
    assert points.strokes
    return points.y


@pytest.mark.parametrize("frequency_hz", [95.0, 250.0, 333.0])
@pytest.mark.parametrize("per_column", [9, 14, 20])
def test_the_edges_of_a_dense_tone_are_as_even_as_the_tone(frequency_hz, per_column):
    y = np.sin(2 * np.pi * frequency_hz * np.arange(200 * per_column) / 1300)
    filled = ranges.without_notches(strokes_of(y, per_column)).reshape(-1, 2)[3:-3]
    # A sample comes as near to the crest as half a step of its phase.
    crest = np.cos(np.pi * frequency_hz / 1300)
    assert filled.max(axis=-1).min() > crest - 0.13
    assert filled.min(axis=-1).max() < 0.13 - crest


@pytest.mark.parametrize(
    ("frequency_hz", "per_column", "strokes"), [(50, 8, False), (95, 5, False), (95, 6, True)]
)
def test_waves_are_samples_unless_columns_would_blur_them(frequency_hz, per_column, strokes):
    y = np.sin(2 * np.pi * frequency_hz * np.arange(200 * per_column) / 1300)[np.newaxis]
    columns = ranges.columns_of(np.arange(y.size), (0, y.size), 200)
    points = columns.reached(y, ranges.wave_of(columns.x, y).extremes(0, y.size))
    assert columns.points(y).strokes == points.strokes == strokes
    if strokes:
        ends = ranges.without_notches(points.y).reshape(-1, 2)[3:-3]
        assert ends.max(axis=-1).min() > 1 - 0.13


def test_ripples_in_silence_make_no_block_of_a_wave():
    y = np.sin(2 * np.pi * 50 * np.arange(1000) / 1300)
    y[300:] = np.random.default_rng(0).uniform(-1e-3, 1e-3, 700)
    for heights in (y, np.zeros(1000)):
        points = ranges.columns_of(np.arange(y.size), (0, y.size), 200).points(heights[np.newaxis])
        assert not points.strokes
