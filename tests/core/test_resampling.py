"""`ss.resample` against the band-limited signal itself, and curves between samples."""

import tracemalloc
from fractions import Fraction
from itertools import permutations

import mpmath
import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.signals import resampling as conversion
from skinsource.signals.resampling import FINER, Kernel, by_ratio, finer

PAIRS = [
    *((1300, rate) for rate in (2000, 8000, 44_100, 48_000, 96_000, 192_000, 1301, 47_999)),
    *((rate, 1300) for rate in (2000, 8000, 44_100, 48_000, 96_000, 192_000, 1301, 44_101)),
    (44_100, 48_000),
    (48_000, 44_100),
    (1210, 1300),
    (1300, 1210),
]
RATES = (1300, 2000, 8000, 44_100, 48_000, 96_000, 192_000)
ODD = ((1301, 44_101), (44_101, 1301), (1301, 8000), (44_101, 48_000), (7919, 44_100))
OTHER_PAIRS = [
    *(pair for pair in permutations(RATES, 2) if pair not in PAIRS),
    *(pair for pair in ODD if pair not in PAIRS),
]
PHASE = 0.3
# Away from the ends, where a tone that is cut off hard rings: for 46 ms; between rates close to
# 1200 Hz, where the filter is steeper, ten times as long.
MARGIN_S, STEEP_MARGIN_S = 0.06, 0.5


def tone(frequency_hz, rate_hz, n):
    return ss.sinusoid(frequency_hz, n / rate_hz, phase_rad=PHASE, sample_rate_hz=rate_hz)


def converted_tone(frequency_hz, from_hz, to_hz):
    """A tone at another rate: its instants in the middle, and its samples there."""
    margin_s = STEEP_MARGIN_S if min(from_hz, to_hz) < 1300 else MARGIN_S
    n = int((0.1 + 2.0 * margin_s) * from_hz)
    resampled = ss.resample(tone(frequency_hz, from_hz, n), from_hz, to_hz)
    start, end = int(margin_s * to_hz), int((0.1 + margin_s) * to_hz)
    return np.arange(start, end), resampled[start:end]


def exact(frequency_hz, rate_hz, places):
    """The tone in 40 digits, rounded once."""
    with mpmath.workdps(40):
        turn = 2 * mpmath.pi * frequency_hz / rate_hz
        return np.array([float(mpmath.sin(turn * int(k) + mpmath.mpf(PHASE))) for k in places])


@pytest.mark.parametrize(("from_hz", "to_hz"), PAIRS)
def test_tones_of_the_band_keep_size_and_phase(from_hz, to_hz):
    for frequency in (25, 250, 500, 600):
        places, samples = converted_tone(frequency, from_hz, to_hz)
        some = np.linspace(0, len(places) - 1, 60).astype(int)
        expected = exact(frequency, to_hz, places[some])
        error = samples[some] - expected
        assert ss.decibels(np.sqrt(2.0 * np.mean(error**2))) < -130.0
        # Least squares with a sine and a cosine: gain, and phase.
        turn = 2.0 * np.pi * ((places * frequency) % to_hz) / to_hz + PHASE
        basis = np.stack((np.sin(turn), np.cos(turn)), axis=1)
        (in_phase, across), *_ = np.linalg.lstsq(basis, samples, rcond=None)
        assert abs(ss.decibels(np.hypot(in_phase, across))) < 1e-5
        assert abs(np.arctan2(across, in_phase)) < 1e-6


@pytest.mark.parametrize(("from_hz", "to_hz"), OTHER_PAIRS)
def test_any_two_rates_keep_the_ends_of_the_band(from_hz, to_hz):
    for frequency in (25, 600):
        places, samples = converted_tone(frequency, from_hz, to_hz)
        some = np.linspace(0, len(places) - 1, 40).astype(int)
        error = samples[some] - exact(frequency, to_hz, places[some])
        # 1 gain, no phase: an error of a millionth holds both promises at once.
        assert np.abs(error).max() < 1e-6


@pytest.mark.parametrize("from_hz", [2000, 8000, 44_100, 48_000, 192_000, 44_101])
def test_what_lies_above_the_band_does_not_fold_into_it(from_hz):
    for frequency in (700, 900, 2500, 3900):
        if frequency < from_hz / 2:
            _, samples = converted_tone(frequency, from_hz, 1300)
            assert ss.decibels(np.sqrt(2.0 * np.mean(samples**2))) < -130.0


def test_what_lies_in_the_transition_folds_only_above_the_band():
    for frequency in (630, 660, 690):
        resampled = ss.resample(tone(frequency, 48_000, 48_000), 48_000, 1300)[100:1200]
        window = np.blackman(len(resampled))
        spectrum = 2.0 * np.abs(np.fft.rfft(resampled * window, 13_000)) / window.sum()
        at_hz = np.arange(len(spectrum)) * 0.1
        assert spectrum[at_hz > 600].max() > 1e-4
        assert ss.decibels(spectrum[(at_hz >= 25) & (at_hz <= 595)].max()) < -80.0


