"""The heads of the tracks: what they show, and what mouse, keys and menu do to tracks."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QMenu, QToolButton

from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.design.waveforms.samples import Recording
from skinsource.design.waveforms.tones import Tone
from skinsource.specs.samples import Samples
from skinsource_gui.fields.inputs import FieldChanges
from skinsource_gui.panels.timeline.content import shown_gain_curves
from skinsource_gui.panels.timeline.head_row import row_places
from skinsource_gui.qt.keys import key_text
from skinsource_gui.qt.labels import how_to_add
from tests.gui.timeline.bench import (
    ALT,
    CONTROL,
    LEFT,
    NONE,
    PLACES,
    SHIFT,
    Bench,
    click,
    design_of,
)

KEY = Qt.Key
WORDS = QPoint(60, 10)


def press_row(bench, index, modifiers=NONE):
    QTest.mouseClick(bench.row(index), LEFT, modifiers, WORDS)


def test_there_is_one_row_for_each_input_and_without_any_it_says_what_to_do(bench):
    assert [row.state.track.location for row in bench.rows.rows] == list(PLACES)
    assert "7, Digit II, pad: Tone 100 Hz" in bench.row(0).accessibleName()
    bench.show(design_of(7, 25))
    name = "Input at 25, Place 25, not on this hand: Tone"
    assert bench.row(1).accessibleName().startswith(name)
    bench.show(Design(limb="synthetic-1"))
    label = bench.panel.findChild(QLabel, "inputs_empty")
    assert label.isVisible()
    assert label.text() == how_to_add("a track")
    assert bench.rows.rows == ()


def test_what_is_not_heard_is_shown_as_silent(bench):
    bench.show(bench.design.with_input(1, muted=True))
    assert [row.state.silent for row in bench.rows.rows] == [False, True, False]
    bench.show(bench.design.with_input(0, solo=True))
    assert [row.state.silent for row in bench.rows.rows] == [False, True, True]


@pytest.mark.parametrize("scale", [1.0, 1.3, 2.0])
def test_heads_and_the_buttons_above_them_have_room_for_larger_text(bench, scale):
    font = bench.panel.font()
    font.setPointSizeF(font.pointSizeF() * scale)
    bench.panel.setFont(font)
    QApplication.processEvents()
    snap = bench.panel.findChild(QToolButton, "timeline_snap")
    assert snap.width() >= snap.sizeHint().width()
    metrics = bench.row(0).fontMetrics()
    places = row_places(bench.row(0).width(), metrics.height())
    assert places.swatch.width() >= metrics.horizontalAdvance("15")
    assert places.name.left() >= places.swatch.right()
    # Lanes are as high as their heads.
    heights = {round(lane.height_px) for lane in bench.panel.lanes.content.lanes}
    assert heights == {row.height() for row in bench.rows.rows}


def test_the_head_of_a_recording_that_keeps_its_size_says_the_peak_beside_a_gain(bench):
    first, other = bench.row(0), bench.row(1)
    beside = other.amplitude.geometry()
    samples = Samples(values=4.88 * np.hanning(301), sample_rate_hz=1300.0, unit="m/s²")
    clip = replace(bench.design.inputs[0].clips[0], waveform=Recording(samples))
    bench.show(bench.design.with_input(0, clips=(clip,), amplitude=-0.5))
    assert (first.amplitude.spec.label, first.amplitude.spec.unit) == ("Gain", "")
    assert first.amplitude.text() == "\N{MINUS SIGN}0.5"
    assert first.state.peak == "2.44 m/s²"
    assert "Peak 2.44 m/s²" in first.toolTip()
    places = row_places(first.width(), first.fontMetrics().height(), peak=True)
    assert first.amplitude.geometry() == places.amplitude
    assert places.amplitude.right() < places.peak.left()
    assert places.peak.right() < places.remove.left()
    assert first.fontMetrics().horizontalAdvance(first.state.peak) <= places.peak.width()
    assert (other.amplitude.spec.unit, other.amplitude.geometry()) == ("m/s²", beside)
    bench.show(replace(bench.design.with_clip(clip.id, waveform=Tone()), scaling="relative"))
    assert first.amplitude.spec.unit == "×"
    assert first.amplitude.geometry() == beside


@pytest.mark.parametrize(
    ("selected", "presses", "expected"),
    [
        ((1,), [KEY.Key_Up], (1,)),
        ((1,), [KEY.Key_Down] * 5, (3,)),
        ((3,), [KEY.Key_Home], (1,)),
        ((1,), [KEY.Key_End], (3,)),
        ((), [KEY.Key_Down], (1,)),
        ((), [KEY.Key_Up], (3,)),
        ((8,), [KEY.Key_Delete], (8,)),
        ((1,), [(KEY.Key_Down, SHIFT)] * 2, (1, 2, 3)),
        ((1,), [(KEY.Key_Down, SHIFT)] * 2 + [(KEY.Key_Up, SHIFT)], (1, 2)),
        ((1,), [(KEY.Key_A, CONTROL)], (2, 3, 1)),
    ],
)
def test_keys_select(bench, selected, presses, expected):
    bench.look(View(selected_inputs=selected))
    for press in presses:
        bench.key(*(press if isinstance(press, tuple) else (press,)))
    assert set(bench.view.selected_inputs) == set(expected)
    assert bench.edits == []


def test_clicks_select_one_add_and_take_out_and_select_all_on_the_way(qtbot):
    bench = Bench(qtbot, design_of(*range(1, 7)))
    press_row(bench, 2)
    assert bench.rows.hasFocus()
    press_row(bench, 4, SHIFT)
    assert bench.view.selected_inputs == (3, 4, 5)
    press_row(bench, 0, SHIFT)
    assert bench.view.selected_inputs == (3, 2, 1)
    press_row(bench, 5, CONTROL)
    assert bench.view.selected_inputs == (3, 2, 1, 6)
    press_row(bench, 1, CONTROL)
    assert bench.view.selected_inputs == (3, 1, 6)
    # A click on one of several selects it alone.
    press_row(bench, 0)
    assert bench.view.selected_inputs == (1,)
    assert bench.edits == []


@pytest.mark.parametrize(
    ("key", "modifiers", "label"),
    [
        (KEY.Key_M, NONE, "Mute 2 inputs"),
        (KEY.Key_S, NONE, "Solo 2 inputs"),
        (KEY.Key_Delete, NONE, "Remove 2 inputs"),
        (KEY.Key_Backspace, NONE, "Remove 2 inputs"),
        (KEY.Key_D, CONTROL, "Duplicate 2 inputs"),
        (KEY.Key_Down, ALT, "Reorder 2 inputs"),
    ],
)
def test_keys_act_on_all_that_are_selected_in_one_step(bench, key, modifiers, label):
    bench.key(KEY.Key_Down, SHIFT)
    if key in (KEY.Key_M, KEY.Key_S):
        # Also while a number has the focus.
        bench.row(1).amplitude.setFocus()
    bench.key(key, modifiers)
    assert bench.labels == [label]


@pytest.mark.parametrize("given_up", [False, True])
def test_a_row_is_dragged_between_two_others_unless_escape_gives_it_up(bench, given_up):
    rows, start = bench.rows, bench.row(0).mapTo(bench.rows, WORDS)
    end = QPoint(start.x(), bench.row(1).geometry().bottom() - 2)
    gap = rows.findChild(object, "input_gap")
    QTest.mousePress(rows, LEFT, NONE, start)
    for y in ((start.y() + end.y()) // 2, end.y()):
        QTest.mouseMove(rows, QPoint(start.x(), y))
    assert gap.isVisible()
    assert bench.edits == []
    if given_up:
        bench.key(KEY.Key_Escape)
    QTest.mouseRelease(rows, LEFT, NONE, end)
    assert bench.places == ([7, 2, 15] if given_up else [2, 7, 15])
    assert not gap.isVisible()


def test_an_amplitude_is_typed_for_its_row_or_for_all_selected_ones(bench):
    click(bench.row(1).amplitude)
    QTest.keyClicks(bench.row(1).amplitude, "2.5")
    bench.key(KEY.Key_Return)
    assert bench.design.inputs[1].amplitude == 2.5
    assert bench.view.selected_input == 2
    assert bench.edits[0][::2] == ("Change amplitude of input at 2 (II tip)", None)
    bench.rows.setFocus()
    bench.key(KEY.Key_Up, SHIFT)
    bench.key(KEY.Key_Return)
    assert bench.row(0).amplitude.editing
    QTest.keyClicks(bench.row(0).amplitude, "4")
    bench.key(KEY.Key_Return)
    assert [track.amplitude for track in bench.design.inputs] == [4.0, 4.0, 1.0]


def test_tab_leads_through_the_selected_row_only_and_keys_stay_when_that_goes(bench):
    bench.key(KEY.Key_Down)
    visited = []
    for _ in range(4):
        bench.key(KEY.Key_Tab)
        visited.append(QApplication.focusWidget())
    assert visited == list(bench.row(1).controls)
    bench.key(KEY.Key_Space)
    assert bench.places == [7, 15]
    assert bench.rows.hasFocus()


def test_the_list_follows_the_selection_from_elsewhere(qtbot):
    bench = Bench(qtbot, design_of(*[1 + k % 20 for k in range(30)]))

    def in_sight(index):
        view, row = bench.panel.list.viewport(), bench.row(index)
        top = row.mapTo(view, QPoint(0, 0)).y()
        lane = bench.panel.lanes.content.lanes[index]
        beside = top + bench.panel.lanes.content.ruler_px
        return 0 <= top <= view.height() - row.height() and abs(lane.top_px - beside) < 1

    for index in (29, 0, 17):
        bench.look(View(selected_inputs=(index + 1,)))
        qtbot.waitUntil(lambda index=index: in_sight(index))
    # Lanes scroll with it.
    bench.panel.lanes.scroll_requested.emit(30.0)
    assert in_sight(0)
    assert not in_sight(17)


def test_the_way_back_of_a_drag_leads_where_it_began_also_from_a_limit():
    design = design_of(7, 2).with_clip(1, onset_s=0.05).with_clip(2, onset_s=0.2)
    view, changes = View(selected_inputs=(1, 2)), FieldChanges()

    def onsets_s(of, value, gesture):
        changed = changes.change(of, view, (1, 2), "onset_s", value, lead=2, gesture=gesture)
        return changed.design, [track.clips[0].onset_s for track in changed.design.inputs]

    at_limit, onsets = onsets_s(design, 0.0, gesture=1)
    assert onsets == [0.0, 0.0]
    assert onsets_s(at_limit, 0.2, gesture=1)[1] == [0.05, 0.2]
    # Another drag begins where the last one ended; a typed value sets all.
    assert onsets_s(at_limit, 0.2, gesture=2)[1] == [0.2, 0.2]
    assert onsets_s(design, 0.3, gesture=None)[1] == [0.3, 0.3]


ALL = ("mute", "solo", "duplicate", "remove", "shift_up", "shift_down", "gain_curve")


@pytest.fixture
def menu_of(bench):
    """Open the menu of a row; its actions by their words."""

    def close():
        for menu in bench.panel.findChildren(QMenu, "inputs_menu"):
            menu.close()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    def open_menu(index, reason=QContextMenuEvent.Reason.Mouse):
        close()
        at = bench.row(index).pos() + WORDS
        where = bench.rows.mapToGlobal(at)
        QApplication.sendEvent(bench.rows, QContextMenuEvent(reason, at, where))
        (menu,) = bench.panel.findChildren(QMenu, "inputs_menu")
        return {action.text().split("\t")[0]: action for action in menu.actions() if action.text()}

    yield open_menu
    close()


def test_the_menu_is_about_the_row_under_the_pointer_and_each_line_does_what_it_says(
    bench, menu_of
):
    lines = menu_of(2)
    assert [line.text().split("\t")[1] for line in lines.values()] == [
        key_text("inputs", name) for name in ALL
    ]
    assert bench.view.selected_inputs == (3,)
    lines["Mute"].trigger()
    assert menu_of(2)["Mute"].isChecked()
    menu_of(1)["Solo"].trigger()
    assert [(track.muted, track.solo) for track in bench.design.inputs] == [
        (False, False),
        (False, True),
        (True, False),
    ]
    menu_of(1)["Move up"].trigger()
    assert bench.places == [2, 7, 15]
    menu_of(0)["Move down"].trigger()
    menu_of(1)["Duplicate"].trigger()
    assert bench.places == [7, 2, 15, 2]
    # The menu key means the row that was selected last.
    menu_of(0, QContextMenuEvent.Reason.Keyboard)["Remove"].trigger()
    assert bench.places == [7, 2, 15]


def test_on_one_of_several_the_menu_is_about_all_of_them(bench, menu_of):
    bench.key(KEY.Key_A, CONTROL)
    lines = menu_of(1)
    assert set(bench.view.selected_inputs) == {1, 2, 3}
    assert "Move 3 inputs up" in lines
    lines["Gain curve"].trigger()
    assert shown_gain_curves(bench.view) == {1, 2, 3}
    lines["Mute 3 inputs"].trigger()
    assert all(track.muted for track in bench.design.inputs)
    menu_of(1)["Remove 3 inputs"].trigger()
    assert bench.places == []
