"""Predict through the actuator: drive, equaliser, actuator, skin."""

from dataclasses import replace

import numpy as np
import pytest
import scipy

import skinsource as ss
from skinsource import View, edits
from skinsource.actuators.actuation import transfers_of
from skinsource.base.errors import InvalidInputError
from skinsource.design.edits.edit import Edit
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.spectra import scaled_taps

RATE_HZ = 48_000
COIL = ss.actuators.load("example-voice-coil")
PIEZO = ss.actuators.load("example-piezo")
INVERSE = ss.equalising.RegularisedInverse()
POLES = ss.equalising.PolePairReplacement(*ss.equalising.resonance_of(COIL))
SEEN = View(outputs=(5, 20), axes="xyz")


def actuation(model=COIL, equaliser=None, **changes):
    actuator_at = ss.ActuatorAt(actuator="a coil", model=model)
    return ss.Actuation(actuators=(actuator_at,), equaliser=equaliser, **changes)


def design_of(*inputs, **changes):
    return ss.Design(limb="synthetic-1", inputs=inputs, **changes)


def tone(place=7, frequency_hz=100.0, **changes):
    wave = ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=0.3)
    return ss.track(place, wave, onset_s=0.1, **changes)


@pytest.mark.parametrize("equaliser", [None, INVERSE, POLES])
@pytest.mark.parametrize("model", [COIL, PIEZO])
def test_a_prediction_is_what_the_simulated_actuator_makes_of_the_exported_volts(model, equaliser):
    # Volts as they are exported, motion at 48 kHz by exact steps, and a plain convolution.
    design = design_of(tone())
    (drive,) = ss.stimulus_of(design, RATE_HZ).samples
    drive = np.pad(drive, (0, RATE_HZ // 2))
    if equaliser is None:
        volts = drive
    else:
        volts = ss.equalising.equalised(drive, RATE_HZ, model, equaliser)
    moved = ss.resample(model.simulate(volts, RATE_HZ, "first").acceleration, RATE_HZ, 1300)
    limb = ss.load_limb("synthetic-1")
    taps = scaled_taps(limb, 7, "probe")[[4, 19]]
    expected = scipy.signal.fftconvolve(taps, moved[np.newaxis, np.newaxis], axes=-1)
    through = replace(design, actuation=actuation(model, equaliser))
    values = ss.evaluate(through, "axis_traces", "response_time_s", view=SEEN)
    first = int(np.flatnonzero(values["response_time_s"] >= 0.0)[0])
    traces = values["axis_traces"][..., first:]
    n = min(traces.shape[-1], expected.shape[-1])
    error = np.abs(traces[..., :n] - expected[..., :n]).max() / np.abs(expected).max()
    assert values["response_time_s"][first] == 0.0
    # The actuator is simulated to 600 Hz, where straight lines between samples lose 0.005 dB.
    assert error < 1e-3


def test_spectra_and_levels_are_over_the_same_record_however_long_an_actuator_rings():
    names = ("selected_spectra", "selected_axis_spectra", "output_band_rms", "line_wave")
    lengths = ("record_samples", "response_samples", "output_rms", "output_levels_db")
    view, tops, rows = replace(SEEN, axes="z"), [], [4, 19]
    for through in (None, actuation(equaliser=INVERSE)):
        design = replace(design_of(tone()), actuation=through)
        values = ss.evaluate(design, *names, *lengths, view=view)
        _, lines = values["selected_spectra"]
        finer = values["response_samples"] / values["record_samples"]
        rms = np.sqrt(np.square(lines).sum(axis=-1) / 2.0 / finer)
        np.testing.assert_allclose(rms, values["output_rms"][rows], rtol=1e-4)
        np.testing.assert_allclose(values["selected_axis_spectra"][1][:, 2], lines)
        in_bands = np.linalg.norm(values["output_band_rms"][1][rows, 0], axis=-1)
        np.testing.assert_allclose(in_bands, rms, rtol=1e-4)
        levels_db = values["output_levels_db"][rows]
        np.testing.assert_allclose(values["line_wave"].wave.level_db, levels_db)
        tops.append(lines.max(axis=-1))
    assert finer > 2.0
    np.testing.assert_allclose(*tops, rtol=0.005)


def test_without_an_actuator_nothing_changes_by_a_bit_and_no_work_is_added():
    design = design_of(tone(), tone(3, 60.0))
    off = replace(design, actuation=actuation(equaliser=INVERSE, on=False))
    quantities = ("output_rms", "axis_traces", "trace_error")
    # The first graph reads the limb for all.
    reader, graph, other = new_graph(), new_graph(), new_graph()
    reader.evaluate(quantities, sources(design, SEEN))
    before = graph.evaluate(quantities, sources(design, SEEN))
    after = other.evaluate(quantities, sources(off, SEEN))
    for name in quantities[:2]:
        np.testing.assert_array_equal(before[name], after[name])
    assert graph.work == other.work
    assert graph.runs == other.runs


def test_a_changed_drive_through_an_actuator_costs_the_transforms_of_one_without():
    counted = []
    for through in (None, actuation(equaliser=INVERSE)):
        design = replace(design_of(tone(), tone(3, 60.0)), actuation=through)
        view, graph = View(outputs=(5,), selected_inputs=(1,)), new_graph()
        quantities = {"output_rms", "selected_traces", "selected_spectra"}
        graph.evaluate(quantities, sources(design, view))
        edited = design.with_clip(design.clips[0].id, waveform=ss.waveforms.Tone(frequency_hz=90.0))
        graph.evaluate(quantities, sources(edited, view))
        counted.append((graph.work.forward_transforms, graph.work.inverse_transforms))
    assert counted[0] == counted[1]


def test_a_long_design_through_an_actuator_is_the_sum_of_its_parts():
    # Block by block against at once.
    late = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.3), onset_s=20.0)
    through = actuation(equaliser=POLES)
    long = replace(design_of(tone(), late), actuation=through)
    short = replace(design_of(tone()), actuation=through)
    values = ss.evaluate(long, "axis_traces", "streamed", view=SEEN)
    alone = ss.evaluate(short, "axis_traces", "streamed", view=SEEN)
    assert values["streamed"]
    assert not alone["streamed"]
    n = alone["axis_traces"].shape[-1]
    peak = np.abs(alone["axis_traces"]).max()
    assert np.abs(values["axis_traces"][..., :n] - alone["axis_traces"]).max() < 1e-12 * peak


