"""The number of an input on its colour."""

import pytest
from PySide6.QtGui import QFont, QFontMetrics
from PySide6.QtWidgets import QHBoxLayout, QWidget

from skinsource_gui.qt.buttons import SWATCH_PX, Swatch


@pytest.mark.parametrize("number", [3, 20, 128])
@pytest.mark.parametrize("letters_px", [13, 26, 39])
def test_the_number_is_whole_in_letters_of_any_size(qtbot, number, letters_px):
    shown = QWidget()
    qtbot.addWidget(shown)
    swatch, row = Swatch(), QHBoxLayout(shown)
    row.addWidget(swatch)
    shown.show()
    swatch.show_input(number, 0, silent=False)
    font = QFont(shown.font())
    font.setPixelSize(letters_px)
    swatch.setFont(font)
    qtbot.waitUntil(lambda: swatch.size() == swatch.sizeHint())
    font.setWeight(QFont.Weight.DemiBold)
    metrics = QFontMetrics(font)
    assert swatch.width() > metrics.horizontalAdvance(str(number))
    assert swatch.height() > metrics.height()
    if letters_px == 13 and number < 100:
        assert (swatch.width(), swatch.height()) == (SWATCH_PX, SWATCH_PX)
