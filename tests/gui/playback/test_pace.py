"""Slow motion, pause, and what is seen after the last sound."""

from dataclasses import replace

import pytest

from skinsource.design.edits.edit import Edit
from skinsource_gui.state.document import NEW_VIEW
from tests.gui.playback.conftest import DESIGN, TONE

WAIT = {"timeout": 20_000}
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
