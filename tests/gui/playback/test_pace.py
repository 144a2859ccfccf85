"""Slow motion, pause, and what is seen after the last sound."""

from dataclasses import replace

import pytest

WAIT = {"timeout": 20_000}
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


def test_from_slow_motion_to_sound_and_back(sound, studio, player, qtbot, listen):
    document = studio.document
    document.look(replace(document.view, slow_motion=50.0))
    studio.do("repeat")
    slow = listen()
    document.look(replace(document.view, slow_motion=1.0))
    qtbot.waitUntil(lambda: player.now is not slow and player.now is not None, **WAIT)
    sounding = player.now
    assert sounding.stream is not None
    document.look(replace(document.view, slow_motion=10.0))
    qtbot.waitUntil(lambda: player.now is not sounding and player.now is not None, **WAIT)
    assert player.now.silent is not None
    assert not sound.streams[0].active


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
