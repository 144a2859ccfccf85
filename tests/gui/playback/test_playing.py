import threading
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QObject
from PySide6.QtWidgets import QPushButton

import skinsource as ss
from skinsource.lab.playing import mixer
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.mix import START_DB
from skinsource_gui.state import playing as live_edits
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing import LiveEdits
from skinsource_gui.state.preferences import start_design
from tests.gui.playback.conftest import DESIGN

WAIT = {"timeout": 20_000}


def settled(player):
    return lambda: not player.playing


def test_space_plays_and_the_playhead_comes_back_where_it_was(sound, studio, player, qtbot, listen):
    document = studio.document
    document.look(replace(document.view, playhead_s=0.1))
    playheads_s = []
    document.playhead_moved.connect(lambda: playheads_s.append(document.view.playhead_s))
    listen()
    qtbot.waitUntil(settled(player), **WAIT)
    assert playheads_s[-1] == 0.1
    assert min(playheads_s) >= 0.1
    assert max(playheads_s) > 0.1
    assert document.undo_stack.count() == 0
    # From the playhead on, at the gain that it starts with.
    samples = sound.streams[0].samples
    expected = ss.stimulus_of(DESIGN, 48_000).samples[:, 4800:] * 0.1
    assert samples[:, 240 : 240 + expected.shape[1]] == pytest.approx(expected, abs=1e-7)


def test_a_playhead_that_runs_evaluates_nothing(sound, studio, player, qtbot, listen):
    listen(loops=True)
    asked = []
    studio.conductor.delivered.connect(asked.append)
    steps = []
    studio.document.playhead_moved.connect(lambda: steps.append(1))
    changes = []
    studio.document.changed.connect(lambda: changes.append(1))
    qtbot.waitUntil(lambda: len(steps) > 10, **WAIT)
    assert (asked, changes) == ([], [])


def test_space_again_fades_out(sound, studio, player, qtbot, listen):
    now = listen(loops=True)
    studio.do("play")
    qtbot.waitUntil(settled(player), **WAIT)
    assert now.stream.queue.ending.reason == "stopped"
    assert studio.notice.text == ""
    assert studio.document.view.playhead_s == 0.0


def test_an_edit_is_heard_while_it_loops_without_a_click(sound, studio, player, qtbot, listen):
    now = listen(loops=True)
    softer = DESIGN.with_input(0, amplitude=0.2)
    studio.document.edit("Softer", softer)
    qtbot.waitUntil(lambda: player.edits.render_s > 0, **WAIT)
    heard_to = now.stream.queue.played_samples
    qtbot.waitUntil(lambda: now.stream.queue.played_samples > heard_to + 30_000, **WAIT)
    samples = sound.streams[0].samples.astype(float)
    assert np.abs(samples[0, -24_000:]).max() == pytest.approx(0.02, rel=0.02)
    own = np.abs(np.diff(ss.stimulus_of(DESIGN, 48_000).samples)).max() * 0.1
    assert np.abs(np.diff(samples)).max() <= own + 0.1 * 2 * np.pi / 2 / 240
    delay = now.stream.delay(player.edits.render_s)
    assert delay.device_s == pytest.approx(0.015)
    assert delay.total_s == pytest.approx(delay.render_s + delay.wait_s + delay.device_s)


def test_an_edit_that_cannot_be_played_leaves_what_is_heard(sound, studio, player, qtbot, listen):
    now = listen(loops=True)
    nine = tuple(ss.track(place, amplitude=0.1) for place in (7, 12, 9))
    studio.document.edit("Add", replace(DESIGN, inputs=nine))
    qtbot.waitUntil(lambda: "Two has 2 outputs" in studio.notice.text, **WAIT)
    assert player.now is now
    assert now.stream.queue.ending is None


def test_the_limit_stops_and_names_the_output(sound, studio, player, qtbot):
    player.gain.put(6.0)
    # It may be over before anybody looks whether it plays.
    studio.do("play")
    qtbot.waitUntil(lambda: "output 1 (place 7)" in studio.notice.text, **WAIT)
    assert "would have passed full scale" in studio.notice.text
    assert not player.playing
    assert np.abs(sound.streams[0].samples).max() <= 1.0


def test_stop_at_once_is_silent_and_turns_the_gain_back(sound, studio, player, qtbot, listen):
    player.gain.put(-3.0)
    now = listen(loops=True)
    studio.do("stop_at_once")
    qtbot.waitUntil(settled(player), **WAIT)
    assert now.stream.queue.ending.reason == "panic"
    assert player.gain.gain_db == START_DB


@pytest.mark.parametrize("stop", ["stop_at_once", "play"])
def test_a_stop_before_the_device_has_begun_holds(sound, studio, player, qtbot, stop):
    studio.do("play")
    studio.do(stop)
    assert not player.playing
    # The thread of the sound does one thing after another: this comes after what was stopped.
    done = []
    player._thread.do(lambda: None, lambda *_: done.append(True))
    qtbot.waitUntil(lambda: bool(done), **WAIT)
    qtbot.waitUntil(lambda: not any(stream.active for stream in sound.streams), **WAIT)
    assert player.now is None


