"""Transfer functions, main axes and travelling waves against signals that were made so."""

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.signals.analysis.transfer import transfer_function
from skinsource.signals.analysis.wave_speed import travelling_wave
from skinsource.signals.projection import ellipse, main_axes

RATE = 1300.0


def test_a_tone_between_noises_is_usable_around_its_frequency_only():
    rng = np.random.default_rng(6)
    time = np.arange(522) / RATE
    response = rng.normal(0.0, 0.01, (1, 1, 522))
    response += np.exp(-time / 0.01) * np.sin(2 * np.pi * 200.0 * time)
    transfer = transfer_function(response, RATE, [[0.01]])
    low, high = transfer.usable_hz[0]
    assert 25.0 <= low < 190.0
    assert 210.0 < high <= 600.0
    at = int(np.argmin(np.abs(transfer.frequency_hz - 200.0)))
    assert transfer.coherence[0, at] > 0.99
    doubled = transfer_function(response, RATE, [[0.01]], np.full(262, 2.0))
    assert doubled.noise == pytest.approx(2.0 * transfer.noise)


def test_coherence_is_the_share_of_power_that_is_not_noise():
    rng = np.random.default_rng(8)
    clean = np.zeros((200, 1, 522))
    clean[..., 100] = 0.5
    sigma = 0.5 / np.sqrt(522)
    transfer = transfer_function(clean + rng.normal(0, sigma, clean.shape), RATE, [[sigma]] * 200)
    # Signal and noise have the same power everywhere: a half is left.
    assert np.mean(transfer.coherence[:, 20:-20]) == pytest.approx(0.5, abs=0.04)


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
    distance_mm = [0.0, 11.0, 30.0, 65.0, 90.0]
    wave = travelling_wave(travelling(speed, loss, distance_mm), distance_mm, RATE)
    assert wave.speed_m_per_s == pytest.approx(speed, rel=0.01)
    assert wave.attenuation_db_per_cm == pytest.approx(loss, abs=1e-3)
    assert wave.delay_s == pytest.approx(np.array(distance_mm) * 1e-3 / speed, abs=2e-5)
    assert wave.similarity == pytest.approx(np.ones(5), abs=1e-3)
    assert wave.speed_deviation_m_per_s < 0.02 * speed


def test_silent_and_untrusted_points_do_not_bend_the_line():
    distance_mm = [0.0, 20.0, 40.0, 60.0]
    signals = travelling(10.0, 1.0, distance_mm)
    signals[1] = 0.0
    signals[3] = np.roll(signals[3], 300)
    wave = travelling_wave(signals, distance_mm, RATE, [True, True, True, False])
    assert wave.counted.tolist() == [True, False, True, False]
    assert wave.speed_m_per_s == pytest.approx(10.0, rel=0.01)
    assert np.isnan(wave.delay_s[1])


def test_what_arrives_everywhere_at_once_or_backwards_has_no_speed():
    distance_mm = [0.0, 20.0, 40.0]
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


def test_what_does_not_fit_is_refused():
    with pytest.raises(InvalidInputError, match="n_points"):
        travelling_wave(np.ones((2, 5)), [0.0], RATE)
    with pytest.raises(InvalidInputError, match="two axes or more"):
        main_axes(np.ones((2, 1, 5)))
    with pytest.raises(InvalidInputError, match="noise"):
        transfer_function(np.ones((2, 3, 9)), RATE, np.ones((2, 2)))
