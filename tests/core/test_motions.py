"""Motions: their laws hold exactly in the tracks that they write."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource.base.errors import InvalidInputError
from skinsource.design.effects.playing import placed, played
from skinsource.design.motions import (
    MOTIONS,
    Alternation,
    ApparentMotion,
    Motion,
    Phantom,
    Sweep,
    TapSequence,
    TravellingPhase,
)
from skinsource.design.waveforms.periodic import Saw, Square, Triangle
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.specs.models import specs_of
from tests.core.motions_bench import PATHS

RATE_HZ = 48000.0
#: No place follows itself.
LEGS = PATHS.filter(lambda path: all(a != b for a, b in pairwise(path)))
TIMES = st.floats(0.0, 100.0)
DURATIONS = st.floats(0.02, 0.5)


def clips_in_time(tracks):
    """Place and clip of all clips, by their number in the label."""
    in_time = [(track.location, clip) for track in tracks for clip in track.clips]
    return sorted(in_time, key=lambda pair: int(pair[1].label.split()[-1].split("/")[0]))


@given(PATHS, DURATIONS, TIMES)
def test_apparent_motion_keeps_its_onset_asynchrony(path, duration_s, onset_s):
    waveform = Tone(200.0, duration_s=duration_s)
    in_time = clips_in_time(ApparentMotion(path=path, waveform=waveform, onset_s=onset_s).tracks())
    assert tuple(place for place, _ in in_time) == path
    for k, (_, clip) in enumerate(in_time):
        assert clip.onset_s == pytest.approx(onset_s + k * (0.32 * duration_s + 0.0473), abs=1e-12)
        assert clip.waveform == waveform
        assert clip.gain == 1.0


def test_apparent_motion_of_known_bursts():
    """Israr and Poupyrev 2011: 0.32 d + 47.3 ms."""
    for burst_s, spacing_s in ((0.04, 0.0601), (0.1, 0.0793), (0.16, 0.0985)):
        motion = ApparentMotion(waveform=Tone(200.0, duration_s=burst_s))
        assert motion.spacing_s == pytest.approx(spacing_s, abs=1e-15)
    assert ApparentMotion().summary == (
        "3 bursts of 100 ms, one every 79.3 ms, 20.7 ms overlap; 258.6 ms in all"
    )


@given(PATHS, st.floats(0.01, 1.0), st.integers(1, 9), TIMES)
def test_alternation_takes_turns(path, spacing_s, rounds, onset_s):
    motion = Alternation(path=path, spacing_s=spacing_s, rounds=rounds, onset_s=onset_s)
    in_time = clips_in_time(motion.tracks())
    assert tuple(place for place, _ in in_time) == path * rounds
    onsets = [clip.onset_s for _, clip in in_time]
    np.testing.assert_allclose(onsets, onset_s + spacing_s * np.arange(len(onsets)), atol=1e-9)


@given(PATHS, st.floats(0.01, 0.5), st.integers(1, 9))
def test_taps_are_even_within_and_between_places(path, spacing_s, taps):
    motion = TapSequence(path=path, spacing_s=spacing_s, taps=taps)
    in_time = clips_in_time(motion.tracks())
    assert [place for place, _ in in_time] == [place for place in path for _ in range(taps)]
    onsets = [clip.onset_s for _, clip in in_time]
    np.testing.assert_allclose(onsets, spacing_s * np.arange(len(onsets)), atol=1e-9)
    assert all(clip.waveform == Tap() for _, clip in in_time)


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
    motion = TravellingPhase(
        path=path, waveform=waveform, distance_m=distance_m, speed_m_s=speed_m_s
    )
    for k, (place, clip) in enumerate(clips_in_time(motion.tracks())):
        assert place == path[k]
        assert clip.onset_s == 0.0
        lag = 2 * math.pi * frequency_hz * k * distance_m / speed_m_s
        difference = clip.waveform.phase_rad - (phase - lag)
        assert math.remainder(difference, 2 * math.pi) == pytest.approx(0.0, abs=1e-9)
        assert replace(clip.waveform, phase_rad=phase) == waveform


def test_a_wave_that_travels_arrives_distance_over_speed_later():
    motion = TravellingPhase(
        path=(1, 2, 3),
        waveform=Tone(100.0, duration_s=0.2, window="none"),
        distance_m=0.01,
        speed_m_s=4.0,
    )
    first, second, third = (
        clip.waveform.samples(RATE_HZ) for _, clip in clips_in_time(motion.tracks())
    )
    delay = round(0.01 / 4.0 * RATE_HZ)
    np.testing.assert_allclose(second[delay:], first[:-delay], rtol=0, atol=1e-12)
    np.testing.assert_allclose(third[2 * delay :], first[: -2 * delay], rtol=0, atol=1e-12)


@given(st.permutations(range(1, 21)), st.floats(0.0, 1.0), st.floats(0.0, 1000.0), TIMES)
def test_the_energies_of_a_phantom_add_up_to_one(places, position, amplitude, onset_s):
    path = tuple(places[:2])
    motion = Phantom(path=path, position=position, amplitude=amplitude, onset_s=onset_s)
    first, second = motion.tracks()
    assert (first.location, second.location) == path
    assert first.amplitude**2 + second.amplitude**2 == pytest.approx(amplitude**2, rel=1e-12)
    assert second.amplitude == pytest.approx(math.sqrt(position) * amplitude)
    (clip,), (other,) = first.clips, second.clips
    assert clip.onset_s == other.onset_s == onset_s
    assert clip.waveform == other.waveform == motion.waveform


def test_a_phantom_at_an_end_plays_there_alone():
    assert [track.amplitude for track in Phantom(position=0.0).tracks()] == [1.0, 0.0]
    assert [track.amplitude for track in Phantom(position=1.0).tracks()] == [0.0, 1.0]


def mixed(motion: Motion, sample_rate_hz: float) -> dict[int, np.ndarray]:
    """What each place of a motion plays from its beginning."""
    tracks = motion.tracks()
    n = round(max(clip.end_s for track in tracks for clip in track.clips) * sample_rate_hz) + 2
    totals = {}
    for track in tracks:
        total = totals.setdefault(track.location, np.zeros(n))
        for clip in track.clips:
            first, shift_s = placed(clip.waveform, clip.effects, clip.onset_s, sample_rate_hz)
            samples = played(clip.waveform, clip.effects, sample_rate_hz, shift_s)
            total[first : first + samples.size] += samples[: n - first]
    return totals


@given(LEGS, st.floats(0.0, 1.0), st.integers(2, 20))
def test_the_energies_of_a_sweep_add_up_to_that_of_its_waveform_at_any_time(path, overlap, n):
    waveform = Square(50.0, duration_s=n / 50.0)
    motion = Sweep(path=path, waveform=waveform, overlap=overlap)
    plain = waveform.samples(RATE_HZ)
    places = mixed(motion, RATE_HZ)
    if len(set(path)) == len(path):
        energy = sum(np.square(place[: plain.size]) for place in places.values())
        np.testing.assert_allclose(energy, np.square(plain), rtol=0, atol=1e-6)


def test_a_sweep_is_at_each_place_in_its_time():
    motion = Sweep(path=(1, 2, 3), waveform=Square(50.0, duration_s=0.8), overlap=0.5)
    places = mixed(motion, RATE_HZ)
    plain = motion.waveform.samples(RATE_HZ)
    beta = np.clip((np.arange(plain.size) / RATE_HZ - 0.1) / 0.2, 0.0, 1.0)
    first = plain * np.cos(np.pi / 2 * beta)
    np.testing.assert_allclose(places[1][: plain.size], first, rtol=0, atol=1e-9)
    last = np.clip((np.arange(plain.size) / RATE_HZ - 0.5) / 0.2, 0.0, 1.0)
    np.testing.assert_allclose(
        places[3][: plain.size], plain * np.sin(np.pi / 2 * last), rtol=0, atol=1e-9
    )
    middle = plain * np.sin(np.pi / 2 * beta) * np.cos(np.pi / 2 * last)
    np.testing.assert_allclose(places[2][: plain.size], middle, rtol=0, atol=1e-9)


def test_a_sweep_takes_any_waveform_and_no_place_twice_in_a_row():
    noise = Noise(3, 0.5, window="none")
    places = mixed(Sweep(path=(1, 2), waveform=noise, overlap=0.0), 1300.0)
    whole = noise.samples(1300.0)
    np.testing.assert_allclose(places[1][:650] + places[2][:650], whole, rtol=0, atol=1e-9)
    assert not places[2][:325].any()
    assert not places[1][325:].any()
    with pytest.raises(InvalidInputError, match=r"Sweep\.path goes from place 4 to 4"):
        Sweep(path=(3, 4, 4))


@pytest.mark.parametrize("kind", MOTIONS)
def test_a_motion_says_what_it_does_and_by_whose_law(kind):
    for text in (kind.title, kind.law, kind.source, kind.limits, kind().summary):
        assert len(text) >= 5
    assert kind.law.endswith(".")
    assert "palm" in kind.limits or "hand" in kind.limits
    assert isinstance(kind(), Motion)
    assert next(iter(specs_of(kind))) == "path"


@pytest.mark.parametrize("kind", MOTIONS)
def test_a_motion_later_is_the_same_later(kind):
    early, late = kind().tracks(), kind(onset_s=7.25).tracks()
    assert [track.location for track in early] == [track.location for track in late]
    for track, other in zip(early, late, strict=True):
        for clip, later in zip(track.clips, other.clips, strict=True):
            assert later.onset_s == pytest.approx(clip.onset_s + 7.25, abs=1e-12)
            assert replace(later, onset_s=clip.onset_s) == clip


@pytest.mark.parametrize("kind", MOTIONS)
def test_a_place_has_one_track(kind):
    path = (3, 5) if kind is Phantom else (3, 5, 3, 5, 7)
    tracks = kind(path=path).tracks()
    assert [track.location for track in tracks] == list(dict.fromkeys(path))
