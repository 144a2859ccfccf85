"""What scrolls knows how much of it is seen, and when that changes."""

import pytest
from PySide6.QtWidgets import QScrollArea, QWidget

from skinsource_gui.qt.fitting import VisibleHeight

HIGH_PX = 600


@pytest.fixture
def area(qtbot):
    area = QScrollArea()
    qtbot.addWidget(area)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    panel = QWidget()
    panel.resize(200, HIGH_PX)
    area.setWidget(panel)
    area.resize(300, 250)
    return area


def test_of_what_is_higher_than_its_area_as_much_is_in_sight_as_that_shows(area):
    in_sight = VisibleHeight(area.widget())
    area.show()
    assert in_sight.px == area.viewport().height() < HIGH_PX
    heights_px = []
    in_sight.changed.connect(lambda: heights_px.append(in_sight.px))
    # The panel itself stays as high as it is.
    area.resize(300, 400)
    assert heights_px
    assert heights_px[-1] == area.viewport().height() > 300
    assert area.widget().height() == HIGH_PX


def test_what_does_not_scroll_is_in_sight_as_a_whole(qtbot):
    panel = QWidget()
    qtbot.addWidget(panel)
    in_sight, heights_px = VisibleHeight(panel), []
    in_sight.changed.connect(lambda: heights_px.append(in_sight.px))
    panel.resize(100, 321)
    panel.show()
    assert heights_px[-1] == in_sight.px == 321
