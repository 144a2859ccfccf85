"""A stimulus that takes long to compute is waited for with words, and given up at once."""

from threading import Event

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QProgressBar

from skinsource.base.job import stop_if
from skinsource.export.stimulus_export import preparing
from skinsource_gui.pages.stimulus import page as preparing_worker
from tests.gui.stimulus.stimulus_bench import WAIT_MS, label


@pytest.fixture
def gate(monkeypatch):
    """Set it, and a stimulus is prepared; nothing is before."""
    gate, whole = Event(), preparing.prepare_stimulus

    def held(*arguments, progress, stop, **options):
        progress(1, 4, "Computing")
        while not gate.wait(0.01):
            stop_if(stop)
        return whole(*arguments, progress=progress, stop=stop, **options)

    monkeypatch.setattr(preparing_worker, "prepare_stimulus", held)
    yield gate
    gate.set()


def bar_of(page):
    return page.findChild(QProgressBar, "stimulus_progress")


def pale(page, name):
    effect = page.findChild(QLabel, f"stimulus_{name}").graphicsEffect()
    return effect is not None and effect.isEnabled()


def test_the_page_says_that_it_computes_and_how_far_it_is(desk, qtbot, gate):
    desk.exports.show("stimulus")
    page = desk.exports.page.part
    qtbot.waitExposed(page)
    bar = bar_of(page)
    qtbot.waitUntil(lambda: bar.isVisible() and bar.text() == "Computing… 25 %")
    assert (bar.value(), bar.maximum()) == (1, 4)
    gate.set()
    qtbot.waitUntil(lambda: page.ready, timeout=WAIT_MS)
    assert not bar.isVisible()
    desk.exports.end()


def test_escape_leaves_the_page_while_it_computes(desk, qtbot, gate):
    desk.exports.show("stimulus")
    page = desk.exports.page.part
    qtbot.waitUntil(lambda: bar_of(page).isVisible())
    with qtbot.waitSignal(page.window().finished):
        QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert not gate.is_set()


def test_what_is_said_of_another_order_is_as_pale_as_its_picture(page, qtbot, gate):
    assert not pale(page, "summary")
    page.form.field("rate").choose("8000")
    assert page.busy
    assert "48 kHz" in label(page, "summary")
    assert pale(page, "summary")
    assert pale(page, "loses")
    gate.set()
    qtbot.waitUntil(lambda: page.ready, timeout=WAIT_MS)
    assert not pale(page, "summary")
    assert "8 kHz" in label(page, "summary")
