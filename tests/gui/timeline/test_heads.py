"""The heads of the tracks: what they show, and what mouse, keys and menu do to tracks."""

import itertools
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QToolButton, QToolTip

from skinsource import Design, View
from skinsource.design.amplitudes import amplitude_text
from skinsource.design.waveforms.samples import Recording
from skinsource.specs.samples import Samples
from skinsource_gui.fields.inputs import FieldChanges
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.timeline.content import shown_gain_curves
from skinsource_gui.qt.keys import key_text
from skinsource_gui.qt.labels import how_to_add
from tests.gui.menus import KEYBOARD, MOUSE, lines_at
from tests.gui.panel_host import clip_results
from tests.gui.timeline.bench import ALT, CONTROL, LEFT, NONE, PLACES, SHIFT, Bench, design_of
from tests.gui.wheel import NOTCH, turn_wheel

KEY = Qt.Key


def name_of(bench, index):
    return bench.head(index).data(Qt.ItemDataRole.AccessibleTextRole)


def test_there_is_one_row_for_each_input_and_without_any_it_says_what_to_do(bench):
    assert [head.track.location for head in bench.rows.heads] == list(PLACES)
    assert bench.rows.width() == 114
    assert "7, Digit II, pad: Tone 100 Hz" in name_of(bench, 0)
    bench.show(design_of(7, 25))
    assert name_of(bench, 1).startswith("Input at 25, Place 25, not on this hand: Tone")
    bench.show(Design(limb="synthetic-1"))
    label = bench.panel.findChild(QLabel, "inputs_empty")
    assert label.isVisible()
    assert label.text() == how_to_add("a track")
    assert bench.rows.heads == []


def test_a_meter_follows_what_its_track_plays(bench):
    results, changed = clip_results(bench.design), []
    bench.panel.show_results(results)
    bench.rows.model().dataChanged.connect(lambda first, _: changed.append(first.row()))
    first, *others = results["input_waveforms"]
    bench.panel.show_results(results | {"input_waveforms": (2 * first, *others)})
    assert changed == [0]


def test_what_is_not_heard_is_said_to_be_silent(bench):
    bench.show(bench.design.with_input(1, muted=True))
    assert [name_of(bench, k).endswith("silent") for k in range(3)] == [False, True, False]
    bench.show(bench.design.with_input(0, solo=True))
    assert [name_of(bench, k).endswith("silent") for k in range(3)] == [False, True, True]


@pytest.mark.parametrize("scale", [1.0, 1.3, 2.0])
def test_heads_have_room_for_larger_text_and_lanes_are_as_high(bench, scale):
    font = bench.panel.font()
    font.setPointSizeF(font.pointSizeF() * scale)
    bench.panel.setFont(font)
    QApplication.processEvents()
    snap = bench.panel.findChild(QToolButton, "timeline_snap")
    assert snap.width() >= snap.sizeHint().width()
    places, metrics = bench.rows.places(1), bench.rows.fontMetrics()
    assert places.swatch.width() >= metrics.horizontalAdvance("15")
    assert places.level.width() >= metrics.horizontalAdvance("\u221219.9")
    parts = [places.swatch, places.level, places.mute, places.solo]
    assert all(left.right() <= right.left() for left, right in itertools.pairwise(parts))
    assert places.solo.bottom() <= places.fader.top() < places.fader.bottom() <= places.meter.top()
    row = bench.rows.visualRect(bench.head(1))
    assert row.height() == pytest.approx(40 * max(metrics.height() / 14, 1.0), abs=1)
    assert metrics.height() == bench.panel.fontMetrics().height()
    assert row.contains(places.meter.toRect())
    tops = [round(lane.top_px - bench.panel.lanes.ruler_px) for lane in bench.content.lanes]
    assert tops == [row.height() * k for k in range(3)]


def test_a_level_has_tenths_where_the_mark_of_polarity_leaves_room(bench):
    def painted(amplitude):
        bench.show(bench.design.with_input(0, amplitude=amplitude))
        return bench.rows.grab(bench.rows.places(0).level.toRect()).toImage()

    assert painted(5.0) != painted(5.3)
    assert painted(-5.0) == painted(-5.3)


