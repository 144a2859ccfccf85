"""Figures of signals: bands, statistics, spectrograms, transfer functions and waves."""

import numpy as np
import pytest

from skinsource.base.conventions import BAND_HZ
from skinsource.base.errors import Stopped
from skinsource.signals.analysis import statistics
from skinsource.signals.analysis.noise import noise_rms, quiet_rms
from skinsource.signals.analysis.spectrogram import MOST_COLUMNS, spectrogram
from skinsource.signals.analysis.statistics import crest_factor, dominant_frequency, onset_time
from skinsource.signals.analysis.transfer import transfer_function
from skinsource.signals.analysis.wave_speed import (
    arrivals,
    line_distances_mm,
    straightness,
    travelling_wave,
)
from skinsource.signals.projection import ellipse, main_axes
from skinsource.studies.checking import straight_lines

RATE = 1300.0


def band_rms(signals, band_hz=BAND_HZ):
    return statistics.band_rms(np.fft.rfft(signals), signals.shape[-1], RATE, band_hz)


@pytest.mark.parametrize("n_times", [1300, 1301, 7])
def test_bins_hold_all_the_energy_together(n_times):
    signals = np.random.default_rng(3).normal(size=(2, 3, n_times))
    _, rms = band_rms(signals, (0.0, 654.0))
    assert rms.shape[:2] == (2, 3)
    energy = np.sum(np.square(rms), axis=-1)
    np.testing.assert_allclose(energy, np.mean(np.square(signals), axis=-1))


def test_only_whole_bins_are_told():
    noise = np.random.default_rng(4).normal(size=2600)
    assert band_rms(noise)[0][[0, -1]].tolist() == [26.0, 598.0]
    assert band_rms(noise, (40.0, 91.9))[0][[0, -1]].tolist() == [41.0, 89.0]
    assert band_rms(noise, None)[0][[0, -1]].tolist() == [1.0, 649.0]


def test_a_frequency_where_a_bin_begins_is_in_that_one():
    # 51 / 300 of the rate is 221 Hz, less the rounding of a float.
    tone = np.sin(2.0 * np.pi * 221.0 * np.arange(300) / RATE + 0.3)
    frequency_hz, rms = band_rms(tone)
    assert frequency_hz[np.argmax(rms)] == 222.0


def test_a_response_that_is_too_short_has_no_bin():
    frequency_hz, rms = band_rms(np.ones((2, 1)))
    assert (frequency_hz.size, rms.shape) == (0, (2, 0))


def test_equal_levels_make_no_line():
    x = np.array([1.0, 2.0, 3.0])
    assert np.isnan(straight_lines(x, np.full(3, 0.1))[2])
    slope, offset, r2 = straight_lines(x, 2.0 + 1e-12 * x)
    assert slope == pytest.approx(1e-12, rel=1e-3)
    assert offset == pytest.approx(2.0)
    assert r2 == pytest.approx(1.0, abs=1e-3)


def test_the_crest_factor_of_a_sine_is_the_root_of_two_and_silence_has_none():
    wave = np.sin(2 * np.pi * 0.0213 * np.arange(5000))
    rms = np.sqrt(np.mean(wave**2))
    factors = crest_factor(np.array([np.abs(wave).max(), 0.0]), np.array([rms, 0.0]))
    assert factors[0] == pytest.approx(np.sqrt(2), rel=1e-3)
    assert np.isnan(factors[1])


@pytest.mark.parametrize("frequency_hz", [31.7, 100.0, 187.3, 402.2])
def test_the_dominant_frequency_is_that_of_the_finest_transform(frequency_hz):
    time = np.arange(900) / RATE
    burst = np.exp(-(((time - 0.3) / 0.08) ** 2)) * np.sin(2 * np.pi * frequency_hz * time)
    whole = np.stack([burst, 3.0 + 0.2 * burst])
    frequencies_hz = dominant_frequency(np.abs(np.fft.rfft(whole)) ** 2, RATE / 900)
    fine = np.abs(np.fft.rfft(burst, 2**20))
    expected = np.argmax(fine) * RATE / 2**20
    assert frequencies_hz == pytest.approx([expected, expected], abs=0.1)


