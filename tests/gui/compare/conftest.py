"""A window whose panel of snapshots is in front."""

import pytest


@pytest.fixture
def panel(window, settle):
    window.docks["compare"].bring_forward()
    settle()
    return window.panel("compare")


@pytest.fixture
def requests(window, monkeypatch):
    """Slots of what is asked of the engine from now on."""
    asked = []
    ask = window.engine.request
    monkeypatch.setattr(
        window.engine, "request", lambda request: (asked.append(request.slot.name), ask(request))
    )
    return asked
