"""The hand panel, driven by real mouse and key events."""

import pytest

from skinsource_gui.panels.hand.panel import HandPanel
from tests.gui.hand.bench import Studio


@pytest.fixture
def studio(qtbot) -> Studio:
    panel = HandPanel()
    qtbot.addWidget(panel)
    panel.resize(260, 330)
    with qtbot.waitExposed(panel):
        panel.show()
    studio = Studio(panel)
    studio.show()
    return studio
