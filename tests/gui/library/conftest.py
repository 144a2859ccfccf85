"""The library panel of a studio."""

import pytest


@pytest.fixture
def panel(window, qtbot):
    window.docks["library"].bring_forward()
    qtbot.waitUntil(lambda: window.panel("library").isVisible())
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window.panel("library")
