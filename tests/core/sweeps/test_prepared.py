"""What an input plays is remembered for the next stimulus, as long as it holds there."""

from dataclasses import replace

import skinsource as ss
from skinsource.base.measurement_conditions import BAND_HZ
from tests.core.own_limbs.lab_bench import installed

# 10.5 turns of 20 Hz: 16 ms of velocity are left, as much as a tone of 10 Hz has.
HALF_A_TURN = ss.waveforms.Tone(frequency_hz=20.0, duration_s=0.525, window="none")


def test_it_is_played_anew_at_another_rate_through_other_actuators_and_in_another_band(user_data):
    installed(band_hz=(5.0, 1500.0))
    installed(name="lab-2", band_hz=(50.0, 1500.0))
    installed(name="lab-3", band_hz=BAND_HZ)
    coil = ss.ActuatorAt(actuator="coil", model=ss.actuators.load("example-voice-coil"))
    through = ss.Actuation(actuators=(coil,), equaliser=ss.equalising.RegularisedInverse())
    slow = ss.Design(
        limb="synthetic-1", scaling="probe", inputs=(ss.track(7, HALF_A_TURN, amplitude=0.1),)
    )
    quick = replace(slow, limb="lab-3")
    driven = replace(slow, limb="lab-1", actuation=through)
    # What is followed down to 5 Hz, or without an equaliser, need not be here.
    refused = replace(driven, limb="lab-2")
    designs = [slow, quick, driven, refused, replace(slow, limb="lab-2"), refused, slow]
    table = ss.sweep(designs)
    assert list(table.failed) == [4, 6]
    assert all("leaves a velocity" in reason for reason in table.failed.values())
    for row, design in enumerate(designs):
        if row + 1 not in table.failed:
            alone = ss.sweep(design)
            for name in ("rms", "peak", "drive_rms", "share_outside_band", "duration_s"):
                assert table.column(name)[row] == alone.column(name)[0]
