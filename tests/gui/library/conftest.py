"""The library panel of a studio."""

import pytest


@pytest.fixture
def panel(window, qtbot):
    window.docks["library"].bring_forward()
    qtbot.waitUntil(lambda: window.panel("library").isVisible())
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window.panel("library")


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window
