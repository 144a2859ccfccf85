"""What the filter between two rates leaves of a signal, against direct sums."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.signals.resampling import passed

RATE_HZ = 1300
TIME_S = np.arange(RATE_HZ) / RATE_HZ


def burst(frequency_hz, phase_rad=0.3):
    """A second of a tone that begins and ends softly, so that it holds little else."""
    return np.hanning(RATE_HZ) * np.sin(2.0 * np.pi * frequency_hz * TIME_S + phase_rad)


def loss_db(signal, to_hz):
    return 10.0 * np.log10(np.sum(signal**2) / np.sum(passed(signal, RATE_HZ, to_hz) ** 2))


def energy(samples, rate_hz):
    return np.sum(samples**2) / rate_hz


def above_db(signal, edge_hz):
    """What is missing without all that lies above an edge, by a plain transform."""
    power = np.abs(np.fft.rfft(signal, 16 * signal.size)) ** 2
    frequency_hz = np.fft.rfftfreq(16 * signal.size, 1.0 / RATE_HZ)
    return 10.0 * np.log10(power.sum() / power[frequency_hz < edge_hz].sum())


@pytest.mark.parametrize(
    ("signal", "to_hz"),
    [
        (burst(100.0) + burst(560.0), 1000),
        (burst(100.0) + 3.0 * burst(300.0), 400),
        (burst(60.0) + 0.1 * burst(200.0), 300),
        (burst(60.0) + burst(90.0), 300),
        (burst(200.0) + burst(450.0), 1000),
    ],
)
def test_what_lies_clear_of_the_edge_is_lost_or_is_not(signal, to_hz):
    assert loss_db(signal, to_hz) == pytest.approx(above_db(signal, to_hz / 2), abs=1e-3)


@pytest.mark.parametrize(
    "signal",
    [
        ss.white_noise(0.5, seed=3, sample_rate_hz=RATE_HZ),
        burst(100.0) + burst(470.0),
        burst(485.0),
        # As of something that is struck, and of a click.
        np.exp(-TIME_S / 0.004) * np.sin(2.0 * np.pi * 250.0 * TIME_S),
        np.eye(1, 40, 20)[0],
    ],
    ids=["noise", "beside the edge", "in the transition", "struck", "click"],
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