def test_silence_has_no_dominant_frequency_and_a_constant_neither():
    assert np.isnan(dominant_frequency(np.zeros((2, 8)), 1.0)).all()
    assert np.isnan(dominant_frequency(np.array([5.0, 0.0, 0.0]), 1.0))


def test_the_lowest_bin_is_not_drawn_towards_a_constant():
    assert dominant_frequency(np.array([100.0, 4.0, 1.0, 0.5]), 2.0) == 2.0


def test_a_signal_begins_where_it_first_reaches_a_tenth_of_its_peak():
    time = np.arange(101) / 100.0 - 0.2
    ramp = np.clip(time - 0.105, 0.0, 0.5) * -8.0
    onsets_s = onset_time(np.stack([ramp, np.zeros(101), np.ones(101)]), time)
    # A straight line: no error between samples, though a tenth lies between two of them.
    assert onsets_s[0] == pytest.approx(0.155, abs=1e-12)
    assert np.isnan(onsets_s[1])
    assert onsets_s[2] == -0.2


def test_noise_is_what_comes_before_the_pulse():
    rng = np.random.default_rng(3)
    response = rng.normal(0.0, 0.5, (2, 3, 522))
    response[..., 60:] *= 100.0
    rms = noise_rms(response, RATE)
    assert rms == pytest.approx(np.sqrt(np.mean(response[..., :39] ** 2, axis=-1)), rel=1e-12)


def test_too_few_samples_of_a_recording_tell_no_noise():
    quiet = np.random.default_rng(6).normal(size=(2, 3, 8))
    assert quiet_rms(quiet[..., :7]) is None
    assert quiet_rms(quiet[..., :0]) is None
    np.testing.assert_allclose(quiet_rms(quiet), np.sqrt(np.mean(quiet**2, axis=-1)))


def amplitude_by_hand(signal, middle, frequency_hz, n_window):
    """One-sided amplitude under a Hann window around a sample."""
    k = np.arange(n_window)
    at = middle - n_window // 2 + k
    weight = 0.5 - 0.5 * np.cos(2 * np.pi * k / n_window)
    values = np.where((at >= 0) & (at < signal.size), signal[at % signal.size], 0.0)
    turned = weight * values * np.exp(-2j * np.pi * frequency_hz * at / RATE)
    return 2.0 * abs(turned.sum()) / weight.sum()


def test_each_cell_is_the_windowed_sum_at_its_time_and_frequency():
    signal = np.random.default_rng(1).normal(size=700)
    levels = spectrogram(signal, RATE, 0.05)
    n_window = 65
    for column in (0, 5, 40, levels.time_s.size - 1):
        for row in (3, 17, 40):
            middle = round(levels.time_s[column] * RATE)
            expected = amplitude_by_hand(signal, middle, levels.frequency_hz[row], n_window)
            assert levels.amplitude[row, column] == pytest.approx(expected, rel=1e-9)


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


def test_signals_shorter_than_the_window_have_a_spectrogram_too():
    levels = spectrogram(np.ones(3), RATE, 0.2)
    assert levels.amplitude.shape == (levels.frequency_hz.size, levels.time_s.size)
    # A constant has no mirror image: 3 samples of 1, where the window is about 1, of 130.
    assert levels.amplitude[0, 0] == pytest.approx(3.0 / 130.0, rel=0.01)


def test_a_transfer_function_is_the_sum_over_taps_at_each_frequency():
    response = np.random.default_rng(2).normal(size=(2, 3, 50))
    transfer = transfer_function(response, RATE, np.zeros((2, 3)))
    for k in (0, 7, 25):
        turn = np.exp(-2j * np.pi * transfer.frequency_hz[k] * np.arange(50) / RATE)
        expected = np.sqrt(np.sum(np.abs(response @ turn) ** 2, axis=1))
        assert transfer.magnitude[:, k] == pytest.approx(expected, rel=1e-10)
    assert (transfer.noise == 0.0).all()
    assert transfer.coherence == pytest.approx(np.ones((2, 26)))


