"""What is matched is played: on a made-up device, and in silence where there is none."""

import threading

import numpy as np
import pytest

import skinsource as ss
from skinsource.lab.matching import MatchingRun, Presenter, Procedure
from skinsource.lab.playing.devices import Output
from tests.core.playing.playing_bench import wait_for
from tests.core.playing.synthetic_sound import SyntheticSoundLibrary, use

PROCEDURE = Procedure(
    person="Anna",
    frequencies_hz=(200.0,),
    places=(3,),
    amplitude=0.25,
    duration_s=0.1,
    pause_s=0.05,
)
#: Samples of a reference, a pause, a test and a pause.
CYCLE = round(0.3 * 48_000)
FADE = 240


@pytest.fixture
def sound(monkeypatch):
    return use(monkeypatch, SyntheticSoundLibrary(Four=4))


@pytest.fixture
def presenter():
    over = threading.Event()
    new = Presenter(Output(outputs=((7, 1), (3, 2))), lambda stream: over.set())
    new.over = over
    yield new
    new.close()


def test_reference_and_test_alternate_on_their_actuators(sound, presenter):
    run = MatchingRun(PROCEDURE, None)
    presenter.present(run.design, 0.0)
    wait_for(lambda: sound.streams[0].samples.shape[1] > 3 * CYCLE)
    output_samples = sound.streams[0].samples
    expected = ss.stimulus_of(run.design, 48_000)
    for channel, row in zip(expected.channels, expected.samples, strict=True):
        output = {7: 0, 3: 1}[channel.place]
        for cycle in (1, 2):
            begin = cycle * CYCLE + FADE
            played = output_samples[output, begin : begin + CYCLE - 2 * FADE]
            expected_row = np.zeros(CYCLE)
            expected_row[: min(row.size, CYCLE)] = row[:CYCLE]
            np.testing.assert_allclose(played, expected_row[: -2 * FADE], atol=1e-6)
    assert not output_samples[2:].any()


def test_an_arrow_changes_the_test_alone_on_the_same_stream(sound, presenter):
    run = MatchingRun(PROCEDURE, None)
    playing = presenter.present(run.design, 0.0)
    before_db = run.level_db
    assert run.step(1.0)
    assert presenter.present(run.design, 0.0) is playing
    queue = playing.stream.queue
    wait_for(lambda: queue.swap is None and queue.faded == queue.fade.size)
    at = len(sound.streams[0].heard)
    wait_for(lambda: len(sound.streams[0].heard) > at + 2 * CYCLE // 256)
    output_samples = np.concatenate(sound.streams[0].heard[at + 2 :]).T
    factor = 10 ** ((before_db + 1.0) / 20)
    assert np.abs(output_samples[0]).max() == pytest.approx(0.25, rel=0.01)
    assert np.abs(output_samples[1]).max() == pytest.approx(0.25 * factor, rel=0.01)


def test_stopped_at_once_it_is_silent_and_can_be_played_again(sound, presenter):
    run = MatchingRun(PROCEDURE, None)
    presenter.present(run.design, 0.0)
    presenter.stop_at_once()
    # Whoever plays again before the device has noticed gets what was asked for, too.
    playing = presenter.present(run.design, 0.0)
    assert len(sound.streams) == 2
    wait_for(lambda: np.abs(sound.streams[1].samples).max(initial=0.0) > 0.1)
    presenter.stop_at_once()
    wait_for(lambda: playing.stream.queue.ending is not None)
    assert playing.stream.queue.ending.reason == "panic"
