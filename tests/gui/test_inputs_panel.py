from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel

from skinsource.design import MAX_INPUTS, Design, Input
from skinsource.view import View
from skinsource.waveforms import Impulse, Noise, Tap, Tone
from skinsource_gui.panels.inputs import InputsPanel
from skinsource_gui.theme import DARK
from skinsource_gui.widgets.input_list import InputRows
from skinsource_gui.widgets.waveform_preview import extremes

PLACES = (7, 2, 15)


class Bench:
    """A panel and the little of a document and a window that it needs."""

    def __init__(self, qtbot, design, selected=0):
        self.panel = InputsPanel()
        qtbot.addWidget(self.panel)
        self.design, self.view = design, View(selected_input=selected)
        self.edits = []
        self.told = []
        self.panel.design_edited.connect(self._edit)
        self.panel.view_changed.connect(self._look)
        self.panel.resize(460, 300)
        self.panel.show_state(self.design, self.view)
        self.panel.show()
        qtbot.waitExposed(self.panel)
        self.panel.activateWindow()
        self.rows.setFocus()
        qtbot.waitUntil(self.rows.hasFocus)

    @property
    def rows(self):
        return self.panel.findChild(InputRows, "input_rows")

    def row(self, index):
        return self.rows.rows[index]

    @property
    def labels(self):
        return [label for label, _, _ in self.edits]

    @property
    def places(self):
        return [one.location for one in self.design.inputs]

    def show(self, design):
        self.design = design
        self.panel.show_state(self.design, self.view)

    def key(self, key, modifiers=Qt.KeyboardModifier.NoModifier):
        QTest.keyClick(QApplication.focusWidget(), key, modifiers)

    def _edit(self, label, design, gesture):
        self.edits.append((label, design, gesture))
        self.told.append("design")
        self.show(design)

    def _look(self, view):
        self.told.append("view")
        self.view = view
        self.panel.show_state(self.design, self.view)


def design_of(*places, **changes):
    design = Design(limb="any")
    for place in places:
        design = design.adding(Input(location=place, **changes))
    return design


@pytest.fixture
def bench(qtbot):
    return Bench(qtbot, design_of(*PLACES))


def click(widget, at=None):
    QTest.mouseClick(widget, Qt.MouseButton.LeftButton, pos=at or widget.rect().center())


def waveforms_of(design):
    return {"input_waveforms": tuple(one.waveform.samples(1300.0) for one in design.inputs)}


def test_there_is_one_row_for_each_input_in_the_order_of_the_design(bench):
    assert [row.state.shown.location for row in bench.rows.rows] == list(PLACES)
    assert "7, Digit II, pad: Tone 100 Hz" in bench.row(0).accessibleName()


def test_an_empty_list_says_what_to_do(bench):
    bench.show(Design(limb="any"))
    words = bench.panel.findChild(QLabel, "inputs_empty")
    assert words.isVisible()
    assert words.text() == "Click a place on the hand to add an input"
    assert bench.rows.rows == ()


def test_a_click_on_a_row_selects_its_input_and_takes_the_keys(bench):
    click(bench.row(2), QPoint(60, 10))
    assert bench.view.selected_input == 2
    assert bench.rows.hasFocus()
    assert bench.edits == []


def test_the_arrow_keys_select_and_stop_at_the_ends(bench):
    bench.key(Qt.Key.Key_Up)
    assert bench.view.selected_input == 0
    for _ in range(5):
        bench.key(Qt.Key.Key_Down)
    assert bench.view.selected_input == 2
    bench.key(Qt.Key.Key_Home)
    assert bench.view.selected_input == 0


def test_the_arrow_keys_begin_at_the_ends_where_nothing_is_selected(qtbot):
    bench = Bench(qtbot, design_of(*PLACES), selected=None)
    bench.key(Qt.Key.Key_Down)
    assert bench.view.selected_input == 0


