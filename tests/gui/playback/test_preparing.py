"""A long design takes a while before it plays: that is said, and can be cancelled."""

import threading

import pytest

from skinsource.lab.playing import session

WAIT = {"timeout": 20_000}


@pytest.fixture
def armed(sound, arm):
    """Actuators that are armed before mixes take long."""
    arm()


@pytest.fixture
def made(monkeypatch):
    """Lets a mix be made once it is set, at the latest at the end of the test."""
    ready, mix = threading.Event(), session.Mixer.mix

    def slowly(self, *given, **more):
        assert ready.wait(20)
        return mix(self, *given, **more)

    monkeypatch.setattr(session.Mixer, "mix", slowly)
    yield ready
    ready.set()


def test_it_is_said_that_sound_is_prepared_until_it_plays(
    sound, studio, player, qtbot, armed, made
):
    button = studio.playback.button
    studio.do("play_on_actuators")
    assert button.text().endswith("Preparing…")
    assert studio.playback.bar.play.accessibleName() == "Stop"
    made.set()
    qtbot.waitUntil(lambda: player.now is not None, **WAIT)
    assert button.text().endswith("Actuators playing")
    player.stop_at_once()
    qtbot.waitUntil(lambda: not player.playing, **WAIT)
    assert button.text().endswith("Actuators off")


def test_what_is_played_after_something_was_cancelled_is_what_is_heard(
    sound, studio, player, qtbot, armed, made
):
    for _ in range(3):
        studio.do("play_on_actuators")
    assert player.preparing
    made.set()
    qtbot.waitUntil(lambda: player.now is not None, **WAIT)
    assert len(sound.streams) == 1
    assert not player.preparing
    player.stop_at_once()
    qtbot.waitUntil(lambda: not player.playing, **WAIT)
