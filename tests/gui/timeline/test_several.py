"""Several inputs in the list: selected, changed, reordered; the list follows the selection."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from skinsource.design.waveforms.tones import Tone
from tests.gui.timeline.bench import PLACES, Bench, click, design_of

KEY, LEFT = Qt.Key, Qt.MouseButton.LeftButton
SHIFT, CONTROL, ALT = (
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.AltModifier,
)
WORDS = QPoint(60, 10)


def press_row(bench, index, modifiers=Qt.KeyboardModifier.NoModifier):
    QTest.mouseClick(bench.row(index), LEFT, modifiers, WORDS)


def test_ctrl_click_adds_and_takes_out(bench):
    press_row(bench, 2, CONTROL)
    assert bench.view.selected_inputs == (1, 3)
    press_row(bench, 0, CONTROL)
    assert bench.view.selected_inputs == (3,)
    assert [row.state.selected for row in bench.rows.rows] == [False, False, True]


def test_shift_click_selects_all_on_the_way_from_the_last_plain_click(qtbot):
    bench = Bench(qtbot, design_of(*range(1, 7)))
    press_row(bench, 2)
    press_row(bench, 4, SHIFT)
    assert bench.view.selected_inputs == (3, 4, 5)
    press_row(bench, 0, SHIFT)
    assert bench.view.selected_inputs == (3, 2, 1)


def test_a_click_on_one_of_several_selects_it_alone(bench):
    bench.key(KEY.Key_A, CONTROL)
    assert set(bench.view.selected_inputs) == {1, 2, 3}
    press_row(bench, 1)
    assert bench.view.selected_inputs == (2,)


def test_shift_and_arrows_extend_the_selection(bench):
    bench.key(KEY.Key_Down, SHIFT)
    bench.key(KEY.Key_Down, SHIFT)
    assert bench.view.selected_inputs == (1, 2, 3)
    bench.key(KEY.Key_Up, SHIFT)
    assert bench.view.selected_inputs == (1, 2)
    bench.key(KEY.Key_End)
    assert bench.view.selected_inputs == (3,)


@pytest.mark.parametrize(
    ("key", "modifiers", "label"),
    [
        (KEY.Key_M, Qt.KeyboardModifier.NoModifier, "Mute 2 inputs"),
        (KEY.Key_S, Qt.KeyboardModifier.NoModifier, "Solo 2 inputs"),
        (KEY.Key_Delete, Qt.KeyboardModifier.NoModifier, "Remove 2 inputs"),
        (KEY.Key_D, CONTROL, "Duplicate 2 inputs"),
        (KEY.Key_Down, ALT, "Reorder 2 inputs"),
    ],
)
def test_keys_act_on_all_that_are_selected_in_one_step(bench, key, modifiers, label):
    bench.key(KEY.Key_Down, SHIFT)
    bench.key(key, modifiers)
    assert bench.labels == [label]


def test_the_button_of_a_selected_row_acts_on_all_and_that_of_another_row_on_itself(bench):
    bench.key(KEY.Key_Down, SHIFT)
    click(bench.row(0).mute)
    assert [track.muted for track in bench.design.inputs] == [True, True, False]
    click(bench.row(2).mute)
    assert [track.muted for track in bench.design.inputs] == [True, True, True]
    click(bench.row(0).remove)
    assert bench.places == list(PLACES[1:])


def test_alt_and_arrows_reorder_and_the_selection_goes_along(bench):
    bench.key(KEY.Key_Down, ALT)
    assert bench.places == [2, 7, 15]
    assert bench.view.selected_inputs == (1,)
    bench.key(KEY.Key_Down, ALT)
    bench.key(KEY.Key_Down, ALT)
    assert bench.places == [2, 15, 7]
    bench.key(KEY.Key_Up, ALT)
    assert bench.places == [2, 7, 15]


def drag_row(bench, index, to_y):
    rows = bench.rows
    start = bench.row(index).mapTo(rows, WORDS)
    QTest.mousePress(rows, LEFT, Qt.KeyboardModifier.NoModifier, start)
    for y in ((start.y() + to_y) // 2, to_y):
        QTest.mouseMove(rows, QPoint(start.x(), y))
    return QPoint(start.x(), to_y)


def test_a_row_is_dragged_between_two_others(bench):
    end = drag_row(bench, 0, bench.row(1).geometry().bottom() - 2)
    assert bench.rows.findChild(object, "input_gap").isVisible()
    assert bench.edits == []
    QTest.mouseRelease(bench.rows, LEFT, Qt.KeyboardModifier.NoModifier, end)
    assert bench.places == [2, 7, 15]
    assert not bench.rows.findChild(object, "input_gap").isVisible()


def test_escape_gives_a_drag_up(bench):
    end = drag_row(bench, 0, bench.row(2).geometry().bottom())
    bench.key(KEY.Key_Escape)
    QTest.mouseRelease(bench.rows, LEFT, Qt.KeyboardModifier.NoModifier, end)
    assert bench.edits == []


def test_an_amplitude_typed_in_one_of_several_rows_sets_all(bench):
    bench.key(KEY.Key_Down, SHIFT)
    click(bench.row(0).amplitude)
    QTest.keyClicks(bench.row(0).amplitude, "2.5")
    bench.key(KEY.Key_Return)
    assert [track.amplitude for track in bench.design.inputs] == [2.5, 2.5, 1.0]
    assert bench.view.selected_inputs == (1, 2)


def test_the_wheel_moves_the_amplitudes_of_all_by_as_much(bench):
    bench.show(bench.design.with_input(1, amplitude=2.0))
    bench.key(KEY.Key_Down, SHIFT)
    field = bench.row(1).amplitude
    field.setFocus()
    for _ in range(2):
        QTest.keyClick(field, KEY.Key_Up)
    first, other, third = (each.amplitude for each in bench.design.inputs)
    assert other > 2.0
    assert first - 1.0 == pytest.approx(other - 2.0)
    assert third == 1.0


def in_sight(bench, index):
    view = bench.panel.list.viewport()
    row = bench.row(index)
    top = row.mapTo(view, QPoint(0, 0)).y()
    return top >= 0 and top + row.height() <= view.height()


def test_the_list_follows_the_selection_from_elsewhere(qtbot):
    bench = Bench(qtbot, design_of(*[1 + k % 20 for k in range(30)]))
    for index in (29, 0, 17):
        bench.view = bench.view.__class__(selected_inputs=(index + 1,))
        bench.show(bench.design)
        qtbot.waitUntil(lambda index=index: in_sight(bench, index))


def test_a_drag_held_on_an_amplitude_ends_when_its_input_goes(bench):
    field = bench.row(0).amplitude
    start = field.rect().center()
    QTest.mousePress(field, LEFT, pos=start)
    QTest.mouseMove(field, start + QPoint(20, 0))
    count = len(bench.edits)
    assert count > 0
    bench.show(bench.design.without_input(0))
    QTest.mouseMove(field, start + QPoint(60, 0))
    QTest.mouseRelease(field, LEFT, pos=start)
    assert len(bench.edits) == count
    assert [track.clips[0].waveform for track in bench.design.inputs] == [Tone()] * 2
