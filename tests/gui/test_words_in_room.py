"""Words of buttons are written as large as there is room, and stay so."""

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QFontInfo
from PySide6.QtWidgets import (
    QApplication,
    QPushButton,
    QScrollArea,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from skinsource_gui.panels.timeline.panel import TimelineToolbar
from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.plots.toolbar import PlotToolbar
from skinsource_gui.qt.fitting import fitting_font, width_in
from skinsource_gui.qt.theme import UNIT_PX, scaled


@pytest.mark.parametrize("kind", [QToolButton, QPushButton])
def test_how_wide_a_button_would_be_does_not_depend_on_how_it_is_written_now(qtbot, kind):
    button = kind()
    qtbot.addWidget(button)
    button.setText("Remove 52 ms delay")
    usual = button.font()
    widths = set()
    for scale in (1.0, 0.9, 0.8, 0.7, 0.6, 1.5):
        button.setFont(scaled(usual, scale))
        assert width_in(button.font(), [button]) == button.sizeHint().width()
        widths.add(width_in(usual, [button]))
    assert len(widths) == 1


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
    buttons = [button for button in bar.findChildren(QToolButton) if button.isVisibleTo(bar)]
    usual = bar.font().pointSizeF()
    rows = set()
    for width in range(width_in(bar.font(), buttons) + 100, 200, -1):
        bar.resize(width, bar.height())
        rows.add(len({button.mapTo(bar, button.rect().topLeft()).y() for button in buttons}))
        if len(rows) > 1:
            break
        assert min(button.font().pointSizeF() for button in buttons) >= 0.79 * usual, width
    assert rows == {1, 2}
    # The way out of a zoom takes what is left.
    staying = [button for button in buttons if button.objectName() != "show-all"]
    assert min(button.font().pointSizeF() for button in staying) >= 0.99 * usual


@pytest.mark.parametrize(
    ("height", "scale", "n_rows"), [(250, 0.7, 1), (700, 0.7, 2), (250, 0.3, 2)]
)
def test_switches_take_a_second_row_where_the_plot_is_high_enough_or_they_would_be_cut(
    qtbot, height, scale, n_rows
):
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
    for at in (250, 700, height):
        view.resize(width, at)
        for _ in range(20):
            QApplication.processEvents()
    assert len({button.geometry().y() for button in shown}) == n_rows
    for switch in shown:
        assert view.toolbar.rect().contains(switch.geometry())
        assert switch.height() >= switch.fontMetrics().height()


def settle():
    for _ in range(20):
        QApplication.processEvents()


def rows_of(buttons):
    """In how many rows they stand."""
    return len({button.geometry().center().y() // button.height() for button in buttons})


@pytest.mark.parametrize("scale", [1.0, 1.5, 3.0])
@pytest.mark.parametrize("high", [True, False])
def test_the_way_out_of_a_zoom_moves_nothing(qtbot, scale, high):
    bar = above_a_plot(None)
    qtbot.addWidget(bar)
    bar.setFont(scaled(bar.font(), scale))
    bar.let_fold(high)
    bar.show()
    bar.show_state(layout="overlaid", zoomed=False)
    staying = [button for button in bar.findChildren(QToolButton) if button.isVisibleTo(bar)]
    everything = bar.findChild(QToolButton, "show-all")
    row_counts = set()
    for width in range(int(800 * scale), 150, -11):
        bar.resize(width, bar.sizeHint().height())
        settle()
        n_rows, height = rows_of(staying), bar.sizeHint().height()
        bar.show_state(layout="overlaid", zoomed=True)
        settle()
        assert rows_of(staying) == n_rows, width
        # Where nothing is left for it beside words that stay, all are smaller, and lower.
        assert bar.sizeHint().height() <= height, width
        if bar.width() >= bar.minimumWidth():
            assert everything.width() >= everything.sizeHint().width()
        row_counts.add(n_rows)
        bar.show_state(layout="overlaid", zoomed=False)
        settle()
    assert row_counts == {1, 2}


def test_a_scroll_bar_sends_no_switches_below(qtbot):
    area, view = QScrollArea(), SignalView("plot", "Plot")
    qtbot.addWidget(area)
    area.setWidget(view)
    area.setWidgetResizable(True)
    for name in ("Remove 52 ms delay", "Each to its peak"):
        view.toolbar.add_switch(name, name, name, lambda on: None)
    view.toolbar.show_state(layout="overlaid", zoomed=False)
    area.show()
    settle()
    shown = [
        button for button in view.toolbar.findChildren(QToolButton) if button.isVisibleTo(view)
    ]
    # The least width at which they stand beside each other in words that are read easily.
    for width in range(1200, 150, -1):
        area.resize(width, 900)
        settle()
        if rows_of(shown) > 1:
            break
    area.resize(width + 2, 900)
    settle()
    assert rows_of(shown) == 1
    assert not area.verticalScrollBar().isVisible()
    view.setMinimumHeight(1000)
    settle()
    assert area.verticalScrollBar().isVisible()
    assert rows_of(shown) == 1


def test_large_words_are_written_still_smaller_before_they_are_cut(qtbot):
    bar = above_a_plot(None)
    qtbot.addWidget(bar)
    usual = bar.font()
    buttons = [button for button in bar.findChildren(QToolButton) if button.isVisibleTo(bar)]
    least = {}
    for scale in (1.0, 3.0):
        bar.setFont(scaled(usual, scale))
        least[scale] = fitting_font((buttons,), bar.font(), 0)
    assert least[1.0].pointSizeF() == pytest.approx(0.6 * usual.pointSizeF(), rel=0.05)
    assert least[3.0].pointSizeF() == pytest.approx(1.2 * usual.pointSizeF(), rel=0.05)
    assert QFontInfo(least[3.0]).pixelSize() >= 12


def test_what_scrolls_has_no_more_room_than_is_in_sight(qtbot):
    area, view = QScrollArea(), SignalView("plot", "Plot")
    qtbot.addWidget(area)
    area.setWidget(view)
    area.setWidgetResizable(True)
    view.setFont(scaled(view.font(), 2.0))
    for name in ("Remove 52 ms delay", "Each to its peak"):
        view.toolbar.add_switch(name, name, name, lambda on: None)
    view.toolbar.show_state(layout="overlaid", zoomed=False)
    view.setMinimumHeight(800)
    area.show()
    QApplication.processEvents()
    shown = [
        button for button in view.toolbar.findChildren(QToolButton) if button.isVisibleTo(view)
    ]
    width = width_in(scaled(view.toolbar.font(), 0.7), shown) + 6 * UNIT_PX
    switch = view.toolbar.findChild(QToolButton, "Each to its peak")
    for height, below in ((250, False), (900, True), (250, False)):
        area.resize(width, height)
        for _ in range(20):
            QApplication.processEvents()
        assert view.height() >= 800
        first = view.toolbar.findChild(QToolButton, "overlaid")
        assert (switch.y() > first.geometry().bottom()) == below
        assert view.legend.text_layout.may_fold == below
