"""Wavelets, tracks and snapshots that are made alike on the skin."""

import math
from dataclasses import replace

import numpy as np
import pytest

from skinsource import Clip, Design, Input, View, edits, load_limb, predict, rms, track
from skinsource.base.errors import Stopped
from skinsource.design.edits.edit import Refusal
from skinsource.design.effects.time import Reverse, Trim
from skinsource.design.waveforms import Tap, Tone, WaveletTrain
from skinsource.engine.levelling import MEASURE, track_levels_db, wavelet_levels_db
from skinsource.engine.quantities import new_graph, sources

LIMB = "synthetic-1"
TRAIN = WaveletTrain((60.0, 150.0, 400.0), slot_s=0.08)


def design_of(train, location=7, scaling="relative", **more):
    inputs = (track(location=location, waveform=train, **more),)
    return Design(limb=LIMB, inputs=inputs, scaling=scaling)


def levels_by_hand(train: WaveletTrain, location: int, scaling="relative") -> list[float]:
    """Each wavelet as the only one of a train, predicted from its samples, without the engine."""
    levels_db = []
    for j, frequency_hz in enumerate(train.frequencies_hz):
        gains_db = train.gains_db[j : j + 1]
        alone = WaveletTrain((frequency_hz,), train.cycles, family=train.family, gains_db=gains_db)
        # Trains give lower ones less, where energies are to be equal.
        drive = alone.samples(1300.0) * train.gains()[j] / alone.gains()[0]
        field = predict(load_limb(LIMB), [drive], [location], scaling=scaling)
        length = np.sqrt((field**2).sum(axis=1))
        levels_db.append(20 * math.log10(rms(length, "loudest", 1300.0).max()))
    return levels_db


@pytest.mark.parametrize(
    ("location", "scaling"), [(7, "relative"), (15, "relative"), (7, "probe"), (7, "upstream")]
)
@pytest.mark.parametrize(
    "train",
    [
        TRAIN,
        replace(TRAIN, equalise="energy"),
        replace(TRAIN, family="hann", gains_db=(-3.0, 2.0, 1.0)),
    ],
    ids=["gabor", "energy", "hann"],
)
def test_all_wavelets_arrive_alike_after_it(train, location, scaling):
    design = design_of(train, location, scaling, amplitude=-3.0, onset_s=0.1234)
    # All of a train is divided by one number, as with "upstream": alone, each would be by its own.
    scaling = scaling.replace("upstream", "relative")
    before = wavelet_levels_db(design, 1)
    plain = levels_by_hand(replace(train, gains_db=()), location, scaling)
    # Where a wavelet lies between samples changes its loudest 100 ms a little.
    np.testing.assert_allclose(
        np.subtract(before, before[0]), np.subtract(plain, plain[0]), atol=0.05
    )
    edit = edits.equalise_on_skin(design, View(), 1, before, MEASURE)
    after = edit.design.clip(1).waveform
    levels = levels_by_hand(after, location, scaling)
    assert max(levels) - min(levels) < 0.05 < max(plain) - min(plain)
    assert max(after.gains_db) == 0.0
    assert replace(after, gains_db=()) == replace(train, gains_db=())


def test_levels_do_not_depend_on_what_else_there_is():
    plain = wavelet_levels_db(design_of(TRAIN), 1)
    clips = (Clip(waveform=Tone(), muted=True), Clip(waveform=TRAIN, muted=True, gain=-0.01))
    other = Input(location=7, clips=clips, amplitude=7.0, muted=True)
    design = Design(limb=LIMB, inputs=(track(3, Tone(), solo=True), other), scaling="upstream")
    train = next(clip for clip in design.clips if isinstance(clip.waveform, WaveletTrain))
    assert wavelet_levels_db(design, train.id) == pytest.approx(plain, abs=1e-9)


def test_effects_and_the_gain_curve_of_the_track_count():
    plain = wavelet_levels_db(design_of(TRAIN), 1)
    quieter = replace(design_of(TRAIN).inputs[0], gain_curve=((0.0, 1.0), (0.07, 1.0), (0.09, 0.1)))
    levels_db = wavelet_levels_db(replace(design_of(TRAIN), inputs=(quieter,)), 1)
    assert levels_db[0] == pytest.approx(plain[0], abs=1.0)
    assert levels_db[2] == pytest.approx(plain[2] - 20.0, abs=0.1)
    turned = Input(location=7, clips=(Clip(waveform=TRAIN, effects=(Reverse(),)),))
    levels_db = wavelet_levels_db(replace(design_of(TRAIN), inputs=(turned,)), 1)
    assert levels_db == pytest.approx(plain, abs=0.5)


def test_others_are_not_made_as_silent_as_a_wavelet_that_is_cut_away():
    clips = (Clip(waveform=TRAIN, effects=(Trim(start_s=2 * TRAIN.slot_s, duration_s=0.1),)),)
    design = Design(limb=LIMB, inputs=(Input(location=7, clips=clips),))
    outcome = edits.equalise_on_skin(design, View(), 1, wavelet_levels_db(design, 1), MEASURE)
    assert isinstance(outcome, Refusal)
    assert "hardly moves the skin" in outcome.sentence


