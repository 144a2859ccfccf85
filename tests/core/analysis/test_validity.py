"""Conditions of the measurement, found, told and mended; where figures begin and end."""

import json
import re
from dataclasses import replace
from unittest.mock import Mock

import numpy as np
import pytest

import skinsource as ss
from skinsource import View, edits, evaluate
from skinsource.base.job import never
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.engine.analysis_rules import line_wave, output_noise_rms
from skinsource.engine.moments import Projection
from skinsource.engine.quantities import new_graph, sources
from skinsource.export.stimulus_export import sidecar
from skinsource.export.stimulus_export.sidecar import about_validity
from skinsource.export.tables import export_levels
from skinsource.limbs import catalog
from skinsource.perception import validity
from skinsource.perception.validity import drive_findings
from skinsource.signals.analysis.wave_speed import travelling_wave

RATE = 1300.0


def tone(frequency_hz, amplitude=1.0, place=7, duration_s=0.5):
    waveform = ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=duration_s)
    return ss.track(place, waveform, amplitude=amplitude)


def findings_of(design, view=None):
    values = new_graph().evaluate({"validity"}, sources(design, view or View()))
    return {finding.name: finding for finding in values["validity"]}


def design_of(*inputs, **changes):
    return ss.Design(limb="synthetic-1", inputs=inputs, **changes)


def test_a_velocity_is_the_integral_of_the_acceleration():
    time = np.arange(1300) / RATE
    burst = np.exp(-(((time - 0.5) / 0.05) ** 2)) * np.sin(2 * np.pi * 90.0 * time) * 20.0
    fine = np.arange(0.0, 1.0, 1e-5)
    exact = np.exp(-(((fine - 0.5) / 0.05) ** 2)) * np.sin(2 * np.pi * 90.0 * fine) * 20.0
    velocity = np.cumsum(exact) * 1e-5
    expected = np.abs(velocity - velocity.mean()).max()
    assert validity.probe_velocity(burst, RATE) == pytest.approx(expected, rel=0.02)


def test_what_rings_past_the_end_does_not_come_back_at_the_start():
    pulse = np.sin(np.pi * np.arange(130) / 130)
    silence = np.zeros(2600)
    padded = np.concatenate((silence, pulse, silence))
    for more in ((), (5.0,)):
        short, long = (validity.probe_velocity(samples, RATE, *more) for samples in (pulse, padded))
        assert short == pytest.approx(long, rel=1e-3)


def test_the_drive_lamp_is_lit_above_the_limit_and_mended_by_less_amplitude():
    design = design_of(tone(100.0, 30.0), tone(200.0, 10.0, place=8))
    finding = findings_of(design)["drive"]
    assert finding.state == "left"
    assert "mm/s" in finding.sentence
    assert finding.factor == pytest.approx(25.13 / 30.0, rel=0.01)
    edit = edits.mend(design, View(), finding)
    assert isinstance(edit, Edit)
    assert findings_of(edit.design)["drive"].state == "kept"
    ratio = edit.design.inputs[1].amplitude / edit.design.inputs[0].amplitude
    assert ratio == pytest.approx(10.0 / 30.0)


@pytest.mark.parametrize("scaling", ["relative", "upstream"])
def test_velocities_are_unknown_where_amplitudes_are_no_accelerations(scaling):
    design = design_of(tone(100.0, 500.0), scaling=scaling)
    finding = findings_of(design)["drive"]
    assert finding.state == "unknown"
    edit = edits.mend(design, View(), finding)
    assert edit.design.scaling == "probe"


def test_energy_outside_the_band_lights_a_lamp_and_a_band_limit_mends_it():
    tap = design_of(ss.track(7, ss.waveforms.Tap()))
    finding = findings_of(tap)["band"]
    assert finding.state == "left"
    # 52 % of the energy of the published tap is below 25 Hz.
    share = float(finding.sentence.split("%")[0])
    assert share == pytest.approx(52, abs=2)
    mended = edits.mend(design_of(tone(15.0, duration_s=1.0)), View(), finding)
    assert isinstance(mended, Edit)
    assert [type(x).__name__ for x in mended.design.clips[0].effects] == ["BandLimit"]
    assert findings_of(design_of(tone(100.0)))["band"].state == "kept"
    assert findings_of(design_of(tone(100.0), tone(15.0, place=8)))["band"].state == "left"
    muted = replace(tone(15.0, place=8), muted=True)
    assert findings_of(design_of(tone(100.0), muted))["band"].state == "kept"
    # What is not heard stays as it is.
    beside = edits.mend(design_of(tone(15.0), muted), View(), finding).design
    assert [len(each.clips[0].effects) for each in beside.inputs] == [1, 0]


