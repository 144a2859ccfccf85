"""Inputs that cannot be played: an error in scripts and files, left out or mended in the studio."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource import Actuation, ActuatorAt, Clip, Design, Input, View, track
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.base.errors import InvalidInputError
from skinsource.design.edits.setup import mends
from skinsource.design.presets.presets import read_preset, shipped_folder
from skinsource.design.signal_path import unplayable_text
from skinsource.design.waveforms import Chirplet, Tap, Tone
from skinsource.engine.quantities import new_graph, sources
from skinsource.export.tables import export_levels

TONE = track(7, Tone(frequency_hz=100.0))
COIL = ActuatorAt(actuator="Coil", model=ss.actuators.load("kastor-2023-air"))
EQUALISED = Actuation(actuators=(COIL,), equaliser=RegularisedInverse())
BEYOND_HALF_THE_RATE = Chirplet(600.0)
UNPLAYABLE = {
    "cannot be sampled": (track(8, BEYOND_HALF_THE_RATE), None),
    "leaves a velocity": (track(8, Tap()), EQUALISED),
    "no such place": (track(25), None),
    "no actuator there": (track(8), Actuation(actuators=(replace(COIL, place=7),))),
}
SHOWN = ("output_levels_db", "selected_traces", "selected_spectra", "validity", "actuator_demand")


def design_of(bad, actuation):
    return Design(limb="synthetic-1", inputs=(TONE, bad), actuation=actuation)


def shown(design, *, edited=1, leave_out=True):
    """What the studio shows."""
    given = sources(design, View(selected_inputs=(edited,)), leave_out_unplayable=leave_out)
    return new_graph().evaluate((*SHOWN, "unplayable_inputs", "input_waveforms"), given)


@pytest.fixture(params=UNPLAYABLE)
def design(request):
    return design_of(*UNPLAYABLE[request.param])


@pytest.mark.parametrize("edited", [1, 2])
def test_the_others_are_predicted_as_if_it_were_muted(design, edited):
    values = shown(design, edited=edited)
    muted = shown(design.with_input(1, muted=True), edited=edited, leave_out=False)
    assert np.array_equal(values["output_levels_db"], muted["output_levels_db"])
    assert np.array_equal(values["selected_traces"], muted["selected_traces"])
    assert np.isfinite(values["output_levels_db"]).all()
    assert muted["unplayable_inputs"] == ()


def test_further_ones_are_named_by_their_places(design):
    design = replace(design, inputs=(*design.inputs, track(30), track(25), track(30)))
    text = unplayable_text(shown(design)["unplayable_inputs"])
    assert text.endswith("; 3 more inputs cannot be played either, at 25, 30.")


def test_it_is_named_with_the_reason_in_one_sentence(design):
    (unplayable,) = shown(design)["unplayable_inputs"]
    assert unplayable.id == 2
    assert str(design.inputs[1].location) in unplayable.sentence
    assert unplayable.sentence.count(". ") == 0
    with pytest.raises(InvalidInputError) as error:
        ss.evaluate(design, "output_levels_db")
    assert str(error.value) == unplayable.problem


def test_what_is_taken_from_the_prediction_says_what_it_is_without(design):
    (first, *_) = shown(design)["validity"]
    (unplayable,) = shown(design)["unplayable_inputs"]
    assert (first.name, first.state) == ("inputs", "left")
    assert unplayable.sentence.removesuffix(".") in first.in_short


def test_files_are_not_written_without_it(design, tmp_path):
    with pytest.raises(InvalidInputError):
        export_levels(tmp_path / "levels.csv", design, View())
    assert list(tmp_path.iterdir()) == []


def test_the_actuator_panel_is_told_of_a_drive_that_cannot_be_followed():
    values = shown(design_of(*UNPLAYABLE["leaves a velocity"]), edited=2)
    assert values["actuator_demand"].place == 8
    assert values["actuator_demand"].leaves_velocity


def test_of_clips_that_cannot_be_sampled_there_are_no_pictures():
    clips = (Clip(), Clip(waveform=BEYOND_HALF_THE_RATE, muted=True))
    design = Design(limb="synthetic-1", inputs=(Input(location=7, clips=clips),))
    values = ss.evaluate(design, "clip_waveforms", "output_levels_db")
    ((good, bad),) = values["clip_waveforms"]
    assert good.size
    assert bad is None
    assert np.isfinite(values["output_levels_db"]).all()


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
