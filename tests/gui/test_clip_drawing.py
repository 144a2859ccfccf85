"""The pen can be reached from the inspector, and from anywhere."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox, QPushButton

from skinsource.design.design import Design, track
from skinsource.design.waveforms.samples import Drawn
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.clip_editor.tools import Pen


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


@pytest.fixture
def studio(open_window, qtbot):
    def make(*waveforms):
        tracks = tuple(track(7 + k, waveform) for k, waveform in enumerate(waveforms))
        window = open_window(Design(limb="synthetic-1", inputs=tracks))
        window.activateWindow()
        qtbot.waitUntil(window.isActiveWindow)
        return window

    return make


def pen_is_taken(window):
    return isinstance(window.panel("clip_editor")._canvas.tool, Pen)


def pen_buttons(window):
    draw_buttons = window.panel("inspector").findChildren(QPushButton, "draw_button")
    return [button for button in draw_buttons if button.isVisible()]


def test_the_inspector_of_a_drawn_waveform_leads_to_the_pen(studio):
    window = studio(Drawn())
    (button,) = pen_buttons(window)
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    editor = window.panel("clip_editor")
    assert editor.isVisible()
    assert pen_is_taken(window)
    assert editor.isAncestorOf(QApplication.focusWidget())


def test_the_pen_is_taken_again_where_the_clip_is_large_already(studio):
    window = studio(Drawn())
    window.do("show_clip_editor")
    assert not pen_is_taken(window)
    window.do("draw_clip")
    assert window.panel("clip_editor").isVisible()
    assert pen_is_taken(window)


@pytest.mark.parametrize(
    "answer", [QMessageBox.StandardButton.Ok, QMessageBox.StandardButton.Cancel]
)
def test_another_waveform_asks_before_it_becomes_samples(studio, monkeypatch, answer):
    window = studio(Tone())
    monkeypatch.setattr(QMessageBox, "question", lambda *_: answer)
    window.do("draw_clip")
    assert window.panel("clip_editor").isVisible()
    assert pen_is_taken(window) is (answer == QMessageBox.StandardButton.Ok)