def test_above_three_hundred_hertz_the_outputs_stand_too_far_apart():
    assert findings_of(design_of(tone(290.0)))["spacing"].state == "kept"
    high = findings_of(design_of(tone(350.0)))["spacing"]
    assert high.state == "left"
    assert high.repair == ""
    assert isinstance(edits.mend(design_of(tone(350.0)), View(), high), Refusal)


def test_outputs_below_six_decibels_are_told_and_can_be_deselected():
    above = np.full(72, 20.0)
    above[[0, 66, 67, 68, 71]] = 5.9
    above[4] = 6.0
    finding = validity.noise_findings(above, synthetic=False, silent=False)
    assert finding.state == "left"
    assert finding.outputs == (1, 67, 68, 69, 72)
    assert "5 of 72" in finding.sentence
    assert "1, 67 to 69 and 72" in finding.sentence
    # Maps of time windows hatch other ones.
    assert "over the whole record; the skin map hatches them" in finding.sentence
    view = View(outputs=(1, 5, 72))
    assert edits.mend(design_of(), view, finding).view.outputs == (5,)
    assert isinstance(edits.mend(design_of(), View(outputs=(5,)), finding), Refusal)
    quiet = validity.noise_findings(np.full(72, 6.0), synthetic=False, silent=False)
    assert (quiet.state, quiet.outputs) == ("kept", ())


def test_tables_carry_what_is_not_kept(tmp_path):
    path = tmp_path / "levels.csv"
    export_levels(path, design_of(tone(400.0, 10.0)), View())
    head = [line for line in path.read_text().splitlines() if line.startswith("#")]
    assert any("validity, spacing: CAUTION" in line for line in head)
    assert not any("validity, band" in line for line in head)
    assert any("RMS over the whole record (record), 0." in line for line in head)


def test_the_sidecar_of_a_stimulus_carries_the_conditions(tmp_path):
    path = tmp_path / "drive.wav"
    ss.export_stimulus(design_of(tone(400.0, 10.0)), path, "wav", 48000)
    sidecar = json.loads((tmp_path / "drive.wav.json").read_text())
    states = {each["condition"]: each["state"] for each in sidecar["validity"]}
    assert states["spacing"] == "left"
    assert sidecar["limb_note"] is None
    nowhere = {"limb_note": None, "validity": []}
    assert about_validity(replace(design_of(), limb="nobody")) == nowhere


def test_the_sidecar_of_a_stimulus_carries_the_note_on_the_limb(monkeypatch):
    limb = ss.load_limb("synthetic-1")
    limb.name, limb.note, limb.synthetic = "measured-1", "measured on a cold day", False
    monkeypatch.setattr(catalog, "load_synthetic_limb", lambda number: limb)
    assert about_validity(design_of())["limb_note"] == "measured on a cold day"
    assert findings_of(design_of())["limb"].sentence.endswith("measured on a cold day.")
    # A measure, of which a map has several.
    noise = validity.noise_findings(np.array([3.0, 9.0]), synthetic=False, silent=False)
    results = {"limb_data": limb, "validity": [noise]}
    monkeypatch.setattr(sidecar, "new_graph", lambda: Mock(evaluate=lambda *_, stop: results))
    assert "whole record, x, y, z" in about_validity(design_of())["validity"][0]["sentence"]


FAST = validity.Finding(name="drive", state="left", sentence="Fast, and more.", in_short="Fast.")
HALF, MOST = (
    validity.Finding(
        name="band", state="left", sentence="Some.", in_short="It is {:.0%} outside.", number=share
    )
    for share in (0.5, 0.9)
)
UNKNOWN = validity.Finding(name="noise", state="unknown", sentence="Nobody knows")
KEPT = validity.Finding(name="band", state="kept", sentence="Fine.")
NOTE = "made from other files"


