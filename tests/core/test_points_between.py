"""Curves between samples: the wave itself, not straight lines."""

import numpy as np
import pytest

from skinsource.signals.resampling import FINER, finer


@pytest.mark.parametrize("frequency_hz", [50.0, 300.0, 590.0])
def test_points_between_samples_lie_on_the_wave(frequency_hz):
    time_s = 0.3 + np.arange(900) / 1300.0

    def wave(at_s):
        return np.exp(-(((at_s - 0.65) / 0.06) ** 2)) * np.cos(2 * np.pi * frequency_hz * at_s)

    drawn_s, (drawn, twice) = finer(time_s, np.stack((wave(time_s), 2.0 * wave(time_s))))
    assert drawn_s.size == 899 * FINER + 1
    np.testing.assert_allclose(drawn_s[::FINER], time_s, atol=1e-12)
    np.testing.assert_allclose(drawn, wave(drawn_s), atol=2e-4)
    np.testing.assert_allclose(twice, 2.0 * drawn, atol=1e-12)
    if frequency_hz == 300.0:
        # Peaks between samples are seen.
        assert np.abs(np.interp(drawn_s, time_s, wave(time_s)) - wave(drawn_s)).max() > 0.2


@pytest.mark.parametrize(("first", "end"), [(0, 9), (3, 120), (400, 432), (890, 900), (899, 900)])
def test_a_stretch_has_the_points_that_it_has_in_the_whole(first, end):
    time_s = 0.3 + np.arange(900) / 1300.0
    signals = np.random.default_rng(1).standard_normal((2, 900))
    whole_s, whole = finer(time_s, signals)
    part_s, part = finer(time_s, signals, first, end)
    visible_part = slice(first * FINER, (end - 1) * FINER + 1)
    np.testing.assert_allclose(part_s, whole_s[visible_part], rtol=0, atol=1e-12)
    np.testing.assert_allclose(part, whole[:, visible_part], rtol=0, atol=1e-12)
    np.testing.assert_allclose(part[:, ::FINER], signals[:, first:end], rtol=0, atol=1e-12)


def test_a_single_sample_stays_alone():
    time_s, signals = finer(np.array([0.5]), np.array([[2.0]]))
    assert (time_s.tolist(), signals.tolist()) == ([0.5], [[2.0]])
