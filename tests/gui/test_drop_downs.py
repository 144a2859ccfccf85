"""Drop-down lists, as they look."""

from collections import Counter

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.qt.theme import THEMES, current_theme
from tests.gui.hand.bench import contrast

SPEC = ChoiceSpec(label="Size", options=(("s", "Small"), ("m", "Medium"), ("l", "Large")))
READABLE = 4.5


@pytest.fixture(params=["light", "dark"])
def field(request, qtbot, use_theme):
    use_theme(THEMES[request.param])
    parent = QWidget()
    qtbot.addWidget(parent)
    field = ChoiceField(SPEC)
    QVBoxLayout(parent).addWidget(field)
    parent.show()
    qtbot.waitExposed(parent)
    field.showPopup()
    qtbot.waitUntil(lambda: field.view().isVisible())
    yield field
    field.hidePopup()


def entry_colours(field, row):
    """Ground of an entry, and the pixel on it that stands out most: the ink of its words."""
    view = field.view()
    area = view.visualRect(view.model().index(row, 0)).adjusted(3, 3, -3, -3)
    picture = view.viewport().grab(area).toImage()
    counted = Counter(
        picture.pixel(x, y) for y in range(picture.height()) for x in range(picture.width())
    )
    ground = QColor(counted.most_common(1)[0][0])
    ink = max((QColor(argb) for argb in counted), key=lambda colour: contrast(colour, ground))
    return ground, ink


def test_the_highlighted_entry_can_be_read_and_stands_out(field):
    for _ in range(2):
        QTest.keyClick(field.view(), Qt.Key.Key_Down)
    QApplication.processEvents()
    assert field.view().currentIndex().row() == 2
    ground, ink = entry_colours(field, 2)
    assert contrast(ink, ground) >= READABLE
    assert ground.name() == current_theme().accent


def test_the_wheel_alone_gives_the_focus_to_nothing_that_it_would_change(window):
    """Qt gives the focus before it delivers the wheel, which sent events do not do."""
    for widget in window.findChildren(QWidget):
        if isinstance(widget, QComboBox | QAbstractSpinBox | QLineEdit | QAbstractSlider):
            assert (
                not widget.focusPolicy() & Qt.FocusPolicy.WheelFocus & ~Qt.FocusPolicy.StrongFocus
            )
    assert window.findChildren(ChoiceField)
