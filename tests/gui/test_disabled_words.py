"""What can do nothing now looks so, in every theme."""

import pytest
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QToolButton

from skinsource_gui.panels.hand.layout import contrast
from skinsource_gui.qt.theme import LIGHT, THEMES, apply_theme


@pytest.fixture
def themed(qapp):
    """Gives all widgets a theme; afterwards they have the usual one."""
    yield lambda theme: apply_theme(qapp, theme)
    apply_theme(qapp, LIGHT)


@pytest.mark.parametrize("theme", THEMES.values(), ids=THEMES)
def test_a_button_that_can_do_nothing_is_told_from_one_that_can(qtbot, themed, theme):
    themed(theme)
    button = QToolButton(text="Undo")
    qtbot.addWidget(button)
    pictures = []
    for enabled in (True, False):
        button.setEnabled(enabled)
        button.show()
        picture = button.grab().toImage()
        ground = picture.pixelColor(2, 2)
        inks = [
            picture.pixelColor(x, y)
            for x in range(4, picture.width() - 4)
            for y in range(4, picture.height() - 4)
        ]
        pictures.append(max(contrast(ink, ground) for ink in inks))
    can, cannot = pictures
    assert can > 1.5 * cannot
    assert contrast(QColor(theme.disabled), QColor(theme.window)) > 4.5