def tip_of(bench, index):
    return bench.head(index).data(Qt.ItemDataRole.ToolTipRole)


def test_the_tooltip_says_amplitude_and_peak_and_a_gain_where_a_recording_keeps_its_size(bench):
    bench.show(bench.design.with_input(0, amplitude=-0.5))
    bench.panel.show_results(clip_results(bench.design))
    assert "-0.5 m/s² (\u22126.02 dB), peak 0.5 m/s²" in tip_of(bench, 0)
    samples = Samples(values=4.88 * np.hanning(301), sample_rate_hz=1300.0, unit="m/s²")
    clip = replace(bench.design.inputs[0].clips[0], waveform=Recording(samples))
    bench.show(bench.design.with_input(0, clips=(clip,)))
    bench.panel.show_results(clip_results(bench.design))
    assert "Input gain -0.5 (\u22126.02 dB), peak 2.44 m/s²" in tip_of(bench, 0)


def test_where_an_amplitude_is_a_peak_on_the_skin_a_gain_curve_leaves_meter_and_tooltip(bench):
    results = clip_results(bench.design)
    softer = tuple(0.5 * played for played in results["input_waveforms"])
    bench.panel.show_results(results | {"input_waveforms": softer})
    meter = bench.rows.places(0).meter.toRect()
    before = bench.rows.grab(meter).toImage()
    bench.show(replace(bench.design, scaling="upstream"))
    assert "1 m/s² (0 dB), peak 1 m/s²" in tip_of(bench, 0)
    assert bench.rows.grab(meter).toImage() != before


def test_the_tooltip_of_several_selected_heads_says_that_buttons_change_all(bench):
    together = "change all selected inputs"
    assert together not in tip_of(bench, 0)
    bench.look(replace(bench.view, selected_inputs=(1, 2)))
    assert [together in tip_of(bench, k) for k in range(3)] == [True, True, False]
    clips = tuple(track.clips[0].id for track in bench.design.inputs[:2])
    bench.look(replace(bench.view, selected_clips=clips))
    assert together not in tip_of(bench, 0)


def amplitudes(bench):
    return [track.amplitude for track in bench.design.inputs]


def drag_fader(bench, index, by_px, *, release=True):
    view, start = bench.rows.viewport(), bench.place(index, "fader")
    QTest.mousePress(view, LEFT, NONE, start)
    for part in (0.5, 1.0):
        QTest.mouseMove(view, start + QPoint(round(part * by_px), 0))
    if release:
        QTest.mouseRelease(view, LEFT, NONE, start + QPoint(by_px, 0))


def test_a_fader_moves_the_selected_tracks_by_as_many_decibels_in_one_step(bench):
    bench.show(bench.design.with_input(1, amplitude=-0.5).with_input(2, amplitude=0.0))
    bench.look(View(selected_inputs=(1, 2)))
    width = bench.rows.places(0).fader.width()
    # The whole fader is 60 dB: a third of it is a factor of 10.
    drag_fader(bench, 0, -round(width / 3))
    first, second, third = amplitudes(bench)
    assert first == pytest.approx(0.1, rel=0.05)
    assert second == pytest.approx(-0.5 * first, rel=1e-3)
    assert third == 0.0
    assert [head.level_text(0) for head in bench.rows.heads] == ["\u221220", "\u221226", "\u2212∞"]
    assert set(bench.labels) == {"Change amplitude of 2 inputs"}
    assert len({gesture for _, _, gesture in bench.edits} - {None}) == 1
    assert QToolTip.text() == f"\u2212{-20 * np.log10(first):.3g} dB"
    # Far to the left it is silent; Escape brings it back.
    drag_fader(bench, 2, round(width), release=False)
    assert amplitudes(bench)[2] > 1.0
    bench.key(KEY.Key_Escape)
    assert amplitudes(bench)[2] == 0.0
    drag_fader(bench, 0, -round(2 * width))
    assert amplitudes(bench)[:2] == [0.0, second]


