"""The shipped actuators and their fits; equalisers against the bounds that theory gives."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.equalising import PolePairReplacement, RegularisedInverse
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


AIR = ss.actuators.load("kastor-2023-air")
BAND = np.geomspace(25.0, 600.0, 2001)


@pytest.mark.parametrize("boost_db", [0.0, 10.0, 20.0, 40.0])
@pytest.mark.parametrize("phase", ["linear", "minimum"])
def test_the_boost_is_never_passed(boost_db, phase):
    for actuator in (COIL, AIR, ss.actuators.load("example-resonant")):
        gain = np.abs(RegularisedInverse(boost_db, phase).filter(actuator, BAND))
        boost = gain * np.abs(actuator.response(BAND)).max()
        assert 20.0 * np.log10(boost.max()) <= boost_db + 1e-3
        if boost_db in (10.0, 20.0) and actuator is not COIL:
            assert 20.0 * np.log10(boost.max()) > boost_db - 0.5


def test_without_need_for_boost_the_inverse_is_the_inverse():
    passed = RegularisedInverse(60.0).filter(COIL, BAND) * COIL.response(BAND)
    assert np.abs(passed - 1.0).max() < 1e-3


def test_the_contactor_moves_as_the_drive_says():
    drive = np.zeros(1300)
    wave = ss.waveforms.Gabor(frequency_hz=150.0).samples(1300.0)
    drive[400 : 400 + wave.size] = 10.0 * wave
    voltage = ss.equalising.equalised(drive, 1300, AIR, RegularisedInverse(40.0))
    motion = AIR.simulate(ss.resample(voltage, 1300, 48_000), 48_000, "first")
    moved = ss.resample(motion.acceleration, 48_000, 1300)
    assert np.abs(moved - drive).max() < 0.05
    (load,) = ss.actuators.predicted(voltage, 1300, AIR)
    assert load.peak_acceleration_m_per_s2 == pytest.approx(10.0, rel=0.01)


@pytest.mark.parametrize(("finer", "band"), [(1, (25.0, 600.0)), (20, (25.0, 40_000.0))])
def test_minimum_phase_begins_no_earlier_than_the_drive(finer, band):
    rate_hz, n = 6500 * finer, 1300 * finer
    tone = np.sin(2.0 * np.pi * 200.0 * np.arange(n) / rate_hz)
    before = {}
    for phase in ("linear", "minimum"):
        filtered = RegularisedInverse(20.0, phase)
        around = {"band_hz": band, "lead_s": 0.2, "tail_s": 0.2}
        voltage = ss.equalising.equalised(tone, rate_hz, AIR, filtered, **around)
        assert voltage.shape == (3 * n,)
        before[phase] = np.abs(voltage[: n - 50]).max() / np.abs(voltage).max()
    assert before["minimum"] < 2e-3
    assert before["linear"] > 20.0 * before["minimum"]


def test_lead_and_tail_add_what_would_be_cut_off():
    tone = np.sin(2.0 * np.pi * 200.0 * np.arange(1300) / 6500.0) * np.hanning(1300)
    plain = ss.equalising.equalised([tone, 2.0 * tone], 6500, AIR, RegularisedInverse())
    wide = ss.equalising.equalised(tone, 6500, AIR, RegularisedInverse(), lead_s=0.1, tail_s=0.3)
    assert plain.shape == (2, 1300)
    assert plain[1] == pytest.approx(2.0 * plain[0])
    assert wide[650 : 650 + 1300] == pytest.approx(plain[0], abs=1e-12)
    assert wide.size == 650 + 1300 + 1950


def test_a_pole_pair_takes_the_resonance_out():
    coil = ss.actuators.VoiceCoil(8.0, 1e-9, 1e-3, 1e-3, 0.0733, 1209.0)
    resonance_hz, quality = ss.equalising.resonance_of(coil)
    assert quality == pytest.approx(15.0, rel=0.01)
    pair = PolePairReplacement(resonance_hz, quality)
    moved = np.abs(coil.response(BAND) * pair.filter(coil, BAND))
    ratio = BAND / resonance_hz
    damped = ratio**2 / np.abs(1.0 - ratio**2 + 1j * ratio / 0.7)
    assert np.ptp(np.log(moved / damped)) < 1e-3
    assert np.exp(np.mean(np.log(moved))) == pytest.approx(1.0, rel=0.01)


@pytest.mark.parametrize("name", ["example-piezo", "example-resonant"])
def test_the_resonance_that_a_response_shows_is_that_of_its_mass_and_spring(name):
    model = ss.actuators.load(name)
    resonance_hz, quality = ss.equalising.resonance_of(model)
    exact_hz = np.sqrt(model.stiffness_n_per_m / model.moving_mass_kg) / (2.0 * np.pi)
    assert resonance_hz == pytest.approx(exact_hz, rel=0.01)
    assert 5.0 < quality < 20.0


def test_the_upstream_tap_is_refused_with_the_reason():
    tap = ss.waveforms.Tap().samples(1300.0)
    velocity = ss.equalising.net_velocity(tap, 1300.0)
    assert velocity.share_below_band == pytest.approx(0.52, abs=0.005)
    assert velocity.left == pytest.approx(8.5e-3, abs=1e-4)
    tone = 0.3 * np.sin(0.5 * np.arange(5200))
    hidden = tone + np.pad(tap, (1000, 5200 - 1000 - tap.size))
    for drive in (tap, -tap, hidden, [tone, hidden]):
        for method in (RegularisedInverse(), PolePairReplacement()):
            with pytest.raises(InvalidInputError, match="Centred tap"):
                ss.equalising.equalised(drive, 1300, COIL, method)
    with pytest.raises(InvalidInputError, match="52 % of its energy lies below 25 Hz"):
        ss.equalising.equalised(tap, 1300, COIL, RegularisedInverse())


def test_an_actuator_without_force_cannot_be_equalised():
    dead = ss.actuators.VoiceCoil(8.0, 8e-4, 0.0, 1e-3, 0.07, 1209.0)
    with pytest.raises(InvalidInputError, match="force factor"):
        ss.equalising.equalised(np.zeros(10), 1300, dead, RegularisedInverse())
    with pytest.raises(InvalidInputError, match="1300"):
        ss.equalising.equalised(np.zeros(10), 1000, COIL, RegularisedInverse())
    with pytest.raises(InvalidInputError, match="boost_db"):
        RegularisedInverse(-1.0)


@pytest.mark.parametrize("band_hz", [(25.0, float("nan")), (float("nan"), 600.0), (600.0, 25.0)])
def test_a_band_that_is_none_is_refused(band_hz):
    with pytest.raises(InvalidInputError, match="band_hz"):
        ss.equalising.followed_band(band_hz, 1300.0)
    with pytest.raises(InvalidInputError, match="sample_rate_hz"):
        ss.equalising.followed_band(None, float("nan"))
