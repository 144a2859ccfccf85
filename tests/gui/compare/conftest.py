"""A window whose Compare panel is in front."""

import pytest


@pytest.fixture
def panel(window, settle):
    window.docks["compare"].bring_forward()
    settle()
    return window.panel("compare")


@pytest.fixture
def requests(window, monkeypatch):
    """What is asked of the engine from now on."""
    asked = []
    ask = window.engine.request
    monkeypatch.setattr(
        window.engine, "request", lambda request: (asked.append(request), ask(request))
    )
    return asked
