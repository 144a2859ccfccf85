"""The loudest tenth of a second: against direct sums, piece by piece, and what must not matter."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource.base.errors import InvalidInputError
from skinsource.signals.generators import sinusoid
from skinsource.signals.loudest_window import LoudestEnergy, loudest_energy
from skinsource.signals.spectra import rms

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


@pytest.mark.parametrize("n", [1, 21, 129, 130, 131, 1000])
@pytest.mark.parametrize("before", [0, 1, 64, 129, 130, 5000])
def test_silence_around_a_signal_changes_no_loudest_level(n, before):
    x = np.random.default_rng(SEED).standard_normal(n)
    padded = np.concatenate((np.zeros(before), x, np.zeros(777)))
    assert rms(padded, "loudest") == pytest.approx(float(rms(x, "loudest")), rel=1e-13)


def test_a_steady_tone_has_the_same_loudest_level_however_long():
    levels = [float(rms(sinusoid(100.0, length), "loudest")) for length in (0.1, 0.2, 1.0, 10.0)]
    np.testing.assert_allclose(levels, np.sqrt(0.5), rtol=1e-12)


def test_a_signal_shorter_than_the_window_is_averaged_over_the_window():
    assert rms(np.ones(13), "loudest") == pytest.approx(np.sqrt(0.1), rel=1e-13)
    assert rms([2.0], "loudest", 10.0) == pytest.approx(2.0)


def test_the_window_is_a_tenth_of_a_second_at_any_rate():
    signal = np.zeros(5000)
    signal[2500] = 1.0
    for rate_hz, n_window in ((1300.0, 130), (2000.0, 200), (3.0, 1)):
        assert rms(signal, "loudest", rate_hz) == pytest.approx(n_window**-0.5, rel=1e-13)


def test_a_span_or_rate_that_is_none_is_refused():
    with pytest.raises(InvalidInputError, match="span 'loud' is not known; choose from record"):
        rms([1.0], "loud")
    for rate_hz in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(InvalidInputError, match="sample_rate_hz"):
            rms([1.0], "loudest", rate_hz)
