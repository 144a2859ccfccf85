"""Each test has a studio of its own: what it leaves behind lies in the test's own folder."""

import pytest


@pytest.fixture
def window(new_window):
    return new_window