def test_a_device_that_is_pulled_out_is_said(sound, studio, player, qtbot, listen):
    listen(loops=True)
    sound.streams[0].pull_out()
    qtbot.waitUntil(lambda: "may have been unplugged" in studio.notice.text, **WAIT)
    assert not player.playing


def test_the_gain_reaches_what_is_heard(sound, studio, player, qtbot, listen):
    now = listen(loops=True)
    studio.do("play_louder")
    studio.do("play_louder")
    assert player.gain.gain_db == START_DB + 2
    assert studio.playback.bar.gain.value_si == START_DB + 2
    assert now.stream.queue.gain_db == pytest.approx(START_DB + 2)
    studio.do("play_softer")
    assert now.stream.queue.gain_db == pytest.approx(START_DB + 1)
    player.gain.put(900.0)
    assert player.gain.gain_db == 20.0


def test_a_playhead_that_is_put_elsewhere_is_followed(sound, studio, player, qtbot, listen):
    now = listen(loops=True)
    queue = now.stream.queue
    document = studio.document
    document.look(replace(document.view, playhead_s=0.4))
    qtbot.waitUntil(lambda: queue.swap is None and queue.position > 0.39 * 48_000, **WAIT)
    studio.do("play")
    qtbot.waitUntil(settled(player), **WAIT)
    assert document.view.playhead_s == 0.4


def test_without_a_device_the_playhead_runs_in_silence(no_sound, studio, player, qtbot, listen):
    now = listen()
    assert now.stream is None
    # The status bar would cut it.
    text = studio.notice.text
    assert text.startswith("In silence: No device to play on was found.")
    playheads_s = []
    studio.document.playhead_moved.connect(
        lambda: playheads_s.append(studio.document.view.playhead_s)
    )
    qtbot.waitUntil(settled(player), **WAIT)
    assert max(playheads_s) > 0.2
    assert studio.document.view.playhead_s == 0.0


def test_what_is_chosen_is_kept_on_this_machine_but_not_the_gain(sound, make_window, preferences):
    first = make_window(DESIGN).playback.player
    output = replace(first.settings.output, device="Eight", host_api="Made up", latency_s=0.03)
    first.gain.put(-3.0)
    first.settings.choose(output)
    assert first.gain.gain_db == START_DB
    second = make_window(DESIGN).playback.player
    assert second.settings.output == output
    assert second.gain.gain_db == START_DB


def test_another_output_ends_what_is_played(sound, studio, player, qtbot, listen):
    listen(loops=True)
    player.settings.choose(replace(player.settings.output, stand_in=True))
    qtbot.waitUntil(settled(player), **WAIT)
    now = listen()
    qtbot.waitUntil(lambda: now.stream.queue.mix is not None, **WAIT)
    assert now.stream.queue.mix.names == ("left", "right")


def test_closing_the_window_lets_go_of_the_device(sound, studio, player, listen):
    listen(loops=True)
    studio.document.mark_saved(studio.document.path)
    studio.close()
    assert not sound.streams[0].active


RESPONSE_S = 522 / 1300


def test_slow_motion_runs_in_silence_and_complains_of_nothing(sound, studio, player, qtbot, listen):
    document = studio.document
    document.look(replace(document.view, slow_motion=20.0))
    now = listen()
    assert now.stream is None
    assert not sound.streams
    assert player.settings.missing == ""
    assert not studio.notice.text.startswith("In silence")
    assert now.visible_s == pytest.approx(0.5 + RESPONSE_S)


def test_faster_and_slower_go_through_the_paces(studio):
    document, factors = studio.document, []
    for _ in range(9):
        studio.do("play_slower")
        factors.append(document.view.slow_motion)
    assert factors == [2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 200.0, 200.0]
    document.look(replace(document.view, slow_motion=30.0))
    studio.do("play_faster")
    assert document.view.slow_motion == 20.0
    for _ in range(5):
        studio.do("play_faster")
    assert document.view.slow_motion == 1.0
    assert document.undo_stack.count() == 0


def test_another_pace_goes_on_where_it_is(no_sound, studio, player, qtbot, listen):
    document = studio.document
    document.look(replace(document.view, slow_motion=50.0, playhead_s=0.2))
    now = listen()
    document.look(replace(document.view, slow_motion=200.0))
    assert player.now is now
    assert now.silent._slow_motion == 200.0
    assert 0.2 <= now.position_s() < 0.3
    assert 0.2 <= document.view.playhead_s < 0.3


