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
