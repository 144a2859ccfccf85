from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators import Limits, MeasuredResponse
from skinsource.actuators.rigs import Rig, RigChannel, highest_gain, rig_breaches
from skinsource.base.errors import InvalidInputError, NothingToPlayOnError, PlaybackError, Stopped
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import Session, SilentRun
from tests.core.playing.playing_bench import wait_for
from tests.core.playing.synthetic_sound import SyntheticSoundLibrary, SyntheticStream, use

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


def test_a_playhead_starts_where_it_is_unless_it_is_behind_the_end_and_the_loop(sound, session):
    looped = replace(ONE, loop_s=(0.2, 0.4))
    for design, at_s, expected in (
        (ONE, 0.25, 0.25), (ONE, 9.0, 0.0), (looped, 0.3, 0.3), (looped, 0.0, 0.0),
        (looped, 0.4, 0.4), (looped, 9.0, 0.2),
    ):  # fmt: skip
        queue = play(session, design, at_s=at_s).stream.queue
        swap, begun = queue.swap, queue.position
        begin = swap.at if swap is not None else begun
        if design is looped:
            animated = session.animate(design, ss.View(playhead_s=at_s), loops=True)
            assert animated.position_s() == pytest.approx(expected, abs=0.02)
        assert begin >= round(expected * 48_000) - FADE
        assert begin < round((expected + 0.15) * 48_000)
    # Without a loop of its own, the middle of a tone is shown again and again.
    assert session.animate(ONE, ss.View(slow_motion=0.0), loops=True).position_s() > 0.2


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


def test_the_playhead_goes_on_while_actuators_ring(session):
    coil = ss.ActuatorAt(model=ss.actuators.load("example-voice-coil"))
    design = replace(ONE, actuation=ss.Actuation(actuators=(coil,)))
    time_s = ss.evaluate(design, "response_time_s")["response_time_s"]
    assert session.animate(design, ss.View(), loops=False).visible_s > time_s[-1]


def test_a_device_that_does_not_begin_is_let_go(sound, session):
    sound.busy = SyntheticStream
    with pytest.raises(PlaybackError, match="Two is not free"):
        play(session)
    sound.busy = ()
    assert play(session).stream is not None


@pytest.fixture
def clock():
    """A clock that is turned by hand."""
    return SimpleNamespace(now_s=50.0)


def silent_run(clock, *about):
    return SilentRun(*about, lambda: clock.now_s)


@pytest.mark.parametrize(
    ("loop_s", "at_s", "after_s", "there_s", "over"),
    [
        (None, 0.5, 1.0, 1.5, False),
        (None, 0.5, 1.5, 2.0, True),
        ((0.5, 1.0), 0.25, 1.0, 0.75, False),
        ((0.5, 1.0), 0.75, 101.1, 0.85, False),
        ((0.5, 1.0), 1.25, 0.5, 1.75, False),
        ((0.5, 1.0), 1.25, 0.75, 2.0, True),
    ],
)
def test_it_runs_with_the_clock_round_a_loop_ahead_and_to_the_end_behind_one(
    clock, loop_s, at_s, after_s, there_s, over
):
    run = silent_run(clock, 2.0, loop_s, at_s)
    clock.now_s += after_s
    assert (run.position_s(), run.over) == (pytest.approx(there_s), over)


def test_a_change_goes_on_where_it_is_or_enters_the_new_loop(clock):
    run = silent_run(clock, 2.0, None, 0.0)
    clock.now_s += 1.0
    run.change(3.0, (0.5, 2.5))
    assert run.position_s() == 1.0
    run.change(3.0, (0.25, 0.75))
    assert run.position_s() == 0.25
    # Behind a loop that it had before, it runs on.
    run.seek(1.0)
    run.change(2.0, (0.25, 0.75), 5.0)
    assert run.position_s() == 1.0


RATE_HZ = 48_000
FLAT = MeasuredResponse(((1.0, 50.0, 0.0), (2000.0, 50.0, 0.0)))
BURST = ss.waveforms.Gabor(frequency_hz=150.0, cycles=8.0)
WIRED = ss.Design(limb="synthetic-1", inputs=(ss.track(7, BURST, onset_s=0.1, amplitude=2.0),))
TWO = replace(WIRED, inputs=(*WIRED.inputs, ss.track(12, BURST, onset_s=0.1, colour=1)))


def rig_of(**changes):
    first = RigChannel(place=7, output=3, full_scale_v=2.0, measured=FLAT)
    second = RigChannel(place=12, output=1, full_scale_v=1.0, measured=FLAT)
    return Rig(title="bench", channels=(replace(first, **changes), second))


def play_wired(session, design=WIRED, **changes):
    settings = {"loops": False, "at_s": 0.0, "gain_db": 0.0, "rig": rig_of(), **changes}
    return session.play(design, Output(device="Eight"), **settings)


def samples_at_outputs(sound, session):
    assert session.over.wait(30)
    return sound.streams[0].samples[:, FADE:]


def test_the_rig_says_which_output_drives_a_place(sound, session):
    quiet = TWO.with_input(0, amplitude=0.5)
    play_wired(session, quiet)
    played = samples_at_outputs(sound, session)
    expected = ss.stimulus_of(quiet, RATE_HZ).samples
    assert played[2].any()
    assert not played[1].any()
    n = expected.shape[1]
    assert played[0, :n] == pytest.approx(expected[1], abs=1e-6)


