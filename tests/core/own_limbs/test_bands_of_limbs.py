"""The band and the unit of the drive, said by a lab or not: everything asks the limb."""

import json
from dataclasses import replace

import h5py
import numpy as np
import pytest

import skinsource as ss
from skinsource import Design, View, edits, stimulus_of, track
from skinsource.actuators.equalising import PolePairReplacement, RegularisedInverse, followed_band
from skinsource.base.errors import InvalidInputError, RecordingError
from skinsource.design.amplitudes import (
    amplitude_meaning,
    amplitude_spec,
    amplitude_unit,
    drive_unit,
)
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.evaluation import Evaluator
from skinsource.export.exported_design import describe_played
from skinsource.export.tables import export_traces
from skinsource.limbs.limb_import import LimbSource, import_limb
from skinsource.limbs.limb_layout import export_limb
from skinsource.limbs.own_limbs import drive_unit_known, facts_of, remove_limb
from skinsource.limbs.scaling import SCALINGS
from tests.core.own_limbs.lab_bench import installed, own_limb
from tests.core.own_limbs.mutants import whole_file

BAND = (40.0, 1500.0)
# Half of what plays lies at 1 kHz: outside of the published band, inside of this one.
PLAYED = Design(
    limb="lab-1",
    inputs=(
        track(1, Tone(frequency_hz=100.0, duration_s=0.2)),
        track(2, Tone(frequency_hz=1000.0, duration_s=0.2)),
    ),
)


def lamp(design, name="band"):
    findings = Evaluator().evaluate(design, ("validity",))["validity"]
    return next(finding for finding in findings if finding.name == name)


def test_the_band_is_kept_exported_and_part_of_the_digest(user_data, tmp_path):
    installed()
    silent = facts_of("lab-1").digest
    assert facts_of("lab-1").band_hz is None
    assert ss.load_limb("lab-1").band_hz is None
    installed(band_hz=BAND)
    facts = facts_of("lab-1")
    assert facts.band_hz == ss.load_limb("lab-1").band_hz == BAND
    assert facts.digest != silent
    assert facts.sentence.endswith("4000 Hz, measured from 40 to 1500 Hz.")
    export_limb("lab-1", tmp_path / "lab.h5")
    again = import_limb(LimbSource(responses=tmp_path / "lab.h5", values={"name": "copy"}))
    assert (again.band_hz, again.digest) == (BAND, facts.digest)


@pytest.mark.parametrize("band", [(600.0, 25.0), (0.0, 2001.0), (-1.0, 5.0), (5.0,), (np.nan, 9.0)])
def test_a_band_that_is_none_is_refused(band):
    with pytest.raises(InvalidInputError, match="band_hz"):
        own_limb(band_hz=band)
    assert own_limb(band_hz=(0, 2000)).band_hz == (0.0, 2000.0)


def test_a_file_that_says_a_band_wrongly_is_refused_by_name(user_data, tmp_path):
    path = whole_file(tmp_path / "bad.h5")
    with h5py.File(path, "r+") as file:
        file.attrs["band_hz"] = "all"
    with pytest.raises(RecordingError, match="'band_hz' is 'all', expected two frequencies"):
        import_limb(LimbSource(responses=path))


def test_what_plays_is_judged_mended_drawn_and_written_in_the_band_of_the_limb(user_data):
    installed(band_hz=BAND)
    assert lamp(PLAYED).state == "kept"
    low = PLAYED.with_clip(PLAYED.inputs[0].clips[0].id, waveform=Tone(frequency_hz=10.0))
    assert lamp(low).state == "left"
    assert "40 to 1500 Hz" in lamp(low).sentence
    (limit,) = edits.mend(low, View(), lamp(low)).design.inputs[0].clips[0].effects
    assert (limit.low_hz, limit.high_hz) == BAND
    bound = edits.bound_clip(low, View(), low.inputs[0].clips[0].id, 4000.0)
    assert bound.design.inputs[0].clips[0].effects == (limit,)
    assert stimulus_of(PLAYED).band_hz == BAND
    # Its outputs stand elsewhere than those of the published limbs.
    assert lamp(PLAYED, "spacing").state == "unknown"
    published = Design(limb="synthetic-1", inputs=PLAYED.inputs[:1])
    assert lamp(published, "spacing").state == "kept"
    installed()
    assert lamp(low).state == "unknown"
    refused = edits.bound_clip(low, View(), low.inputs[0].clips[0].id, 4000.0)
    assert "is unknown; import it with its band" in refused.sentence
    assert stimulus_of(PLAYED).band_hz == (0.0, pytest.approx(2000.0 * 12 / 13))
    # At a higher rate there is no more to follow.
    for rate_hz, top_hz in ((None, 2000.0), (48_000, 2000.0), (1000, 500.0)):
        played = stimulus_of(PLAYED, rate_hz)
        lower_hz = min(played.sample_rate_hz, played.own_rate_hz)
        assert followed_band(played.limb_band_hz, lower_hz) == (
            25.0,
            pytest.approx(top_hz * 12 / 13),
        )


