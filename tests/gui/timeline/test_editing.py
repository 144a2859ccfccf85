from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.design import MAX_INPUTS
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise
from skinsource_gui.fields.inputs import FieldChanges
from tests.gui.timeline.bench import Bench, click, design_of


@pytest.mark.parametrize("key", [Qt.Key.Key_Delete, Qt.Key.Key_Backspace])
def test_delete_removes_the_selected_input_and_selects_the_next(bench, key):
    bench.key(Qt.Key.Key_Down)
    bench.key(key)
    assert bench.places == [7, 15]
    assert bench.view.selected_input == 3
    assert bench.labels == ["Remove input at 2 (II tip)"]


def test_removing_the_last_row_selects_the_one_before(bench):
    bench.key(Qt.Key.Key_End)
    bench.requests.clear()
    bench.key(Qt.Key.Key_Delete)
    assert bench.requests == ["edit"]
    assert bench.view.selected_input == 2


def test_removing_a_row_above_keeps_the_same_input_selected(bench):
    bench.key(Qt.Key.Key_End)
    click(bench.row(0).remove)
    assert bench.places == [2, 15]
    assert bench.view.selected_input == 3


def test_ctrl_d_duplicates_the_selected_input_in_a_colour_of_its_own(bench):
    bench.show(bench.design.with_input(0, amplitude=3.0).with_clip(1, waveform=Noise(seed=4)))
    bench.key(Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier)
    copy, original = bench.design.inputs[3], bench.design.inputs[0]
    assert replace(copy, colour=0, id=1, clips=original.clips) == original
    assert replace(copy.clips[0], id=1) == original.clips[0]
    assert (copy.colour, copy.id) == (3, 4)
    assert bench.view.selected_input == 4
    assert bench.labels == ["Duplicate input at 7 (II pad)"]


def test_one_input_too_many_is_refused_with_words(qtbot):
    bench = Bench(qtbot, design_of(*[1] * MAX_INPUTS))
    bench.key(Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier)
    assert bench.edits == []
    assert str(MAX_INPUTS) in bench.refusals[-1]


def test_typing_an_amplitude_edits_the_input_of_its_row_and_selects_it(bench):
    click(bench.row(1).amplitude)
    QTest.keyClicks(bench.row(1).amplitude, "2.5")
    bench.key(Qt.Key.Key_Return)
    assert bench.design.inputs[1].amplitude == 2.5
    assert bench.view.selected_input == 2
    assert [(label, gesture) for label, _, gesture in bench.edits] == [
        ("Change amplitude of input at 2 (II tip)", None)
    ]


def test_enter_types_the_amplitude_of_the_selected_input(bench):
    bench.key(Qt.Key.Key_Down)
    bench.key(Qt.Key.Key_Return)
    assert bench.row(1).amplitude.editing
    assert bench.row(1).amplitude.hasFocus()


def test_a_drag_of_the_amplitude_is_one_gesture_and_keeps_its_row(bench):
    row = bench.row(0)
    field = row.amplitude
    start = field.rect().center()
    QTest.mousePress(field, Qt.MouseButton.LeftButton, pos=start)
    for way in (20, 40, 60):
        here = QPointF(start + QPoint(way, 0))
        move = QMouseEvent(
            QEvent.Type.MouseMove,
            here,
            QPointF(field.mapToGlobal(here.toPoint())),
            Qt.MouseButton.NoButton,
            Qt.MouseButton.LeftButton,
            Qt.KeyboardModifier.NoModifier,
        )
        QApplication.sendEvent(field, move)
    QTest.mouseRelease(field, Qt.MouseButton.LeftButton, pos=start)
    assert len(bench.edits) == 3
    assert len({gesture for _, _, gesture in bench.edits}) == 1
    assert bench.design.inputs[0].amplitude == 1.75
    assert bench.row(0) is row


def test_the_unit_of_the_amplitude_follows_the_scaling(bench):
    assert bench.row(0).amplitude.spec.unit == "m/s²"
    bench.show(replace(bench.design, scaling="relative"))
    assert bench.row(0).amplitude.spec.unit == "×"


def test_tab_leads_through_the_controls_of_the_selected_row_only(bench):
    bench.key(Qt.Key.Key_Down)
    visited = []
    for _ in range(4):
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
        visited.append(QApplication.focusWidget())
    assert visited == list(bench.row(1).controls)
    bench.key(Qt.Key.Key_Space)
    assert bench.places == [7, 15]


def test_removing_the_row_that_has_the_focus_leaves_the_keys_with_the_list(bench):
    for _ in range(4):
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
    bench.key(Qt.Key.Key_Return)
    assert bench.places == [2, 15]
    assert bench.rows.hasFocus()


BOTH = View(selected_inputs=(1, 2))


def onsets_s(design):
    return [track.clips[0].onset_s for track in design.inputs]


def change(changes, design, value, gesture):
    ids = BOTH.selected_inputs
    return changes.change(design, BOTH, ids, "onset_s", value, lead=2, gesture=gesture).design


@pytest.fixture
def design():
    design = design_of(7, 2)
    return design.with_clip(1, onset_s=0.05).with_clip(2, onset_s=0.2)


def test_the_way_back_of_a_drag_leads_where_it_began_also_from_a_limit(design):
    changes = FieldChanges()
    at_limit = change(changes, design, 0.0, gesture=1)
    assert onsets_s(at_limit) == [0.0, 0.0]
    assert onsets_s(change(changes, at_limit, 0.2, gesture=1)) == [0.05, 0.2]


def test_another_drag_begins_where_the_last_one_ended(design):
    changes = FieldChanges()
    at_limit = change(changes, design, 0.0, gesture=1)
    assert onsets_s(change(changes, at_limit, 0.2, gesture=2)) == [0.2, 0.2]


def test_a_typed_value_sets_all(design):
    assert onsets_s(change(FieldChanges(), design, 0.3, gesture=None)) == [0.3, 0.3]
