"""Motions: their laws hold exactly in the tracks that they write, and they are added to designs."""

import math
from dataclasses import replace
from itertools import groupby, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource import View, edits
from skinsource.base.errors import InvalidInputError
from skinsource.design import motions
from skinsource.design.design import MAX_INPUTS, Design, Input
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.waveforms import Saw, Square, Tap, Tone, Triangle
from tests.core.clips_bench import total

RATE_HZ = 48000.0
PATHS = st.lists(st.integers(1, 20), min_size=2, max_size=12).map(tuple)
#: No place follows itself.
LEGS = PATHS.filter(lambda path: all(a != b for a, b in pairwise(path)))
every_motion = pytest.mark.parametrize("kind", motions.MOTIONS)


def clips_in_time(motion: motions.Motion):
    """Place and clip of all clips, by their number in the label."""
    in_time = [(track.location, clip) for track in motion.tracks() for clip in track.clips]
    return sorted(in_time, key=lambda pair: int(pair[1].label.split()[-1].split("/")[0]))


@given(PATHS, st.floats(0.02, 0.5), st.floats(0.01, 1.0), st.integers(1, 9), st.floats(0.0, 100.0))
def test_bursts_are_evenly_spaced_along_the_path(path, burst_s, spacing_s, count, onset_s):
    waveform = Tone(200.0, duration_s=burst_s)
    common = {"path": path, "waveform": waveform, "onset_s": onset_s}
    spaced = {**common, "spacing_s": spacing_s}
    repeated = tuple(place for place in path for _ in range(count))
    for motion, places, step_s in (
        # Israr and Poupyrev 2011.
        (motions.ApparentMotion(**common), path, 0.32 * burst_s + 0.0473),
        (motions.Alternation(**spaced, rounds=count), path * count, spacing_s),
        (motions.TapSequence(**spaced, taps=count), repeated, spacing_s),
    ):
        in_time = clips_in_time(motion)
        assert tuple(place for place, _ in in_time) == places
        assert {(clip.waveform, clip.gain) for _, clip in in_time} == {(waveform, 1.0)}
        onsets_s = [clip.onset_s for _, clip in in_time]
        expected_s = onset_s + step_s * np.arange(len(onsets_s))
        np.testing.assert_allclose(onsets_s, expected_s, rtol=0, atol=1e-9)


@given(
    PATHS,
    st.sampled_from([Tone, Square, Saw, Triangle]),
    st.floats(5.0, 600.0),
    st.floats(0.001, 0.2),
    st.floats(0.5, 50.0),
    st.floats(-6.0, 6.0),
)
def test_a_travelling_phase_is_the_wave_delayed(
    path, kind, frequency_hz, distance_m, speed_m_s, phase
):
    waveform = kind(frequency_hz=frequency_hz, phase_rad=phase, duration_s=0.2, window="none")
    motion = motions.TravellingPhase(
        path=path, waveform=waveform, distance_m=distance_m, speed_m_s=speed_m_s
    )
    for k, (place, clip) in enumerate(clips_in_time(motion)):
        assert place == path[k]
        assert clip.onset_s == 0.0
        lag = 2 * math.pi * frequency_hz * k * distance_m / speed_m_s
        difference = clip.waveform.phase_rad - (phase - lag)
        assert math.remainder(difference, 2 * math.pi) == pytest.approx(0.0, abs=1e-9)
        assert replace(clip.waveform, phase_rad=phase) == waveform


@given(st.permutations(range(1, 21)), st.floats(0.0, 1.0), st.floats(0.0, 1000.0))
def test_the_energies_of_a_phantom_add_up_to_one(places, position, amplitude):
    path = tuple(places[:2])
    motion = motions.Phantom(path=path, position=position, amplitude=amplitude, onset_s=0.3)
    first, second = motion.tracks()
    assert (first.location, second.location) == path
    assert first.amplitude**2 + second.amplitude**2 == pytest.approx(amplitude**2, rel=1e-12)
    assert second.amplitude == pytest.approx(math.sqrt(position) * amplitude)
    (clip,), (other,) = first.clips, second.clips
    assert clip.onset_s == other.onset_s == 0.3
    assert clip.waveform == other.waveform == motion.waveform


def mixed(motion: motions.Motion) -> dict[int, np.ndarray]:
    """What each place of a motion plays from its beginning."""
    return {
        track.location: total(*track.clips, rate_hz=RATE_HZ, n_times=50_000)
        for track in motion.tracks()
    }


@settings(max_examples=30)
@given(
    LEGS.filter(lambda path: len(set(path)) == len(path)), st.floats(0.0, 1.0), st.integers(2, 20)
)
def test_the_energies_of_a_sweep_add_up_to_that_of_its_waveform_at_any_time(path, overlap, n):
    waveform = Square(50.0, duration_s=n / 50.0)
    plain = waveform.samples(RATE_HZ)
    places = mixed(motions.Sweep(path=path, waveform=waveform, overlap=overlap))
    energy = sum(np.square(place[: plain.size]) for place in places.values())
    np.testing.assert_allclose(energy, np.square(plain), rtol=0, atol=1e-6)


