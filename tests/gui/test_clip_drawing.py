"""The pen can be reached from the inspector, and from anywhere."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton

from skinsource.design.design import Design, track
from skinsource.design.waveforms.samples import Drawn
from skinsource_gui.panels.clip_editor.tools import Pen


@pytest.fixture
def studio(open_window):
    def make(waveform):
        return open_window(Design(limb="synthetic-1", inputs=(track(7, waveform),)))

    return make


def pen_is_taken(window):
    return isinstance(window.panel("clip_editor")._canvas.tool, Pen)


def test_the_clip_panel_leads_to_the_pen_and_so_does_the_action(studio, qtbot):
    window = studio(Drawn())
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    button = window.panel("inspector").findChild(QToolButton, "draw_button")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    editor = window.panel("clip_editor")
    assert editor.isVisible()
    assert pen_is_taken(window)
    assert editor.isAncestorOf(QApplication.focusWidget())
    editor.use("look")
    window.do("draw_clip")
    assert pen_is_taken(window)
