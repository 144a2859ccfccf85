"""Amplitudes on a limb whose responses answer a drive of which nobody says the unit."""

import json
from dataclasses import replace

import pytest

import skinsource as ss
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.base.errors import InvalidInputError
from skinsource.design.amplitudes import (
    amplitude_meaning,
    amplitude_spec,
    amplitude_unit,
    drive_unit,
)
from skinsource.design.design import View
from skinsource.export.exported_design import describe_played
from skinsource.export.tables import export_traces
from skinsource.limbs.own_limbs import drive_unit_known, facts_of, remove_limb
from skinsource.limbs.scaling import SCALINGS
from tests.core.own_limbs.lab_bench import installed

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.05)
PUBLISHED = ss.Design(limb="synthetic-1", inputs=(ss.track(2, TONE, amplitude=0.5),))
LAB = replace(PUBLISHED, limb="lab-1")
COIL = ss.ActuatorAt(model=ss.actuators.load("example-voice-coil"))


def units(design):
    return [amplitude_unit(replace(design, scaling=scaling)) for scaling in SCALINGS]


def driven(design):
    return [drive_unit(replace(design, scaling=scaling)) for scaling in SCALINGS]


@pytest.fixture
def probe_limb(user_data):
    return installed(per_unit_drive=False)


def test_only_where_the_drive_is_the_amplitude_its_unit_is_not_known(lab):
    assert facts_of("lab-1").per_unit_drive
    assert not drive_unit_known("lab-1")
    assert units(LAB) == ["m/s²", "×", "a.u."]
    assert driven(LAB) == ["1", "a.u.", "a.u."]
    spec = amplitude_spec(LAB)
    assert spec.unit == "a.u."
    assert "unit of the drive of this limb" in spec.hint
    assert "probe" not in spec.hint
    relative = amplitude_meaning(replace(LAB, scaling="relative"))
    assert "one unit of the drive" in relative
    assert "pulse" not in relative
    upstream = replace(LAB, scaling="upstream")
    assert amplitude_meaning(upstream) == amplitude_meaning(replace(upstream, limb="synthetic-1"))


def test_a_limb_that_answers_the_probe_is_told_of_as_the_published_ones(probe_limb):
    assert drive_unit_known("lab-1")
    for scaling in SCALINGS:
        lab, published = (replace(design, scaling=scaling) for design in (LAB, PUBLISHED))
        for say in (amplitude_unit, amplitude_meaning, drive_unit, amplitude_spec):
            assert say(lab) == say(published)
    assert units(PUBLISHED) == ["m/s²", "×", "m/s²"]
    assert driven(PUBLISHED) == ["1", "measuring pulse", "m/s²"]


def test_of_a_limb_that_is_not_here_or_is_another_one_the_unit_is_not_known_either(probe_limb):
    here = replace(LAB, limb_digest=facts_of("lab-1").digest)
    assert amplitude_unit(here) == "m/s²"
    assert amplitude_unit(replace(here, limb_digest="0" * 64)) == "a.u."
    remove_limb("lab-1")
    assert units(here) == ["m/s²", "×", "a.u."]
    assert amplitude_unit(replace(LAB, limb="")) == "m/s²"


def test_actuators_are_asked_for_volts_or_accelerations_whatever_the_limb_answers(lab):
    volts = replace(LAB, actuation=ss.Actuation(actuators=(COIL,)))
    asked = ss.Actuation(actuators=(COIL,), equaliser=RegularisedInverse())
    accelerations = replace(LAB, actuation=asked)
    assert (amplitude_unit(volts), drive_unit(volts)) == ("V", "V")
    assert (amplitude_unit(accelerations), drive_unit(accelerations)) == ("m/s²", "m/s²")
    assert amplitude_meaning(accelerations) == "Acceleration at the contactor"
    for design, said in ((volts, "voltage at the actuator, V"), (accelerations, "m/s²")):
        table = describe_played(LAB.limb, "", design.scaling, (), design.actuated)
        assert any(line.startswith("amplitudes: ") and said in line for line in table)
    off = replace(LAB, actuation=replace(asked, on=False))
    assert amplitude_unit(off) == "a.u."


def test_no_equaliser_takes_a_drive_of_unknown_unit_for_accelerations(lab, tmp_path):
    path, options = tmp_path / "lab.wav", {"equaliser": RegularisedInverse()}
    asked = ss.Actuation(actuators=(COIL,), equaliser=RegularisedInverse())
    rig = ss.rigs.Rig(
        channels=(ss.rigs.RigChannel(place=2, output=1, actuator="example-voice-coil"),)
    )
    with pytest.raises(
        InvalidInputError, match="the drive of this limb has an unknown unit"
    ) as refused:
        ss.export_stimulus(LAB, path, rig=rig, **options)
    assert "scaling" not in str(refused.value)
    ss.export_stimulus(replace(LAB, actuation=asked), path, **options)
    assert path.exists()


def exported(path, design, format):
    ss.export_stimulus(design, path, format=format)
    return json.loads(path.with_name(f"{path.name}.json").read_text())


@pytest.mark.parametrize("answers_drive", [True, False])
def test_what_is_exported_says_it_in_every_file(user_data, tmp_path, answers_drive):
    installed(per_unit_drive=answers_drive)
    path = tmp_path / "stim.h"
    facts = exported(path, LAB, "c-header")
    unit = "a.u." if answers_drive else "m/s²"
    assert facts["unit"] == facts["channels"][0]["unit"] == unit
    assert ("of the probe in m/s²" in facts["scaling_means"]) is not answers_drive
    assert ("unit of the drive" in facts["scaling_means"]) is answers_drive
    header = path.read_text()
    assert ("it stands for 0.5 a.u.\n" in header) is answers_drive
    export_traces(tmp_path / "traces.csv", LAB, View(axes="xz", outputs=(3,)))
    table = (tmp_path / "traces.csv").read_text()
    assert ("# amplitudes: in the unit of the drive" in table) is answers_drive
    html = LAB._repr_html_()
    assert (f"0.5 {unit}" in html, "m/s²" in html) == (True, not answers_drive)