def test_predict_does_the_same_for_scripts(limb):
    design = replace(design_of(tone()), actuation=actuation(equaliser=INVERSE))
    values = ss.evaluate(design, "axis_traces", "response_time_s", view=SEEN)
    (drive,) = ss.stimulus_of(design).samples
    alone = ss.predict(limb, [drive], [7], scaling="probe", actuation=design.actuation)
    from_0 = values["axis_traces"][..., values["response_time_s"] >= 0.0]
    np.testing.assert_allclose(alone[[4, 19]], from_0, rtol=0.0, atol=1e-12 * np.abs(from_0).max())


def test_each_place_answers_through_its_own_actuator():
    own = (
        ss.ActuatorAt(place=7, actuator="a piezo", model=PIEZO),
        ss.ActuatorAt(actuator="a coil", model=COIL),
    )
    for place, model in ((7, PIEZO), (3, COIL)):
        both = replace(design_of(tone(place)), actuation=ss.Actuation(actuators=own))
        alone = replace(design_of(tone(place)), actuation=actuation(model))
        output_rms = ss.evaluate(both, "output_rms")["output_rms"]
        # What is left out of a response is as little as says nothing; how much, both decide.
        np.testing.assert_allclose(output_rms, ss.evaluate(alone, "output_rms")["output_rms"], 1e-5)


def test_a_place_without_an_actuator_is_refused_and_named():
    actuator_at = ss.ActuatorAt(place=3, actuator="a coil", model=COIL)
    design = replace(
        design_of(tone(7)), actuation=ss.Actuation(actuators=(actuator_at,), rig="bench")
    )
    with pytest.raises(InvalidInputError, match=r"Place 7 has no .* the rig bench.* or switch off"):
        ss.evaluate(design, "output_rms")
    # What is off needs not be switched off.
    not_through = replace(design.actuation, on=False)
    with pytest.raises(InvalidInputError, match=r"inputs, or choose another rig\.$"):
        not_through.at(7)


