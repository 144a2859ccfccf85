"""Gain curves where time is inserted or removed: what is left has the gain it had, steps too."""

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from skinsource.design import edits
from skinsource.design.design import Design, Input
from skinsource.design.view import View

VIEW = View()
# On a grid, so that points often lie at one time, and where time is cut.
tenths = st.integers(0, 12).map(lambda k: k / 10)
curves = st.lists(st.tuples(tenths, st.sampled_from((0.0, 0.5, 1.0, 3.0))), max_size=6).map(
    lambda points: tuple(sorted(points, key=lambda point: point[0]))
)
BESIDE_S = 1e-7
STEP = ((0.0, 1.0), (0.5, 1.0), (0.5, 0.0), (1.0, 0.0))


def gains(design, times_s):
    curve = design.inputs[0].gain_curve
    return np.interp(times_s, *np.array(curve).T) if curve else np.ones(len(times_s))


def design_of(curve):
    return Design(limb="synthetic-1", inputs=(Input(location=7, gain_curve=curve),))


def around(low, high):
    """Times a little before and behind each tenth, from one to another."""
    grid = np.arange(round(low * 10), round(high * 10) + 1) / 10
    beside = np.concatenate((grid - BESIDE_S, grid + BESIDE_S))
    return beside[(beside > low) & (beside < high)]


@settings(max_examples=120, deadline=None, derandomize=True)
@given(curves, tenths, st.sampled_from((0.1, 0.25)))
@example(STEP, 0.5, 0.25)
def test_time_that_comes_in_leaves_the_gain_before_and_behind_it(curve, at_s, length_s):
    before = design_of(curve)
    after = edits.insert_time(before, VIEW, at_s, length_s).design
    early, late = around(0.0, at_s), around(at_s, 1.4)
    np.testing.assert_allclose(gains(after, early), gains(before, early), atol=1e-5)
    np.testing.assert_allclose(gains(after, late + length_s), gains(before, late), atol=1e-5)


@settings(max_examples=120, deadline=None, derandomize=True)
@given(curves, tenths, st.integers(1, 5).map(lambda k: k / 10))
@example(STEP, 0.5, 0.2)
@example(STEP, 0.3, 0.2)
def test_time_that_goes_leaves_the_gain_before_and_behind_it(curve, start_s, length_s):
    before = design_of(curve)
    end_s = round(start_s + length_s, 1)
    after = edits.remove_time(before, VIEW, start_s, end_s).design
    early, late = around(0.0, start_s), around(end_s, 2.0)
    np.testing.assert_allclose(gains(after, early), gains(before, early), atol=1e-5)
    np.testing.assert_allclose(gains(after, late - length_s), gains(before, late), atol=1e-5)
