"""Responses from sweeps and tables, against the actuator that was swept."""

import numpy as np
import pytest
import soundfile

import skinsource as ss
from skinsource.base.errors import RecordingError

COIL = ss.actuators.load("example-voice-coil")
RATE_HZ = 8000


@pytest.fixture(scope="module")
def swept():
    """Voltage and acceleration of a sweep from 15 to 1200 Hz, and what rings after it."""
    time_s = np.arange(6 * RATE_HZ) / RATE_HZ
    rise = np.log(1200.0 / 15.0) / 5.0
    phase = 2.0 * np.pi * 15.0 * np.expm1(rise * np.minimum(time_s, 5.0)) / rise
    voltage = 0.5 * np.sin(phase) * (time_s < 5.0)
    return voltage, COIL.simulate(voltage, RATE_HZ, "first").acceleration


def test_a_sweep_gives_the_response_of_what_was_swept(swept):
    hz = np.geomspace(25.0, 600.0, 50)
    response = ss.measuring.response_from_sweep(*swept, RATE_HZ, (25.0, 600.0))
    assert [response.points[k][0] for k in (0, -1)] == pytest.approx([25.0, 600.0], rel=0.02)
    # A voltage that goes evenly from sample to sample has lost sinc² of its upper end.
    exact = COIL.response(hz) * np.sinc(hz / RATE_HZ) ** 2
    assert np.abs(response.response(hz) / exact - 1.0).max() < 0.02


def test_noise_of_the_accelerometer_averages_out(swept):
    voltage, acceleration = swept
    noise = np.random.default_rng(2).standard_normal(acceleration.size)
    noisy = acceleration + 0.3 * noise * np.sqrt(np.mean(acceleration**2))
    response = ss.measuring.response_from_sweep(voltage, noisy, RATE_HZ)
    assert ss.actuators.misfit_db(response, *_points(25.0, 600.0)) < 1.0


def test_a_sound_file_holds_voltage_and_acceleration(swept, tmp_path):
    voltage, acceleration = swept
    path = tmp_path / "sweep.wav"
    both = np.stack((voltage / 2.0, acceleration / 200.0), axis=1)
    soundfile.write(path, both, RATE_HZ, subtype="FLOAT")
    response = ss.measuring.open_response(
        path, volts_at_full_scale=2.0, m_per_s2_at_full_scale=200.0
    )
    direct = ss.measuring.response_from_sweep(voltage, acceleration, RATE_HZ)
    hz = np.geomspace(25.0, 600.0, 50)
    assert response.response(hz) == pytest.approx(direct.response(hz), rel=1e-4)


TABLES = {
    "gain and degrees": (
        "frequency_hz,gain,phase_deg",
        lambda h: (abs(h), np.degrees(np.angle(h))),
    ),
    "decibels and radians": (
        "Frequency (Hz);dB;phase_rad",
        lambda h: (20.0 * np.log10(abs(h)), np.angle(h)),
    ),
    "real and imaginary": ("freq_hz\treal\timag", lambda h: (h.real, h.imag)),
}


@pytest.mark.parametrize("name", TABLES)
def test_a_table_holds_a_response(tmp_path, name):
    head, columns = TABLES[name]
    mark = "," if "," in head else ";" if ";" in head else "\t"
    hz, response = _points(20.0, 1000.0)
    rows = [mark.join(f"{v:.9g}" for v in row) for row in zip(hz, *columns(response), strict=True)]
    path = tmp_path / "response.csv"
    path.write_text("\n".join([head, *rows]) + "\n")
    assert ss.measuring.open_response(path).response(hz) == pytest.approx(response, rel=1e-6)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a,b\n1,2\n3,4\n", "it has no column frequency_hz, expected a table"),
        ("frequency_hz,x\n1,2\n3,4\n", "no gain"),
        ("frequency_hz,gain\n20,0\n100,0\n", "zeros"),
        ("frequency_hz,gain\n-20,1\n100,1\n", "frequencies of 0"),
    ],
)
def test_other_tables_are_refused_with_the_name_of_the_file(tmp_path, text, word):
    path = tmp_path / "odd.csv"
    path.write_text(text)
    with pytest.raises(RecordingError, match=word) as caught:
        ss.measuring.open_response(path)
    assert "odd.csv" in str(caught.value)


def _points(low_hz, high_hz):
    hz = np.geomspace(low_hz, high_hz, 60)
    return hz, COIL.response(hz)
