"""Lines for names that are there already."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLineEdit, QVBoxLayout, QWidget

from skinsource_gui.qt.labels import NameLine


@pytest.fixture
def around(qtbot):
    host = QWidget()
    qtbot.addWidget(host)
    return host


@pytest.fixture
def line(around):
    column = QVBoxLayout(around)
    column.addWidget(QLineEdit())
    line = NameLine()
    column.addWidget(line)
    around.show()
    around.findChild(QLineEdit).setFocus()
    line.setText("hand")
    return line


def test_what_is_typed_after_the_first_click_takes_the_place_of_the_name(line, qtbot):
    qtbot.mouseClick(line, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(line.hasFocus)
    assert line.selectedText() == "hand"
    qtbot.keyClicks(line, "lab")
    assert line.text() == "lab"
