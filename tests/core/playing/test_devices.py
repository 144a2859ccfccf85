"""Devices of a made-up sound library, and rows of samples at their rates."""

import importlib
import re
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skinsource as ss
from skinsource.base.errors import InvalidInputError, NothingToPlayOnError, PlaybackError
from skinsource.base.extras import extra_line
from skinsource.lab.playing import devices, stream
from skinsource.lab.playing.devices import DeviceRows, Output, output_from_text
from skinsource.lab.playing.stream import PlayQueue
from tests.core.playing.synthetic_sound import SoundLibrary

CARDS = (
    ("Built-in", 0, 2, 0, 44100.0),
    ("Microphone", 0, 0, 2, 44100.0),
    ("Eight", 1, 8, 0, 48000.0),
)


class Library(SoundLibrary):
    """Three devices, of which one only hears."""

    def __init__(self, rows=CARDS, refusal=(), rates=(44_100, 48_000)):
        super().__init__(default_output=2)
        self.rows, self.refusal, self.rates = rows, refusal, rates

    def query_hostapis(self):
        # That of a host is another one.
        return ({"name": "ALSA", "default_output_device": 0}, {"name": "JACK"})

    def OutputStream(self, **asked):  # as sounddevice calls it
        return self.open(None)


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
    library(rows=(*CARDS, ("Built-in", 1, 2, 0, 48000.0)))
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
    with pytest.raises(
        NothingToPlayOnError, match=f"^To play, type: {re.escape(extra_line('audio'))} and "
    ):
        devices.sound_library()


def test_without_portaudio_the_package_of_the_system_is_said(monkeypatch):
    def fail(name):
        raise OSError("PortAudio library not found")

    monkeypatch.setattr(importlib, "import_module", fail)
    with pytest.raises(NothingToPlayOnError, match=r"apt install libportaudio2.*library not found"):
        devices.sound_library()


FROM_HZ = 1300


def rows(seed=0, n=2600):
    """A tone in the middle, one that starts at once and one that ends last, and silence."""
    noise = np.random.default_rng(seed).standard_normal((4, n))
    noise[0, :900] = noise[0, 1200:] = 0.0
    noise[1, 300:] = 0.0
    noise[2, : n - 50] = 0.0
    noise[3] = 0.0
    return noise


@pytest.mark.parametrize("to_hz", [48_000, 44_100, 8_000, 1_300, 1_000])
def test_it_is_the_same_as_resampling_everything_to_the_last_bit(to_hz):
    resampled = DeviceRows().at(rows(), FROM_HZ, to_hz)
    assert np.array_equal(resampled, ss.resample(rows(), FROM_HZ, to_hz))


def test_only_rows_that_have_changed_go_through_the_filter(monkeypatch):
    filtered = []
    monkeypatch.setattr(
        devices, "resample", lambda row, *rates: filtered.append(row) or ss.resample(row, *rates)
    )
    memory, before = DeviceRows(), rows()
    first = memory.at(before, FROM_HZ, 48_000)
    after = before[[1, 0, 3, 2]].copy()
    assert np.array_equal(memory.at(after, FROM_HZ, 48_000), first[[1, 0, 3, 2]])
    assert len(filtered) == 4
    after[0, 5] += 1.0
    changed = memory.at(after, FROM_HZ, 48_000)
    assert np.array_equal(changed, ss.resample(after, FROM_HZ, 48_000))
    assert len(filtered) == 5


def test_what_is_given_out_does_not_change_what_is_kept():
    memory = DeviceRows()
    first = memory.at(rows(), FROM_HZ, 8_000)
    given = rows()
    again = memory.at(given, FROM_HZ, 8_000)
    again[:] = 7.0
    given[:] = 7.0
    assert np.array_equal(memory.at(rows(), FROM_HZ, 8_000), ss.resample(rows(), FROM_HZ, 8_000))
    assert np.array_equal(first, ss.resample(rows(), FROM_HZ, 8_000))


def test_a_place_without_an_output_of_its_own_takes_the_next_free_one():
    output = Output(outputs=((7, 2),))
    assert output.outputs_of([3, 7, 18]) == {3: 1, 7: 2, 18: 3}
    assert output.outputs_of([7]) == {7: 2}
    assert Output().outputs_of([12, 5, 12]) == {12: 1, 5: 2}


def test_an_output_that_another_place_is_wired_to_is_not_free():
    assert Output(outputs=((9, 1),)).outputs_of([3]) == {3: 2}


@given(
    st.lists(st.integers(1, 72), unique=True, max_size=20),
    st.lists(st.tuples(st.integers(1, 72), st.integers(1, 30)), max_size=20),
)
def test_no_two_places_share_an_output(places, pairs):
    outputs = tuple({place: (place, output) for place, output in pairs}.values())
    outputs = tuple({output: (place, output) for place, output in outputs}.values())
    numbers = Output(outputs=outputs).outputs_of(places)
    assert set(numbers) == set(places)
    assert len(set(numbers.values())) == len(numbers)


def test_what_is_written_down_is_read_again():
    output = Output(
        device="USB: 8 × out",
        host_api="ALSA",
        sample_rate_hz=96_000,
        latency_s=0.01,
        outputs=((7, 3), (2, 1)),
        stand_in=True,
        shift_hz=250.0,
    )
    assert output_from_text(output.to_text()) == output
    assert output_from_text(Output().to_text()) == Output()


@pytest.mark.parametrize(
    "text",
    ["", "[]", "7", '{"device": 7}', '{"sample_rate_hz": 0}', '{"other": 1}', "[" * 9999,
     '{"outputs": [[1, 2, 3]]}', '{"outputs": [[1, 0]]}', '{"outputs": 5}', '{"latency_s": "x"}',
     '{"stand_in": "no"}', '{"latency_s": NaN}', '{"outputs": [[1, 2], [3, 2]]}'],
)  # fmt: skip
def test_anything_else_is_refused(text):
    with pytest.raises(InvalidInputError):
        output_from_text(text)
