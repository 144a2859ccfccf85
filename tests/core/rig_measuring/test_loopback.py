"""A loopback tells the delay of a card, beyond what the card says."""

import numpy as np
import pytest
import scipy

import skinsource as ss
from skinsource.base.errors import PlaybackError
from skinsource.lab.rig_measuring.loopback import clicks, lags
from tests.core.rig_measuring import bench_top
from tests.core.rig_measuring.bench_top import BLOCK_S, TIMES

RATE_HZ, DELAY = 48_000, 321


@pytest.fixture
def cable(monkeypatch):
    path = np.zeros(8192)
    path[DELAY] = 0.6
    return bench_top.use(monkeypatch, bench_top.Card(path, output=1))


def test_delay_and_jitter_of_a_cable_are_those_of_the_card(cable):
    found = ss.rig_measuring.loopback(1, 1, repeats=5)
    assert found.n_seen == 5
    # What is played in a block comes back from the next one on.
    assert found.round_trip_s == pytest.approx(BLOCK_S + DELAY / RATE_HZ, abs=1e-8)
    assert found.jitter_s < 1e-8
    told_s = TIMES.outputBufferDacTime - TIMES.inputBufferAdcTime
    assert found.behind_s == pytest.approx(found.round_trip_s - told_s)


def test_a_reference_tells_how_much_later_another_output_is(monkeypatch):
    # The card answers to output 2 alone; output 1 plays the same clicks.
    late, prompt = np.zeros(8192), np.zeros(8192)
    late[DELAY], prompt[0] = 0.6, 0.6
    bench_top.use(monkeypatch, bench_top.Card(late, prompt, output=2))
    found = ss.rig_measuring.loopback(2, 1, reference=(1, 2), repeats=3)
    np.testing.assert_allclose(found.later_s, DELAY / RATE_HZ, atol=1e-8)


def came_back(rate_hz, delay_s, gain):
    """Clicks as they are played, and as they come back, by scipy: later, band-limited, weaker."""
    click, starts, played = clicks(5, rate_hz)
    spectrum = scipy.fft.rfft(played)
    hz = scipy.fft.rfftfreq(played.size, 1.0 / rate_hz)
    later = scipy.fft.irfft(gain * spectrum * np.exp(-2j * np.pi * hz * delay_s), played.size)
    return click, starts, later


@pytest.mark.parametrize("rate_hz", [8000, 44_100, 96_000, 192_000])
@pytest.mark.parametrize(
    ("gain", "noise", "hum", "within_s"),
    [
        (0.5, 0.0, 0.0, 1e-8),
        (-0.5, 0.0, 0.0, 1e-8),
        (0.5, 0.02, 0.0, 2e-5),
        (0.5, 0.0, 0.5, 5e-6),
        # The input clips.
        (3.0, 0.0, 0.0, 5e-6),
        (0.005, 0.0001, 0.001, 2e-5),
    ],
)
def test_a_delay_between_samples_is_right_in_noise_and_hum_clipped_and_reversed(
    rate_hz, gain, noise, hum, within_s
):
    delay_s = 0.0123456
    click, starts, recorded = came_back(rate_hz, delay_s, gain)
    times_s = np.arange(recorded.size) / rate_hz
    recorded = recorded + noise * np.random.default_rng(1).standard_normal(recorded.size)
    recorded += hum * np.sin(2.0 * np.pi * 50.0 * times_s + 1.0)
    found_s = lags(np.clip(recorded, -1.0, 1.0), click, starts, rate_hz) / rate_hz
    np.testing.assert_allclose(found_s, delay_s, atol=within_s)


def test_a_delay_that_is_longer_than_the_pause_between_clicks_is_told_in_full():
    click, starts, recorded = came_back(8000, 0.43, 0.5)
    np.testing.assert_allclose(lags(recorded, click, starts, 8000) / 8000, 0.43, atol=1e-8)


def test_a_click_that_is_missing_is_not_taken_for_another():
    click, starts, recorded = came_back(8000, 0.0123456, 0.5)
    recorded[starts[2] : starts[3]] = 0.0
    seen = np.isfinite(lags(recorded, click, starts, 8000))
    assert seen.tolist() == [True, True, False, True, True]


def test_noise_alone_and_hum_alone_are_no_click():
    click, starts, recorded = came_back(8000, 0.0, 0.5)
    noise = np.random.default_rng(2).standard_normal(recorded.size)
    hum = np.sin(2.0 * np.pi * 50.0 * np.arange(recorded.size) / 8000)
    for nothing in (0.1 * noise, 0.5 * hum + 1e-4 * noise, 0.0 * noise):
        assert np.isnan(lags(nothing, click, starts, 8000)).all()


def test_a_missing_cable_is_one_sentence(cable):
    cable.noise = 0.0
    with pytest.raises(PlaybackError, match=r"Input 2 .* heard nothing of output 1"):
        ss.rig_measuring.loopback(1, 2, repeats=2)
    with pytest.raises(PlaybackError, match="4 outputs"):
        ss.rig_measuring.loopback(9, 1)