def test_keys_and_the_wheel_move_a_fader_and_come_back_to_where_it_was(bench):
    bench.key(KEY.Key_Right)
    assert amplitudes(bench) == [1.122, 1.0, 1.0]
    bench.key(KEY.Key_Left, SHIFT)
    assert amplitudes(bench)[0] == pytest.approx(1.122 / 1.9953, rel=1e-3)
    assert len({gesture for _, _, gesture in bench.edits}) == 1
    bench.show(bench.design.with_input(0, amplitude=1.0))
    view = bench.rows.viewport()
    for notches, expected in ((1, 1.122), (-1, 1.0)):
        turn_wheel(view, bench.place(0, "fader"), (0, notches * NOTCH))
        assert amplitudes(bench) == [expected, 1.0, 1.0]
    # Over a track that is not selected the wheel scrolls.
    turn_wheel(view, bench.place(1, "fader"), (0, NOTCH))
    bench.panel.lanes.setFocus()
    turn_wheel(view, bench.place(0, "fader"), (0, NOTCH))
    assert amplitudes(bench) == [1.0, 1.0, 1.0]


def ground(bench, index):
    """The colour of a head beside its parts."""
    corner = bench.rows.visualRect(bench.head(index)).topRight()
    return bench.rows.grab().toImage().pixelColor(corner + QPoint(-4, 5)).name()


def test_heads_whose_clips_are_selected_look_unlike_selected_heads_and_change_one_by_one(bench):
    first, second, _ = (track.clips[0].id for track in bench.design.inputs)
    bench.look(View(selected_inputs=(1, 2), selected_clips=(first, second)))
    bench.press(1, "mute")
    assert [track.muted for track in bench.design.inputs] == [False, True, False]
    assert len({ground(bench, k) for k in range(3)}) == 1
    bench.look(View(selected_inputs=(1,), selected_clips=(first,)))
    # A head without a selected clip: tracks are selected, and no clips.
    bench.press(1, held=CONTROL)
    assert (bench.view.selected_inputs, bench.view.selected_clips) == ((1, 2), ())
    bench.press(0, "solo")
    assert [track.solo for track in bench.design.inputs] == [True, True, False]
    assert ground(bench, 0) == ground(bench, 1) != ground(bench, 2)


def test_keys_act_on_the_clips_that_are_outlined_or_else_on_the_track_that_was_used(lanes):
    lanes.lanes.select(1, 4)
    # A switch selects nothing, and the clips keep the keyboard.
    lanes.press(1, "mute")
    assert lanes.view.selected_clips == (1, 4)
    lanes.key(KEY.Key_M)
    # So do clips that come while a head has it.
    lanes.look(View(selected_inputs=(2,)))
    lanes.rows.setFocus()
    lanes.lanes.select(2)
    # The next Delete takes neither a clip beside it nor the track.
    for _ in range(2):
        lanes.key(KEY.Key_Delete)
        assert (lanes.view.selected_inputs, lanes.view.selected_clips) == ((1,), ())
    assert lanes.labels[1:] == ["Mute 2 clips", "Remove clip at 7 (II pad)"]
    for use in (lanes.press, partial(drag_fader, lanes, by_px=9)):
        lanes.lanes.select(4, 1)
        use(1)
        assert (lanes.view.selected_inputs, lanes.view.selected_clips) == ((2,), ())
        lanes.key(KEY.Key_M)
        assert "ute input at 3" in lanes.labels[-1]
    # Who comes by Tab means tracks as well.
    lanes.lanes.select(4)
    lanes.rows.setFocus(Qt.FocusReason.TabFocusReason)
    assert (lanes.view.selected_clips, lanes.rows.hasFocus()) == ((), True)


