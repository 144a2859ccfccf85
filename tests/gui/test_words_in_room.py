"""Words of buttons are written as large as there is room, and stay so."""

import pytest
from PySide6.QtWidgets import QPushButton, QToolButton

from skinsource_gui.theme import scaled
from skinsource_gui.widgets.words_in_room import width_in


@pytest.mark.parametrize("kind", [QToolButton, QPushButton])
def test_how_wide_a_button_would_be_does_not_depend_on_how_it_is_written_now(qtbot, kind):
    button = kind()
    qtbot.addWidget(button)
    button.setText("Remove 52 ms delay")
    usual = button.font()
    found = set()
    for scale in (1.0, 0.9, 0.8, 0.7, 0.6, 1.5):
        button.setFont(scaled(usual, scale))
        assert width_in(button.font(), [button]) == button.sizeHint().width()
        found.add(width_in(usual, [button]))
    assert len(found) == 1
