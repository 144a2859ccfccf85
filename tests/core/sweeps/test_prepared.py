"""What an input plays is remembered for the next stimulus, as long as it holds there."""

from dataclasses import replace

import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import never
from skinsource.base.measurement_conditions import BAND_HZ
from skinsource.engine.shared import Shared
from skinsource.studies.sweeps.metrics import Preparing
from tests.core.own_limbs.lab_bench import installed

# 10.5 turns of 20 Hz: 16 ms of velocity are left, as much as a tone of 10 Hz has.
HALF_A_TURN = ss.waveforms.Tone(frequency_hz=20.0, duration_s=0.525, window="none")


def test_it_is_played_anew_at_another_rate_through_other_actuators_and_in_another_band(user_data):
    installed(band_hz=(5.0, 1500.0))
    installed(name="lab-2", band_hz=(50.0, 1500.0))
    installed(name="lab-3", band_hz=BAND_HZ)
    coil = ss.ActuatorAt(actuator="coil", model=ss.actuators.load("example-voice-coil"))
    through = ss.Actuation(actuators=(coil,), equaliser=ss.equalising.RegularisedInverse())
    preparing = Preparing(Shared())
    plain = ss.Design(
        limb="synthetic-1", scaling="probe", inputs=(ss.track(7, HALF_A_TURN, amplitude=0.1),)
    )
    (slow,) = preparing.of(plain, never).placed
    assert preparing.of(replace(plain, title="Another"), never).placed[0] is slow
    (quick,) = preparing.of(replace(plain, limb="lab-3"), never).placed
    assert quick.drive.samples.size / slow.drive.samples.size == pytest.approx(
        4000 / 1300, rel=0.01
    )
    driven = replace(plain, limb="lab-1", actuation=through)
    (followed,) = preparing.of(driven, never).placed
    assert followed.drive.samples.size == quick.drive.samples.size
    # What was followed down to 5 Hz, or without an equaliser, need not be here.
    with pytest.raises(InvalidInputError, match="leaves a velocity"):
        preparing.of(replace(driven, limb="lab-2"), never)
    preparing.of(replace(plain, limb="lab-2"), never)
    with pytest.raises(InvalidInputError, match="leaves a velocity"):
        preparing.of(replace(driven, limb="lab-2"), never)