def test_notes_and_what_is_not_kept_are_said_in_short_and_what_is_unknown_only_in_full():
    judged = validity.Judged(label="A", note=NOTE, findings=(FAST, UNKNOWN, KEPT))
    assert validity.in_short([judged]) == ("Made from other files.", "Fast.")
    assert validity.in_full([judged]) == (
        "NOTE on the limb: made from other files",
        "validity, drive: CAUTION: Fast, and more.",
        "validity, noise: unknown: Nobody knows",
    )
    assert validity.in_short([validity.Judged(label="A", findings=(KEPT,))]) == ()


def test_what_holds_for_several_is_said_once_with_who_they_are_and_for_all_without():
    several = [
        validity.Judged(label="A", note=NOTE, findings=(FAST,)),
        validity.Judged(label="B", findings=(FAST,)),
        validity.Judged(label="C", note=NOTE, findings=(FAST,)),
    ]
    assert validity.in_short(several) == ("A, C: Made from other files.", "Fast.")
    several[1] = validity.Judged(label="B", findings=(KEPT,))
    assert validity.in_short(several) == ("A, C: Made from other files.", "A, C: Fast.")


def test_numbers_that_differ_between_designs_are_a_range():
    several = [
        validity.Judged(label="A", findings=(MOST,)),
        validity.Judged(label="B", findings=(HALF,)),
    ]
    assert validity.in_short(several) == ("It is 50% to 90% outside.",)
    assert validity.in_short([*several, validity.Judged(label="C", findings=())]) == (
        "A, B: It is 50% to 90% outside.",
    )
    assert validity.in_short(several[:1]) == ("It is 90% outside.",)
    # A note may hold anything.
    assert validity.in_short([validity.Judged(label="A", note="a {:.0%} b", findings=())]) == (
        "A {:.0%} b.",
    )


@pytest.mark.parametrize("scaling", ["probe", "upstream"])
def test_each_condition_that_is_not_kept_has_short_words_and_no_other(scaling):
    waveforms = ss.waveforms.Tone(frequency_hz=400.0), ss.waveforms.Tone(frequency_hz=10.0)
    inputs = tuple(
        ss.track(place, waveform, amplitude=90.0) for place, waveform in enumerate(waveforms, 7)
    )
    design = ss.Design(limb="synthetic-1", scaling=scaling, inputs=inputs)
    findings = evaluate(design, "validity")["validity"]
    left = {finding.name for finding in findings if finding.state == "left"}
    assert left >= {"band", "spacing", "limb", "drive" if scaling == "probe" else "scaling"}
    for finding in findings:
        assert bool(finding.in_short) == (finding.state == "left")
        assert (finding.number is None) == ("{" not in finding.in_short)
        assert len(finding.in_short) <= 100
    short = " ".join(validity.in_short([validity.Judged(label="A", findings=findings)]))
    assert "{" not in short
    assert " of the energy lies above 300 Hz" in short


def test_short_words_hold_the_number_of_the_sentence():
    time_s = np.arange(1300) / 1300.0
    loud = 90.0 * np.sin(800.0 * np.pi * time_s) + 30.0 * np.sin(20.0 * np.pi * time_s)
    findings = [
        *validity.drive_findings([(7, loud)], 1300.0, "probe"),
        validity.noise_findings(np.array([3.0, 9.0, 9.0, 9.0]), synthetic=False, silent=False),
    ]
    with_number = [finding.name for finding in findings if finding.number is not None]
    assert with_number == ["band", "drive", "spacing", "noise"]
    for finding in findings:
        both = finding.in_short.format(finding.number), finding.sentence
        assert len({re.findall(r"\d[\d.]*%?", text)[0] for text in both}) == 1


LINE = (20, 22, 24, 26)


def tone_at(frequency_hz, amplitude=1.0, place=8, duration_s=1.0, **changes):
    waveform = ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=duration_s)
    return ss.track(place, waveform, amplitude=amplitude, **changes)


def sine(frequency_hz, amplitude=1.0):
    """A second of it: its spectrum lies within some hertz around its frequency."""
    wave = np.sin(2 * np.pi * frequency_hz * np.arange(1300) / RATE)
    return amplitude * wave * np.hanning(1300)