def test_a_sweep_is_at_each_place_in_its_time():
    motion = motions.Sweep(path=(1, 2, 3), waveform=Square(50.0, duration_s=0.8), overlap=0.5)
    plain = motion.waveform.samples(RATE_HZ)
    time_s = np.arange(plain.size) / RATE_HZ
    first, last = (np.pi / 2 * np.clip((time_s - at) / 0.2, 0.0, 1.0) for at in (0.1, 0.5))
    levels = {1: np.cos(first), 2: np.sin(first) * np.cos(last), 3: np.sin(last)}
    for place, samples in mixed(motion).items():
        expected = plain * levels[place]
        np.testing.assert_allclose(samples[: plain.size], expected, rtol=0, atol=1e-9)


@every_motion
def test_a_motion_has_a_track_for_each_place_and_later_it_is_the_same_later(kind):
    path = (3, 5) if kind is motions.Phantom else (3, 5, 3, 5, 7)
    early, late = kind(path=path).tracks(), kind(path=path, onset_s=7.25).tracks()
    assert [track.location for track in early] == list(dict.fromkeys(path))
    for track, other in zip(early, late, strict=True):
        for clip, later in zip(track.clips, other.clips, strict=True):
            assert later.onset_s == pytest.approx(clip.onset_s + 7.25, abs=1e-12)
            assert replace(later, onset_s=clip.onset_s) == clip


@pytest.mark.parametrize(
    ("kind", "changes"),
    [
        *((kind, {"path": bad}) for kind in motions.MOTIONS for bad in ((3,), (3, 0))),
        (motions.Phantom, {"path": (3, 3)}),
        (motions.Phantom, {"path": (3, 4, 5)}),
        (motions.Phantom, {"position": 1.01}),
        (motions.TravellingPhase, {"waveform": Tap()}),
        (motions.Sweep, {"path": (3, 4, 4)}),
    ],
)
def test_what_no_motion_can_do_is_named(kind, changes):
    with pytest.raises(InvalidInputError, match=rf"^{kind.__name__}\.{next(iter(changes))} "):
        kind(**changes)


@every_motion
def test_a_motion_is_added_beside_what_is_there_and_selected(kind):
    design = Design(limb="synthetic-1", inputs=(Input(location=7), Input(location=16)))
    outcome = edits.add_motion(design, View(selected_inputs=(1,)), kind())
    assert isinstance(outcome, Edit)
    assert outcome.design.inputs[:2] == design.inputs
    added = outcome.design.inputs[2:]
    assert outcome.view.selected_inputs == tuple(track.id for track in added)
    assert outcome.view.selected_clips == outcome.design.motions[-1].clips
    assert outcome.label == f"Add {kind.title.lower()} at {len(added)} places"
    for track, written in zip(added, kind().tracks(), strict=True):
        assert (track.location, track.amplitude) == (written.location, written.amplitude)
        assert [replace(clip, id=0) for clip in track.clips] == list(written.clips)
    assert len({track.colour for track in added}) == len(added)


def test_a_motion_that_does_not_fit_is_refused():
    full = Design(limb="synthetic-1", inputs=(Input(location=1),) * (MAX_INPUTS - 1))
    empty = Design(limb="synthetic-1")
    for design, motion, reason in (
        (full, motions.Phantom(), "at most 100 inputs"),
        (full, None, ""),
        (empty, motions.Alternation(onset_s=600.0), "onset_s"),
    ):
        outcome = edits.add_motion(design, View(), motion)
        assert isinstance(outcome, Refusal)
        assert reason in outcome.sentence


@given(PATHS, st.sampled_from(motions.MOTIONS))
def test_a_motion_can_follow_the_path_of_another(path, kind):
    leader = motions.ApparentMotion(path=path, amplitude=2.5, onset_s=1.5)
    follower = motions.with_path_of(kind(), leader)
    assert type(follower) is kind
    assert (follower.amplitude, follower.onset_s) == (2.5, 1.5)
    moving = tuple(place for place, _ in groupby(path))
    expected_path = {motions.Phantom: tuple(dict.fromkeys(path))[:2], motions.Sweep: moving}.get(
        kind, path
    )
    assert follower.path == (expected_path if len(expected_path) > 1 else kind().path)


@pytest.mark.parametrize(
    "text", ["16, 18, 20", "16 18 20", "16-18-20", " 16,18 ,20;", "16 → 18 → 20"]
)
def test_a_path_can_be_typed(text):
    assert motions.path_of(text) == (16, 18, 20)
    assert motions.path_of(" ,") == ()


@pytest.mark.parametrize("text", ["16, x", "1.5 2", "99999999 1", "２, 3", "16,, -a"])
def test_what_is_no_path_is_named(text):
    with pytest.raises(InvalidInputError, match="the path has"):
        motions.path_of(text)