def test_a_pause_leaves_the_playhead_where_it_is(no_sound, studio, player, qtbot, listen):
    document = studio.document
    document.look(replace(document.view, slow_motion=10.0))
    listen()
    qtbot.waitUntil(lambda: document.view.playhead_s > 0.01, **WAIT)
    studio.do("pause")
    qtbot.waitUntil(lambda: not player.playing, **WAIT)
    stands_s = document.view.playhead_s
    assert stands_s > 0.01
    studio.do("pause")
    qtbot.waitUntil(lambda: player.now is not None, **WAIT)
    qtbot.waitUntil(lambda: document.view.playhead_s > stands_s, **WAIT)
    assert document.view.playhead_s < stands_s + 0.5


def test_the_playhead_runs_on_until_the_skin_is_at_rest(sound, studio, player, qtbot, listen):
    playheads_s = []
    studio.document.playhead_moved.connect(
        lambda: playheads_s.append(studio.document.view.playhead_s)
    )
    listen()
    qtbot.waitUntil(lambda: not player.playing, timeout=30_000)
    assert max(playheads_s) > 0.5 + 0.8 * RESPONSE_S
    assert playheads_s[-1] == 0.0
    assert studio.notice.text == ""


@pytest.fixture
def made(monkeypatch):
    """Lets a mix be made once it is set, at the latest at the end of the test."""
    ready, mix = threading.Event(), mixer.Mixer.mix

    def slowly(self, *given, **more):
        assert ready.wait(20)
        return mix(self, *given, **more)

    monkeypatch.setattr(mixer.Mixer, "mix", slowly)
    yield ready
    ready.set()


def test_it_is_said_that_sound_is_prepared_until_it_plays(sound, studio, player, qtbot, made):
    note = studio.playback.note
    studio.do("play")
    assert not note.isVisible()
    qtbot.waitUntil(note.isVisible, **WAIT)
    assert studio.playback.bar.play.accessibleName() == "Stop"
    made.set()
    qtbot.waitUntil(lambda: player.now is not None, **WAIT)
    assert not note.isVisible()
    player.stop_at_once()
    qtbot.waitUntil(lambda: not player.playing, **WAIT)


def test_what_is_prepared_can_be_cancelled_and_is_not_played(sound, studio, player, qtbot, made):
    note = studio.playback.note
    studio.do("play")
    qtbot.waitUntil(note.isVisible, **WAIT)
    note.findChild(QPushButton, "cancel_preparing").click()
    assert not note.isVisible()
    assert not player.playing
    made.set()
    # The thread of the sound does one thing after another: this comes after it.
    done, failed = [], []
    player.failed.connect(failed.append)
    player._thread.do(lambda: None, lambda *_: done.append(True))
    qtbot.waitUntil(lambda: bool(done), **WAIT)
    assert player.now is None
    assert (sound.streams, failed) == ([], [])


def test_what_is_played_after_something_was_cancelled_is_what_is_heard(
    sound, studio, player, qtbot, made
):
    studio.do("play")
    studio.do("play")
    studio.do("play")
    assert player.preparing
    made.set()
    qtbot.waitUntil(lambda: player.now is not None, **WAIT)
    assert len(sound.streams) == 1
    assert not player.preparing
    player.stop_at_once()
    qtbot.waitUntil(lambda: not player.playing, **WAIT)


class Clock:
    """Seconds, as told."""

    now_s = 100.0

    def __call__(self):
        return self.now_s


class HeldThread:
    """Does what it was given when it is told to, in so many seconds."""

    def __init__(self, clock):
        self._clock, self._waiting = clock, []

    def do(self, work, then):
        self._waiting.append((work, then))

    def finish(self, took_s):
        """Do the next thing."""
        work, then = self._waiting.pop(0)
        self._clock.now_s += took_s
        then(work(), None)


@pytest.fixture
def clock(monkeypatch):
    clock = Clock()
    monkeypatch.setattr(live_edits, "perf_counter", clock)
    return clock


def test_an_edit_that_waits_for_the_one_before_it_is_late_by_that_too(qapp, clock):
    document, owner, thread = Document(start_design("synthetic-1")), QObject(), HeldThread(clock)
    playing = object()
    session = SimpleNamespace(made=SimpleNamespace(change=lambda *_, **__: playing))
    edits = LiveEdits(document, session, thread, owner)
    design = document.design
    edits.begin(playing, design, Output(), None, loops=True)

    def edit(amplitude):
        document.edit("Louder", design.with_input(0, amplitude=amplitude))

    edit(0.5)
    clock.now_s += 0.010
    edit(0.6)
    clock.now_s += 0.005
    edit(0.7)
    thread.finish(took_s=0.025)
    assert edits.render_s == pytest.approx(0.040)
    # Both that waited are rendered at once; the first of them waited for 30 ms.
    thread.finish(took_s=0.040)
    assert edits.render_s == pytest.approx(0.070)
    clock.now_s += 1.0
    edit(0.8)
    thread.finish(took_s=0.020)
    assert edits.render_s == pytest.approx(0.020)
    edits.end()