def test_a_tone_between_noises_is_usable_around_its_frequency_only():
    rng = np.random.default_rng(6)
    time = np.arange(522) / RATE
    response = rng.normal(0.0, 0.01, (1, 1, 522))
    response += np.exp(-time / 0.01) * np.sin(2 * np.pi * 200.0 * time)
    transfer = transfer_function(response, RATE, np.array([[0.01]]))
    low, high = transfer.usable_hz[0]
    assert 25.0 <= low < 190.0
    assert 210.0 < high <= 600.0
    at = int(np.argmin(np.abs(transfer.frequency_hz - 200.0)))
    assert transfer.coherence[0, at] > 0.99
    doubled = transfer_function(response, RATE, np.array([[0.01]]), np.full(262, 2.0))
    assert doubled.noise == pytest.approx(2.0 * transfer.noise)


def test_motion_on_a_tilted_line_has_that_axis_and_an_ellipse_of_its_length():
    time = np.arange(4000) / RATE
    direction = np.array([0.6, 0.0, -0.8])
    line = direction[:, None] * np.sin(2 * np.pi * 65.0 * time)
    axes = main_axes(line[None] + 7.0)
    assert axes.direction[0] == pytest.approx([-0.6, 0.0, 0.8], abs=1e-9)
    assert axes.deviation[0, 0] == pytest.approx(np.sqrt(0.5), rel=1e-6)
    assert axes.share[0] == pytest.approx(1.0)
    assert not axes.none[0]
    points = ellipse(axes.covariance[0], (0, 2))
    assert np.hypot(*points.T).max() == pytest.approx(np.sqrt(0.5), rel=1e-6)


def test_motion_on_a_circle_and_silence_have_no_main_axis():
    turn = 2 * np.pi * np.arange(1300) * 50 / RATE
    circle = np.stack([np.cos(turn), np.sin(turn)])
    axes = main_axes(np.stack([circle, 0.0 * circle]))
    assert axes.none.tolist() == [True, True]
    assert axes.share[0] == pytest.approx(0.5)
    assert np.isnan(axes.share[1])
    squeezed = main_axes((circle * [[1.0], [0.998]])[None])
    assert not squeezed.none[0]


def test_points_of_an_ellipse_solve_its_equation():
    rng = np.random.default_rng(9)
    mixing = rng.normal(size=(3, 3))
    covariance = mixing @ mixing.T
    points = ellipse(covariance, (1, 2))
    inverse = np.linalg.inv(covariance[1:, 1:])
    assert np.einsum("ni,ij,nj->n", points, inverse, points) == pytest.approx(np.ones(len(points)))


def travelling(speed_m_per_s, loss_db_per_cm, distance_mm, noise=0.0):
    """Bursts of 150 Hz that arrive later and weaker with distance; delays between samples."""
    rng = np.random.default_rng(10)
    time = np.arange(1200) / RATE
    rows = []
    for d in distance_mm:
        since = time - 0.2 - d * 1e-3 / speed_m_per_s
        burst = np.exp(-((since / 0.02) ** 2)) * np.cos(2 * np.pi * 150.0 * since)
        rows.append(burst * 10 ** (-loss_db_per_cm * d / 10.0 / 20.0))
    return np.array(rows) + noise * rng.normal(size=(len(distance_mm), time.size))


@pytest.mark.parametrize(("speed", "loss"), [(5.0, 1.5), (15.0, 0.4), (40.0, 0.0)])
def test_speed_and_loss_of_a_made_wave_are_found(speed, loss):
    distance_mm = np.array([0.0, 11.0, 30.0, 65.0, 90.0])
    wave = travelling_wave(travelling(speed, loss, distance_mm), distance_mm, RATE)
    assert wave.speed_m_per_s == pytest.approx(speed, rel=0.01)
    assert wave.attenuation_db_per_cm == pytest.approx(loss, abs=1e-3)
    assert wave.delay_s == pytest.approx(distance_mm * 1e-3 / speed, abs=2e-5)
    assert wave.similarity == pytest.approx(np.ones(5), abs=1e-3)
    assert wave.speed_deviation_m_per_s < 0.02 * speed