def test_a_selection_that_does_not_exist_is_none(qtbot):
    bench = Bench(qtbot, design_of(*PLACES), selected=7)
    assert bench.rows.selected_row is None
    bench.key(Qt.Key.Key_Delete)
    assert bench.edits == []


def test_the_keys_m_and_s_mute_and_solo_the_selected_input(bench):
    bench.key(Qt.Key.Key_M)
    assert bench.design.inputs[0].muted
    bench.key(Qt.Key.Key_M)
    assert not bench.design.inputs[0].muted
    bench.key(Qt.Key.Key_S)
    assert bench.design.inputs[0].solo
    assert bench.labels == ["Mute input 7", "Unmute input 7", "Solo input 7"]
    assert bench.row(0).solo.isChecked()


def test_the_keys_m_and_s_also_work_while_a_number_has_the_focus(bench):
    click(bench.row(1).amplitude)
    bench.key(Qt.Key.Key_M)
    assert [one.muted for one in bench.design.inputs] == [False, True, False]


def test_buttons_act_on_their_own_row_and_leave_the_selection(bench):
    click(bench.row(1).mute)
    click(bench.row(2).solo)
    assert bench.design.inputs[1].muted
    assert bench.design.inputs[2].solo
    assert bench.view.selected_input == 0


def test_what_is_not_heard_is_shown_as_silent(bench):
    bench.show(bench.design.with_input(1, muted=True))
    assert [row.state.silent for row in bench.rows.rows] == [False, True, False]
    bench.show(bench.design.with_input(1, solo=True))
    assert [row.state.silent for row in bench.rows.rows] == [True, True, True]
    bench.show(bench.design.with_input(0, solo=True))
    assert [row.state.silent for row in bench.rows.rows] == [False, True, True]


def test_a_muted_row_looks_different(bench):
    bench.panel.show_results(waveforms_of(bench.design))
    before = bench.row(1).grab().toImage()
    bench.show(bench.design.with_input(1, muted=True))
    assert bench.row(1).grab().toImage() != before


@pytest.mark.parametrize("key", [Qt.Key.Key_Delete, Qt.Key.Key_Backspace])
def test_delete_removes_the_selected_input_and_selects_the_next(bench, key):
    bench.key(Qt.Key.Key_Down)
    bench.key(key)
    assert bench.places == [7, 15]
    assert bench.view.selected_input == 1
    assert bench.labels == ["Remove input 2"]


def test_removing_the_last_row_selects_the_one_before(bench):
    bench.key(Qt.Key.Key_End)
    bench.told.clear()
    bench.key(Qt.Key.Key_Delete)
    assert bench.told == ["design", "view"]
    assert bench.view.selected_input == 1


def test_removing_a_row_above_keeps_the_same_input_selected(bench):
    bench.key(Qt.Key.Key_End)
    click(bench.row(0).remove)
    assert bench.places == [2, 15]
    assert bench.view.selected_input == 1


def test_removing_the_only_input_selects_nothing(qtbot):
    bench = Bench(qtbot, design_of(7))
    bench.key(Qt.Key.Key_Delete)
    assert bench.design.inputs == ()
    assert bench.view.selected_input is None


def test_ctrl_d_duplicates_the_selected_input_in_a_colour_of_its_own(bench):
    bench.show(bench.design.with_input(0, amplitude=3.0, waveform=Noise(seed=4)))
    bench.key(Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier)
    copy, original = bench.design.inputs[3], bench.design.inputs[0]
    assert replace(copy, colour=0) == original
    assert copy.colour == 3
    assert bench.view.selected_input == 3
    assert bench.labels == ["Duplicate input 7"]


def test_one_input_too_many_is_refused_with_words(qtbot):
    bench = Bench(qtbot, design_of(*[1] * MAX_INPUTS))
    bench.key(Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier)
    assert bench.edits == []
    words = bench.panel.findChild(QLabel, "inputs_problem")
    assert words.isVisible()
    assert str(MAX_INPUTS) in words.text()


