import numpy as np
import pytest

import skinsource as ss
from skinsource.lab.playing.session import analytic, on_two_ears, turned_up

RATE_HZ, THERE_HZ = 1300, 48_000


def shifted(rows, shift_hz):
    whole = analytic(rows)
    parts = ss.resample(np.concatenate((whole.real, whole.imag)), RATE_HZ, THERE_HZ)
    return turned_up(parts, THERE_HZ, shift_hz)


def burst(frequency_hz, rate_hz, n, phase=0.0):
    """A tone under a window that is smooth to a millionth, so that its ends do not ring."""
    time = np.arange(n) / rate_hz
    centre = 1.0
    envelope = np.exp(-0.5 * ((time - centre) / 0.12) ** 2)
    return envelope * np.cos(2 * np.pi * frequency_hz * time + phase)


@pytest.mark.parametrize("frequency_hz", [40.0, 100.0, 250.0, 550.0])
def test_a_tone_is_heard_so_many_hertz_higher_under_the_same_envelope(frequency_hz):
    row = burst(frequency_hz, RATE_HZ, 2600)
    shifted_row = shifted(row[np.newaxis], 300.0)[0]
    expected = burst(frequency_hz + 300.0, THERE_HZ, shifted_row.size)
    assert np.abs(shifted_row - expected).max() < 1e-4


def test_channels_are_spread_from_left_to_right_in_their_order():
    rows = np.eye(2)
    assert on_two_ears(rows).tolist() == [[0.75, 0.25], [0.25, 0.75]]
    assert on_two_ears(np.ones((1, 3))).tolist() == [[0.5] * 3, [0.5] * 3]
    assert on_two_ears(np.zeros((0, 3))).tolist() == [[0.0] * 3, [0.0] * 3]
