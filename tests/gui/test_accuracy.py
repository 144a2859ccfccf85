"""The error of what is on screen is checked when edits pause, and kept where times are."""

import pytest

from skinsource_gui.shell.status import rounded_up


@pytest.fixture
def checked(window):
    checks = []
    window.accuracy.checked.connect(checks.append)
    return checks


def known(checked):
    return bool(checked) and checked[-1] is not None


def test_when_edits_pause_the_error_is_checked(qtbot, window, checked):
    window.document.edit("a", window.document.design.with_input(0, amplitude=2.0))
    qtbot.waitUntil(lambda: known(checked), timeout=5000)
    assert 0 < checked[-1].estimate < 1e-14
    assert checked[-1].estimate < checked[-1].bound < 1e-10
    assert window.status_line.error is checked[-1]


def test_an_edit_takes_the_old_error_away_at_once(qtbot, window, checked):
    qtbot.waitUntil(lambda: known(checked), timeout=5000)
    window.document.edit("a", window.document.design.with_input(0, amplitude=3.0))
    qtbot.waitUntil(lambda: checked[-1] is None)
    assert window.status_line.error is None


def test_without_traces_nothing_is_checked(qtbot, window, checked):
    window.docks["traces"].close()
    qtbot.waitUntil(lambda: not window.engine.busy)
    window.document.edit("a", window.document.design.with_input(0, amplitude=4.0))
    qtbot.waitUntil(lambda: not window.engine.busy)
    assert window.accuracy._shown is None


@pytest.mark.parametrize(
    ("error", "shown"),
    [
        (1.2e-15, "2e-15"),
        (2e-15, "2e-15"),
        (9.3e-15, "1e-14"),
        (0.0, "3e-16"),
        (0.04, "4e-2"),
        (1.0, "1e0"),
    ],
)
def test_an_error_is_never_shown_smaller_than_it_is(error, shown):
    assert rounded_up(error) == shown
    assert float(shown) >= error
