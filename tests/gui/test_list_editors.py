"""Lists of numbers and points, typed; tables."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QKeySequence, QShortcut, QTextCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QToolButton

from skinsource.base.errors import InvalidInputError
from skinsource.design.waveforms.tones import Glide
from skinsource.design.waveforms.wavelet_train import WaveletTrain, frequency_sweep
from skinsource.signals.synthesis import curve_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import CurveSpec, ListSpec, NumberSpec
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.list_editors import GlideCurve, SweepDialog
from skinsource_gui.fields.text_field import LiveText
from skinsource_gui.fields.units import numbers_text, points_text, read_numbers, read_points
from skinsource_gui.shell.actions import ACTIONS, MENUS, ActionSpec

FREQUENCIES = specs_of(WaveletTrain)["frequencies_hz"]
POINTS = specs_of(Glide)["points"]
DELAYS = ListSpec(label="Delays", of=NumberSpec(label="Delay", unit="s", minimum=0, maximum=9))


@pytest.fixture
def make_cell(qtbot):
    def make(spec, value):
        cell = FieldCell("many", spec)
        qtbot.addWidget(cell)
        cell.edits = []
        cell.edited.connect(lambda name, value, gesture: cell.edits.append(value))
        cell.set_value(value)
        cell.show()
        qtbot.waitExposed(cell)
        cell.line = cell.field if isinstance(cell.field, LiveText) else cell.findChild(LiveText)
        cell.line.setFocus()
        cell.line.moveCursor(QTextCursor.MoveOperation.End)
        return cell

    return make


@pytest.mark.parametrize(
    ("spec", "text", "values", "shown"),
    [
        (FREQUENCIES, "50 84.1 400", (50.0, 84.1, 400.0), "50, 84.1, 400"),
        (FREQUENCIES, "50;84,1;400", (50.0, 84.1, 400.0), "50, 84.1, 400"),
        (FREQUENCIES, "50 Hz, 0.4 kHz,", (50.0, 400.0), "50, 400"),
        # In a list all times are in milliseconds.
        (DELAYS, "0, 250, 2500, 3 s", (0.0, 0.25, 2.5, 3.0), "0, 250, 2500, 3000"),
        (
            POINTS,
            "0 60 0; 2500, 84.1, 1;",
            ((0.0, 60.0, 0.0), (2.5, 84.1, 1.0)),
            "0 60 0; 2500 84.1 1",
        ),
    ],
)
def test_lists_are_read_as_one_writes_them_and_shown_short(spec, text, values, shown):
    read, write = (read_points, points_text) if spec is POINTS else (read_numbers, numbers_text)
    assert read(text, spec) == values
    assert write(values, spec) == shown
    assert read(shown, spec) == values


@pytest.mark.parametrize(
    ("spec", "text", "reason"),
    [
        (FREQUENCIES, "50, x", "“x” is not a number"),
        (FREQUENCIES, "50, 0", "0 Hz is too low"),
        (FREQUENCIES, "", "0 typed. Allowed: 1 to 1000 numbers"),
        (POINTS, "0 60 0; 100 60", "“100 60” has 2 numbers. Each point has 3: time in ms"),
        (POINTS, "0 60 0", "1 typed. Allowed: 2 to 2000 points"),
        (POINTS, "100 60 0; 50 60 1", "50 comes after 100. Put the points in the order"),
        (POINTS, "0 60 0; 100 60 2", "2 is too high"),
    ],
)
def test_what_a_list_may_not_hold_is_refused_in_words(spec, text, reason):
    with pytest.raises(InvalidInputError, match=reason):
        (read_points if spec is POINTS else read_numbers)(text, spec)


def test_a_list_is_told_while_it_is_typed_and_stays_as_it_is_typed(make_cell):
    cell = make_cell(FREQUENCIES, (50.0, 84.1))
    assert cell.line.text() == "50, 84.1"
    QTest.keyClicks(cell.line, ",70")
    assert cell.edits[-1] == (50.0, 84.1, 70.0)
    cell.set_value((50.0, 84.1, 70.0))
    assert cell.line.text() == "50, 84.1,70"
    cell.set_value((60.0,))
    assert cell.line.text() == "60"


def test_half_a_list_says_what_is_missing_and_esc_brings_it_back(make_cell):
    cell = make_cell(FREQUENCIES, (50.0, 84.1))
    cell.edited.connect(lambda _name, value, _gesture: cell.set_value(value))
    QTest.keyClicks(cell.line, ", 90z")
    assert cell.edits[-1] == (50.0, 84.1, 90.0)
    assert cell.note == "Frequency: “z” is not one of its units. Units: Hz, kHz."
    QTest.keyClick(cell.line, Qt.Key.Key_Escape)
    assert cell.line.text() == "50, 84.1"
    assert cell.edits[-1] == (50.0, 84.1)
    assert cell.note == ""


def test_of_a_list_left_invalid_no_half_is_taken_and_the_text_stays_marked(make_cell, qtbot):
    cell = make_cell(FREQUENCIES, (60.0,))
    cell.activateWindow()
    qtbot.waitUntil(cell.isActiveWindow)
    cell.edited.connect(lambda _name, value, _gesture: cell.set_value(value))
    cell.line.selectAll()
    QTest.keyClicks(cell.line, "50, 100, abc, 9000")
    assert (50.0, 100.0) in cell.edits
    cell.line.clearFocus()
    assert cell.edits[-1] == (60.0,)
    assert cell.line.text() == "50, 100, abc, 9000"
    assert "abc" in cell.note


def test_a_sweep_replaces_the_list_once_it_is_accepted(qtbot, make_cell):
    cell = make_cell(FREQUENCIES, (400.0, 100.0, 50.0))
    cell.findChild(QToolButton, "sweep").click()
    dialog = cell.window().findChild(SweepDialog)
    qtbot.waitUntil(dialog.isVisible)
    assert dialog.values == frequency_sweep(50.0, 400.0, 3, "logarithmic", "down")
    assert dialog.findChild(QLabel, "sweep_list").text() == "400, 141.42, 50 Hz"
    dialog.spacing.choose("linear")
    dialog.order.choose("up")
    assert dialog.findChild(QLabel, "sweep_list").text() == "50, 225, 400 Hz"
    assert cell.edits == []
    dialog.accept()
    assert cell.edits == [(50.0, 225.0, 400.0)]


def glide_cell(make_cell, points):
    """A cell whose owner takes over each edit, as the inspector does."""
    cell = make_cell(POINTS, points)
    cell.edited.connect(lambda _, value, __: cell.set_value(value))
    cell.curves = {
        name: cell.findChild(GlideCurve, f"{name}_curve") for name in ("frequency", "amplitude")
    }
    return cell


def test_a_point_that_is_dragged_moves_its_curve_and_not_the_other(make_cell):
    cell = glide_cell(make_cell, Glide().points)
    curve = cell.curves["frequency"]
    at = curve.place_of(1).toPoint()
    QTest.mousePress(curve, Qt.MouseButton.LeftButton, pos=at)
    for down_px in (4, 8):
        QTest.mouseMove(curve, at + QPoint(0, -down_px))
    QTest.mouseRelease(curve, Qt.MouseButton.LeftButton, pos=at + QPoint(0, -8))
    points = cell.edits[-1]
    assert curve_of(points, "frequency")[1][1] > 70.0
    assert curve_of(points, "amplitude") == curve_of(Glide().points, "amplitude")
    assert cell.line.text() == points_text(points, POINTS)


def test_a_new_point_stays_though_it_bends_nothing_yet(make_cell):
    cell = glide_cell(make_cell, ((0.0, 100.0, 1.0), (0.5, 100.0, 1.0)))
    curve = cell.curves["frequency"]
    between = ((curve.place_of(0) + curve.place_of(1)) / 2).toPoint()
    QTest.mousePress(curve, Qt.MouseButton.LeftButton, pos=between)
    assert len(curve.value) == 3
    QTest.mouseMove(curve, between + QPoint(0, 20))
    QTest.mouseRelease(curve, Qt.MouseButton.LeftButton, pos=between + QPoint(0, 20))
    bends = curve_of(cell.edits[-1], "frequency")
    assert len(bends) == 3
    assert bends[1][1] < 80.0
    assert bends[0][1] == bends[2][1] == 100.0


def test_times_of_points_are_shown_short_and_stay_exact_when_others_are_typed(qtbot):
    time = NumberSpec(label="Time", unit="s", minimum=0, maximum=9)
    gain = NumberSpec(label="Gain", minimum=0, maximum=4)
    cell = FieldCell("gain_curve", CurveSpec(label="Gain curve", x=time, y=gain, most=9))
    qtbot.addWidget(cell)
    edits = []
    cell.edited.connect(lambda name, value, gesture: edits.append(value))
    cell.set_value(((0.509010598, 1.0), (0.917761532, 0.0)))
    assert cell.field.line.text() == "509.01 1; 917.76 0"
    cell.field.line.setPlainText("509.01 1; 917.76 2")
    assert edits == [((0.509010598, 1.0), (0.917761532, 2.0))]
    cell.field.line.setPlainText("509.02 1; 917.76 2")
    assert edits[1:] == [((0.50902, 1.0), (0.917761532, 2.0))]
    # Rounded, these would be one.
    cell.set_value(((0.509010598, 1.0), (0.509010599, 0.0)))
    assert cell.field.line.text() == "509.010598 1; 509.010599 0"


def test_conditions_follow_the_document(window):
    enabled = {name: action.isEnabled for name, action in window.actions_by_name.items()}
    assert enabled["select_no_outputs"]()
    assert enabled["mute_input"]()
    window.document.look(replace(window.document.view, outputs=(), selected_inputs=()))
    assert not enabled["select_no_outputs"]()
    assert not enabled["mute_input"]()
    assert enabled["clear_inputs"]()
    window.do("clear_inputs")
    assert not enabled["clear_inputs"]()


def test_an_action_is_a_command_or_an_edit_not_both_and_not_neither():
    fields = {"name": "a", "text": "A", "hint": "A"}
    for more in ({}, {"command": "files.new", "edit": lambda design, view: None}):
        with pytest.raises(ValueError, match="either a command or an edit"):
            ActionSpec(**fields, **more)


def test_each_menu_opens_with_a_letter_of_its_own_and_the_first_with_f10(window, qtbot):
    bar = window.menuBar()
    keys = [QKeySequence.mnemonic(action.text()) for action in bar.actions()]
    assert QKeySequence() not in keys
    others = [QKeySequence(key) for spec in ACTIONS for key in spec.keys]
    assert len(set(keys) - set(others)) == len(keys) == len(MENUS)
    (key,) = [
        shortcut
        for shortcut in bar.findChildren(QShortcut)
        if shortcut.key() == QKeySequence("F10")
    ]
    assert key.key() not in others
    key.activated.emit()
    menu = bar.actions()[0].menu()
    qtbot.waitUntil(menu.isVisible)
    menu.close()