def test_typing_an_amplitude_edits_the_input_of_its_row_and_selects_it(bench):
    click(bench.row(1).amplitude)
    QTest.keyClicks(bench.row(1).amplitude, "2.5")
    bench.key(Qt.Key.Key_Return)
    assert bench.design.inputs[1].amplitude == 2.5
    assert bench.view.selected_input == 1
    assert [(label, gesture) for label, _, gesture in bench.edits] == [
        ("Change amplitude of input 2", None)
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


def test_an_open_editor_survives_the_removal_of_another_row(bench):
    row = bench.row(2)
    click(row.amplitude)
    QTest.keyClicks(row.amplitude, "4")
    bench.show(bench.design.without_input(0))
    assert bench.row(1) is row
    assert row.amplitude.editing
    assert row.amplitude.text() == "4"
    assert row.amplitude.hasFocus()


def test_rows_are_not_rebuilt_when_values_change(bench):
    rows = bench.rows.rows
    bench.show(bench.design.with_input(1, amplitude=5.0, location=3, waveform=Tap()))
    assert bench.rows.rows == rows
    assert bench.row(1).amplitude.value_si == 5.0


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


def test_each_row_shows_what_its_input_plays(bench):
    design = bench.design.with_input(1, waveform=Noise(duration_s=4.0))
    bench.show(design.with_input(2, waveform=Impulse()))
    before = bench.row(1).preview.grab().toImage()
    bench.panel.show_results(waveforms_of(bench.design))
    assert bench.row(1).preview.grab().toImage() != before
    assert all(row.preview.duration_s is not None for row in bench.rows.rows)


def test_results_of_another_number_of_inputs_are_not_shown(bench):
    bench.panel.show_results(waveforms_of(design_of(7)))
    assert all(row.preview.duration_s is None for row in bench.rows.rows)


def test_a_problem_empties_the_miniatures_and_is_told(bench):
    bench.panel.show_results(waveforms_of(bench.design))
    bench.panel.show_problem("No limb of that name")
    words = bench.panel.findChild(QLabel, "inputs_problem")
    assert (words.text(), words.isVisible()) == ("No limb of that name", True)
    assert all(row.preview.duration_s is None for row in bench.rows.rows)
    bench.panel.show_results(waveforms_of(bench.design))
    assert not words.isVisible()


def test_old_miniatures_turn_pale_only_after_a_while(bench, qtbot):
    bench.panel.show_results(waveforms_of(bench.design))
    fresh = bench.row(0).preview.grab().toImage()
    bench.panel.show_stale(True)
    assert bench.row(0).preview.grab().toImage() == fresh
    qtbot.waitUntil(lambda: bench.row(0).preview.grab().toImage() != fresh)
    bench.panel.show_stale(False)
    assert bench.row(0).preview.grab().toImage() == fresh


def test_fifty_inputs_scroll_and_the_selected_one_is_in_sight(qtbot):
    bench = Bench(qtbot, design_of(*[1 + k % 20 for k in range(50)]))
    bench.key(Qt.Key.Key_End)
    row = bench.row(49)
    assert bench.view.selected_input == 49
    qtbot.waitUntil(lambda: not row.visibleRegion().isEmpty())


def test_the_panel_takes_over_a_theme_and_fits_its_smallest_dock(bench):
    light = bench.panel.grab().toImage()
    bench.panel.show_theme(DARK)
    assert bench.panel.grab().toImage() != light
    assert bench.panel.minimumSizeHint().width() <= 300
    assert bench.panel.minimumSizeHint().height() <= 150


def test_an_unfinished_tone_keeps_its_highest_and_lowest_sample_in_a_miniature():
    samples = Tone(duration_s=2.0).samples(1300.0)
    shown = extremes(samples, 64)
    assert shown.shape == (64, 2)
    assert shown.min() == samples.min()
    assert shown.max() == samples.max()
    assert np.all(shown[:, 0] <= shown[:, 1])
