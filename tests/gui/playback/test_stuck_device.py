"""A device that never answers keeps the studio from ending for a while only."""

import threading

import pytest
from PySide6.QtCore import QObject

from skinsource_gui.app import app
from skinsource_gui.state import playing
from skinsource_gui.state.playing import device_is_stuck, end_sound, sound_worker


@pytest.fixture
def device(qtbot):
    """Answers once it is set, at the latest at the end of the test."""
    answers = threading.Event()
    yield answers
    answers.set()
    qtbot.waitUntil(lambda: not device_is_stuck())


def test_the_end_does_not_wait_for_a_device_that_is_stuck(device, monkeypatch, qtbot):
    monkeypatch.setattr(playing, "LONGEST_END_S", 0.01)
    parent, closed = QObject(), threading.Event()
    worker = sound_worker(parent)
    worker.run(device.wait)
    end_sound(worker, closed.set)
    assert not closed.is_set()
    assert device_is_stuck()
    # One that answers after all is closed in order.
    device.set()
    assert closed.wait(20)
    qtbot.waitUntil(lambda: not device_is_stuck())


def test_the_end_waits_for_a_device_that_answers(device):
    parent, done = QObject(), []
    worker = sound_worker(parent)
    worker.run(lambda: done.append("played"))
    end_sound(worker, lambda: done.append("closed"))
    assert done == ["played", "closed"]
    assert not device_is_stuck()


@pytest.mark.parametrize("stuck", [True, False])
def test_only_a_stuck_device_ends_the_process_at_once(monkeypatch, stuck):
    ended = []
    monkeypatch.setattr(app, "device_is_stuck", lambda: stuck)
    monkeypatch.setattr(app.os, "_exit", ended.append)
    app.end_if_stuck(3)
    assert ended == ([3] if stuck else [])