@pytest.mark.parametrize("rate_hz", [2000, 8000, 44_100, 48_000, 96_000, 192_000, 1777])
def test_there_and_back_is_where_it_began(rate_hz):
    rng = np.random.default_rng(5)
    places = np.arange(2600)
    signal = np.zeros(2600)
    for frequency in rng.uniform(25.0, 600.0, 30):
        signal += np.sin(2.0 * np.pi * frequency * places / 1300.0 + rng.uniform(0.0, 6.0))
    signal *= np.exp(-0.5 * ((places - 1300) / 200.0) ** 2)
    back = ss.resample(ss.resample(signal, 1300, rate_hz), rate_hz, 1300)
    assert len(back) >= 2600
    error = back[:2600] - signal
    assert ss.decibels(np.abs(error).max() / np.abs(signal).max()) < -115.0


def test_equal_rates_give_the_same_bits():
    signal = np.random.default_rng(0).standard_normal((2, 3000))
    resampled = ss.resample(signal, 48_000, 48_000)
    np.testing.assert_array_equal(resampled, signal)
    assert resampled is not signal


@pytest.mark.parametrize(("from_hz", "to_hz"), [(1300, 48_000), (44_100, 1300), (48_000, 44_100)])
def test_blocks_leave_no_seam(from_hz, to_hz, monkeypatch):
    signal = np.random.default_rng(1).standard_normal(20_000)
    whole = ss.resample(signal, from_hz, to_hz)
    monkeypatch.setattr(conversion, "_BLOCK", 3000)
    np.testing.assert_allclose(ss.resample(signal, from_hz, to_hz), whole, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("from_hz", "to_hz"), [(1300, 2001), (1999, 1300), (1210, 1300)])
def test_weights_computed_one_by_one_are_those_of_the_filter(from_hz, to_hz, monkeypatch):
    signal = np.random.default_rng(1).standard_normal((2, 3000))
    whole = ss.resample(signal, from_hz, to_hz)
    monkeypatch.setattr(conversion, "_LONGEST_FILTER", 0)
    monkeypatch.setattr(conversion, "_BLOCK", 20_000)
    np.testing.assert_allclose(ss.resample(signal, from_hz, to_hz), whole, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("samples", "rates", "message"),
    [
        ([0.0, np.nan, 1.0], (1300, 48_000), r"nan at index \(1,\)"),
        ([0.0, np.inf], (1300, 1300), "index"),
        ([1.0], (1300.5, 48_000), "from_hz"),
        ([1.0], (1300, 0), "to_hz"),
        (1.0, (1300, 48_000), "single number"),
        ([1j], (1300, 48_000), "complex"),
        (np.ones(1000), (1, 10_000_000), "take a part"),
        (np.broadcast_to(np.float32(0.0), 50_000_000), (10_000_000, 9_999_999), "Take a part"),
    ],
)
def test_what_cannot_be_converted_is_refused(samples, rates, message):
    with pytest.raises(InvalidInputError, match=message):
        ss.resample(samples, *rates)


@pytest.mark.parametrize(
    ("from_hz", "to_hz"),
    [(1300, 48_000), (48_000, 1300), (1300, 2600), (1300, 1000), (44_100, 48_000), (1210, 1300)],
)
def test_a_matrix_of_weights_gives_what_the_filter_gives(from_hz, to_hz, monkeypatch):
    signals = np.random.default_rng(3).standard_normal((2, 3001))
    signals[:, 1000:1700] = 0.0
    resampled = ss.resample(signals, from_hz, to_hz)
    monkeypatch.setattr(Kernel, "is_small", False)
    filtered = ss.resample(signals, from_hz, to_hz)
    np.testing.assert_allclose(resampled, filtered, rtol=0, atol=2e-14)
    assert not np.array_equal(resampled, filtered)


def test_a_filter_longer_than_the_signal_takes_little_memory():
    tracemalloc.start()
    try:
        resampled = ss.resample(np.ones(1_000_000), 1_000_000, 1)
        assert tracemalloc.get_traced_memory()[1] < 200e6
    finally:
        tracemalloc.stop()
    # The sum of the filter over the first second, in which half of it lies.
    assert resampled == pytest.approx(ss.resample(np.ones(100), 100, 1), rel=0.02)


@pytest.mark.parametrize("rate_hz", [999.98, 1234.567, 1300.0 / 7.0])
def test_rates_that_are_no_whole_numbers_keep_long_signals(rate_hz):
    time_s = np.arange(10_000) / rate_hz
    resampled = by_ratio(np.sin(50.0 * time_s), Fraction(1300.0) / Fraction(rate_hz), rate_hz)
    middle = slice(resampled.size // 2, resampled.size - 500)
    expected = np.sin(50.0 * np.arange(resampled.size)[middle] / 1300.0)
    np.testing.assert_allclose(resampled[middle], expected, atol=1e-4)


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
