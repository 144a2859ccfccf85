"""A sweep on an output and an accelerometer on an input, also of another device with its clock."""

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.prediction import Limits
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.errors import InvalidInputError, PlaybackError, Stopped
from skinsource.cli.command_line import main
from skinsource.lab.playing.devices import Device, Output
from skinsource.lab.rig_measuring import duplex
from skinsource.lab.rig_measuring.duplex import InputDevice, input_device_of
from skinsource.lab.rig_measuring.measurement import kept, measure
from tests.core.rig_measuring.bench_top import (
    BLOCK_S,
    COIL,
    DELAY_S,
    HZ,
    INPUT_VOLTS,
    RATE_HZ,
    SENSITIVITY,
    SETUP,
    VOLTS,
    Card,
    ears,
    sensed,
    use,
)
from tests.core.rig_measuring.two_cards import BEGUN_LATER, In, Out, TwoCards

CHANNEL = RigChannel(place=7, output=3, full_scale_v=1.5, amplifier_gain=2.0)
RIG = Rig(title="Bench", channels=(RigChannel(place=2), CHANNEL))
PLAYED = Output(sample_rate_hz=RATE_HZ)


def measured(rig=RIG, place=7, setup=SETUP, **more):
    return measure(rig, place, setup, output=PLAYED, **more)


#: Of the gain, with sweeps as short as these, and of gain and phase together: a delay that is told
#: from the phase is right to 10 µs, 3 degrees at 800 Hz.
GAIN, BOTH = 0.02, 0.06


def relative_error(result, model=COIL):
    """Largest relative distance from what the model is by its formula, delay and sign included."""
    ratio = result.response.response(HZ) / model.response(HZ)
    assert np.abs(np.abs(ratio) - 1.0).max() < GAIN
    return np.abs(ratio - 1.0).max()


@pytest.fixture
def card(monkeypatch):
    return use(monkeypatch, Card(ears(sensed(COIL))))


def test_the_response_of_the_actuator_comes_back_in_m_per_s2_per_v(card):
    result = measured()
    assert relative_error(result) < BOTH
    assert abs(result.delay_s - DELAY_S - BLOCK_S) < 2e-5
    assert not result.inverted
    assert result.n_left_out == 0
    assert result.noise_m_per_s2 == pytest.approx(1e-5 * INPUT_VOLTS / SENSITIVITY, rel=0.1)
    # What is said of its error is about what its error is.
    assert np.median(result.error) < 0.01
    quiet, loud = (np.abs(stream.samples).max(axis=1) for stream in card.streams)
    assert loud == pytest.approx([0.0, 0.0, 0.1], rel=0.01)
    assert quiet == pytest.approx([0.0, 0.0, 0.01], rel=0.01)


def test_a_wire_from_output_to_input_tells_the_delay(monkeypatch):
    wire = ears(lambda hz: np.full(hz.size, 0.5 + 0j))
    use(monkeypatch, Card(wire, ears(sensed(COIL))))
    result = measured(setup=replace(SETUP, input_number=2, loopback_input=1))
    assert result.delay_by_wire
    assert abs(result.delay_s - DELAY_S - BLOCK_S) < 1e-6
    assert relative_error(result) < 0.02


def test_noise_covers_the_lowest_frequencies_and_they_are_left_out(monkeypatch):
    use(monkeypatch, Card(ears(sensed(COIL)), noise=2e-2))
    result = measured()
    assert result.n_left_out > 0
    assert result.response.points[0][0] > 22.0
    hz = np.array([point[0] for point in result.response.points])
    off = np.abs(np.abs(result.response.response(hz) / COIL.response(hz)) - 1.0)
    # Within three of its own standard errors and what the width of a point costs, nearly always.
    assert np.mean(off < 3.0 * result.error + GAIN) > 0.95
    assert result.error.max() <= 0.1
    assert np.median(result.error) > 0.005


def test_an_actuator_that_moves_against_the_voltage_is_told(monkeypatch):
    use(monkeypatch, Card(ears(sensed(COIL, -VOLTS))))
    result = measured()
    assert result.inverted
    assert "opposes the voltage" in " ".join(result.lines)
    turned = replace(RIG, channels=(replace(CHANNEL, polarity="inverted"),))
    assert not measured(turned).inverted
    assert relative_error(measured(turned)) < BOTH


def test_what_was_measured_is_in_its_channel_with_the_date(card):
    result = measured()
    after = kept(RIG, result)
    assert after.channels[0] == RIG.channels[0]
    today = datetime.now(UTC).date().isoformat()
    assert after.channels[1] == replace(CHANNEL, measured=result.response, measured_on=today)
    assert after.channels[1].calibrated