def test_what_is_predicted_through_an_equaliser_is_played_through_it(sound, session):
    coil = ss.actuators.load("example-voice-coil")
    through = ss.Actuation(
        actuators=(ss.ActuatorAt(actuator="coil", model=coil),),
        equaliser=ss.equalising.RegularisedInverse(),
    )
    play_wired(session, replace(WIRED, actuation=through))
    played = samples_at_outputs(sound, session)[2]
    # 50 m/s² for each volt, 2 V at full scale.
    expected = ss.stimulus_of(WIRED, RATE_HZ).samples[0] / 50.0 / 2.0
    assert played[: expected.size] == pytest.approx(expected, abs=4e-3 * np.abs(expected).max())


@pytest.mark.parametrize("on", [False, True])
def test_without_a_rig_the_actuators_of_the_design_get_their_volts(sound, session, on):
    coil, equaliser = ss.actuators.load("example-voice-coil"), ss.equalising.RegularisedInverse()
    actuator = ss.ActuatorAt(actuator="coil", model=coil)
    chosen = ss.Actuation(actuators=(actuator,), equaliser=equaliser, on=on)
    peak = session.peak(replace(WIRED, actuation=chosen), Output(device="Eight"))
    drive = ss.stimulus_of(WIRED, RATE_HZ).samples[0]
    volts = ss.equalising.equalised(drive, RATE_HZ, coil, equaliser)
    assert peak.full_scale == pytest.approx(np.abs(volts).max(), rel=0.01)
    assert (peak.volts, peak.device, sound.streams) == (None, "Eight", [])


def test_a_limit_of_the_rig_stops_it_before_anything_is_heard(sound, session):
    limited = rig_of(limits=Limits(peak_voltage_v=1.0))
    loud = WIRED.with_input(0, amplitude=0.9)
    playing = play_wired(session, loud, rig=limited)
    assert session.over.wait(30)
    ending = playing.stream.queue.ending
    assert ending.reason == "rig"
    assert "place 7: peak voltage)" in ending.sentence
    assert "Turn the gain down to" in ending.sentence
    assert not sound.streams[0].samples.any()
    # What it says is enough.
    again = Session(lambda stream: session.over.set())
    session.over.clear()
    quiet = play_wired(again, loud, rig=limited, gain_db=np.floor(10 * ending.highest_db) / 10)
    assert session.over.wait(30)
    assert quiet.stream.queue.ending.reason == "end"
    again.close()


def test_a_gain_that_is_turned_up_past_a_limit_stops_it(sound, session):
    limited = rig_of(limits=Limits(peak_voltage_v=1.0))
    playing = play_wired(
        session, WIRED.with_input(0, amplitude=0.9), rig=limited, gain_db=-20.0, loops=True
    )
    queue = playing.stream.queue
    assert queue.ending is None
    queue.set_gain(0.0)
    assert session.over.wait(30)
    assert queue.ending.reason == "rig"
    # Not even the way up to it is heard.
    assert np.abs(sound.streams[0].samples).max() <= 0.09 + 1e-6


def test_a_louder_edit_is_looked_at_before_it_is_heard(sound, session):
    limited = rig_of(limits=Limits(peak_voltage_v=1.0))
    playing = play_wired(session, WIRED.with_input(0, amplitude=0.3), rig=limited, loops=True)
    session.change(
        playing, WIRED.with_input(0, amplitude=0.9), Output(device="Eight"), loops=True, rig=limited
    )
    assert session.over.wait(30)
    assert playing.stream.queue.ending.reason == "rig"
    assert np.abs(sound.streams[0].samples).max() <= 0.3 + 1e-6


def test_a_rig_of_another_device_is_refused(sound, session):
    with pytest.raises(PlaybackError, match="wired to 'Two', but Eight is chosen"):
        play_wired(session, rig=rig_of(device="Two"))


def test_a_place_that_the_rig_does_not_wire_is_refused(sound, session):
    elsewhere = replace(WIRED, inputs=(ss.track(3, BURST),))
    with pytest.raises(InvalidInputError, match="Place 3 is not wired"):
        play_wired(session, elsewhere)


def test_the_test_tone_is_no_louder_than_the_rig_allows(sound, session):
    limited = rig_of(limits=Limits(peak_voltage_v=1.0))
    playing = session.tone(3, Output(device="Eight"), 0.0, limited)
    assert session.over.wait(30)
    assert playing.stream.queue.ending.reason == "rig"
    session.over.clear()
    playing = session.tone(3, Output(device="Eight"), -10.0, limited)
    assert session.over.wait(30)
    assert playing.stream.queue.ending.reason == "end"


@pytest.mark.parametrize("limits", [Limits(peak_voltage_v=0.7), Limits(displacement_m=1e-5)])
def test_the_highest_gain_is_the_one_at_which_a_limit_is_reached(limits):
    rig = rig_of(limits=limits)
    samples = ss.stimulus_of(WIRED, 8000).samples
    margin = highest_gain(rig, [7], samples, 8000)
    assert 0.0 < margin.factor < np.inf
    assert rig_breaches(rig, [7], samples * margin.factor * 1.0001, 8000)
    assert not rig_breaches(rig, [7], samples * margin.factor * 0.9999, 8000)
