"""Spectrograms against sums that are written out."""

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError, Stopped
from skinsource.signals.analysis.spectrogram import MOST_COLUMNS, spectrogram

RATE = 1300.0


def amplitude_by_hand(signal, middle, frequency_hz, n_window):
    """One-sided amplitude under a Hann window around a sample, term by term."""
    half = n_window // 2
    total = 0.0
    weights = 0.0
    for k in range(n_window):
        weight = 0.5 - 0.5 * np.cos(2 * np.pi * k / n_window)
        weights += weight
        at = middle - half + k
        if 0 <= at < signal.size:
            total += weight * signal[at] * np.exp(-2j * np.pi * frequency_hz * at / RATE)
    return 2.0 * abs(total) / weights


def test_each_cell_is_the_windowed_sum_at_its_time_and_frequency():
    signal = np.random.default_rng(1).normal(size=700)
    levels = spectrogram(signal, RATE, 0.05)
    n_window = 65
    for column in (0, 5, 40, levels.time_s.size - 1):
        for row in (3, 17, 40):
            middle = round(levels.time_s[column] * RATE)
            expected = amplitude_by_hand(signal, middle, levels.frequency_hz[row], n_window)
            assert levels.amplitude[row, column] == pytest.approx(expected, rel=1e-9)


def test_a_tone_reads_its_amplitude_at_its_time_and_frequency():
    time = np.arange(2600) / RATE
    signal = np.where((time > 0.5) & (time < 1.2), 3.0 * np.sin(2 * np.pi * 103.0 * time), 0.0)
    levels = spectrogram(signal, RATE, 0.1)
    assert levels.at(0.85, 103.0) == pytest.approx(3.0, rel=0.011)
    assert levels.at(0.85, 250.0) < 0.01
    assert levels.at(0.3, 103.0) < 1e-9
    assert levels.time_s[0] == 0.0
    assert levels.time_s[-1] == pytest.approx(time[-1], abs=0.1 / 8)


def test_a_long_signal_keeps_its_loudest_in_a_screenful_of_columns():
    signal = np.zeros(780_000)
    at = 400_123
    signal[at : at + 130] = np.sin(2 * np.pi * 200.0 * np.arange(130) / RATE)
    long = spectrogram(signal, RATE, 0.05)
    assert long.time_s.size <= MOST_COLUMNS
    short = spectrogram(signal[at - 2000 : at + 2000], RATE, 0.05)
    row = int(np.argmin(np.abs(long.frequency_hz - 200.0)))
    assert long.amplitude[row].max() == pytest.approx(short.amplitude[row].max(), rel=0.02)
    column = int(np.argmax(long.amplitude[row]))
    assert long.time_s[column] == pytest.approx((at + 65) / RATE, abs=0.4)
    with pytest.raises(Stopped):
        spectrogram(signal, RATE, 0.05, lambda: True)


def test_what_cannot_be_looked_at_is_refused():
    with pytest.raises(InvalidInputError, match="7 samples"):
        spectrogram(np.ones(100), 1000.0, 0.007)
    with pytest.raises(InvalidInputError, match="expected \\(n_times,\\)"):
        spectrogram(np.ones((2, 5)), RATE, 0.1)
