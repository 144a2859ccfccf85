"""What an export says it is equalised for."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.equalising import RegularisedInverse, equalised
from skinsource.actuators.rigs import Rig, RigChannel
from tests.core.exporting.export_bench import read, sidecar

RATE_HZ = 8000
MODEL = ss.actuators.load("example-voice-coil")
COIL = ss.Actuation(actuators=(ss.ActuatorAt(actuator="Coil, in air", model=MODEL),))
INVERSE = RegularisedInverse(boost_db=12.0)


@pytest.fixture
def design():
    gabor = ss.waveforms.Gabor(frequency_hz=200.0, cycles=8.0)
    return ss.Design(limb="synthetic-1", inputs=(ss.track(7, gabor, onset_s=0.1),))


def exported(design, path, **options):
    return ss.export_stimulus(design, path, rate_hz=RATE_HZ, **options)


def test_without_an_equaliser_it_says_so(design, tmp_path):
    path = tmp_path / "a.wav"
    assert exported(design, path).equalised == "Not equalised (raw accelerations)"
    assert sidecar(path)["equalised"] == "Not equalised (raw accelerations)"
    # Knowing the actuator alone makes no volts.
    assert exported(design, path, actuation=COIL).equalised == "Not equalised (raw accelerations)"
    assert sidecar(path)["actuator"] is None


@pytest.mark.parametrize(
    ("changes", "message"),
    [({"scaling": "upstream"}, "raw drives"), ({"actuation": COIL}, "volts of the design")],
)
def test_what_is_no_acceleration_is_not_called_one(design, tmp_path, changes, message):
    done = exported(replace(design, **changes), tmp_path / "a.wav")
    assert done.equalised == f"Not equalised ({message})"


def test_an_actuator_that_is_named_gets_its_volts_whatever_is_predicted(design, tmp_path):
    path = tmp_path / "a.wav"
    done = exported(design, path, actuation=COIL, equaliser=INVERSE)
    assert done.equalised == "Equalised for Coil, in air (regularised inverse)"
    drive = ss.stimulus_of(design, RATE_HZ).samples
    volts = equalised(drive, RATE_HZ, MODEL, INVERSE)
    np.testing.assert_allclose(read(path), volts * done.gain, atol=1e-6)
    about = sidecar(path)
    assert about["equalised"] == done.equalised
    assert about["unit"] == "V"
    assert about["actuator"] == ["Coil, in air"]
    assert about["equaliser"]["boost_db"] == 12.0
    assert about["predicted_through"] is None
    # It is the design that was exported, not one with an actuator in it.
    exported(design, tmp_path / "b.wav")
    assert sidecar(tmp_path / "b.wav")["design_digest"] == about["design_digest"]


def test_a_rig_says_the_actuators_itself(design, tmp_path):
    channel = RigChannel(place=7, actuator="example-voice-coil", full_scale_v=100.0)
    rig = Rig(title="Bench 3", channels=(channel,))
    done = exported(design, tmp_path / "a.wav", actuation=COIL, rig=rig, equaliser=INVERSE)
    assert done.equalised == "Equalised for Bench 3 (regularised inverse)"
    assert sidecar(tmp_path / "a.wav")["actuator"] == ["example-voice-coil"]
    nameless = Rig(channels=(channel,))
    done = exported(design, tmp_path / "a.wav", rig=nameless, equaliser=INVERSE)
    assert done.equalised == "Equalised for the rig (regularised inverse)"
