"""Tab goes as one reads; the panel in use is the one pressed or with the keyboard last."""

from itertools import pairwise

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QScrollArea, QWidget

from skinsource import Design, View, track
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.plots.pictures import PANEL_IN_USE
from skinsource_gui.qt.theme import current_theme
from skinsource_gui.shell.focus import tab_stops
from tests.gui.dock_bench import bar_with, titles


@pytest.fixture
def window(open_window, qtbot):
    tone = track(7, Tone(frequency_hz=100.0))
    window = open_window(Design(limb="synthetic-1", inputs=(tone,)), View(selected_inputs=(1,)))
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window


@pytest.mark.parametrize("unfolded", [False, True])
def test_the_output_too(window, settle, unfolded):
    window.docks["output"].bring_forward()
    settle()
    panel = window.panel("output")
    if unfolded:
        panel.choices.cell("actuator").edited.emit("actuator", "example-piezo", None)
        panel.more.click()
        settle()
    # Wherever its middle is: what scrolls is no line among those that it holds.
    inside = panel.findChild(QScrollArea).widget().layout()
    for top_px in range(0, 60, 6):
        inside.setContentsMargins(0, top_px, 0, 0)
        QApplication.processEvents()
        stops = tab_stops(panel, (panel,))
        check_places([stop for stop in stops if not isinstance(stop, QScrollArea)], panel)
        scrolling = [k for k, stop in enumerate(stops) if isinstance(stop, QScrollArea)]
        assert all(stops[k].isAncestorOf(stops[k + 1]) for k in scrolling)


def check_places(stops, panel):
    places = [(stop.objectName(), stop.mapTo(panel, stop.rect().center()).y()) for stop in stops]
    assert all(after[1] >= before[1] - 4 for before, after in pairwise(places)), places


def corner(window):
    diagram = window.panel("hand").diagram
    picture = diagram.grab().toImage()
    return picture.pixelColor(0, picture.height() // 3).name()


def test_the_hand_shows_that_it_has_the_keyboard_before_a_key_is_used_there(window, settle):
    diagram = window.panel("hand").diagram
    QTest.mouseClick(
        diagram, Qt.MouseButton.LeftButton, pos=diagram.rect().center() + QPoint(0, 120)
    )
    assert QApplication.focusWidget() is diagram
    assert diagram.state.cursor is None
    assert corner(window) == current_theme().accent
    window.panel("timeline").setFocus()
    assert corner(window) != current_theme().accent


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
