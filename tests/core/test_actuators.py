"""The actuators that are shipped, and what is measured or fitted."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError

HZ = np.geomspace(20.0, 1000.0, 60)


def test_the_others_have_a_shape_and_no_scale():
    names = ss.actuators.shape_names()
    assert "bk-4810" in names
    assert not set(names) & set(ss.actuators.names())
    for name in names:
        shape = ss.actuators.load_shape(name)
        assert not hasattr(shape, "simulate")
        assert np.abs(shape.shape(1e6)) == pytest.approx(1.0, abs=1e-3)
        assert np.abs(shape.shape(shape.resonance_hz)) == pytest.approx(shape.quality)
        with pytest.raises(InvalidInputError, match="load_shape"):
            ss.actuators.load(name)


@pytest.mark.parametrize("name", ["example-voice-coil", "example-resonant", "kastor-2023-air"])
def test_a_fit_finds_the_response_it_was_given(name):
    truth = ss.actuators.load(name)
    values = truth.response(HZ)
    assert ss.actuators.misfit_db(ss.actuators.fit(HZ, values), HZ, values) < 1e-6
    assert ss.actuators.misfit_db(ss.actuators.fit(HZ, np.abs(values)), HZ, values) < 1e-3
    known = ss.actuators.fit(
        HZ, values, resistance_ohm=truth.resistance_ohm, moving_mass_kg=truth.moving_mass_kg
    )
    for parameter in ("inductance_h", "force_factor_n_per_a", "stiffness_n_per_m"):
        assert getattr(known, parameter) == pytest.approx(getattr(truth, parameter), rel=1e-6)


def test_a_fit_survives_noise():
    truth = ss.actuators.load("example-resonant")
    noise = np.random.default_rng(3).standard_normal((2, HZ.size))
    values = truth.response(HZ) * (1.0 + 0.02 * (noise[0] + 1j * noise[1]))
    fitted = ss.actuators.fit(HZ, values)
    assert ss.actuators.misfit_db(fitted, HZ, truth.response(HZ)) < 0.5


@pytest.mark.parametrize(
    ("frequency_hz", "values", "word"),
    [
        (HZ[:5], np.ones(5), "few"),
        (HZ, np.ones(59), "shape"),
        (HZ, np.zeros(60), "zeros"),
        (-HZ, np.ones(60), "frequencies of 0"),
        (HZ, np.full(60, np.nan), "not numbers"),
        (HZ, ["a"] * 60, "complex"),
    ],
)
def test_what_is_no_measurement_is_not_fitted(frequency_hz, values, word):
    with pytest.raises(InvalidInputError, match=word):
        ss.actuators.fit(frequency_hz, values)


@pytest.mark.parametrize("hold", ["zero", "first"])
def test_a_measured_response_moves_as_the_model_it_was_taken_from(hold):
    coil = ss.actuators.load("kastor-2023-air")
    hz = np.geomspace(5.0, 2000.0, 400)
    measured = ss.actuators.MeasuredResponse.of(hz[::-1], coil.response(hz[::-1]))
    tone = np.sin(2.0 * np.pi * 100.0 * np.arange(4800) / 48_000.0) * np.hanning(4800)
    voltage = np.concatenate((np.zeros(4800), tone, np.zeros(9600)))
    simulated, exact = (actuator.simulate(voltage, 48_000.0, hold) for actuator in (measured, coil))
    for name in ("acceleration", "velocity", "displacement"):
        values, true = getattr(simulated, name), getattr(exact, name)
        assert np.abs(values - true).max() < 5e-4 * np.abs(true).max()
    assert np.isnan(simulated.current).all()


def test_a_measured_response_is_as_measured_and_falls_beyond():
    measured = ss.actuators.MeasuredResponse.of([100.0, 200.0], [2.0, 8.0j])
    assert measured.response([100.0, 200.0]) == pytest.approx([2.0, 8.0j])
    assert measured.response(50.0) == pytest.approx(0.5)
    assert abs(measured.response(400.0)) == pytest.approx(2.0)
    assert abs(measured.response(np.sqrt(2.0) * 100.0)) == pytest.approx(4.0)
    assert measured.response(-200.0) == pytest.approx(-8.0j)
    assert measured.response(0.0) == 0.0
    with pytest.raises(InvalidInputError, match="twice"):
        ss.actuators.MeasuredResponse.of([100.0, 100.0], [1.0, 2.0])


COIL = ss.actuators.load("example-voice-coil")


def test_a_prediction_of_a_long_tone_follows_from_the_responses():
    tone = 0.5 * np.sin(2.0 * np.pi * 100.0 * np.arange(8000) / 4000.0)
    thermal = ss.actuators.Thermal(resistance_k_per_w=50.0, time_constant_s=0.5)
    (load,) = ss.actuators.predicted(tone, 4000, COIL, thermal=thermal)
    gain, flow = abs(COIL.response(100.0)), COIL.admittance(100.0)
    assert load.peak_voltage_v == pytest.approx(0.5, rel=0.1)
    assert load.rms_voltage_v == pytest.approx(0.5 / np.sqrt(2.0), rel=1e-3)
    assert load.rms_current_a == pytest.approx(0.5 * abs(flow) / np.sqrt(2.0), rel=1e-3)
    assert load.mean_power_w == pytest.approx(0.125 * flow.real, rel=1e-2)
    assert load.peak_acceleration_m_per_s2 == pytest.approx(0.5 * gain, rel=0.2)
    assert load.linear_share == pytest.approx(load.peak_velocity_m_per_s / 0.04)
    assert load.duty == 1.0
    assert load.duration_s == 2.0
    heat = 4.0 * 0.125 * abs(flow) ** 2 * 50.0
    assert load.temperature_rise_k == pytest.approx(heat * (1.0 - np.exp(-4.0)), rel=0.01)


def test_each_channel_has_its_own_actuator_and_duty():
    rows = np.zeros((2, 13_000))
    rows[0, :1300] = rows[1, :6500] = 1.0
    rows[1, 3000:6500], rows[1, 6500:] = 0.002, 0.0005
    loads = ss.actuators.predicted(rows, 13_000, [COIL, ss.actuators.load("kastor-2023-air")])
    assert [round(load.duty, 1) for load in loads] == [0.1, 0.5]
    assert loads[0].peak_displacement_m != loads[1].peak_displacement_m
    with pytest.raises(InvalidInputError, match="2 channels"):
        ss.actuators.predicted(rows, 13_000, [COIL])