def test_a_velocity_is_told_from_where_the_limb_was_measured(user_data):
    # 3 m/s² at 10 Hz are 48 mm/s.
    slow = Tone(frequency_hz=10.0, duration_s=1.0)
    design = Design(limb="lab-1", inputs=(track(1, slow, amplitude=3.0),), scaling="probe")
    for band, lowest_hz in (((5.0, 1500.0), 5), (None, 25), ((0.0, 1500.0), 25), ((0.1, 9.0), 1)):
        installed(band_hz=band, per_unit_drive=False)
        finding = lamp(design, "drive")
        assert f"from {lowest_hz} Hz on" in finding.sentence
        assert (finding.state == "left") == (lowest_hz < 10), band
        fastest = ss.evaluate(design, "fastest_probe_m_per_s")["fastest_probe_m_per_s"]
        assert f"velocity {1e3 * fastest:.3g} mm/s" in finding.sentence
    assert finding.factor == pytest.approx(0.04 / (3.0 / (2.0 * np.pi * 10.0)), rel=0.1)


@pytest.mark.parametrize(
    ("band", "followed"),
    [(BAND, BAND), (None, (25.0, 12 / 13 * 2000.0)), ((0.0, 50.0), (25.0, 50.0))],
)
def test_actuators_follow_drives_in_the_band_of_the_limb(user_data, band, followed):
    installed(band_hz=band)
    limb, coil = ss.load_limb("lab-1"), ss.actuators.load("example-voice-coil")
    for equaliser in (None, ss.equalising.RegularisedInverse(40.0)):
        through = ss.Actuation(
            actuators=(ss.ActuatorAt(place=None, actuator="coil", model=coil),), equaliser=equaliser
        )
        design = replace(PLAYED, scaling="probe", actuation=through)
        evaluated = Evaluator().evaluate(design, ("driven_limb",))["driven_limb"]
        shown_hz = np.array([followed[0], 30.0, 100.0, 1000.0, 1500.0, 1840.0])
        shown_hz = shown_hz[(shown_hz >= followed[0]) & (shown_hz <= followed[1])]
        taps, plain = evaluated.response_to(1)[4, 0], limb.response_to(1)[4, 0]
        later = np.arange(taps.size) - evaluated.lead_samples
        gain = spectrum_at(taps, later, shown_hz) / spectrum_at(plain, np.arange(90), shown_hz)
        # The equaliser makes the contactor do what is asked; without it the coil answers.
        expected = np.ones(shown_hz.size) if equaliser else coil.response(shown_hz)
        np.testing.assert_allclose(
            np.abs(gain), np.abs(expected) * abs(gain[0] / expected[0]), rtol=0.02
        )


def spectrum_at(samples, later, frequency_hz):
    return np.exp(-2j * np.pi * frequency_hz[:, None] * later / 4000.0) @ samples


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
    # With another pole pair the gain is 1 in the mean only.
    pair = replace(LAB, actuation=replace(asked, equaliser=PolePairReplacement()))
    meaning = "acceleration at the contactor, in the mean of the band"
    assert amplitude_meaning(pair).lower() == meaning
    table = describe_played(LAB.limb, "", pair.scaling, (), pair.actuated)
    assert f"amplitudes: {meaning}, m/s²" in table
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


def test_the_methods_text_names_the_axes_that_a_limb_has(user_data):
    installed()
    assert " (x, z, principal axis) reached " in ss.methods_text(LAB)
    assert " (x, z, principal axis) reached " in ss.methods_text(LAB, View(axes="y"))
    assert " (z) reached " in ss.methods_text(LAB, View(axes="z"))


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
