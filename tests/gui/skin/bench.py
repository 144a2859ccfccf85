"""What the tests of this folder share."""

from dataclasses import fields, replace

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest

from skinsource.design.edits.edit import Edit
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.state.preferences import start_design
from tests.gui.wheel import NOTCH, turn_wheel

LEFT, MIDDLE = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton


PLAIN, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier


CONTROL = Qt.KeyboardModifier.ControlModifier


SEED = 7


class Window:
    """Gives a panel's wishes back to it, as the application does."""

    def __init__(self, panel, results):
        self.panel, self.results = panel, results
        self.design, self.view = start_design("synthetic-1"), View()
        self.views, self.outcomes = [], []
        panel.view_changed.connect(self.take)
        panel.edited.connect(self.do)

    def do(self, outcome, _gesture):
        self.outcomes.append(outcome)
        if isinstance(outcome, Edit):
            self.design = outcome.design
            self.take(outcome.view)

    def take(self, view):
        self.views.append(view)
        self.view = view
        self.panel.show_state(self.design, view)

    @property
    def settings(self):
        return settings_of(self.view, "skin", SkinSettings)

    def show(self, **changes):
        known = {field.name for field in fields(SkinSettings)}
        own = {name: changes.pop(name) for name in known & changes.keys()}
        self.view = replace(self.view, **changes)
        if own:
            self.view = with_settings(self.view, "skin", replace(self.settings, **own))
        self.panel.show_state(self.design, self.view)

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