@pytest.mark.parametrize(
    ("selected", "presses", "expected"),
    [
        ((1,), [KEY.Key_Up], (1,)),
        ((1,), [KEY.Key_Down] * 5, (3,)),
        ((3,), [KEY.Key_Home], (1,)),
        ((1,), [KEY.Key_End], (3,)),
        ((), [KEY.Key_Down], (1,)),
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

    def selected():
        return set(bench.view.selected_inputs), bench.view.selected_input

    bench.press(2)
    assert bench.rows.hasFocus()
    bench.press(4, held=SHIFT)
    assert selected() == ({3, 4, 5}, 5)
    bench.press(0, held=SHIFT)
    assert selected() == ({1, 2, 3}, 1)
    bench.press(5, held=CONTROL)
    assert selected() == ({1, 2, 3, 6}, 6)
    bench.press(1, held=CONTROL)
    assert selected()[0] == {1, 3, 6}
    bench.press(1, "fader", held=CONTROL)
    assert selected()[0] == {1, 2, 3, 6}
    # A click on one of several selects it alone.
    bench.press(0)
    assert bench.view.selected_inputs == (1,)
    assert bench.edits == []


@pytest.mark.parametrize(
    ("key", "modifiers", "label"),
    [
        (KEY.Key_M, NONE, "Mute 2 inputs"),
        (KEY.Key_S, NONE, "Solo 2 inputs"),
        (KEY.Key_Delete, NONE, "Remove 2 inputs"),
        (KEY.Key_D, CONTROL, "Duplicate 2 inputs"),
        (KEY.Key_Down, ALT, "Reorder 2 inputs"),
    ],
)
def test_keys_act_on_all_that_are_selected_in_one_step(bench, key, modifiers, label):
    bench.key(KEY.Key_Down, SHIFT)
    bench.key(key, modifiers)
    assert bench.labels == [label]


@pytest.mark.parametrize("given_up", [False, True])
def test_a_row_is_dragged_between_two_others_unless_escape_gives_it_up(bench, given_up):
    view, start, end = bench.rows.viewport(), bench.place(0), bench.place(1, "meter")
    gap = bench.rows.findChild(object, "input_gap")
    QTest.mousePress(view, LEFT, NONE, start)
    for y in ((start.y() + end.y()) // 2, end.y()):
        QTest.mouseMove(view, QPoint(start.x(), y))
    assert gap.isVisible()
    assert bench.edits == []
    if given_up:
        bench.key(KEY.Key_Escape)
    QTest.mouseRelease(view, LEFT, NONE, end)
    assert bench.places == ([7, 2, 15] if given_up else [2, 7, 15])
    assert not gap.isVisible()


def editor(bench):
    return bench.rows.findChild(NumberField, "amplitude_field")


def test_an_amplitude_is_typed_for_its_row_or_for_all_selected_ones(bench):
    view, fader = bench.rows.viewport(), bench.place(1, "fader")
    QTest.mouseDClick(view, LEFT, pos=fader)
    # A shaken mouse clicks twice more, without a press that was seen.
    twice, at = QEvent.Type.MouseButtonDblClick, QPointF(view.mapToGlobal(fader))
    QApplication.sendEvent(view, QMouseEvent(twice, QPointF(fader), at, LEFT, LEFT, NONE))
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QTest.keyClicks(editor(bench), "20")
    QTest.keyClick(editor(bench), KEY.Key_Return)
    assert amplitudes(bench) == [1.0, 10.0, 1.0]
    assert [head.level_text() for head in bench.rows.heads] == ["0.0", "+20.0", "0.0"]
    bench.look(View(selected_inputs=(2, 1)))
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    bench.rows.setFocus()
    bench.key(KEY.Key_Return)
    # What is no number stays, and changes nothing.
    QTest.keyClicks(editor(bench), "x")
    QTest.keyClick(editor(bench), KEY.Key_Return)
    assert editor(bench).problem
    assert amplitudes(bench) == [1.0, 10.0, 1.0]
    QTest.keyClick(editor(bench), KEY.Key_Backspace)
    QTest.keyClicks(editor(bench), "4 m/s²")
    QTest.keyClick(editor(bench), KEY.Key_Return)
    assert amplitudes(bench) == [4.0, 4.0, 1.0]
    assert bench.labels == [
        "Change amplitude of input at 2 (II tip)",
        "Change amplitude of 2 inputs",
    ]


@pytest.mark.parametrize(
    ("typed", "expected"),
    [
        ("-6 dB", [0.501187, -0.501187]),
        ("−6", [0.501187, -0.501187]),
        ("-6.02", [1.0, -0.5]),
        ("−∞", [0.0, 0.0]),
        ("-inf dB", [0.0, 0.0]),
        ("-2 m/s^2", [-2.0, -2.0]),
        ("1", [1.122018, -1.122018]),
    ],
)
def test_the_level_that_is_shown_is_typed_and_leaves_the_polarity(bench, typed, expected):
    bench.show(bench.design.with_input(1, amplitude=-0.5), selected_inputs=(1, 2))
    QTest.mouseDClick(bench.rows.viewport(), LEFT, pos=bench.place(1, "level"))
    assert (editor(bench).text(), editor(bench).unit_text) == ("-6.02", "dB")
    editor(bench).insert(typed)
    # A step of a number ends typing as well.
    QTest.keyClick(editor(bench), KEY.Key_Down)
    assert amplitudes(bench)[:2] == pytest.approx(expected, abs=1e-6)
    assert ["Polarity inverted" in tip_of(bench, k) for k in (0, 1)] == [
        value < 0 for value in amplitudes(bench)[:2]
    ]


def test_an_inverted_track_that_is_silent_has_an_amplitude_of_0_in_words(bench):
    bench.show(bench.design.with_input(0, amplitude=-0.5), selected_inputs=(1,))
    drag_fader(bench, 0, -200)
    assert "0 m/s² (silent)" in tip_of(bench, 0).split("\n")
    assert amplitude_text(bench.design, bench.design.inputs[0]) == "0 m/s²"
    # The fader has kept its polarity.
    bench.rows.setFocus()
    bench.key(KEY.Key_Right)
    assert amplitudes(bench)[0] < 0


def test_the_list_follows_the_selection_from_elsewhere(qtbot):
    bench = Bench(qtbot, design_of(*[1 + k % 20 for k in range(30)]))

    def in_sight(index):
        view, row = bench.rows.viewport(), bench.rows.visualRect(bench.head(index))
        lane = bench.content.lanes[index]
        beside = row.top() + bench.content.ruler_px
        return 0 <= row.top() <= view.height() - row.height() and abs(lane.top_px - beside) < 1

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


def menu_of(bench, index, reason=MOUSE):
    view = bench.rows.viewport()
    return lines_at(bench.panel, "inputs_menu", view, bench.place(index), reason)


def test_the_menu_is_about_the_row_under_the_pointer_and_each_line_does_what_it_says(bench):
    lines = menu_of(bench, 2)
    assert [line.text().split("\t")[1] for line in lines.values()] == [
        key_text("inputs", name) for name in ALL
    ]
    assert bench.view.selected_inputs == (3,)
    lines["Mute"].trigger()
    assert menu_of(bench, 2)["Mute"].isChecked()
    menu_of(bench, 1)["Solo"].trigger()
    assert [track.muted for track in bench.design.inputs] == [False, False, True]
    assert [track.solo for track in bench.design.inputs] == [False, True, False]
    menu_of(bench, 1)["Move up"].trigger()
    assert bench.places == [2, 7, 15]
    menu_of(bench, 0)["Move down"].trigger()
    menu_of(bench, 1)["Duplicate"].trigger()
    assert bench.places == [7, 2, 15, 2]
    # The menu key means the row that was selected last.
    menu_of(bench, 0, KEYBOARD)["Remove"].trigger()
    assert bench.places == [7, 2, 15]


def test_on_one_of_several_the_menu_is_about_all_of_them(bench):
    bench.key(KEY.Key_A, CONTROL)
    lines = menu_of(bench, 1)
    assert set(bench.view.selected_inputs) == {1, 2, 3}
    assert "Move 3 inputs up" in lines
    lines["Gain curve"].trigger()
    assert shown_gain_curves(bench.view) == {1, 2, 3}
    lines["Mute 3 inputs"].trigger()
    assert all(track.muted for track in bench.design.inputs)
    menu_of(bench, 1)["Remove 3 inputs"].trigger()
    assert bench.places == []
