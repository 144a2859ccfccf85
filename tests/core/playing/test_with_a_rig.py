"""Playing for a rig: its wiring, volts, polarity, delays and limits."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators import Limits, MeasuredResponse
from skinsource.actuators.rigs import Rig, RigChannel, highest_gain, rig_breaches
from skinsource.base.errors import InvalidInputError, PlaybackError
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import Session

RATE_HZ = 48_000
FADE = 240
FLAT = MeasuredResponse(((1.0, 50.0, 0.0), (2000.0, 50.0, 0.0)))
BURST = ss.waveforms.Gabor(frequency_hz=150.0, cycles=8.0)
ONE = ss.Design(limb="synthetic-1", inputs=(ss.track(7, BURST, onset_s=0.1, amplitude=2.0),))
TWO = replace(ONE, inputs=(*ONE.inputs, ss.track(12, BURST, onset_s=0.1, colour=1)))


def rig_of(**changes):
    first = RigChannel(place=7, output=3, full_scale_v=2.0, measured=FLAT)
    second = RigChannel(place=12, output=1, full_scale_v=1.0, measured=FLAT)
    return Rig(title="bench", channels=(replace(first, **changes), second))


def play(session, design=ONE, **changes):
    settings = {"loops": False, "at_s": 0.0, "gain_db": 0.0, "rig": rig_of(), **changes}
    return session.play(design, Output(device="Eight"), **settings)


def samples_at_outputs(sound, session):
    assert session.over.wait(30)
    return sound.streams[0].samples[:, FADE:]


def test_the_rig_says_which_output_drives_a_place(sound, session):
    quiet = TWO.with_input(0, amplitude=0.5)
    play(session, quiet)
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
    play(session, replace(ONE, actuation=through))
    played = samples_at_outputs(sound, session)[2]
    # 50 m/s² for each volt, 2 V at full scale.
    expected = ss.stimulus_of(ONE, RATE_HZ).samples[0] / 50.0 / 2.0
    assert played[: expected.size] == pytest.approx(expected, abs=4e-3 * np.abs(expected).max())


@pytest.mark.parametrize("on", [False, True])
def test_without_a_rig_the_actuators_of_the_design_get_their_volts(sound, session, on):
    coil, equaliser = ss.actuators.load("example-voice-coil"), ss.equalising.RegularisedInverse()
    actuator = ss.ActuatorAt(actuator="coil", model=coil)
    chosen = ss.Actuation(actuators=(actuator,), equaliser=equaliser, on=on)
    peak = session.peak(replace(ONE, actuation=chosen), Output(device="Eight"))
    drive = ss.stimulus_of(ONE, RATE_HZ).samples[0]
    volts = ss.equalising.equalised(drive, RATE_HZ, coil, equaliser)
    assert peak.full_scale == pytest.approx(np.abs(volts).max(), rel=0.01)
    assert (peak.volts, peak.device, sound.streams) == (None, "Eight", [])


def test_a_limit_of_the_rig_stops_it_before_anything_is_heard(sound, session):
    limited = rig_of(limits=Limits(peak_voltage_v=1.0))
    loud = ONE.with_input(0, amplitude=0.9)
    playing = play(session, loud, rig=limited)
    assert session.over.wait(30)
    ending = playing.stream.queue.ending
    assert ending.reason == "rig"
    assert "place 7: peak voltage)" in ending.sentence
    assert "Turn the gain down to" in ending.sentence
    assert not sound.streams[0].samples.any()
    # What it says is enough.
    again = Session(lambda stream: session.over.set())
    session.over.clear()
    quiet = play(again, loud, rig=limited, gain_db=np.floor(10 * ending.highest_db) / 10)
    assert session.over.wait(30)
    assert quiet.stream.queue.ending.reason == "end"
    again.close()


def test_a_gain_that_is_turned_up_past_a_limit_stops_it(sound, session):
    limited = rig_of(limits=Limits(peak_voltage_v=1.0))
    playing = play(
        session, ONE.with_input(0, amplitude=0.9), rig=limited, gain_db=-20.0, loops=True
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
    playing = play(session, ONE.with_input(0, amplitude=0.3), rig=limited, loops=True)
    session.change(
        playing, ONE.with_input(0, amplitude=0.9), Output(device="Eight"), loops=True, rig=limited
    )
    assert session.over.wait(30)
    assert playing.stream.queue.ending.reason == "rig"
    assert np.abs(sound.streams[0].samples).max() <= 0.3 + 1e-6


def test_a_rig_of_another_device_is_refused(sound, session):
    with pytest.raises(PlaybackError, match="wired to 'Two', but Eight is chosen"):
        play(session, rig=rig_of(device="Two"))


def test_a_place_that_the_rig_does_not_wire_is_refused(sound, session):
    elsewhere = replace(ONE, inputs=(ss.track(3, BURST),))
    with pytest.raises(InvalidInputError, match="place 3 is not wired"):
        play(session, elsewhere)


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
    samples = ss.stimulus_of(ONE, 8000).samples
    margin = highest_gain(rig, [7], samples, 8000)
    assert 0.0 < margin.factor < np.inf
    assert rig_breaches(rig, [7], samples * margin.factor * 1.0001, 8000)
    assert not rig_breaches(rig, [7], samples * margin.factor * 0.9999, 8000)
