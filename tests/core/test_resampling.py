"""`ss.resample` against the band-limited signal, what passes it, and rounding for a device."""

import tracemalloc
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.signals import quantising
from skinsource.signals import resampling as conversion
from skinsource.signals.quantising import KINDS, quantised
from skinsource.signals.resampling import FINER, Kernel, by_ratio, finer, passed

PAIRS = [
    *((1300, rate) for rate in (2000, 8000, 44_100, 48_000, 96_000, 192_000, 1301, 47_999)),
    *((rate, 1300) for rate in (2000, 8000, 44_100, 48_000, 96_000, 192_000, 1301, 44_101)),
    (44_100, 48_000),
    (48_000, 44_100),
    (1210, 1300),
    (1300, 1210),
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


RATE_HZ = 1300
TIME_S = np.arange(RATE_HZ) / RATE_HZ


def burst(frequency_hz, phase_rad=0.3):
    """A second of a tone that begins and ends softly, so that it holds little else."""
    return np.hanning(RATE_HZ) * np.sin(2.0 * np.pi * frequency_hz * TIME_S + phase_rad)


def loss_db(signal, to_hz):
    return 10.0 * np.log10(np.sum(signal**2) / np.sum(passed(signal, RATE_HZ, to_hz) ** 2))


def energy(samples, rate_hz):
    return np.sum(samples**2) / rate_hz


@pytest.mark.parametrize(
    "signal",
    [
        ss.white_noise(0.5, seed=3, sample_rate_hz=RATE_HZ),
        burst(100.0) + burst(470.0),
        burst(100.0) + burst(560.0),
        burst(485.0),
        # As of something that is struck, and of a click.
        np.exp(-TIME_S / 0.004) * np.sin(2.0 * np.pi * 250.0 * TIME_S),
        np.eye(1, 40, 20)[0],
    ],
    ids=["noise", "beside the edge", "behind the edge", "in the transition", "struck", "click"],
)
def test_it_is_the_energy_that_resampling_leaves(signal):
    # Room at both ends: what rings there counts.
    room = np.pad(signal, 1300)
    passed_energy = energy(ss.resample(room, RATE_HZ, 1000), 1000)
    # What folds back beside the edge adds a little.
    assert loss_db(signal, 1000) == pytest.approx(
        10.0 * np.log10(energy(room, RATE_HZ) / passed_energy), abs=0.12
    )


@pytest.mark.parametrize("to_hz", [1000, 1001])
@pytest.mark.parametrize("phase_rad", [0.0, 0.4, np.pi / 2])
def test_a_tone_at_half_the_rate_is_halved_whatever_its_phase(to_hz, phase_rad):
    assert loss_db(burst(500.0, phase_rad), to_hz) == pytest.approx(6.0, abs=0.4)


def test_a_higher_rate_loses_what_lies_beyond_the_pass_band():
    assert loss_db(burst(590.0), 48_000) < 0.01
    # From 600 Hz on the filter falls, also on the way up.
    inside = ss.resample(np.pad(burst(640.0), 1300), RATE_HZ, 48_000)
    spectrum = np.abs(np.fft.rfft(inside)) ** 2
    at_own_hz = np.fft.rfftfreq(inside.size, 1.0 / 48_000) < RATE_HZ / 2
    lost_db = 10.0 * np.log10(
        energy(burst(640.0), RATE_HZ) / (2.0 * spectrum[at_own_hz].sum() / inside.size / 48_000)
    )
    assert loss_db(burst(640.0), 48_000) == pytest.approx(lost_db, abs=0.01)
    assert lost_db > 1.0


def test_steeper_filters_between_1200_and_1300_hz_keep_600_hz():
    assert loss_db(burst(590.0), 1250) < 0.01
    assert loss_db(burst(640.0), 1250) > 20.0


@pytest.mark.parametrize("to_hz", [100, 900, 1250, 48_000])
def test_what_passes_stays_where_it_is(to_hz):
    signal = burst(30.0)
    left = passed(signal, RATE_HZ, to_hz)
    ring = (left.size - signal.size) // 2
    np.testing.assert_allclose(left[ring:-ring], signal, atol=2e-4)
    assert np.abs(left[:ring]).max() < 2e-4