def test_a_drive_that_leaves_a_velocity_is_refused_through_an_equaliser_alone():
    tap = ss.track(13, ss.waveforms.Tap())
    refused = design_of(tap, actuation=actuation(equaliser=INVERSE))
    with pytest.raises(
        InvalidInputError, match=r"Input at place 13 cannot be played .*52 % .*Centred tap"
    ):
        ss.evaluate(refused, "output_rms")
    limb, samples = ss.load_limb("synthetic-1"), ss.tap()
    with pytest.raises(InvalidInputError, match="Centred tap"):
        ss.predict(limb, [samples], [13], scaling="probe", actuation=refused.actuation)
    for design in (
        replace(refused, actuation=actuation()),
        design_of(ss.track(13, ss.waveforms.CentredTap()), actuation=refused.actuation),
    ):
        assert ss.evaluate(design, "output_rms")["output_rms"].max() > 0.0


def test_an_actuator_that_rings_for_ever_is_refused():
    undamped = ss.actuators.VoiceCoil(8.0, 8e-4, 0.001, 1e-3, 0.0, 1200.0)
    with pytest.raises(InvalidInputError, match=r"rings for longer than 0\.5 s"):
        ss.evaluate(design_of(tone(), actuation=actuation(undamped)), "output_rms")


@pytest.mark.parametrize("name", ss.actuators.names())
@pytest.mark.parametrize("equaliser", [None, INVERSE, replace(INVERSE, phase="minimum")])
def test_all_shipped_actuators_can_be_predicted_through(name, equaliser):
    transfer = transfers_of(actuation(ss.actuators.load(name), equaliser), 1300.0)[None]
    assert 0 < transfer.lead <= 650
    assert transfer.samples.size <= 1300
    assert np.isfinite(transfer.samples).all()


@pytest.mark.parametrize(
    ("actuators", "message"),
    [
        ((), "empty"),
        ((ss.ActuatorAt(model=COIL), ss.ActuatorAt(model=PIEZO)), "all other places twice"),
        ((ss.ActuatorAt(place=3, model=COIL), ss.ActuatorAt(place=3, model=COIL)), "place 3 twice"),
    ],
)
def test_actuators_that_cannot_be_are_refused(actuators, message):
    with pytest.raises(InvalidInputError, match=message):
        ss.Actuation(actuators=actuators)


def test_switching_it_on_and_off_are_edits_that_remember():
    design, view = design_of(tone()), View()
    on = edits.predict_through(design, view, actuation())
    assert isinstance(on, Edit)
    assert (on.label, on.design.actuated) == ("Predict through the actuator", actuation())
    off = edits.predict_through(on.design, view, None)
    assert isinstance(off, Edit)
    assert off.label == "Predict without the actuator"
    assert off.design.actuated is None
    assert off.design.actuation == actuation(on=False)


def test_a_rig_brings_the_actuators_that_it_knows_and_is_kept_in_files(tmp_path):
    chosen = ss.Actuation(
        actuators=(ss.ActuatorAt(actuator="Coil", model=COIL),), equaliser=INVERSE, on=False
    )
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7),), actuation=chosen)
    known = ss.rigs.RigChannel(place=7, actuator="example-piezo", full_scale_v=2.0)
    rig = ss.rigs.Rig(title="Bench 3", channels=(known, replace(known, place=8, output=2)))
    wired = edits.choose_rig(design, SEEN, rig).design
    assert (wired.rig, wired.actuation.rig, wired.actuation.at(8).model) == (rig, "Bench 3", PIEZO)
    assert (wired.actuation.equaliser, wired.actuated) == (INVERSE, None)
    ss.save_design(tmp_path / "d.skinsource", wired)
    assert ss.open_design(tmp_path / "d.skinsource").design == wired
    removed = edits.choose_rig(wired, SEEN, None).design
    assert (removed.rig, removed.actuation) == (None, None)
    # A rig that does not say how its actuators move leaves the choice.
    blank = ss.rigs.Rig(channels=(ss.rigs.RigChannel(place=7),))
    assert edits.choose_rig(design, SEEN, blank).design == replace(design, rig=blank)


