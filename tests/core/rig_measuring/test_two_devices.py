"""Played on one device and recorded from another, whose clock is its own."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.errors import PlaybackError, Stopped
from skinsource.lab.playing.devices import Device, Output
from skinsource.lab.rig_measuring import duplex
from skinsource.lab.rig_measuring.duplex import InputDevice, input_device_of
from skinsource.lab.rig_measuring.measurement import measure
from tests.core.rig_measuring.bench_top import (
    COIL,
    DELAY_S,
    RATE_HZ,
    SETUP,
    VOLTS,
    ears,
    relative_error,
    sensed,
    use,
)
from tests.core.rig_measuring.two_cards import BEGUN_LATER, In, Out, TwoCards

RIG = Rig(channels=(RigChannel(place=7, output=3, full_scale_v=VOLTS),))


def measured(setup=SETUP, **more):
    return measure(RIG, 7, setup, output=Output(sample_rate_hz=RATE_HZ), **more)


@pytest.fixture
def cards(monkeypatch):
    return use(monkeypatch, TwoCards(ears(sensed(COIL))))


@pytest.mark.parametrize("ppm", [0.0, 83.0, -400.0])
def test_the_response_comes_back_whatever_the_clocks_do(cards, ppm):
    cards.ratio = 1.0 + 1e-6 * ppm
    result = measured()
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
    result = measured(replace(SETUP, input_number=2, loopback_input=1))
    assert result.clock_ppm == pytest.approx(150.0, abs=0.05)
    assert relative_error(result) < 0.02


def test_each_device_is_named_that_refuses_or_is_gone(cards, monkeypatch):
    cards.refusal = ("Invalid sample rate", -9997)
    with pytest.raises(PlaybackError, match="Hears does not take 8000 Hz; it prefers 44100"):
        measured()
    cards.refusal = ("Invalid number of channels", -9998)
    with pytest.raises(PlaybackError, match="Hears does not take 2 inputs"):
        measured()
    cards.refusal = ()
    for cards.busy, name in ((In, "Hears"), (Out, "Plays")):
        with pytest.raises(PlaybackError, match=f"{name} is not free: another program uses it"):
            measured()
    cards.busy = ()
    monkeypatch.setattr(duplex, "_GONE_AFTER_S", 1.0)
    cards.pulled_after = 40
    # However long it takes to close them: then none of them answers.
    cards.before_closing = lambda: monkeypatch.setattr(duplex, "_GONE_AFTER_S", -1.0)
    with pytest.raises(PlaybackError, match="Plays stopped answering"):
        measured()
    cards.before_closing = lambda: None
    monkeypatch.setattr(duplex, "_GONE_AFTER_S", 1.0)
    cards.pulled_after, cards.deaf_after = 100_000, 200
    with pytest.raises(PlaybackError, match="Hears stopped answering"):
        measured()
    assert all(stream.closed.is_set() for stream in cards.streams)


def test_lost_samples_are_told_and_a_stop_is_silent(cards):
    with pytest.raises(Stopped):
        measured(stop=lambda: True)
    assert all(stream.closed.is_set() for stream in cards.streams)
    cards.loses_at = 150
    with pytest.raises(PlaybackError, match="lost 1 times"):
        measured()


def test_a_stop_is_heard_too_while_what_was_played_last_is_on_its_way_in(cards):
    cards.deaf_after = 200
    with pytest.raises(Stopped):
        measured(stop=lambda: cards.began and not cards.streams[-1].active)
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
