"""Effects at their very ends: before own time 0, and at half the sample rate."""

import numpy as np
import pytest

from skinsource.design.effects.level import BandLimit
from skinsource.design.effects.time import Reverse, Stretch

RATE_HZ = 1000.0


@pytest.mark.parametrize("shift_s", [0.0, 0.0003, 0.0009])
def test_backwards_too_nothing_plays_before_time_0(shift_s):
    # What a delayed recording has behind its end would come first.
    samples = Reverse().applied(np.ones(13), RATE_HZ, shift_s, 0.0105)
    own_s = np.arange(samples.size) / RATE_HZ - shift_s
    assert (samples[own_s < 0.0] == 0.0).all()
    assert (samples[own_s >= 0.0] == 1.0).all()


@pytest.mark.parametrize("n", range(50, 60))
def test_the_share_that_is_removed_counts_half_the_rate_once(n):
    limit = BandLimit(0.0, 400.0)
    samples = np.where(np.arange(n) % 2, -1.0, 1.0)
    size = limit._spectrum(samples, RATE_HZ)[1]
    frequencies_hz = np.abs(np.fft.fftfreq(size, 1.0 / RATE_HZ))
    energy = np.abs(np.fft.fft(samples, size)) ** 2
    share = (energy * limit.gains_at(frequencies_hz) ** 2).sum() / energy.sum()
    assert limit.share_removed(samples, RATE_HZ) == pytest.approx(1.0 - share, abs=1e-12)


@pytest.mark.parametrize(("shift_s", "size"), [(0.0, 80), (0.0004, 81)])
def test_what_is_stretched_plays_at_its_last_instant_too(shift_s, size):
    samples = Stretch(2.0).applied(np.ones(40), RATE_HZ, shift_s, 0.04)
    assert samples.size == size
    own_s = np.arange(size) / RATE_HZ - shift_s
    assert (samples[(own_s >= 0.0) & (own_s < 0.08)] > 0.1).all()
    assert (samples[own_s < 0.0] == 0.0).all()