def test_what_would_pass_a_limit_of_the_rig_is_never_played(card):
    held = replace(CHANNEL, limits=Limits(peak_voltage_v=0.15))
    with pytest.raises(InvalidInputError, match=r"place 7: peak voltage\); .*−26\.1 dB or less"):
        measured(Rig(channels=(held,)))
    assert not card.streams
    assert (
        relative_error(measured(Rig(channels=(held,)), setup=replace(SETUP, level_db=-26.1))) < BOTH
    )


def test_a_limit_of_the_motion_is_looked_at_once_the_response_is_known(card):
    held = replace(CHANNEL, limits=Limits(displacement_m=1e-6))
    with pytest.raises(InvalidInputError, match="place 7: displacement"):
        measured(Rig(channels=(held,)))
    assert len(card.streams) == 1


def test_an_input_that_would_clip_says_how_loud_it_may_be(card):
    card.paths = (card.paths[0] * 60.0,)
    with pytest.raises(
        InvalidInputError, match=r"input 1 would clip at −20 dB; choose −\d"
    ) as warned:
        measured()
    assert len(card.streams) == 1
    most_db = -float(str(warned.value).split("choose −")[1].split(" dB")[0])
    loudest = replace(SETUP, level_db=most_db)
    assert -3.0 < measured(setup=loudest).peak_input_db < 0.0


def test_a_sensor_that_hears_nothing_is_told_with_what_to_look_at(card):
    card.paths = (np.zeros_like(card.paths[0]),)
    with pytest.raises(InvalidInputError, match=r"above the noise.*Check amplifier"):
        measured()
    card.noise, card.offset = 0.0, 0.0
    with pytest.raises(InvalidInputError, match="above the noise"):
        measured()


def test_a_card_that_is_pulled_out_or_loses_samples_is_told(card):
    card.loses_at = 40
    with pytest.raises(PlaybackError, match="lost 1 times"):
        measured()
    card.loses_at, card.pulled_after = -1, 40
    with pytest.raises(PlaybackError, match="Bench card stopped answering"):
        measured()


@pytest.mark.parametrize(
    ("changes", "setup", "message"),
    [
        ({"n_outputs": 0}, SETUP, "No audio device"),
        ({"n_inputs": 0}, SETUP, "No device to record from"),
        ({"n_outputs": 2}, SETUP, "has 2 outputs, and place 7 is assigned to output 3"),
        ({}, replace(SETUP, input_number=5), "has 2 inputs, and input 5"),
        ({}, replace(SETUP, input_device="Other"), "'Other' has no inputs or is not there"),
        ({"refusal": ("Invalid sample rate", -9997)}, SETUP, "does not take 8000 Hz"),
        ({"refusal": ("Device unavailable", -9985)}, SETUP, "is not free"),
    ],
)
def test_what_a_device_does_not_have_or_take_is_one_clear_error(card, changes, setup, message):
    for name, value in changes.items():
        setattr(card, name, value)
    with pytest.raises(PlaybackError, match=message):
        measured(setup=setup)


def test_what_is_not_known_is_asked_for_before_anything_is_played(card):
    with pytest.raises(InvalidInputError, match="Place 9 is not wired in the rig 'Bench'"):
        measured(place=9)
    with pytest.raises(InvalidInputError, match="volts at full scale"):
        measured(place=2)
    with pytest.raises(InvalidInputError, match="choose a higher rate"):
        measured(setup=replace(SETUP, highest_hz=3900.0))
    with pytest.raises(InvalidInputError, match="expected two inputs"):
        replace(SETUP, loopback_input=1)
    assert not card.streams


def test_the_command_writes_the_response_into_the_rig(card, tmp_path, capsys):
    path = tmp_path / "bench.skinrig"
    ss.save_rig(path, RIG)
    command = (
        f"rig measure {path} --place 7 --sensitivity {SENSITIVITY} --input-volts {INPUT_VOLTS}"
    )
    more = f" --level -20 --seconds 1.5 --repeats 2 --rate {RATE_HZ}"
    assert main((command + more).split()) == 0
    assert "Place 7: 240 points from 20 to 1000 Hz" in capsys.readouterr().out
    after = ss.open_rig(path)
    assert np.abs(after.channels[1].measured.response(100.0) / COIL.response(100.0) - 1) < 0.03
    assert main([*(command + more).split(), "--input", "9"]) == 1
    assert "input 9 is to be recorded" in capsys.readouterr().err
    assert ss.open_rig(path) == after
    assert main(["rig", "devices"]) == 0
    assert "Bench card (Made up, 2 inputs)  (usual)" in capsys.readouterr().out