def test_the_actuators_of_a_rig_get_no_pole_pair_of_another_one():
    pair = ss.equalising.PolePairReplacement(*ss.equalising.resonance_of(COIL))
    coil = ss.Actuation(actuators=(ss.ActuatorAt(actuator="Coil", model=COIL),), equaliser=pair)
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7),), actuation=coil)
    piezo = ss.rigs.RigChannel(place=7, actuator="example-piezo")
    wired = edits.choose_rig(design, SEEN, ss.rigs.Rig(channels=(piezo,))).design
    assert wired.actuation.equaliser == INVERSE
    same = replace(piezo, model=COIL)
    wired = edits.choose_rig(design, SEEN, ss.rigs.Rig(channels=(same,))).design
    assert wired.actuation.equaliser == pair


def test_where_a_rig_says_the_actuators_others_are_refused_and_equalisers_are_not():
    known = ss.rigs.RigChannel(place=7, actuator="example-piezo", full_scale_v=2.0)
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7),))
    wired = edits.choose_rig(design, SEEN, ss.rigs.Rig(channels=(known,))).design
    coil = ss.Actuation(actuators=(ss.ActuatorAt(actuator="Coil", model=COIL),))
    for before in (wired, edits.choose_actuation(wired, SEEN, None).design):
        refusal = edits.choose_actuation(before, SEEN, coil)
        assert "Choose another rig, or none" in refusal.sentence
    equalised = replace(wired.actuation, equaliser=INVERSE)
    assert edits.choose_actuation(wired, SEEN, equalised).design.actuation.equaliser == INVERSE
    free = edits.choose_rig(wired, SEEN, None).design
    assert edits.choose_actuation(free, SEEN, coil).design.actuation.actuators == coil.actuators


def test_what_is_chosen_is_predicted_through_only_where_that_is_switched_on():
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7),))
    chosen = ss.Actuation(actuators=(ss.ActuatorAt(actuator="Coil", model=COIL),))
    off = edits.choose_actuation(design, SEEN, chosen).design
    assert off.actuation == replace(chosen, on=False)
    on = edits.predict_through(off, SEEN, chosen).design
    changed = edits.choose_actuation(on, SEEN, replace(chosen, equaliser=INVERSE, on=False)).design
    assert changed.actuated == replace(chosen, equaliser=INVERSE)


def test_a_step_says_whether_actuator_or_equaliser_was_changed():
    coil = ss.Actuation(actuators=(ss.ActuatorAt(actuator="Coil", model=COIL),))
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7),), actuation=coil)
    piezo = ss.Actuation(actuators=(ss.ActuatorAt(actuator="Piezo", model=PIEZO),))
    steps = {replace(coil, equaliser=INVERSE): "equaliser", piezo: "actuator"}
    for changed, what in steps.items():
        assert edits.choose_actuation(design, SEEN, changed).label == f"Change the {what}"


def test_scripts_get_the_demand_at_the_input_that_the_view_selects():
    tone = ss.waveforms.Tone(frequency_hz=100.0)
    inputs = (ss.track(7, tone, amplitude=0.5), ss.track(13, tone, amplitude=2.0))
    coil = ss.ActuatorAt(model=ss.actuators.load("example-voice-coil"))
    design = ss.Design(limb="synthetic-1", inputs=inputs, actuation=ss.Actuation(actuators=(coil,)))
    for selected, place, peak_v in (((1,), 7, 0.5), ((2,), 13, 2.0), ((), 7, 0.5)):
        view = ss.View(selected_inputs=selected)
        values = ss.evaluate(design, "actuator_demand", "transfer_place", view=view)
        assert values["transfer_place"] == values["actuator_demand"].place == place
        assert values["actuator_demand"].figures.peak_voltage_v == pytest.approx(peak_v, rel=1e-3)
