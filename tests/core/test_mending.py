"""An input that cannot be played: what is offered lets it be played, or leaves it out."""

import pytest

import skinsource as ss
from skinsource.design.design import View
from skinsource.design.edits.setup import mends
from skinsource.design.presets.presets import read_preset, shipped_folder

COIL = ss.ActuatorAt(actuator="Coil", model=ss.actuators.load("kastor-2023-air"))
EQUALISED = ss.Actuation(actuators=(COIL,), equaliser=ss.equalising.RegularisedInverse())
LAST = ["Mute it", "Predict without the actuator"]


def preset(name):
    lanes = read_preset(shipped_folder() / f"{name}.skinpreset").fragment.lanes
    return ss.Input(location=6, clips=lanes[0].clips)


@pytest.mark.parametrize(
    ("track", "labels"),
    [
        (ss.track(6, ss.waveforms.Tap()), ["Use a centred tap", *LAST]),
        (preset("tick-train"), ["Limit to the band", *LAST]),
        (preset("heartbeat"), ["Fade in and out", *LAST]),
        (preset("click"), ["Balance the samples", *LAST]),
        (ss.track(6, ss.waveforms.Chirplet(600.0)), ["Mute it"]),
        (ss.track(25), ["Mute it"]),
    ],
)
def test_each_mend_lets_the_design_be_predicted(track, labels):
    tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    design = ss.Design(limb="synthetic-1", inputs=(tone, track), actuation=EQUALISED)
    found = mends(design, View(), 2)
    assert [edit.label for edit in found] == labels
    for edit in found:
        assert edit.design.inputs[0] == design.inputs[0]
        assert ss.evaluate(edit.design, "unplayable_inputs")["unplayable_inputs"] == ()


def test_where_no_actuator_is_the_clips_stay():
    one_place = ss.Actuation(actuators=(ss.ActuatorAt(place=7, model=COIL.model),))
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(8),), actuation=one_place)
    assert [edit.label for edit in mends(design, View(), 1)] == LAST
