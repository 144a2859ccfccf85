from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication, QLabel, QToolButton

from skinsource.design import Design, track
from skinsource_gui.panels.timeline.heads.row_places import row_places
from tests.gui.timeline.bench import PLACES, Bench, click, design_of, results_of


def test_there_is_one_row_for_each_input_in_the_order_of_the_design(bench):
    assert [row.state.shown.location for row in bench.rows.rows] == list(PLACES)
    assert "7, Digit II, pad: Tone 100 Hz" in bench.row(0).accessibleName()


def test_an_empty_list_says_what_to_do(bench):
    bench.show(Design(limb="any"))
    words = bench.panel.findChild(QLabel, "inputs_empty")
    assert words.isVisible()
    assert words.text() == "Click a place on the hand to add a track"
    assert bench.rows.rows == ()


def test_a_click_on_a_row_selects_its_input_and_takes_the_keys(bench):
    click(bench.row(2), QPoint(60, 10))
    assert bench.view.selected_input == 3
    assert bench.rows.hasFocus()
    assert bench.edits == []


def test_the_arrow_keys_select_and_stop_at_the_ends(bench):
    bench.key(Qt.Key.Key_Up)
    assert bench.view.selected_input == 1
    for _ in range(5):
        bench.key(Qt.Key.Key_Down)
    assert bench.view.selected_input == 3
    bench.key(Qt.Key.Key_Home)
    assert bench.view.selected_input == 1


def test_the_arrow_keys_begin_at_the_ends_where_nothing_is_selected(qtbot):
    bench = Bench(qtbot, design_of(*PLACES), selected=-1)
    bench.key(Qt.Key.Key_Down)
    assert bench.view.selected_input == 1


def test_a_selection_that_does_not_exist_is_none(qtbot):
    bench = Bench(qtbot, design_of(*PLACES), selected=7)
    assert bench.rows.last_row is None
    bench.key(Qt.Key.Key_Delete)
    assert bench.edits == []


def test_the_keys_m_and_s_mute_and_solo_the_selected_input(bench):
    bench.key(Qt.Key.Key_M)
    assert bench.design.inputs[0].muted
    bench.key(Qt.Key.Key_M)
    assert not bench.design.inputs[0].muted
    bench.key(Qt.Key.Key_S)
    assert bench.design.inputs[0].solo
    assert bench.labels == [
        "Mute input at 7 (II pad)",
        "Unmute input at 7 (II pad)",
        "Solo input at 7 (II pad)",
    ]
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
    assert bench.view.selected_input == 1


def test_what_is_not_heard_is_shown_as_silent(bench):
    bench.show(bench.design.with_input(1, muted=True))
    assert [row.state.silent for row in bench.rows.rows] == [False, True, False]
    bench.show(bench.design.with_input(1, solo=True))
    assert [row.state.silent for row in bench.rows.rows] == [True, True, True]
    bench.show(bench.design.with_input(0, solo=True))
    assert [row.state.silent for row in bench.rows.rows] == [False, True, True]


def test_a_muted_row_looks_different(bench):
    bench.panel.show_results(results_of(bench.design))
    before = bench.row(1).grab().toImage()
    bench.show(bench.design.with_input(1, muted=True))
    assert bench.row(1).grab().toImage() != before


@pytest.mark.parametrize("scale", [1.0, 1.3, 2.0])
def test_heads_and_the_buttons_above_them_have_room_for_larger_text(bench, scale):
    font = bench.panel.font()
    font.setPointSizeF(font.pointSizeF() * scale)
    bench.panel.setFont(font)
    QApplication.processEvents()
    buttons = bench.panel.findChildren(QToolButton)
    snap = next(one for one in buttons if one.objectName() == "timeline_snap")
    assert snap.width() >= snap.sizeHint().width()
    places = row_places(bench.row(0).width(), bench.row(0).fontMetrics().height())
    number = bench.row(0).fontMetrics().horizontalAdvance("15")
    assert places.swatch.width() >= number
    assert places.name.left() >= places.swatch.right()


def test_the_row_that_has_the_keyboard_may_give_way_to_others(bench):
    """As when another design is opened while a number of the list is selected."""
    first = bench.row(0)
    first.amplitude.setFocus()
    new = Design(limb="any", inputs=tuple(replace(track(location=k), id=50 + k) for k in (4, 5)))
    bench.show(new)
    assert [one.id for one in bench.rows.rows] == [54, 55]
    assert bench.rows.hasFocus()
    assert all(one.state.list_focused for one in bench.rows.rows)
