"""Units: how they are written, and the way to an acceleration."""

import numpy as np
import pytest

from skinsource.readers.units import differentiated, time_unit_s, unit_named

RATE_HZ = 1300.0


@pytest.mark.parametrize("frequency_hz", [60.0, 250.0, 500.0])
def test_the_derivative_is_that_of_the_formula(frequency_hz):
    # A tone under a Gaussian of 50 ms in the middle of 1 s: nothing at the ends.
    time = np.arange(1300) / RATE_HZ - 0.5
    omega = 2.0 * np.pi * frequency_hz
    envelope, turn = np.exp(-0.5 * (time / 0.05) ** 2), omega * time + 0.4
    velocity = envelope * np.sin(turn)
    slope = -time / 0.05**2
    expected = envelope * (slope * np.sin(turn) + omega * np.cos(turn))
    derivative = differentiated(velocity, RATE_HZ, 1)
    assert np.abs(derivative - expected).max() < 1e-9 * np.abs(expected).max()


def test_drift_and_offset_leave_no_acceleration_inside():
    drift = 5.0 + np.linspace(0.0, 3.0, 13_000)
    derivative = differentiated(drift, RATE_HZ, 2)
    # Their ends are steps; the edge of the band rings for less than half a second.
    assert np.abs(derivative[1300:-1300]).max() < 1e-3 * np.abs(derivative).max()


@pytest.mark.parametrize(("frequency_hz", "gain"), [(10.0, 0.0), (14.0, 0.0), (20.0, 0.5), (30, 1)])
def test_the_band_begins_at_25_hz(frequency_hz, gain):
    time = np.arange(26_000) / RATE_HZ
    tone = np.sin(2.0 * np.pi * frequency_hz * time)
    middle = differentiated(tone, RATE_HZ, 1)[6500:-6500]
    assert np.abs(middle).max() == pytest.approx(gain * 2 * np.pi * frequency_hz, abs=0.05)


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("g", "g"), ("G", "g"), ("m/s²", "m/s²"), ("m/s^2", "m/s²"), ("m/s2", "m/s²"),
        (" mm/s ", "mm/s"), ("um", "µm"), ("μm", "µm"), ("N", "N"), ("volts", "V"), ("v", "V"),
        ("kg", ""), ("mV", ""), ("", ""),
    ],
)  # fmt: skip
def test_units_are_known_in_many_spellings(text, unit):
    assert unit_named(text) == unit


@pytest.mark.parametrize(
    ("name", "is_time", "seconds"),
    [
        ("time", "", 1.0), ("Time", "ms", 1e-3), ("t", "µs", 1e-6), ("time_ms", "", 1e-3),
        ("timestamp", "s", 1.0), ("time", "h", None), ("tap", "", None), ("temperature", "", None),
    ],
)  # fmt: skip
def test_columns_of_time_are_known_by_their_names(name, is_time, seconds):
    assert time_unit_s(name, is_time) == seconds
