"""Where a panel scrolls, its bar does not come and go without end."""

import pytest
from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtWidgets import QApplication, QVBoxLayout, QWidget

from skinsource_gui.qt.fitting import SteadyArea

_TURNS = 30


class LowerWhereNarrower(QWidget):
    """As words are that are written smaller where there is less room."""

    def minimumSizeHint(self):
        return QSize(50, 100 if self.width() >= 200 else 90)

    def resizeEvent(self, event):
        self.updateGeometry()


class Counted(QObject):
    """How often a widget got another size."""

    times = 0

    def eventFilter(self, watched, event):
        self.times += event.type() == QEvent.Type.Resize
        return False


def inside(depth):
    """What is lower where it is narrower, or has something in it that is."""
    lowest = LowerWhereNarrower()
    if not depth:
        return lowest
    panel = QWidget()
    around = QVBoxLayout(panel)
    around.setContentsMargins(0, 0, 0, 0)
    around.addWidget(lowest)
    return panel


@pytest.fixture(params=[0, 1])
def area(qtbot, request):
    area = SteadyArea()
    qtbot.addWidget(area)
    area.setFrameShape(SteadyArea.Shape.NoFrame)
    area.setWidget(inside(request.param))
    area.resize(400, 300)
    area.show()
    qtbot.waitExposed(area)
    return area


def turn(times=_TURNS):
    for _ in range(times):
        QApplication.processEvents()


def test_a_bar_beside_which_there_is_room_and_without_it_none_stays(area):
    area.resize(204, 95)
    turn()
    counted = Counted()
    area.viewport().installEventFilter(counted)
    area.verticalScrollBar().installEventFilter(counted)
    turn()
    assert counted.times == 0
    assert area.verticalScrollBar().isVisible()


def test_it_goes_once_there_is_another_room(area):
    area.resize(204, 95)
    turn()
    area.resize(400, 300)
    turn()
    assert not area.verticalScrollBar().isVisible()
    area.resize(400, 80)
    turn()
    assert area.verticalScrollBar().isVisible()
    assert area.verticalScrollBarPolicy() == Qt.ScrollBarPolicy.ScrollBarAsNeeded
