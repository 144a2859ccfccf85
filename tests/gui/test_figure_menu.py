"""The menu that the right button opens on figures."""

import pytest
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtWidgets import QApplication, QMenu

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.pages.files import exports
from tests.gui.analysis.analysis_bench import analysis

DESIGN = Design(limb="synthetic-1", inputs=(track(location=7, waveform=Tone(duration_s=0.2)),))


def menu_on(figure):
    """Press the right button in the middle of a figure; return what opens, if anything."""
    at = figure.rect().center()
    mouse = QContextMenuEvent.Reason.Mouse
    QApplication.sendEvent(figure, QContextMenuEvent(mouse, at, figure.mapToGlobal(at)))
    return figure.findChild(QMenu, "figure_menu")


@pytest.mark.parametrize("name", ["spectrogram", "transfer", "main_axis"])
def test_the_right_button_on_a_figure_offers_its_picture(open_window, qtbot, monkeypatch, name):
    window = open_window(DESIGN, View(selected_inputs=(1,), outputs=(3,)))
    window.activateWindow()
    panel = analysis(window, name)
    qtbot.waitUntil(lambda: panel.isVisible() and not panel.figure.message, timeout=30_000)
    menu = menu_on(panel.figure)
    by_words = {action.text(): action for action in menu.actions()}
    asked = []
    monkeypatch.setattr(
        exports, "ask_picture_options", lambda *_, **about: asked.append(about["title"])
    )
    window.panel("skin").setFocus()
    by_words["Save picture as…"].trigger()
    menu.close()
    assert asked == ["Export picture of the panel Analysis"]
    assert ("Copy numbers" in by_words) == panel.copies
