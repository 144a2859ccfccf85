"""The history lists what was done, and a click goes there."""

import time
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.history.panel import DONE, PRESENT, TIME, HistoryPanel
from skinsource_gui.state.document import Document
from skinsource_gui.state.historian import Historian
from skinsource_gui.state.panel import PanelRegistry

KEY = Qt.Key


class Bench:
    """A document and the panel that lists its steps."""

    def __init__(self, qtbot):
        self.document = Document(Design(limb="synthetic-1", inputs=(track(location=7),)))
        self.panel = HistoryPanel()
        qtbot.addWidget(self.panel)
        panels = PanelRegistry({"history": lambda: self.panel})
        panels["history"]
        self.historian = Historian(self.document, panels)
        self.panel.resize(300, 400)
        self.panel.show()

    @property
    def amplitude(self):
        return self.document.design.inputs[0].amplitude

    def edit(self, *amplitudes, gesture=None):
        for amplitude in amplitudes:
            design = self.document.design.with_input(0, amplitude=amplitude)
            self.document.edit(f"Amplitude {amplitude:g}", design, gesture)

    def rows(self, role=Qt.ItemDataRole.DisplayRole):
        model = self.panel.model
        return [model.index(k).data(role) for k in range(model.rowCount())]

    def click(self, row):
        area = self.panel.rows.visualRect(self.panel.model.index(row))
        at = area.center() - QPoint(20, 0)
        QTest.mouseClick(self.panel.rows.viewport(), Qt.MouseButton.LeftButton, pos=at)


@pytest.fixture
def bench(qtbot):
    bench = Bench(qtbot)
    yield bench
    bench.document.undo_stack.clear()


def test_each_step_is_listed_with_its_label_and_time_and_a_gesture_once(bench):
    before = time.strftime("%H:%M:%S")
    bench.edit(2.0)
    bench.edit(*range(3, 40), gesture=3)
    after = time.strftime("%H:%M:%S")
    assert bench.rows() == ["New design", "Amplitude 2", "Amplitude 39"]
    assert bench.rows(TIME)[0] == ""
    assert all(before <= when <= after for when in bench.rows(TIME)[1:])
    assert bench.rows(PRESENT) == [False, False, True]


def test_a_click_goes_there_and_back(bench):
    bench.edit(2.0, 3.0, 4.0)
    bench.click(1)
    assert bench.amplitude == 2.0
    assert bench.rows() == ["New design", "Amplitude 2", "Amplitude 3", "Amplitude 4"]
    assert bench.rows(DONE) == [True, True, False, False]
    _, present, back, _ = bench.rows(Qt.ItemDataRole.AccessibleTextRole)
    assert present.endswith(", present")
    assert back.endswith(", taken back")
    bench.click(3)
    assert bench.amplitude == 4.0
    bench.click(0)
    assert bench.amplitude == 1.0
    assert not bench.document.modified
    bench.edit(9.0)
    assert bench.rows() == ["New design", "Amplitude 9"]


def test_the_keys_reach_every_step(bench):
    bench.edit(2.0, 3.0, 4.0)
    rows = bench.panel.rows
    QTest.keyClick(rows, KEY.Key_Up)
    QTest.keyClick(rows, KEY.Key_Up)
    assert bench.amplitude == 4.0
    QTest.keyClick(rows, KEY.Key_Return)
    assert bench.amplitude == 2.0
    QTest.keyClick(rows, KEY.Key_End)
    QTest.keyClick(rows, KEY.Key_Space)
    assert bench.amplitude == 4.0


def test_the_step_that_was_saved_is_marked_and_the_start_has_the_name_of_its_file(bench):
    bench.edit(2.0)
    bench.document.mark_saved(Path("tap.skinsource"))
    bench.edit(3.0)
    assert bench.rows()[0] == "New design"
    assert [when.startswith("saved") for when in bench.rows(TIME)] == [False, True, False]
    bench.document.start_over(bench.document.design, View(), Path("a.skinsource"))
    bench.document.mark_saved(Path("b.skinsource"))
    assert bench.rows() == ["Opened a.skinsource"]
    bench.document.start_over(bench.document.design, View(), None)
    assert bench.rows() == ["New design"]


def test_a_thousand_steps_are_kept_and_older_ones_are_said_to_be_forgotten(bench):
    bench.panel.hide()
    bench.edit(*(k / 8 for k in range(1, 1004)))
    history = bench.historian.history()
    bench.panel.show_history(history)
    assert len(bench.rows()) == 1001
    assert bench.rows()[0] == "Before the last 1000 steps"
    bench.panel.step_requested.emit(1)
    assert bench.amplitude == 4 / 8


def test_a_hidden_panel_is_told_nothing_and_catches_up(window, qtbot):
    dock, panel = window.docks["history"], window.panel("history")
    dock.bring_forward()
    qtbot.waitUntil(panel.isVisible)
    dock.hide()
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=2.0))
    assert panel.model.rowCount() == 1
    dock.bring_forward()
    assert panel.model.rowCount() == 2


def test_bursts_and_drags_are_steps_of_their_own(open_window):
    design = Design(limb="synthetic-1", inputs=(track(location=7), track(location=9)))
    window = open_window(design, View(selected_inputs=(1,)))
    field = window.panel("inspector").findChild(NumberField, "amplitude_field")
    # A burst of keys ends where another input is selected.
    QTest.keyClick(field, KEY.Key_Up)
    QTest.keyClick(field, KEY.Key_Up)
    first = window.document.design.inputs[0].amplitude
    window.document.look(View(selected_inputs=(2,)))
    QTest.keyClick(field, KEY.Key_Up)
    assert window.document.undo_stack.count() == 2
    for _ in range(2):
        centre, left = field.rect().center(), Qt.MouseButton.LeftButton
        QTest.mousePress(field, left, pos=centre)
        for step in range(1, 6):
            QTest.mouseMove(field, centre + QPoint(8 * step, 0))
        QTest.mouseRelease(field, left, pos=centre + QPoint(40, 0))
    assert window.document.undo_stack.count() == 4
    for _ in range(3):
        window.do("undo")
    assert [track.amplitude for track in window.document.design.inputs] == [first, 1.0]
