"""Words of buttons are written as large as there is room, and stay so."""

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import (
    QApplication,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from skinsource_gui.panels.timeline.panel import TimelineToolbar
from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.plots.toolbar import PlotToolbar
from skinsource_gui.qt.fitting import width_in
from skinsource_gui.qt.theme import UNIT_PX, scaled


class Fits(QObject):
    """Counts what has a bar fit its words anew."""

    def __init__(self):
        super().__init__()
        self.count = 0

    def eventFilter(self, watched, event):
        kinds = QEvent.Type.Resize, QEvent.Type.LayoutRequest, QEvent.Type.FontChange
        self.count += event.type() in kinds
        return False


def beside_the_ruler(parent):
    return TimelineToolbar(parent)


def above_a_plot(parent):
    bar = PlotToolbar(parent)
    for name in ("Remove 52 ms delay", "Envelope", "Principal axis"):
        bar.add_switch(name, name, name, lambda on: None)
    bar.show_state(layout="overlaid", zoomed=True)
    return bar


@pytest.mark.parametrize("make", [beside_the_ruler, above_a_plot])
def test_in_any_room_words_settle_in_one_size(qtbot, make):
    host, fits = QWidget(), Fits()
    qtbot.addWidget(host)
    host.setFont(scaled(host.font(), 2.0))
    column = QVBoxLayout(host)
    column.setContentsMargins(0, 0, 0, 0)
    bar = make(host)
    column.addWidget(bar)
    host.show()
    qtbot.waitExposed(host)
    for width in (*range(40, 1200, 23), *range(1200, 40, -29)):
        fits.count = 0
        bar.installEventFilter(fits)
        host.resize(width, 200)
        for _ in range(20):
            QApplication.processEvents()
        bar.removeEventFilter(fits)
        # Once for the room; once or twice more where words take another size or another row.
        assert fits.count <= 6, (width, bar.width())


@pytest.mark.parametrize(("scale", "n_rows"), [(1.0, 1), (0.7, 2), (0.3, 2)])
def test_switches_take_a_second_row_before_words_are_hard_to_read(qtbot, scale, n_rows):
    view = SignalView("plot", "Plot")
    qtbot.addWidget(view)
    # In large letters: small ones leave room in any plot.
    view.setFont(scaled(view.font(), 2.0))
    for name in ("Remove 52 ms delay", "Each to its peak"):
        view.toolbar.add_switch(name, name, name, lambda on: None)
    view.toolbar.show_state(layout="overlaid", zoomed=False)
    view.show()
    QApplication.processEvents()
    shown = [
        button for button in view.toolbar.findChildren(QToolButton) if button.isVisibleTo(view)
    ]
    # What words of that size need, and what is around and between them.
    width = width_in(scaled(view.toolbar.font(), scale), shown) + 4 * UNIT_PX
    for at in (700, 250):
        view.resize(width, at)
        for _ in range(20):
            QApplication.processEvents()
    assert len({button.geometry().y() for button in shown}) == n_rows
    for switch in shown:
        assert view.toolbar.rect().contains(switch.geometry())
        assert switch.height() >= switch.fontMetrics().height()
