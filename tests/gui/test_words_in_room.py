"""Words of buttons are written as large as there is room, and stay so."""

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication, QPushButton, QToolButton, QVBoxLayout, QWidget

from skinsource_gui.panels.timeline.timeline_toolbar import TimelineToolbar
from skinsource_gui.theme import THEMES, scaled
from skinsource_gui.widgets.plot.plot_toolbar import PlotToolbar
from skinsource_gui.widgets.plot.signal_view import SignalView
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
    bar = TimelineToolbar(parent)
    bar.show_theme(THEMES["light"])
    return bar


def above_a_plot(parent):
    bar = PlotToolbar(parent)
    for name in ("Remove 52 ms delay", "Envelope", "Principal axis"):
        bar.add_switch(name, name, name, lambda wanted: None)
    bar.show_state(layout="overlaid", zoomed=True)
    return bar


@pytest.mark.parametrize("scale", [1.0, 1.25, 1.5, 2.0, 3.0])
@pytest.mark.parametrize("make", [beside_the_ruler, above_a_plot])
def test_in_any_room_words_settle_in_one_size(qtbot, make, scale):
    host, fits = QWidget(), Fits()
    qtbot.addWidget(host)
    host.setFont(scaled(host.font(), scale))
    column = QVBoxLayout(host)
    column.setContentsMargins(0, 0, 0, 0)
    bar = make(host)
    column.addWidget(bar)
    host.show()
    qtbot.waitExposed(host)
    for width in (*range(40, 1200, 7), *range(1200, 40, -13)):
        fits.count = 0
        bar.installEventFilter(fits)
        host.resize(width, 200)
        for _ in range(20):
            QApplication.processEvents()
        bar.removeEventFilter(fits)
        # Once for the room; once or twice more where words take another size or another row.
        assert fits.count <= 6, (width, bar.width())


def test_switches_go_below_before_words_are_hard_to_read(qtbot):
    bar = above_a_plot(None)
    qtbot.addWidget(bar)
    bar.show()
    buttons = [one for one in bar.findChildren(QToolButton) if one.isVisibleTo(bar)]
    usual = bar.font().pointSizeF()
    rows = set()
    for width in range(width_in(bar.font(), buttons) + 100, 200, -1):
        bar.resize(width, bar.height())
        rows.add(len({one.mapTo(bar, one.rect().topLeft()).y() for one in buttons}))
        if len(rows) > 1:
            break
        assert min(one.font().pointSizeF() for one in buttons) >= 0.79 * usual, width
    assert rows == {1, 2}
    assert min(one.font().pointSizeF() for one in buttons) >= 0.99 * usual


@pytest.mark.parametrize(("height", "n_rows"), [(150, 1), (400, 2)])
def test_switches_take_a_second_row_where_the_plot_is_high_enough_and_are_whole(
    qtbot, height, n_rows
):
    view = SignalView("plot", "Plot")
    qtbot.addWidget(view)
    for name in ("Remove 52 ms delay", "Each to its peak"):
        view.toolbar.add_switch(name, name, name, lambda wanted: None)
    view.toolbar.show_state(layout="overlaid", zoomed=False)
    view.show()
    for at in (150, 400, height):
        view.resize(300, at)
        for _ in range(20):
            QApplication.processEvents()
    shown = [one for one in view.toolbar.findChildren(QToolButton) if one.isVisibleTo(view)]
    places = [one.geometry() for one in shown]
    assert len({place.y() for place in places}) == n_rows
    for place in places:
        assert view.toolbar.rect().contains(place), (place, view.toolbar.rect())
        assert place.height() >= view.fontMetrics().height()
