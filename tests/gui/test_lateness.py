"""Lateness is told after a while; being up to date, at once."""

import pytest

from skinsource_gui.qt.overlays import Staleness


@pytest.fixture
def told(qapp):
    lateness = Staleness(qapp)
    lateness.said = []
    lateness.changed.connect(lateness.said.append)
    yield lateness
    lateness.deleteLater()


def test_what_is_soon_up_to_date_again_is_never_called_late(told, qtbot):
    told.set_stale(True)
    told.set_stale(False)
    other = Staleness(told)
    other.set_stale(True)
    qtbot.waitUntil(lambda: other.late)
    assert told.said == []


def test_lateness_is_told_once_and_ends_at_once(told, qtbot):
    told.set_stale(True)
    qtbot.waitUntil(lambda: told.late)
    told.set_stale(True)
    told.set_stale(False)
    told.set_stale(False)
    assert told.said == [True, False]


def test_a_second_edit_does_not_postpone_it(told, qtbot):
    told.set_stale(True)
    other = Staleness(told)
    other.set_stale(True)
    # Asked again and again, as by a drag.
    qtbot.waitUntil(lambda: told.set_stale(True) or told.late)
    assert told.said == [True]
