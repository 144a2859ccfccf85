"""The history lists what was done, and a click goes there."""

import time
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.history.panel import DONE, PRESENT, TIME, HistoryPanel
from skinsource_gui.state.document import Document
from skinsource_gui.state.historian import Historian
from skinsource_gui.state.panel import PanelRegistry
from skinsource_gui.state.preferences import start_design

KEY = Qt.Key


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


@pytest.fixture
def panel(window, qtbot):
    window.docks["history"].bring_forward()
    qtbot.waitUntil(lambda: window.panel("history").isVisible())
    return window.panel("history")


def edit(window, amplitude, gesture=None):
    design = window.document.design.with_input(0, amplitude=amplitude)
    window.document.edit(f"Amplitude {amplitude:g}", design, gesture)


def rows(panel, role=Qt.ItemDataRole.DisplayRole):
    return [panel.model.index(k).data(role) for k in range(panel.model.rowCount())]


def click(panel, row):
    area = panel.rows.visualRect(panel.model.index(row))
    QTest.mouseClick(
        panel.rows.viewport(), Qt.MouseButton.LeftButton, pos=area.center() - QPoint(20, 0)
    )


def amplitude(window):
    return window.document.design.inputs[0].amplitude


def test_each_step_is_listed_with_its_label_and_time(window, panel):
    before = time.strftime("%H:%M:%S")
    edit(window, 2.0)
    edit(window, 3.0)
    after = time.strftime("%H:%M:%S")
    assert rows(panel) == ["New design", "Amplitude 2", "Amplitude 3"]
    assert rows(panel, TIME)[0] == ""
    assert all(before <= when <= after for when in rows(panel, TIME)[1:])
    assert rows(panel, PRESENT) == [False, False, True]


def test_a_click_goes_there_and_back(window, panel):
    for value in (2.0, 3.0, 4.0):
        edit(window, value)
    click(panel, 1)
    assert amplitude(window) == 2.0
    assert rows(panel) == ["New design", "Amplitude 2", "Amplitude 3", "Amplitude 4"]
    assert rows(panel, DONE) == [True, True, False, False]
    click(panel, 3)
    assert amplitude(window) == 4.0
    click(panel, 0)
    assert amplitude(window) == 1.0
    assert not window.document.modified
    edit(window, 9.0)
    assert rows(panel) == ["New design", "Amplitude 9"]


def test_the_keys_reach_every_step(window, panel, qtbot):
    for value in (2.0, 3.0, 4.0):
        edit(window, value)
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    panel.setFocus()
    assert QApplication.focusWidget() is panel.rows
    QTest.keyClick(panel.rows, KEY.Key_Up)
    QTest.keyClick(panel.rows, KEY.Key_Up)
    assert amplitude(window) == 4.0
    QTest.keyClick(panel.rows, KEY.Key_Return)
    assert amplitude(window) == 2.0
    QTest.keyClick(panel.rows, KEY.Key_End)
    QTest.keyClick(panel.rows, KEY.Key_Space)
    assert amplitude(window) == 4.0


def test_one_gesture_is_one_row_with_its_last_label(window, panel):
    for k in range(2, 40):
        edit(window, float(k), gesture=3)
    assert rows(panel) == ["New design", "Amplitude 39"]


def test_the_file_that_was_saved_is_named_and_marked(window, panel, tmp_path):
    edit(window, 2.0)
    window.document.mark_saved(tmp_path / "tap.skinsource")
    edit(window, 3.0)
    assert rows(panel)[0] == "New design"
    assert [when.startswith("saved") for when in rows(panel, TIME)] == [False, True, False]


def test_a_thousand_steps_are_kept_and_older_ones_are_said_to_be_forgotten(qtbot):
    document, panel = (
        Document(Design(limb="synthetic-1", inputs=(track(location=7),))),
        HistoryPanel(),
    )
    qtbot.addWidget(panel)
    Historian(document, PanelRegistry.of(panel))
    panel.show()
    for k in range(1, 1004):
        document.edit("a", document.design.with_input(0, amplitude=k / 8))
    assert len(rows(panel)) == 1001
    assert rows(panel)[0] == "Before the last 1000 steps"
    panel.step_requested.emit(1)
    assert document.design.inputs[0].amplitude == 4 / 8
    document.undo_stack.clear()


def test_a_hidden_panel_is_told_nothing_and_catches_up(window, panel):
    window.docks["history"].hide()
    edit(window, 2.0)
    assert rows(panel) == ["New design"]
    window.docks["history"].bring_forward()
    assert rows(panel) == ["New design", "Amplitude 2"]


def test_another_design_has_another_history(window, panel):
    edit(window, 2.0)
    window.document.start_over(
        Design(limb="synthetic-1", inputs=(track(location=3),)), View(), None
    )
    assert rows(panel) == ["New design"]


def test_what_is_read_aloud_says_where_one_is(window, panel):
    edit(window, 2.0)
    window.document.undo_stack.undo()
    first, second = rows(panel, Qt.ItemDataRole.AccessibleTextRole)
    assert first == "New design, present"
    assert second.startswith("Amplitude 2, ")
    assert second.endswith("taken back")


def drag(field, dx):
    centre = field.rect().center()
    QTest.mousePress(field, Qt.MouseButton.LeftButton, pos=centre)
    for step in range(1, 6):
        QTest.mouseMove(field, centre + QPoint(dx * step // 5, 0))
    QTest.mouseRelease(field, Qt.MouseButton.LeftButton, pos=centre + QPoint(dx, 0))


def test_a_number_that_is_dragged_twice_makes_two_steps(window, panel):
    inspector = window.panel("inspector")
    field = inspector.findChild(NumberField, "amplitude_field")
    drag(field, 40)
    first = amplitude(window)
    assert first != 1.0
    drag(field, 40)
    assert amplitude(window) != first
    assert len(rows(panel)) == 3
    window.do("undo")
    assert amplitude(window) == first


def test_a_burst_of_keys_ends_where_another_input_is_selected(open_window, qtbot):
    design = Design(limb="synthetic-1", inputs=(track(location=7), track(location=9)))
    window = open_window(design, View(selected_inputs=(1,)))
    field = window.panel("inspector").findChild(NumberField, "amplitude_field")
    QTest.keyClick(field, KEY.Key_Up)
    QTest.keyClick(field, KEY.Key_Up)
    window.document.look(View(selected_inputs=(2,)))
    QTest.keyClick(field, KEY.Key_Up)
    assert window.document.undo_stack.count() == 2
    first, second = (track.amplitude for track in window.document.design.inputs)
    window.do("undo")
    assert [track.amplitude for track in window.document.design.inputs] == [first, 1.0]
    assert second != 1.0


def test_a_design_that_is_saved_under_another_name_was_not_opened_by_that_name(qtbot):
    document = Document(start_design("any"))
    historian = Historian(document, PanelRegistry.of())
    assert historian.history().start == "New design"
    document.mark_saved(Path("b.skinsource"))
    assert historian.history().start == "New design"
    document.start_over(document.design, View(), Path("a.skinsource"))
    document.mark_saved(Path("b.skinsource"))
    assert historian.history().start == "Opened a.skinsource"
    document.start_over(document.design, View(), None)
    assert historian.history().start == "New design"
