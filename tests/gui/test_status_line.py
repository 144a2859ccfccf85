"""What the status bar tells of results, and what is kept of times and error."""

from dataclasses import replace
from itertools import pairwise

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QApplication

from skinsource.design.design import track
from skinsource.design.panel_settings import with_settings
from skinsource.engine.gains import TraceError
from skinsource_gui.panels.skin.settings import SENSATION, SkinSettings
from skinsource_gui.shell.status import summary


@pytest.fixture
def wait_for(window, qtbot):
    """Wait until the status line has a text."""
    return lambda text: qtbot.waitUntil(lambda: window.status_line.text() == text, timeout=10_000)


def edit(window, **changes):
    window.document.edit("a", window.document.design.with_input(0, **changes))


SHOWN = "Predicted acceleration, back of the hand"


def test_the_middle_says_what_the_skin_shows_and_how_many_inputs_are_felt(window, wait_for):
    wait_for(SHOWN)
    inputs = (track(location=3, muted=True), track(location=4, colour=1))
    window.document.edit("a", replace(window.document.design, inputs=inputs))
    wait_for(f"{SHOWN} · 1 of 2 inputs play")
    view, settings = window.document.view, SkinSettings(quantity=SENSATION)
    window.document.look(with_settings(view, "skin", settings))
    wait_for(
        "Predicted level above the threshold of detection, back of the hand · 1 of 2 inputs play"
    )
    window.document.edit("a", replace(window.document.design, inputs=()))
    wait_for("No input yet")


def test_while_results_are_awaited_it_says_so(window, wait_for, monkeypatch):
    edit(window, amplitude=2.0)
    wait_for(SHOWN)
    asked = []
    with monkeypatch.context() as patch:
        patch.setattr(window.engine, "request", asked.append)
        edit(window, amplitude=3.0)
        wait_for(f"{SHOWN} · computing…")
    window.engine.request(asked[-1])
    wait_for(SHOWN)


def test_a_message_is_shown_in_the_middle_and_goes_while_the_chip_stays(window, wait_for):
    chip = window.conditions.chip
    assert chip.x() < window.status_line.x() < 200
    window.reports.report("Snapshot 1 is shown")
    assert window.status_line.text() == "Snapshot 1 is shown"
    assert chip.isVisible()
    window.statusBar().clearMessage()
    wait_for(SHOWN)


def test_an_edit_is_timed_from_hand_to_screen(window, qtbot):
    times = window.status_line.clock.times
    before = len(times.seconds())
    edit(window, amplitude=2.0)
    qtbot.waitUntil(lambda: len(times.seconds()) > before)
    assert times.seconds()[-1] > 0.0
    assert window.status_line.times_and_error().startswith("Last ")


def test_times_are_summed_up_by_median_95_percent_and_slowest():
    seconds = (0.004, 0.008, 0.3)
    assert summary(seconds) == "Last 3 edits: median 8.0 ms, 95 % within 300 ms, slowest 300 ms."
    assert summary(()) == ""
    assert "95 % within 95 ms" in summary(tuple(k * 1e-3 for k in range(1, 101)))


def test_the_error_of_the_traces_is_kept_for_the_page_on_accuracy(window, wait_for):
    line = window.status_line
    wait_for(SHOWN)
    line.show_error(TraceError(estimate=1.2e-15, bound=3.4e-13))
    assert line.times_and_error().endswith("Traces that are shown: error ≈ 2e-15, at most 4e-13.")
    assert line.text() == SHOWN


def test_nothing_in_the_status_bar_is_clipped(window, wait_for):
    window.resize(1366, 768)
    edit(window, amplitude=2.0)
    wait_for(SHOWN)
    QApplication.processEvents()
    shown = window.conditions.chip, window.status_line, window._get_limbs
    assert window.statusBar().height() <= 24
    places = sorted((label.mapTo(window, QPoint()).x(), label.width()) for label in shown)
    for (left, width), (following, _) in pairwise(places):
        assert left + width <= following
