"""Buttons above a plot stand in as many rows as their words need."""

import pytest
from PySide6.QtWidgets import QApplication, QScrollArea, QToolButton

from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.qt.theme import scaled


@pytest.fixture
def view(qtbot):
    """A plot in a dock, with large letters."""
    area, view = QScrollArea(), SignalView("plot", "Plot")
    qtbot.addWidget(area)
    area.setWidgetResizable(True)
    area.setWidget(view)
    view.setFont(scaled(view.font(), 2.0))
    for name in ("Remove 52 ms delay", "Each to its peak"):
        view.toolbar.add_switch(name, name, name, lambda on: None)
    view.toolbar.show_state(layout="overlaid", zoomed=False)
    area.show()
    yield view
    area.hide()


def shown(view):
    buttons = view.toolbar.findChildren(QToolButton)
    return [button for button in buttons if button.isVisibleTo(view)]


def places(view):
    return {button.objectName(): button.geometry() for button in shown(view)}


def settle(view, width, height=700):
    view.window().resize(width, height)
    for _ in range(5):
        QApplication.processEvents()


@pytest.mark.parametrize("share", [1.1, 0.7, 0.4])
def test_buttons_take_more_rows_where_words_have_no_room(view, share):
    settle(view, round(share * view.toolbar.sizeHint().width()))
    assert (len({button.geometry().y() for button in shown(view)}) == 1) == (share > 1.0)
    for button in shown(view):
        assert view.toolbar.rect().contains(button.geometry())
        assert button.width() >= button.sizeHint().width()


def test_in_any_room_they_settle_and_the_way_out_of_a_zoom_moves_none(view):
    for width in (*range(300, 1200, 47), *range(1200, 300, -59)):
        settle(view, width)
        before = places(view)
        view.toolbar.show_state(layout="overlaid", zoomed=True)
        settle(view, width)
        assert places(view).items() > before.items()
        view.toolbar.show_state(layout="overlaid", zoomed=False)
        settle(view, width)
        assert places(view) == before