def lamp(name, *drives):
    findings = drive_findings(list(enumerate(drives, start=6)), RATE, "upstream")
    return next(finding for finding in findings if finding.name == name)


def test_a_point_of_another_shape_has_a_level_and_no_delay_that_counts():
    rng = np.random.default_rng(11)
    first = rng.normal(size=1300)
    later = [np.roll(first, 5 * k) for k in range(3)]
    signals = np.stack([*later, rng.normal(size=1300)])
    wave = travelling_wave(signals, np.array([0.0, 50.0, 100.0, 150.0]), RATE)
    assert wave.similarity[-1] < 0.5
    assert list(wave.timed) == [True, True, True, False]
    assert wave.counted.all()
    assert wave.speed_m_per_s == pytest.approx(0.05 / (5 / RATE), rel=0.02)


def test_points_of_a_line_count_from_six_decibels_above_the_noise():
    design = ss.Design(limb="synthetic-1", inputs=(tone_at(100.0, duration_s=0.1),))
    values = ss.evaluate(design, "vibration", "limb_data", "record_samples")
    above_db = np.full(72, 40.0)
    above_db[21], above_db[23] = 5.99, 6.0
    known = values["limb_data"], above_db, RATE, values["record_samples"]
    line = line_wave(values["vibration"], LINE, *known, never)
    assert list(line.wave.counted) == [True, False, True, True]


def test_a_wave_is_followed_along_z_whatever_axes_are_chosen():
    design = ss.Design(limb="synthetic-1", inputs=(tone_at(100.0, duration_s=0.1),))
    line_wave = ss.evaluate(design, "line_wave", view=View(outputs=LINE, axes="x"))["line_wave"]
    traces = ss.evaluate(design, "axis_traces", view=View(outputs=LINE, axes="xyz"))["axis_traces"]
    levels_db = 10.0 * np.log10(np.mean(traces[:, 2] ** 2, axis=-1))
    assert line_wave.axis == "z"
    assert line_wave.wave.level_db == pytest.approx(levels_db, abs=1e-9)


def test_delays_count_from_the_first_input_that_is_heard():
    audible, view = tone_at(120.0, duration_s=0.1, onset_s=0.3), View(outputs=(20,))
    muted, still = replace(tone_at(60.0, place=3), muted=True), tone_at(60.0, 0.0, place=4)
    alone, beside = (
        ss.evaluate(ss.Design(limb="synthetic-1", inputs=inputs), "output_statistics", view=view)
        for inputs in ((audible,), (muted, still, audible))
    )
    assert 0.04 < alone["output_statistics"].delay_s[0] < 0.08
    assert beside["output_statistics"].delay_s == pytest.approx(
        alone["output_statistics"].delay_s, abs=1e-6
    )


def test_noise_along_a_direction_is_that_of_independent_axes():
    direction = np.array([[0.6, 0.8, 0.0], [1.0, 0.0, 0.0]])
    energy = np.array([[4.0, 9.0, 16.0], [4.0, 9.0, 16.0]])
    noise_rms = output_noise_rms(energy, Projection((0, 1, 2), direction), 10)
    rng = np.random.default_rng(12)
    axes = rng.normal(size=(2, 3, 200_000)) * np.sqrt(energy / 10)[..., None]
    drawn = np.einsum("oa,oat->ot", direction, axes)
    assert noise_rms == pytest.approx(drawn.std(axis=-1), rel=0.01)


@pytest.mark.parametrize(("share", "state"), [(0.04, "kept"), (0.06, "left"), (0.15, "left")])
def test_a_twentieth_of_the_energy_may_lie_where_it_should_not(share, state):
    weights = np.sqrt(1.0 - share), np.sqrt(share)
    assert lamp("band", sine(100.0, weights[0]) + sine(10.0, weights[1])).state == state
    assert lamp("spacing", sine(100.0, weights[0]) + sine(400.0, weights[1])).state == state


def test_shares_of_several_drives_are_weighed_by_their_energy():
    loud, soft = sine(100.0, 10.0), sine(10.0, 1.0)
    assert lamp("band", loud, soft).state == "kept"
    assert lamp("band", sine(100.0, 1.0), sine(10.0, 10.0)).sentence.startswith("99%")
