"""Windows: those of MATLAB and the loudest tenth of a second; spectra, held over windows too."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import windows

import skinsource as ss
from skinsource.base.errors import InvalidInputError, Stopped
from skinsource.design.waveforms import Noise, Tone
from skinsource.signals.generators import window
from skinsource.signals.loudest_window import LoudestEnergy, loudest_energy
from skinsource.signals.spectra import magnitude_spectrum, mean_of_bins, rms, share_outside_band

LENGTHS = [*range(70), 130, 131, 260, 651, 1000, 1300, 7919]


@pytest.mark.parametrize("n", LENGTHS)
def test_windows_are_those_of_matlab(n):
    np.testing.assert_allclose(window("hanning", n), windows.hann(n + 2)[1:-1], rtol=0, atol=1e-12)
    np.testing.assert_allclose(window("tukey", n), windows.tukey(n, 0.25), rtol=0, atol=1e-12)
    np.testing.assert_array_equal(window("none", n), [1.0] * n)


@pytest.mark.parametrize(
    ("call", "given", "message"),
    [
        *((window, ("tukey", n), "a whole number") for n in (-1, 2.5, math.nan, math.inf)),
        (window, ("hamming", 21), "choose from none, tukey, hanning"),
        (rms, ([1.0], "loud"), "span 'loud' is not known; choose from record"),
        *(
            (rms, ([1.0], "loudest", hz), "sample_rate_hz")
            for hz in (0.0, -1.0, math.nan, math.inf)
        ),
        (ss.peak_hold_spectrum, (np.ones(100), 1e15), "sample_rate_hz is 1e\\+15"),
        (ss.peak_hold_spectrum, ([], 1300.0), "at least one sample"),
    ],
)
def test_what_is_no_length_window_span_or_rate_is_refused(call, given, message):
    with pytest.raises(InvalidInputError, match=message):
        call(*given)


def test_a_whole_length_of_any_type_will_do():
    np.testing.assert_array_equal(window("tukey", 21.0), window("tukey", np.int64(21)))


SEED = 7


def direct(x: np.ndarray, n: int) -> float:
    """Largest energy of any n neighbours, each window summed by itself without rounding."""
    squares = [0.0] * (n - 1) + (x * x).tolist() + [0.0] * (n - 1)
    return max(math.fsum(squares[k : k + n]) for k in range(len(squares) - n + 1))


def signals(n: int) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(SEED)
    burst_then_silence = np.zeros(n)
    burst_then_silence[: n // 4] = 1e9 * rng.standard_normal(n // 4)
    quiet_after_loud = rng.standard_normal(n) * np.logspace(0, -12, n)
    signal = np.zeros(n)
    signal[n // 2] = -3.0
    return {
        "noise": rng.standard_normal(n),
        "burst, then silence": burst_then_silence,
        "fading": quiet_after_loud,
        "growing": quiet_after_loud[::-1].copy(),
        "one sample": signal,
        "constant": np.ones(n),
        "silence": np.zeros(n),
    }


@pytest.mark.parametrize("n_window", [1, 2, 13, 130])
@pytest.mark.parametrize("n", [1, 2, 129, 130, 131, 259, 260, 261, 1821])
def test_the_loudest_window_is_that_of_sums_over_all(n, n_window):
    for what, x in signals(n).items():
        energy = loudest_energy(x, n_window)
        assert energy == pytest.approx(direct(x, n_window), rel=1e-13, abs=0), what


@pytest.mark.parametrize("n_window", [1, 13, 130])
def test_a_quiet_window_after_a_loud_one_keeps_its_digits(n_window):
    loud_then_quiet = np.concatenate((np.full(500, 1e9), np.full(500, 1e-3)))
    loudest = LoudestEnergy((), n_window)
    loudest.add(0, loud_then_quiet)
    loudest.energy[...] = 0.0
    loudest.add(1000 + n_window, np.full(300, 1e-3))
    assert loudest.energy == pytest.approx(min(300, n_window) * 1e-6, rel=1e-13)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.integers(0, 400), min_size=1, max_size=6),
    st.lists(st.integers(0, 300), min_size=6, max_size=6),
    st.integers(0, 2**32 - 1),
)
def test_pieces_with_silence_between_them_give_what_the_whole_gives(lengths, gaps, seed):
    rng = np.random.default_rng(seed)
    whole = np.zeros((2, 3, sum(lengths) + sum(gaps) + 1))
    loudest = LoudestEnergy((2, 3), 130)
    first = 0
    for length, gap in zip(lengths, gaps, strict=False):
        first += gap
        piece = rng.standard_normal((2, 3, length))
        whole[..., first : first + length] = piece
        loudest.add(first, piece)
        first += length
    np.testing.assert_allclose(loudest.energy, loudest_energy(whole, 130), rtol=1e-13)


def test_a_signal_shorter_than_the_window_is_averaged_over_the_window():
    assert rms(np.ones(13), "loudest") == pytest.approx(np.sqrt(0.1), rel=1e-13)
    assert rms([2.0], "loudest", 10.0) == pytest.approx(2.0)


def test_the_window_is_a_tenth_of_a_second_at_any_rate():
    signal = np.zeros(5000)
    signal[2500] = 1.0
    for rate_hz, n_window in ((1300.0, 130), (2000.0, 200), (3.0, 1)):
        assert rms(signal, "loudest", rate_hz) == pytest.approx(n_window**-0.5, rel=1e-13)


RATE = 1300.0


@pytest.mark.parametrize("frequency_hz", [25.0, 60.0, 100.37, 250.5, 333.3, 599.9])
@pytest.mark.parametrize("duration_s", [0.5, 3.0])
def test_a_sine_reads_its_amplitude_at_its_frequency(frequency_hz, duration_s):
    tone = np.sin(2 * np.pi * frequency_hz * np.arange(round(duration_s * RATE)) / RATE)
    frequencies, amplitude = ss.peak_hold_spectrum(tone, RATE)
    assert amplitude.max() == pytest.approx(1.0, rel=0.012)
    assert abs(frequencies[np.argmax(amplitude)] - frequency_hz) <= 0.5 + 1e-9


def test_it_equals_a_plain_loop_over_windows():
    signal = np.random.default_rng(7).normal(size=(2, 3, 900))
    frequencies, amplitude = ss.peak_hold_spectrum(signal, RATE)
    n = round(0.25 * RATE)
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(n) / n)
    padded = np.pad(signal, ((0, 0), (0, 0), (n - 1, n - 1)))
    expected = np.zeros_like(amplitude)
    for start in range(0, padded.shape[-1] - n + 1, n // 8):
        turns = np.exp(-2j * np.pi * np.outer(np.arange(n), frequencies) / RATE)
        part = np.abs((padded[..., start : start + n] * window) @ turns) / window.sum()
        part[..., 1:-1] *= 2
        expected = np.maximum(expected, part)
    assert frequencies[-1] == RATE / 2
    np.testing.assert_allclose(amplitude, expected, rtol=1e-9, atol=1e-12)


def test_one_sample_is_enough_and_it_can_be_stopped():
    assert ss.peak_hold_spectrum([1.0], RATE)[1].max() == pytest.approx(4 / 325, rel=1e-3)
    with pytest.raises(Stopped):
        ss.peak_hold_spectrum(np.ones(10), RATE, stop=lambda: True)


@pytest.mark.parametrize("n", [1, 2, 3, 10])
@pytest.mark.parametrize("n_bins", [1, 2, 9, 10, 40])
def test_a_mean_is_that_of_the_bins_around(n, n_bins):
    magnitude = np.random.default_rng(n).random((2, 3, n_bins))
    means = mean_of_bins(magnitude, n)
    assert means.shape == magnitude.shape
    for k in range(n_bins):
        around = magnitude[..., max(k - n // 2, 0) : k + (n - 1) // 2 + 1]
        assert means[..., k] == pytest.approx(around.mean(axis=-1))


def direct_spectrum(x: np.ndarray) -> np.ndarray:
    """One-sided amplitudes as sums, one for each frequency."""
    n, k = x.size, np.arange(x.size // 2 + 1)
    turns = np.exp(-2j * np.pi * (np.outer(k, np.arange(n)) % n) / n)
    return np.abs(turns @ x) / n * np.where((k == 0) | (2 * k == n), 1, 2)


@pytest.mark.parametrize("n", [1, 2, 3, 4, 5, 6, 7, 130, 131, 521, 522, 651, 652])
def test_spectra_of_odd_and_even_lengths_are_those_of_the_sum(n):
    x = np.random.default_rng(SEED).standard_normal(n)
    magnitude = direct_spectrum(x)
    found_hz, amplitudes = magnitude_spectrum(x, 1300.0)
    np.testing.assert_allclose(found_hz, np.arange(magnitude.size) * 1300.0 / n, rtol=1e-15)
    limit = 1e-12 * magnitude.max()
    np.testing.assert_allclose(amplitudes, magnitude, rtol=0, atol=limit, err_msg=f"{SEED=}")


RATE_HZ = 1300.0


@pytest.mark.parametrize(("low_hz", "high_hz"), [(0.0, 100.0), (25.0, 600.0), (600.0, 650.0)])
@pytest.mark.parametrize("second", [1.0, -1.0, 0.3])
def test_two_samples_have_a_cosine_for_a_spectrum(second, low_hz, high_hz):
    """|1 + a exp(-i w)|² = 1 + a² + 2 a cos w, integrated from w1 to w2."""
    low, high = (2 * math.pi * edge / RATE_HZ for edge in (low_hz, high_hz))
    energy = (1 + second**2) * (high - low) + 2 * second * (math.sin(high) - math.sin(low))
    expected = 1 - energy / (math.pi * (1 + second**2))
    share = share_outside_band(np.array([1.0, second]), RATE_HZ, (low_hz, high_hz))
    assert share == pytest.approx(expected, abs=1e-14)


def test_any_signal_agrees_with_the_integral_of_its_spectrum():
    samples = Noise(5, 0.2).samples(RATE_HZ) + 0.1
    n = 2**20
    frequency_hz = np.fft.rfftfreq(n, 1 / RATE_HZ)
    power = np.abs(np.fft.rfft(samples, n)) ** 2
    inside = (frequency_hz >= 25.0) & (frequency_hz <= 600.0)
    expected = 1 - np.trapezoid(power[inside]) / np.trapezoid(power)
    assert share_outside_band(samples, RATE_HZ) == pytest.approx(expected, abs=1e-5)


def test_silence_around_a_signal_and_its_strength_change_nothing():
    samples = Tone(40.0, duration_s=0.05).samples(RATE_HZ)
    share = share_outside_band(samples, RATE_HZ)
    assert 0.01 < share < 0.9
    padded = np.concatenate((np.zeros(333), samples, np.zeros(1001)))
    assert share_outside_band(padded, RATE_HZ) == pytest.approx(share, abs=1e-13)
    for factor in (-1.0, 1e-200, 1e200):
        assert share_outside_band(factor * samples, RATE_HZ) == pytest.approx(share, abs=1e-13)


def test_nothing_of_silence_lies_outside():
    assert share_outside_band(np.zeros(100), RATE_HZ) == 0.0
    assert share_outside_band(np.zeros(0), RATE_HZ) == 0.0
