"""Whatever is done, in whatever order: nothing fails, and what is shown is what was designed."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog

import skinsource as ss
from skinsource.edits import change_waveform, place_input, select_outputs
from skinsource.projection import AXES, METHODS
from skinsource.waveforms import Noise, Tap, Tone
from skinsource_gui.shell.actions import ACTIONS

SCALINGS, SPANS = ("upstream", "relative", "probe"), ("record", "loudest")
#: These ask for a file, start a job or end the studio.
LEFT_OUT = {"open_design", "save_design", "save_design_as", "quit_studio", "toggle_full_screen"}
DONE = [
    spec.name
    for spec in ACTIONS
    if spec.name not in LEFT_OUT and not spec.name.startswith(("export_", "new_"))
]
KEYS = (
    *(Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Space),
    *(Qt.Key.Key_M, Qt.Key.Key_S, Qt.Key.Key_Delete, Qt.Key.Key_Insert, Qt.Key.Key_Escape),
    *(Qt.Key.Key_Home, Qt.Key.Key_End, Qt.Key.Key_Tab, Qt.Key.Key_Return, Qt.Key.Key_5),
)
MODIFIERS = (
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)
#: Longer ones are streamed.
DURATIONS_S = (0.02, 0.3, 1.0, 14.0)
MOST_INPUTS = 6
STEPS, LOOK_EVERY = 40, 5


class Hands:
    """Does things to a window at random, always the same for one seed."""

    def __init__(self, window, seed):
        self.window, self.document = window, window.document
        self.random = np.random.default_rng(seed)
        self.done = []

    def one_of(self, things):
        return things[self.random.integers(len(things))]

    def do_something(self):
        ways = (self.act, self.act, self.press, self.press, self.place, self.play, self.look)
        way = self.one_of((*ways, self.choose, self.step, self.step, self.dock, self.setup))
        self.done.append((way.__name__, *(way() or ())))

    def act(self):
        name = self.one_of(DONE)
        self.window.do(name)
        return (name,)

    def press(self):
        names = ("timeline", "hand", "inspector", "skin", "traces", "spectra")
        panel = self.window.panel(self.one_of(names))
        panel.setFocus(Qt.FocusReason.TabFocusReason)
        key, modifiers = self.one_of(KEYS), self.one_of(MODIFIERS)
        QTest.keyClick(QApplication.focusWidget() or panel, key, modifiers)
        return panel.name, key.name, modifiers.name

    def place(self):
        if len(self.document.design.inputs) < MOST_INPUTS:
            place = int(self.random.integers(1, 21))
            self.apply(place_input, place)

    def play(self):
        duration_s = float(self.one_of(DURATIONS_S))
        made = (Tone(duration_s=duration_s), Noise(duration_s=duration_s), Tap())
        ids = self.document.view.selected_inputs
        if ids:
            self.apply(change_waveform, ids, self.one_of(made))
        return (duration_s,)

    def look(self):
        view = self.document.view
        changes = {"axes": AXES, "method": METHODS, "span": SPANS}
        name = self.one_of(tuple(changes))
        chosen = self.one_of(changes[name])
        self.document.look(replace(view, **{name: chosen}))
        return name, chosen

    def choose(self):
        count = self.random.integers(0, 6)
        outputs = self.random.choice(72, count, replace=False) + 1
        self.apply(select_outputs, tuple(int(one) for one in outputs))

    def step(self):
        stack = self.document.undo_stack
        for _ in range(self.random.integers(1, 4)):
            self.one_of((stack.undo, stack.redo))()

    def dock(self):
        dock = self.window.docks[self.one_of(tuple(self.window.docks))]
        way = self.one_of(("show", "hide", "float", "dock"))
        if way in ("show", "hide"):
            dock.setVisible(way == "show")
        else:
            dock.setFloating(way == "float")
        return dock.objectName(), way

    def setup(self):
        design = replace(self.document.design, scaling=self.one_of(SCALINGS))
        self.document.edit("Scaling", design)
        return (design.scaling,)

    def apply(self, edit, *arguments):
        self.document.apply(edit(self.document.design, self.document.view, *arguments))


def close_dialogs(window):
    for dialog in window.findChildren(QDialog):
        if dialog.isVisible():
            dialog.close()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def shown_levels(window):
    return window.panel("skin").map.content.levels_db


@pytest.mark.parametrize("seed", range(2))
def test_whatever_is_done_the_levels_shown_at_rest_are_those_of_the_design(
    window, qtbot, settle, seed
):
    hands = Hands(window, seed)
    compared = 0
    for k in range(STEPS):
        hands.do_something()
        QApplication.processEvents()
        close_dialogs(window)
        if k % LOOK_EVERY != LOOK_EVERY - 1:
            continue
        settle()
        assert not window.engine.busy, hands.done
        if window.panel("skin").isVisible():
            document = window.document
            found = ss.evaluate(document.design, "output_levels_db", view=document.view)
            shown = shown_levels(window)
            np.testing.assert_allclose(shown, found["output_levels_db"], atol=1e-6)
            assert not window.panel("skin").map.content.outdated, hands.done
            compared += 1
    assert compared
    window.do("arrange_design")
    settle()
    assert window.notice.text == "", hands.done