def test_silent_and_untrusted_points_do_not_bend_the_line():
    distance_mm = np.array([0.0, 20.0, 40.0, 60.0])
    signals = travelling(10.0, 1.0, distance_mm)
    signals[1] = 0.0
    signals[3] = np.roll(signals[3], 300)
    wave = travelling_wave(signals, distance_mm, RATE, np.array([True, True, True, False]))
    assert wave.counted.tolist() == [True, False, True, False]
    assert wave.speed_m_per_s == pytest.approx(10.0, rel=0.01)
    assert np.isnan(wave.delay_s[1])


def test_what_arrives_everywhere_at_once_or_backwards_has_no_speed():
    distance_mm = np.array([0.0, 20.0, 40.0])
    standing = np.tile(travelling(10.0, 0.0, [0.0]), (3, 1))
    assert np.isnan(travelling_wave(standing, distance_mm, RATE).speed_m_per_s)
    backwards = travelling(10.0, 0.0, distance_mm)[::-1]
    assert np.isnan(travelling_wave(backwards, distance_mm, RATE).speed_m_per_s)
    silent = travelling_wave(np.zeros((3, 50)), distance_mm, RATE)
    assert np.isnan([silent.speed_m_per_s, silent.attenuation_db_per_cm]).all()


def test_delays_that_the_way_does_not_explain_have_no_speed():
    # Delays that jump to and fro by 40 ms over a way of 65 outputs, and grow a little with it.
    distance_mm = np.linspace(0.0, 2500.0, 65)
    rng = np.random.default_rng(13)
    jumping = distance_mm / 127.0 + rng.uniform(-20.0, 20.0, distance_mm.size)
    signals = travelling(1.0, 0.0, jumping)
    wave = travelling_wave(signals, distance_mm, RATE)
    expected = np.corrcoef(distance_mm, jumping)[0, 1] ** 2
    assert wave.explained == pytest.approx(expected, abs=0.01)
    assert wave.explained < 0.5
    assert np.isnan(wave.speed_m_per_s)
    assert np.isfinite(wave.attenuation_db_per_cm)


def test_what_moves_before_its_group_delay_has_passed_does_not_arrive_then():
    burst = np.sin(2 * np.pi * 100.0 * np.arange(390) / RATE) * np.exp(-np.arange(390) / 65.0)
    first, late = np.pad(burst, (130, 780)), np.pad(burst, (260, 650))
    signals = np.stack((first, late + 0.1 * first, late + 0.3 * first))
    delay_s = arrivals(signals, RATE, 0.1)
    assert delay_s[1] == pytest.approx(0.1, abs=1e-3)
    assert np.isnan(delay_s[2])


def test_a_way_to_and_fro_has_no_speed_and_a_bent_one_has():
    distance_mm = np.linspace(0.0, 60.0, 5)
    signals = travelling(8.0, 0.0, distance_mm)
    bent = travelling_wave(signals, distance_mm, RATE, straight=0.51)
    assert bent.speed_m_per_s == pytest.approx(8.0, rel=0.01)
    assert np.isnan(travelling_wave(signals, distance_mm, RATE, straight=0.49).speed_m_per_s)


def test_straightness_is_the_distance_of_the_ends_over_the_way():
    corners = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]])
    assert straightness(corners) == pytest.approx(5.0 / 7.0)
    assert straightness(corners[[0, 1, 1]]) == 1.0
    assert straightness(corners[[0, 2, 0]]) == 0.0
    assert straightness(corners[[2, 2]]) == 1.0


def test_distances_add_up_along_the_line():
    distances_mm = line_distances_mm(np.array([[0.0, 0.0], [3.0, 4.0], [3.0, 10.0]]), 2.0)
    assert distances_mm.tolist() == [0.0, 10.0, 22.0]
