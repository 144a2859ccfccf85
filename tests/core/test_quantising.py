"""The one quantiser: nothing wraps, what is cut off is counted."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource.signals import quantising
from skinsource.signals.quantising import KINDS, quantised


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_wraps_and_what_is_cut_off_is_counted(kind):
    loud = [[1.5, -1.5, 1e300, 1.0 + 1e-15, 1.0], [0.0, -1e9, 0.5, -0.5, -1.0]]
    result = quantised(loud, kind)
    signed = result.values.astype(np.int64) - result.kind.zero
    most = result.kind.most
    assert signed[0].tolist() == [most, -most, most, most, most]
    assert signed[1, 1] == -most
    assert result.clipped.tolist() == [4, 1]


@given(st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=30), st.sampled_from(sorted(KINDS)))
def test_every_sample_is_rounded_to_the_nearest(samples, kind):
    result = quantised([samples], kind)
    for sample, value in zip(samples, result.values[0].tolist(), strict=True):
        # In exact arithmetic; the product may round by half a step of a float, no more.
        off = Fraction(sample) * result.full_scale - (value - result.kind.zero)
        assert abs(off) <= Fraction(1, 2) + Fraction(1, 2**20)
    assert result.largest_error <= 0.5 / result.full_scale * (1 + 1e-6)


def test_dither_is_triangular_and_makes_the_error_independent_of_the_signal():
    # A signal of a quarter of a step is lost without dither, and is there on average with it.
    level = 0.25 / 32766
    result = quantised(np.full((1, 200_000), level), "int16", dither_seed=3)
    steps = result.values[0] - 0.25
    assert abs(steps.mean()) < 0.01
    # Of a triangle of two steps, 1/6, and of rounding, 1/12.
    assert np.var(steps) == pytest.approx(1 / 4, rel=0.02)
    assert not quantised(np.full((1, 10), level), "int16").values.any()


def test_dither_never_clips_a_signal_of_full_scale():
    result = quantised(np.ones((2, 100_000)), "int16", dither_seed=0)
    assert result.clipped.tolist() == [0, 0]
    assert result.full_scale == 32766
    assert result.values.max() == 32767
    assert result.values.min() == 32765


def test_dither_is_that_of_its_seed_other_in_each_channel_and_without_seams(monkeypatch):
    samples = np.zeros((2, 5000))
    result = quantised(samples, "int16", dither_seed=7).values
    assert np.any(result[0] != result[1])
    assert np.any(result != quantised(samples, "int16", dither_seed=8).values)
    monkeypatch.setattr(quantising, "_BLOCK", 333)
    np.testing.assert_array_equal(quantised(samples, "int16", dither_seed=7).values, result)