APART = Rig(channels=(RigChannel(place=7, output=3, full_scale_v=VOLTS),))


@pytest.fixture
def cards(monkeypatch):
    return use(monkeypatch, TwoCards(ears(sensed(COIL))))


@pytest.mark.parametrize("ppm", [0.0, 83.0, -400.0])
def test_the_response_comes_back_whatever_the_clocks_do(cards, ppm):
    cards.ratio = 1.0 + 1e-6 * ppm
    result = measured(APART)
    assert result.clock_ppm == pytest.approx(ppm, abs=0.5)
    assert relative_error(result) < 0.06
    # By the clock that records, which has run since the first sample.
    begun_s = BEGUN_LATER / RATE_HZ + 0.205e-6 * ppm
    assert result.delay_s == pytest.approx(DELAY_S + begun_s, abs=2e-5)
    assert np.median(result.error) < 0.01
    text = " ".join(result.lines)
    assert "two devices, Plays and Hears, which start independently" in text
    assert ("ppm faster", "clocks agree", "ppm slower")[1 - int(np.sign(ppm))] in text


def test_a_wire_tells_delay_and_clocks(cards):
    cards.paths = (ears(lambda hz: np.full(hz.size, 0.5 + 0j)), *cards.paths)
    cards.ratio = 1.0 + 150e-6
    result = measured(APART, setup=replace(SETUP, input_number=2, loopback_input=1))
    assert result.clock_ppm == pytest.approx(150.0, abs=0.05)
    assert relative_error(result) < 0.02


def test_each_device_is_named_that_refuses_or_is_gone(cards, monkeypatch):
    cards.refusal = ("Invalid sample rate", -9997)
    with pytest.raises(PlaybackError, match="Hears does not take 8000 Hz; it prefers 44100"):
        measured(APART)
    cards.refusal = ("Invalid number of channels", -9998)
    with pytest.raises(PlaybackError, match="Hears does not take 2 inputs"):
        measured(APART)
    cards.refusal = ()
    for cards.busy, name in ((In, "Hears"), (Out, "Plays")):
        with pytest.raises(PlaybackError, match=f"{name} is not free: another program uses it"):
            measured(APART)
    cards.busy = ()
    monkeypatch.setattr(duplex, "_GONE_AFTER_S", 1.0)
    cards.pulled_after = 40
    # However long it takes to close them: then none of them answers.
    cards.before_closing = lambda: monkeypatch.setattr(duplex, "_GONE_AFTER_S", -1.0)
    with pytest.raises(PlaybackError, match="Plays stopped answering"):
        measured(APART)
    cards.before_closing = lambda: None
    monkeypatch.setattr(duplex, "_GONE_AFTER_S", 1.0)
    cards.pulled_after, cards.deaf_after = 100_000, 200
    with pytest.raises(PlaybackError, match="Hears stopped answering"):
        measured(APART)
    assert all(stream.closed.is_set() for stream in cards.streams)


def test_lost_samples_are_told_and_a_stop_is_silent(cards):
    with pytest.raises(Stopped):
        measured(APART, stop=lambda: True)
    assert all(stream.closed.is_set() for stream in cards.streams)
    cards.loses_at = 150
    with pytest.raises(PlaybackError, match="lost 1 times"):
        measured(APART)


def test_a_stop_is_heard_too_while_what_was_played_last_is_on_its_way_in(cards):
    cards.deaf_after = 200
    with pytest.raises(Stopped):
        measured(APART, stop=lambda: cards.began and not cards.streams[-1].active)
    assert all(stream.closed.is_set() for stream in cards.streams)


PLAYED_ON = Device(
    index=2, name="Card", host_api="ALSA", n_outputs=4, sample_rate_hz=48_000, is_default=False
)


def device(index, name="Card", host_api="ALSA"):
    return InputDevice(index=index, name=name, host_api=host_api, n_inputs=2, sample_rate_hz=48_000)


@pytest.mark.parametrize(
    ("name", "there", "index"),
    [
        # The same device, then one of its host, then any.
        ("", (device(0, "Jack", "JACK"), device(1, "Other"), device(2)), 2),
        ("", (device(0, "Jack", "JACK"), device(1, "Other")), 1),
        ("", (device(0, "Jack", "JACK"),), 0),
        # So also of those that have the name.
        ("Card", (device(0, host_api="JACK"), device(1), device(2)), 2),
        ("Card", (device(0, host_api="JACK"), device(3), device(2, "Other")), 3),
        ("Jack", (device(0, "Jack", "JACK"), device(2)), 0),
    ],
)
def test_the_nearest_to_the_device_that_is_played_on_is_recorded_from(name, there, index):
    assert input_device_of(name, PLAYED_ON, there).index == index
