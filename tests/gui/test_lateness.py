"""Lateness is told after a while; being up to date, at once."""

import pytest

from skinsource_gui.qt.overlays import Staleness


@pytest.fixture
def lateness(qapp):
    lateness = Staleness(qapp)
    lateness.changes = []
    lateness.changed.connect(lateness.changes.append)
    yield lateness
    lateness.deleteLater()


def test_what_is_soon_up_to_date_again_is_never_called_late(lateness, qtbot):
    lateness.set_stale(True)
    lateness.set_stale(False)
    other = Staleness(lateness)
    other.set_stale(True)
    qtbot.waitUntil(lambda: other.is_stale)
    assert lateness.changes == []


def test_lateness_is_told_once_and_ends_at_once(lateness, qtbot):
    lateness.set_stale(True)
    qtbot.waitUntil(lambda: lateness.is_stale)
    lateness.set_stale(True)
    lateness.set_stale(False)
    lateness.set_stale(False)
    assert lateness.changes == [True, False]
