"""Equalisers against the bounds that theory gives, and motions against what was asked for."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.equalising import PolePairReplacement, RegularisedInverse
from skinsource.base.errors import InvalidInputError

COIL = ss.actuators.load("example-voice-coil")
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
