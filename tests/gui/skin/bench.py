"""What the tests of this folder share."""

from dataclasses import fields, replace

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest

from skinsource.design.panel_settings import settings_of, with_settings
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.state.preferences import start_design
from tests.gui.panel_host import PanelHost
from tests.gui.wheel import NOTCH, turn_wheel

LEFT, MIDDLE = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton


PLAIN, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier


CONTROL = Qt.KeyboardModifier.ControlModifier


SEED = 7


class Window(PanelHost):
    """The skin panel on the start design."""

    def __init__(self, panel, results):
        super().__init__(panel, start_design("synthetic-1"))
        self.results = results

    @property
    def settings(self):
        return settings_of(self.view, "skin", SkinSettings)

    def show(self, design=None, **changes):
        known = {field.name for field in fields(SkinSettings)}
        own = {name: changes.pop(name) for name in known & changes.keys()}
        if own:
            self.view = with_settings(self.view, "skin", replace(self.settings, **own))
        super().show(design, **changes)

    def deliver(self, **changes):
        needed = {name: self.results[name] for name in self.panel.needs}
        self.panel.show_results({**needed, **changes})
        self.panel.show_stale(False)


def place(window, number):
    return window.panel.map.stage.place_of(number).toPoint()


def click(window, number, modifiers=PLAIN):
    QTest.mouseClick(window.panel.map, LEFT, modifiers, place(window, number))


def drag(widget, start, end, button=LEFT, modifiers=PLAIN):
    QTest.mousePress(widget, button, modifiers, start)
    for part in (0.5, 1.0):
        # QTest.mouseMove names no button or modifier; none is needed while one is held.
        QTest.mouseMove(widget, start + (end - start) * part)
    QTest.mouseRelease(widget, button, modifiers, end)


def wheel(widget, at, notches, modifiers=PLAIN):
    return turn_wheel(widget, at, (0, NOTCH * notches), modifiers)


def entries(word):
    """Entries of the menu of a word of the measure line, by their texts."""
    word.menu().aboutToShow.emit()
    return {action.text(): action for action in word.menu().actions() if action.text()}


def choose(word, text):
    entries(word)[text].trigger()


def pixel(picture, at):
    return QColor(picture.pixel(at)).getRgb()[:3]
