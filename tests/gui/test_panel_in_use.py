"""The panel in use is the one that was pressed last, or to which the keyboard went since."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from skinsource_gui.plots.pictures import PANEL_IN_USE
from tests.gui.dock_bench import bar_with, titles

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def studio(window, qtbot):
    """A window whose keyboard is in the panel Hand."""
    window.activateWindow()
    qtbot.waitActive(window)
    window.docks["hand"].bring_forward()
    keep_keyboard(window, qtbot)
    return window


def keep_keyboard(window, qtbot):
    window.panel("hand").setFocus()
    qtbot.waitUntil(lambda: window.panel("hand").isAncestorOf(QApplication.focusWidget()))
    assert in_use(window) == "Hand"


def in_use(window):
    return window.pictures.picture_of(PANEL_IN_USE).title


def press(part, at=None, button=LEFT):
    """Click as a mouse does: in the window, not on a widget that somebody picked."""
    top = part.window()
    spot = part.mapTo(top, part.rect().center() if at is None else at)
    QTest.mouseClick(top.windowHandle(), button, pos=spot)
    QApplication.processEvents()


def empty_part(panel):
    """A spot of a panel where nothing takes the keyboard."""
    window = panel.window()
    spots = (QPoint(x, y) for y in range(1, panel.height(), 2) for x in range(1, panel.width(), 2))
    for at in spots:
        part = window.childAt(panel.mapTo(window, at))
        while part is not panel and not part.focusPolicy() & Qt.FocusPolicy.ClickFocus:
            part = part.parentWidget()
        if part is panel:
            return at
    raise AssertionError(panel.name)


@pytest.mark.parametrize("name", ["skin", "traces", "spectra"])
def test_a_panel_is_in_use_once_its_ground_is_pressed_and_the_keyboard_stays(studio, name):
    focused = QApplication.focusWidget()
    press(studio.panel(name), empty_part(studio.panel(name)))
    assert in_use(studio) == studio.panel(name).title
    assert QApplication.focusWidget() is focused


def test_a_panel_without_anything_for_the_keyboard_is_in_use_once_its_tab_is_pressed(studio, qtbot):
    studio.tabifyDockWidget(studio.docks["traces"], studio.docks["spectra"])
    studio.docks["traces"].raise_()
    for part in studio.panel("spectra").findChildren(QWidget):
        part.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    keep_keyboard(studio, qtbot)
    bar = bar_with(studio, "Spectra")
    press(bar, bar.tabRect(titles(bar).index("Spectra")).center())
    qtbot.waitUntil(lambda: in_use(studio) == "Spectra")


def test_a_panel_out_of_the_window_is_in_use_once_it_is_pressed(studio, qtbot):
    dock = studio.docks["skin"]
    dock.setFloating(True)
    qtbot.waitExposed(dock)
    keep_keyboard(studio, qtbot)
    focused = QApplication.focusWidget()
    press(dock.panel, empty_part(dock.panel))
    assert in_use(studio) == "Skin"
    dock.activateWindow()
    dock.panel.setFocus()
    qtbot.waitUntil(lambda: dock.isAncestorOf(QApplication.focusWidget()))
    studio.activateWindow()  # as who goes to a menu there
    qtbot.waitUntil(lambda: QApplication.focusWidget() is focused)
    assert in_use(studio) == "Skin"


def test_a_panel_that_is_closed_is_in_use_no_longer(studio):
    dock = studio.docks["skin"]
    press(dock.panel, empty_part(dock.panel))
    assert in_use(studio) == "Skin"
    studio.do("close_panel")
    assert not dock.isVisible()
    assert in_use(studio) == "Hand"
