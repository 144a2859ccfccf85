"""Strokes become samples."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource.signals.synthesis import Stroke, drawn_over, zeroed

RATE_HZ = 1300.0
PLACES = st.tuples(st.floats(0, 2), st.floats(-1, 1))
PENS = st.lists(PLACES, min_size=1, max_size=30)


@pytest.mark.parametrize(
    ("pen", "points"),
    [
        ([(0.0, 0.0), (0.1, 1.0), (0.2, -1.0)], ((0.0, 0.0), (0.1, 1.0), (0.2, -1.0))),
        # Going back it replaces what it drew there.
        (
            [(0.0, 0.0), (0.1, 1.0), (0.2, 0.5), (0.3, 1.0), (0.15, -1.0)],
            ((0.0, 0.0), (0.1, 1.0), (0.15, -1.0), (0.3, 1.0)),
        ),
        # Of several values at one time the last one stays.
        ([(0.1, 0.0), (0.1, 0.5), (0.1, -0.2)], ((0.1, -0.2),)),
    ],
)
def test_a_pen_leaves_the_points_that_it_drew_last(pen, points):
    assert Stroke.through(pen).points == points


@given(PENS)
def test_a_stroke_rises_in_time_whatever_the_pen_does(pen):
    stroke = Stroke.through(pen)
    times = [time for time, _ in stroke.points]
    assert times == sorted(set(times))
    # The last place of the pen is always part of it.
    assert stroke.points[times.index(pen[-1][0])][1] == pytest.approx(pen[-1][1], abs=1e-12)


@given(PENS)
def test_samples_stay_within_what_was_drawn(pen):
    stroke = Stroke.through(pen)
    first, samples = stroke.samples(RATE_HZ)
    values = [value for _, value in stroke.points]
    assert first >= 0
    assert min(values) <= samples.min() <= samples.max() <= max(values)
    assert samples.size >= 1


@given(st.lists(st.integers(0, 600), min_size=2, max_size=12, unique=True).map(sorted))
def test_points_on_samples_are_met_exactly(numbers):
    values = np.cos(np.array(numbers) * 1.7)
    pen = [(k / RATE_HZ, float(v)) for k, v in zip(numbers, values, strict=True)]
    first, samples = Stroke.through(pen).samples(RATE_HZ)
    assert first == numbers[0]
    assert samples.size == numbers[-1] - numbers[0] + 1
    np.testing.assert_allclose(samples[np.array(numbers) - first], values, atol=1e-12)


def test_a_stroke_covers_its_own_time_and_nothing_else():
    before = np.full(100, 0.25)
    stroke = Stroke.through([(10 / RATE_HZ, 1.0), (19 / RATE_HZ, 1.0)])
    after = drawn_over(before, stroke, RATE_HZ)
    assert (after[10:20] == 1.0).all()
    assert (np.delete(after, slice(10, 20)) == 0.25).all()
    assert (before == 0.25).all()


def test_a_stroke_makes_the_signal_longer_and_moves_the_nearest_sample():
    beyond = Stroke.through([(8 / RATE_HZ, 0.5), (9 / RATE_HZ, 0.5)])
    after = drawn_over(np.ones(5), beyond, RATE_HZ)
    assert after.tolist() == [1, 1, 1, 1, 1, 0, 0, 0, 0.5, 0.5]
    between = Stroke.through([(10.3 / RATE_HZ, 0.5), (10.4 / RATE_HZ, 0.7)])
    after = drawn_over(np.zeros(20), between, RATE_HZ)
    assert np.flatnonzero(after).tolist() == [10]


def test_zero_is_drawn_from_end_to_end_in_either_direction():
    for ends in ((3, 6), (6, 3)):
        after = zeroed(np.ones(10), *(end / RATE_HZ for end in ends), RATE_HZ)
        assert np.flatnonzero(after == 0).tolist() == [3, 4, 5, 6]
