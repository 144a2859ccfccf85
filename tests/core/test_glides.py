"""Glides: a tone, a chirp, and whatever lies between their points."""

import math

import numpy as np
import pytest

from skinsource.design.waveforms.tones import Chirp, Glide, Tone
from tests.core.wavelets_bench import FINE_HZ, RATE_HZ


@pytest.mark.parametrize("shift_s", [0.0, 3e-4])
def test_a_glide_of_one_frequency_is_a_tone_and_of_two_a_chirp(shift_s):
    level = Glide(((0.0, 123.4, 1.0), (0.4, 123.4, 1.0))).samples(RATE_HZ, shift_s)
    tone = Tone(123.4, 0.0, 0.4, "none").samples(RATE_HZ, shift_s)
    np.testing.assert_allclose(level, tone, rtol=0, atol=1e-12)
    rising = Glide(((0.0, 30.0, 1.0), (0.4, 500.0, 1.0))).samples(RATE_HZ, shift_s)
    chirp = Chirp(30.0, 500.0, 0.4).samples(RATE_HZ, shift_s)
    np.testing.assert_allclose(rising, chirp, rtol=0, atol=1e-12)


def test_points_within_a_straight_stretch_change_nothing():
    ends = ((0.0, 30.0, 0.25), (0.5, 530.0, 0.75))
    between = tuple((0.5 * k / 64, 30.0 + 500.0 * k / 64, 0.25 + 0.5 * k / 64) for k in range(65))
    np.testing.assert_allclose(
        Glide(between).samples(RATE_HZ, 1e-4),
        Glide(ends).samples(RATE_HZ, 1e-4),
        rtol=0,
        atol=1e-12,
    )


def test_the_phase_of_a_glide_does_not_jump_where_its_frequency_does():
    points = ((0.0, 80.0, 1.0), (0.1, 80.0, 1.0), (0.1, 200.0, 1.0), (0.2, 200.0, 1.0))
    samples = Glide(points).samples(FINE_HZ)
    assert np.abs(np.diff(samples)).max() < 2 * math.pi * 200.0 / FINE_HZ
    np.testing.assert_allclose(
        samples[4800:],
        np.sin(2 * np.pi * (0.1 * 80.0 + np.arange(4800) / FINE_HZ * 200.0)),
        rtol=0,
        atol=1e-12,
    )


def test_a_glide_holds_the_values_of_its_first_point_before_it():
    late = Glide(((0.1, 80.0, 0.5), (0.2, 200.0, 1.0))).samples(RATE_HZ)
    full = Glide(((0.0, 80.0, 0.5), (0.1, 80.0, 0.5), (0.2, 200.0, 1.0))).samples(RATE_HZ)
    np.testing.assert_array_equal(late, full)
