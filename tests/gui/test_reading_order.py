"""Tab goes as one reads, and what has the keyboard shows it."""

from itertools import pairwise

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QScrollArea

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.qt.theme import current_theme
from skinsource_gui.shell.focus import tab_stops


@pytest.fixture
def window(open_window, qtbot):
    tone = track(7, Tone(frequency_hz=100.0))
    window = open_window(Design(limb="synthetic-1", inputs=(tone,)), View(selected_inputs=(1,)))
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window


def tops(panel):
    return [stop.mapTo(panel, QPoint()).y() for stop in tab_stops(panel, (panel,))]


def names(panel):
    return [stop.objectName() for stop in tab_stops(panel, (panel,))]


def test_the_inspector_is_walked_from_top_to_bottom(window):
    panel = window.panel("inspector")
    stop_names = names(panel)
    assert stop_names[:3] == ["draw_button", "location_field", "amplitude_field"]
    assert stop_names[-2:] == ["add_effect", "track_fold"]
    assert tops(panel) == sorted(tops(panel))


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
