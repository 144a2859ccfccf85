"""Devices of a made-up sound library, which answers as sounddevice does."""

import importlib
import re
import sys
from types import SimpleNamespace

import pytest

from skinsource.base.errors import NothingToPlayOnError, PlaybackError
from skinsource.base.extras import extra_line
from skinsource.lab.playing import devices, stream
from skinsource.lab.playing import devices as portaudio
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.mix import PlayQueue

CARDS = (("Built-in", 0, 2, 44100.0), ("Microphone", 0, 0, 44100.0), ("Eight", 1, 8, 48000.0))


class PortAudioError(Exception):
    pass


class Library:
    """Three devices, of which one only hears."""

    PortAudioError = PortAudioError

    def __init__(self, cards=CARDS, default=2, refusal=None, rates=(44_100, 48_000)):
        self.cards, self.refusal, self.rates = cards, refusal, rates
        self.default = SimpleNamespace(device={"output": default})
        self.looked = 0

    def query_hostapis(self):
        return ({"name": "ALSA", "default_output_device": 0}, {"name": "JACK"})

    def query_devices(self):
        names = ("name", "hostapi", "max_output_channels", "default_samplerate")
        return [dict(zip(names, card, strict=True)) for card in self.cards]

    def check_output_settings(self, *, device, channels, dtype, samplerate):
        assert channels <= self.cards[device][2]
        if samplerate not in self.rates:
            raise PortAudioError("Invalid sample rate", -9997)

    def OutputStream(self, **asked):  # as sounddevice calls it
        raise PortAudioError(*self.refusal)

    def _terminate(self):
        self.looked -= 1

    def _initialize(self):
        self.looked += 2


@pytest.fixture
def library(monkeypatch):
    def use(**made):
        backend = Library(**made)
        monkeypatch.setattr(importlib, "import_module", lambda name: backend)
        return backend

    return use


def test_what_the_system_plays_on_comes_first_and_what_cannot_play_not_at_all(library):
    library()
    listed = devices.devices()
    assert [device.title for device in listed] == [
        "Eight (JACK, 8 outputs)",
        "Built-in (ALSA, 2 outputs)",
    ]
    assert [device.is_default for device in listed] == [True, False]


def test_a_device_is_found_by_its_name_and_its_host(library):
    library(cards=(*CARDS, ("Built-in", 1, 2, 48000.0)))
    listed = devices.devices()
    assert devices.device_of(Output(), listed).name == "Eight"
    output = Output(device="Built-in", host_api="JACK")
    assert devices.device_of(output, listed).index == 3
    assert devices.device_of(Output(device="Built-in"), listed).index == 0


def test_a_device_that_is_not_there_is_named_with_those_that_are(library):
    library()
    with pytest.raises(PlaybackError, match=r"'Nine' was not found.*there are Eight, Built-in"):
        devices.device_of(Output(device="Nine"), devices.devices())


def test_rates_are_those_that_the_device_takes(library):
    library(rates=(8_000, 48_000, 12_345))
    assert devices.rates_of(devices.devices()[0]) == (8_000, 48_000)


@pytest.mark.parametrize(
    ("refusal", "message"),
    [
        (("Invalid sample rate", -9997), "Eight does not take 48000 Hz; it prefers 48000 Hz"),
        (("Invalid number of channels", -9998), "Eight does not take 3 outputs"),
        (("Device unavailable", -9985), "Eight is not free: another program uses it"),
        (
            ("Unanticipated host error", -9999),
            "cannot be used for 3 outputs: Unanticipated host error",
        ),
        (("no code",), "cannot be used for 3 outputs: no code"),
    ],
)
def test_what_a_device_refuses_is_said_in_plain_words(library, refusal, message):
    library(refusal=refusal)
    with pytest.raises(PlaybackError, match=message):
        stream.Stream(PlayQueue(3, 48_000), devices.devices()[0], 0.02, lambda: None)


def test_without_the_extra_the_line_to_type_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "sounddevice", None)
    with pytest.raises(NothingToPlayOnError, match=re.escape(extra_line("audio"))):
        portaudio.sound_library()


def test_without_portaudio_the_package_of_the_system_is_said(monkeypatch):
    def fail(name):
        raise OSError("PortAudio library not found")

    monkeypatch.setattr(importlib, "import_module", fail)
    with pytest.raises(NothingToPlayOnError, match=r"apt install libportaudio2.*library not found"):
        portaudio.sound_library()
