from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import NothingToPlayOnError, PlaybackError, Stopped
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import SilentRun
from tests.core.playing.playing_bench import wait_for
from tests.core.playing.synthetic_sound import SyntheticSoundLibrary, use

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.5)
ONE = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE, amplitude=0.9),))
FADE = 240


def play(session, design=ONE, output=None, **changes):
    settings = {"loops": False, "at_s": 0.0, "gain_db": 0.0, **changes}
    return session.play(design, output or Output(), **settings)


def test_a_design_is_played_to_its_end(sound, session):
    playing = play(session)
    assert session.over.wait(20)
    assert playing.stream.queue.ending.reason == "end"
    expected = ss.stimulus_of(ONE, 48_000).samples[0].astype(np.float32)
    output = sound.streams[0].samples
    assert np.array_equal(output[0, FADE : FADE + expected.size], expected)
    assert not output[1].any()


def test_a_playhead_behind_the_end_or_outside_the_loop_starts_from_the_beginning(sound, session):
    looped = replace(ONE, loop_s=(0.2, 0.4))
    for design, at_s, expected in (
        (ONE, 0.25, 0.25), (ONE, 9.0, 0.0), (looped, 0.3, 0.3), (looped, 0.0, 0.2),
        (looped, 0.45, 0.2),
    ):  # fmt: skip
        queue = play(session, design, at_s=at_s).stream.queue
        swap, begun = queue.swap, queue.position
        begin = swap.at if swap is not None else begun
        assert begin >= round(expected * 48_000) - FADE
        assert begin < round((expected + 0.15) * 48_000)


def test_what_is_stopped_while_it_is_prepared_opens_no_device(sound, session):
    with pytest.raises(Stopped):
        play(session, stop=lambda: True)
    assert sound.streams == []


def test_an_edit_that_needs_more_outputs_opens_the_device_anew(sound, session):
    playing = play(session, output=Output(device="Eight"), loops=True)
    three = replace(ONE, inputs=tuple(ss.track(place, TONE) for place in (7, 8, 9)))
    changed = session.change(playing, three, Output(device="Eight"), loops=True)
    assert [stream.asked["channels"] for stream in sound.streams] == [2, 3]
    assert playing.stream.closed
    assert not changed.stream.closed


def test_more_places_than_outputs_are_refused_and_what_plays_goes_on(sound, session):
    playing = play(session, loops=True)
    three = replace(ONE, inputs=tuple(ss.track(place, TONE) for place in (7, 8, 9)))
    with pytest.raises(PlaybackError, match="Two has 2 outputs, and place 9 is assigned to output"):
        session.change(playing, three, Output(), loops=True)
    assert not playing.stream.closed
    with pytest.raises(PlaybackError, match="Two has 2 outputs"):
        play(session, three)
    muted = three.with_input(2, muted=True)
    assert play(session, muted, loops=True).stream is not None


def test_closing_falls_to_silence_first(sound, session):
    play(session, loops=True)
    stream = sound.streams[0]
    wait_for(lambda: stream.samples.shape[1] > 4000)
    session.close()
    output = stream.samples[0].astype(float)
    assert np.abs(np.diff(output)).max() < np.pi / 2 / 48
    assert output[-1] == 0.0


def test_a_tone_is_on_one_output_alone(sound, session):
    playing = session.tone(5, Output(device="Eight"), 0.0)
    assert session.over.wait(20)
    output = sound.streams[0].samples
    assert output.shape[0] == 5
    assert not output[:4].any()
    assert np.abs(output[4]).max() == pytest.approx(1.0, abs=1e-3)
    assert playing.stream.queue.ending.reason == "end"
    with pytest.raises(PlaybackError, match="Two has 2 outputs"):
        session.tone(3, Output(), 0.0)


def test_without_a_device_it_runs_in_silence_and_says_why(monkeypatch, session):
    use(monkeypatch, SyntheticSoundLibrary())
    playing = play(session)
    assert playing.stream is None
    assert "No audio device was found" in playing.reason
    assert playing.position_s() >= 0.0
    changed = session.change(playing, replace(ONE, loop_s=(0.1, 0.2)), Output(), loops=False)
    assert changed is playing
    assert not playing.over
    with pytest.raises(NothingToPlayOnError):
        session.tone(1, Output(), 0.0)


def test_a_device_that_does_not_begin_is_let_go(sound, session):
    sound.refuses_to_start = True
    with pytest.raises(PlaybackError, match="Two is not free"):
        play(session)
    sound.refuses_to_start = False
    assert play(session).stream is not None


@pytest.fixture
def clock():
    """A clock that is turned by hand."""
    return SimpleNamespace(now_s=50.0)


def silent_run(clock, *about):
    return SilentRun(*about, lambda: clock.now_s)


def test_it_runs_as_fast_as_the_clock_and_is_over_at_the_end(clock):
    run = silent_run(clock, 2.0, None, 0.5)
    clock.now_s += 1.0
    assert (run.position_s(), run.over) == (1.5, False)
    clock.now_s += 0.5
    assert run.over


def test_a_loop_is_never_over(clock):
    run = silent_run(clock, 2.0, (0.5, 1.0), 0.75)
    clock.now_s += 1.0
    assert run.position_s() == pytest.approx(0.75)
    clock.now_s += 100.1
    assert run.position_s() == pytest.approx(0.85)
    assert not run.over


def test_behind_the_loop_it_runs_to_the_end(clock):
    run = silent_run(clock, 2.0, (0.5, 1.0), 1.25)
    clock.now_s += 0.5
    assert (run.position_s(), run.over) == (1.75, False)
    clock.now_s += 0.5
    assert run.over


def test_a_change_goes_on_where_it_is_or_enters_the_new_loop(clock):
    run = silent_run(clock, 2.0, None, 0.0)
    clock.now_s += 1.0
    run.change(3.0, (0.5, 2.5))
    assert run.position_s() == 1.0
    run.change(3.0, (0.25, 0.75))
    assert run.position_s() == 0.25
    run.seek(0.5)
    assert run.position_s() == 0.5
