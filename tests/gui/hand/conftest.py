"""The hand panel, driven by real mouse and key events."""

import pytest

from tests.gui.hand.bench import Studio


@pytest.fixture
def studio(qtbot) -> Studio:
    return Studio(qtbot)
