"""The gain curve of a track, typed in the inspector."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from skinsource_gui.fields.text_field import LiveText
from skinsource_gui.panels.inspector.panel import InputFields
from skinsource_gui.state.preferences import start_design


def line_of(window):
    inspector = window.panel("inspector")
    lines = [label for label in inspector.findChildren(LiveText) if label.isVisibleTo(inspector)]
    return lines[0] if lines else None


def retype(line, text):
    line.setFocus()
    line.selectAll()
    QTest.keyClicks(line, text)


def test_it_stands_there_where_there_is_one_and_is_typed_exactly(make_window):
    design = start_design("synthetic-1").with_input(0, gain_curve=((0.1, 1.0), (0.4, 0.25)))
    window = make_window(design)
    line = line_of(window)
    assert line.accessibleName() == "Gain curve"
    assert line.toPlainText() == "100 1; 400 0.25"
    retype(line, "100 1; 250.5 0.125")
    assert window.document.design.inputs[0].gain_curve == ((0.1, 1.0), (0.2505, 0.125))
    retype(line, "100 1; 50 0.125")
    assert "comes after" in line.problem
    # What could be read last stays.
    QTest.keyClick(line, Qt.Key.Key_Escape)
    assert line.toPlainText() == "100 1"
    assert window.document.design.inputs[0].gain_curve == ((0.1, 1.0),)


def test_typed_away_it_can_be_typed_again(make_window):
    design = start_design("synthetic-1").with_input(0, gain_curve=((0.1, 0.5),))
    window = make_window(design)
    line = line_of(window)
    line.setFocus()
    line.selectAll()
    QTest.keyClick(line, Qt.Key.Key_Delete)
    assert window.document.design.inputs[0].gain_curve == ()
    assert line_of(window) is line
    QTest.keyClicks(line, "0 0.5")
    assert window.document.design.inputs[0].gain_curve == ((0.0, 0.5),)


def test_a_track_without_one_has_no_line_for_it(make_window):
    window = make_window()
    assert line_of(window) is None
    fields = window.panel("inspector").findChild(InputFields)
    assert "gain_curve" not in {cell.name for cell in fields._fields()}
