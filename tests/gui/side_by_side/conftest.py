"""A window whose panel of maps side by side is in front."""

import pytest


@pytest.fixture
def panel(window, settle):
    window.docks["side_by_side"].bring_forward()
    settle()
    return window.panel("side_by_side")
