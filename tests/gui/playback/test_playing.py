"""Playing: what is heard, limits and edits meanwhile, slow motion, pause, and the last sound."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QObject

import skinsource as ss
from skinsource.design.edits.edit import Edit
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import Playing
from skinsource.lab.playing.stream import START_DB
from skinsource_gui.state.document import NEW_VIEW, Document
from skinsource_gui.state.playing import LiveEdits, Player
from tests.gui.playback.conftest import DESIGN, TONE

WAIT = {"timeout": 20_000}


def settled(player):
    return lambda: not player.playing


def test_it_plays_and_the_playhead_comes_back_where_it_was(sound, studio, player, qtbot, listen):
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


def test_the_limit_stops_and_names_the_output(sound, studio, player, qtbot, arm):
    player.gain.put(6.0)
    arm()
    # It may be over before anybody looks whether it plays.
    studio.do("play_on_actuators")
    qtbot.waitUntil(lambda: "output 1 (place 7)" in studio.notice.text, **WAIT)
    assert "would have passed full scale" in studio.notice.text
    assert not player.playing


def test_stop_at_once_is_silent_and_turns_the_gain_back(sound, studio, player, qtbot, listen):
    player.gain.put(-3.0)
    now = listen(loops=True)
    studio.do("stop_at_once")
    qtbot.waitUntil(settled(player), **WAIT)
    assert now.stream.queue.ending.reason == "panic"
    assert player.gain.gain_db == START_DB
    assert player.peak is None


@pytest.mark.parametrize("stop", ["stop_at_once", "play", "play_on_actuators"])
def test_a_stop_before_the_device_has_begun_holds(sound, studio, player, qtbot, arm, stop):
    arm()
    studio.do("play_on_actuators")
    studio.do(stop)
    assert not player.playing
    # The thread of the sound does one thing after another: this comes after what was stopped.
    done = []
    player._thread.run(lambda: None, lambda *_: done.append(True))
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
    studio.do("play_on_actuators")
    qtbot.waitUntil(settled(player), **WAIT)
    assert document.view.playhead_s == 0.4


def test_space_animates_the_skin_and_moves_no_actuator(sound, studio, player, qtbot, arm, animate):
    arm()
    studio.document.look(replace(studio.document.view, slow_motion=1.0))
    now = animate()
    assert now.stream is None
    assert not player.on_actuators
    assert studio.playback.button.text().endswith("Actuators armed")
    playheads_s = []
    studio.document.playhead_moved.connect(
        lambda: playheads_s.append(studio.document.view.playhead_s)
    )
    # It begins again, also after an edit.
    studio.document.edit("Title", replace(studio.document.design, title="Edited"))
    for _ in range(2):
        playheads_s.clear()
        qtbot.waitUntil(lambda: max(playheads_s, default=0.0) > 0.2, **WAIT)
        qtbot.waitUntil(lambda: playheads_s[-1] < 0.2, **WAIT)
    player.stop()
    qtbot.waitUntil(settled(player), **WAIT)
    assert studio.document.view.playhead_s == 0.0
    assert sound.streams == []


def test_nothing_is_sent_before_the_actuators_are_armed(sound, studio, player, qtbot):
    studio.do("play_on_actuators")
    assert not player.playing
    assert "Arm them under Output" in studio.notice.text
    player.play_tone(1)
    assert not player.playing
    assert sound.streams == []


def test_without_a_device_nothing_is_armed_and_the_reason_is_said(no_sound, studio, player, qtbot):
    player.arm(True)
    qtbot.waitUntil(lambda: "No audio device was found" in studio.notice.text, **WAIT)
    assert player.peak is None


def test_the_peak_follows_edits_and_another_file_disarms(sound, studio, player, qtbot, arm):
    arm()
    assert player.peak.full_scale == pytest.approx(0.9, abs=0.01)
    studio.document.edit("Softer", DESIGN.with_input(0, amplitude=0.2))
    qtbot.waitUntil(lambda: player.peak.full_scale == pytest.approx(0.5, abs=0.01), **WAIT)
    studio.document.undo_stack.undo()
    qtbot.waitUntil(lambda: player.peak.full_scale == pytest.approx(0.9, abs=0.01), **WAIT)
    studio.document.start_over(DESIGN, studio.document.view, None)
    assert player.peak is None
    arm()
    player.settings.choose(Output(device="Eight", host_api="Made up"))
    assert player.peak is None


def test_what_is_chosen_is_kept_on_this_machine_but_not_the_gain(sound, preferences, qapp):
    parent = QObject()
    first = Player(Document(DESIGN), preferences, parent)
    output = replace(first.settings.output, device="Eight", host_api="Made up", latency_s=0.03)
    first.gain.put(-3.0)
    first.settings.choose(output)
    assert first.gain.gain_db == START_DB
    first.gain.put(-3.0)
    second = Player(Document(DESIGN), preferences, parent)
    assert second.settings.output == output
    assert second.gain.gain_db == START_DB
    for player in (first, second):
        player.end()


def test_closing_the_window_lets_go_of_the_device(sound, studio, player, listen):
    listen(loops=True)
    studio.document.mark_saved(studio.document.path)
    studio.close()
    assert not sound.streams[0].active


def test_of_edits_made_while_one_is_rendered_only_the_last_is_rendered_too(qapp):
    document, owner, waiting, rendered = Document(DESIGN), QObject(), [], []

    def change(playing, design, *_, **__):
        rendered.append(design.inputs[0].amplitude)
        return playing

    thread = SimpleNamespace(run=lambda *task: waiting.append(task))
    edits = LiveEdits(document, lambda: SimpleNamespace(change=change), thread, owner)
    edits.begin(Playing(), DESIGN, Output(), None, loops=True)
    for amplitude in (0.5, 0.6, 0.7):
        document.edit("Louder", DESIGN.with_input(0, amplitude=amplitude))
    while waiting:
        work, then = waiting.pop(0)
        then(work(), None)
    assert rendered == [0.5, 0.7]
    edits.end()


RESPONSE_S = 522 / 1300


def test_slow_motion_changes_while_the_wave_runs(sound, studio, player, qtbot, animate):
    document = studio.document
    document.look(replace(document.view, slow_motion=20.0))
    now = animate()
    assert now.visible_s == pytest.approx(0.5 + RESPONSE_S)
    document.look(replace(document.view, slow_motion=1.0))
    assert player.now is now
    qtbot.waitUntil(lambda: document.view.playhead_s > 0.3, **WAIT)
    assert not sound.streams


def test_on_actuators_it_is_played_in_real_time(sound, studio, player, qtbot, listen):
    document = studio.document
    document.look(replace(document.view, slow_motion=50.0))
    now = listen(loops=True)
    assert now.stream is not None
    document.look(replace(document.view, slow_motion=10.0))
    assert player.now is now


def test_faster_and_slower_go_through_the_paces(studio):
    document, factors = studio.document, []
    assert studio.actions_by_name["play_automatic"].isChecked()
    studio.do("play_slower")
    assert document.view.slow_motion == 100.0
    document.look(replace(document.view, slow_motion=1.0))
    for _ in range(9):
        studio.do("play_slower")
        factors.append(document.view.slow_motion)
    assert factors == [2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0]
    studio.do("play_slower")
    assert document.view.slow_motion == 1000.0
    document.look(replace(document.view, slow_motion=30.0))
    studio.do("play_faster")
    assert document.view.slow_motion == 20.0
    for _ in range(5):
        studio.do("play_faster")
    assert document.view.slow_motion == 1.0
    studio.do("play_automatic")
    assert document.view.slow_motion == 0.0
    assert document.undo_stack.count() == 0


def test_the_speed_is_chosen_by_itself_until_the_user_chooses_one(studio, qtbot, animate):
    document, run = studio.document, animate().silent
    assert run.slow_motion == 50.0
    assert 0.25 <= run.position_s() <= 0.26
    document.look(replace(document.view, slow_motion=2.0))
    qtbot.waitUntil(lambda: run.slow_motion == 2.0, **WAIT)
    quick = replace(TONE, frequency_hz=400.0)
    inputs = tuple(
        replace(track, clips=(replace(track.clips[0], waveform=quick),)) for track in DESIGN.inputs
    )
    document.apply(Edit(label="", design=replace(DESIGN, inputs=inputs), view=NEW_VIEW))
    qtbot.waitUntil(lambda: run.slow_motion == 200.0, **WAIT)


def test_a_pause_leaves_the_playhead_where_it_is(studio, player, qtbot, animate):
    document = studio.document
    document.look(replace(document.view, slow_motion=10.0))
    animate()
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
