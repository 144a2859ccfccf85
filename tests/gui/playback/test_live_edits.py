"""How late an edit comes is told from when it was made."""

from types import SimpleNamespace

import pytest
from PySide6.QtCore import QObject

from skinsource.lab.playing.devices import Output
from skinsource_gui.state import playing as live_edits
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing import LiveEdits
from skinsource_gui.state.preferences import start_design


class Clock:
    """Seconds, as told."""

    now_s = 100.0

    def __call__(self):
        return self.now_s


class HeldThread:
    """Does what it was given when it is told to, in so many seconds."""

    def __init__(self, clock):
        self._clock, self._waiting = clock, []

    def run(self, work, then):
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
    session = SimpleNamespace(change=lambda *_, **__: playing)
    edits = LiveEdits(document, lambda: session, thread, owner)
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