@pytest.mark.parametrize("scaling", ["probe", "relative", "upstream"])
def test_tracks_that_are_matched_are_equally_strong_alone_on_the_skin(scaling):
    inputs = (
        track(7, Tone(60.0), amplitude=0.3),
        track(15, TRAIN, amplitude=-2.0, muted=True),
        track(3, Tone(200.0), amplitude=1.5, onset_s=0.1),
    )
    design = Design(limb=LIMB, inputs=inputs, scaling=scaling)
    before = track_levels_db(design, (1, 2, 3))
    assert max(before.values()) - min(before.values()) > 3.0
    done = edits.match_tracks(design, View(selected_inputs=(1, 3, 2)), before)
    amplitudes = [track.amplitude for track in done.design.inputs]
    # The one that was selected last stays, and so do signs.
    assert amplitudes[1] == -2.0
    assert min(amplitudes[0], amplitudes[2]) > 0.0
    after = track_levels_db(done.design, (1, 2, 3))
    assert max(after.values()) - min(after.values()) < 0.01
    assert done.label == "Match levels of 3 inputs"


def test_a_track_that_moves_nothing_is_not_matched():
    design = Design(limb=LIMB, inputs=(track(7, Tone()), track(3, Tone(), amplitude=0.0)))
    outcome = edits.match_tracks(design, View(), track_levels_db(design, design.ids))
    assert isinstance(outcome, Refusal)
    assert "3 (" in outcome.sentence


@pytest.mark.parametrize(
    ("design", "clip_id", "levels_db", "message"),
    [
        (design_of(TRAIN), 9, (0.0, 0.0, 0.0), "no clip has the id 9"),
        (design_of(Tone()), 1, (0.0,), "no longer plays that wavelet train"),
        (design_of(TRAIN), 1, (0.0, 0.0), "no longer plays that wavelet train"),
        (design_of(TRAIN), 1, (0.0, -math.inf, 0.0), "150 Hz hardly moves"),
        (design_of(TRAIN), 1, (0.0, 0.0, -61.0), "400 Hz hardly moves"),
        (design_of(TRAIN), 1, (math.nan, 0.0, 0.0), "hardly moves"),
    ],
)
def test_what_cannot_be_equalised_is_refused_in_words(design, clip_id, levels_db, message):
    outcome = edits.equalise_on_skin(design, View(), clip_id, levels_db, MEASURE)
    assert isinstance(outcome, Refusal)
    assert message in outcome.sentence


def test_it_tells_how_far_it_is_and_can_be_stopped():
    progress = []
    wavelet_levels_db(design_of(TRAIN), 1, progress=lambda *step: progress.append(step))
    assert [step[:2] for step in progress] == [(1, 3), (2, 3), (3, 3)]
    with pytest.raises(Stopped):
        wavelet_levels_db(design_of(TRAIN), 1, stop=lambda: True)


GAIN = 0.3
DESIGN = Design(
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=100.0)),
        track(location=18, waveform=Tap(), onset_s=0.1, amplitude=-2.0),
    ),
)
VIEW = View(outputs=(29, 52))
SCALED = ("output_rms", "selected_traces", "axis_spectra", "axis_traces")
NOT_SCALED = ("input_waveforms", "place_drives", "contact_weighted_rms", "validity")


def values_of(names, gain=1.0, view=VIEW, graph=None):
    graph = graph or new_graph()
    return graph.evaluate(names, sources(DESIGN, view, match_gain=gain))


def flat(value):
    """All numbers in nested tuples of arrays, one after another."""
    if isinstance(value, tuple):
        return np.concatenate([flat(part) for part in value])
    return np.ravel(np.asarray(value, float))


@pytest.mark.parametrize("selected", [(), (1,), (2,)])
def test_all_that_the_skin_does_has_the_gain(selected):
    view = replace(VIEW, selected_inputs=selected)
    as_stored, scaled = values_of(SCALED, view=view), values_of(SCALED, GAIN, view=view)
    for name in SCALED:
        expected = GAIN * as_stored[name]
        least = 1e-13 * np.abs(expected).max()
        np.testing.assert_allclose(scaled[name], expected, rtol=1e-12, atol=least)


def test_no_drive_has_it_and_nothing_that_is_judged_by_drives():
    as_stored, scaled = values_of(NOT_SCALED), values_of(NOT_SCALED, GAIN)
    for name in NOT_SCALED[:-1]:
        np.testing.assert_array_equal(flat(scaled[name]), flat(as_stored[name]))
    assert scaled["validity"] == as_stored["validity"]


def test_what_is_too_long_to_be_transformed_at_once_has_it_too():
    late = replace(DESIGN.inputs[1], clips=(replace(DESIGN.inputs[1].clips[0], onset_s=60.0),))
    design = replace(DESIGN, inputs=(DESIGN.inputs[0], late))
    names = ("streamed", "output_rms", "selected_traces")
    stored, scaled = (
        new_graph().evaluate(names, sources(design, VIEW, match_gain=gain)) for gain in (1.0, GAIN)
    )
    assert stored["streamed"]
    for name in names[1:]:
        least = 1e-12 * np.abs(stored[name]).max()
        np.testing.assert_allclose(scaled[name], GAIN * stored[name], rtol=1e-9, atol=least)
