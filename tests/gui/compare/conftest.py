"""A window whose Compare panel is in front."""

import pytest


@pytest.fixture
def panel(window, settle):
    window.docks["compare"].bring_forward()
    settle()
    return window.panel("compare")
