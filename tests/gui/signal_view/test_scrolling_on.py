"""A wheel that scrolls what is around a plot goes on when the plot arrives under the pointer."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QScrollArea, QVBoxLayout, QWidget

from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.qt.wheel import PAUSE_S, ScrollGesture
from tests.gui.signal_view.bench import TIME, waves

PLAIN, CTRL = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier


class ScrolledPlot:
    """A plot below a tall text, and a clock that is set by hand."""

    def __init__(self, qtbot):
        self.now_s, self.zooms = 100.0, []
        self.view = SignalView("scrolled", "Scrolled")
        self.view.setMinimumHeight(400)
        inside, self.area = QWidget(), QScrollArea()
        column = QVBoxLayout(inside)
        text = QWidget()
        text.setFixedHeight(400)
        column.addWidget(text)
        column.addWidget(self.view)
        self.area.setWidgetResizable(True)
        self.area.setWidget(inside)
        qtbot.addWidget(self.area)
        plot = self.view.plot
        plot.scrolling_on = ScrollGesture(plot, lambda: self.now_s)
        self.area.resize(400, 300)
        self.area.show()
        qtbot.waitExposed(self.area)
        self.view.set_view(TIME, None, stacked=False)
        self.view.show_curves(waves(), synthetic=False)
        self.view.zoom_requested.connect(self.zooms.append)
        QCursor.setPos(self.area.mapToGlobal(QPoint(200, 150)))

    @property
    def scrolled(self):
        return self.area.verticalScrollBar().value()

    def turn(self, held=PLAIN):
        at = QCursor.pos()
        QTest.wheelEvent(
            self.area.windowHandle(),
            QPointF(self.area.mapFromGlobal(at)),
            QPoint(0, -120),
            QPoint(),
            held,
        )

    def turn_until_over_the_plot(self):
        for _ in range(20):
            self.turn()
            self.now_s += 0.1
            if QApplication.widgetAt(QCursor.pos()) is self.view.plot.viewport():
                return
        raise AssertionError("the plot never came under the pointer")


@pytest.fixture
def bench(qtbot):
    return ScrolledPlot(qtbot)


def test_a_turn_that_began_as_scrolling_goes_on_to_the_end_and_beyond(bench):
    bench.turn_until_over_the_plot()
    before = bench.scrolled
    bench.turn()
    assert bench.scrolled > before
    for _ in range(20):
        bench.now_s += PAUSE_S - 0.1
        bench.turn()
    assert bench.scrolled == bench.area.verticalScrollBar().maximum()
    assert bench.zooms == []


@pytest.mark.parametrize("why", ["moved", "rested", "key"])
def test_the_plot_takes_the_wheel_when_it_is_meant(bench, why):
    bench.turn_until_over_the_plot()
    before = bench.scrolled
    if why == "moved":
        QCursor.setPos(QCursor.pos() + QPoint(0, 8))
    elif why == "rested":
        bench.now_s += PAUSE_S
    bench.turn(CTRL if why == "key" else PLAIN)
    assert len(bench.zooms) == 1
    assert bench.scrolled == before
