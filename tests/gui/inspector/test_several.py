"""Several inputs in the inspector: shown is the last, edited are all."""

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.text_field import LiveText
from skinsource_gui.panels.inspector.panel import InputFields, InputHeading
from skinsource_gui.qt.buttons import LetterButton
from skinsource_gui.state.preferences import start_design
from tests.gui.inspector.bench import Bench, design_of

LEFT = Qt.MouseButton.LeftButton


def label_of(bench, name):
    cells = bench.panel.findChildren(FieldCell)
    return next(cell.label.text() for cell in cells if cell.name == name and cell.isVisible())


def two(qtbot):
    bench = Bench(qtbot, design_of(Tone(frequency_hz=100.0), Noise(), Tone(frequency_hz=50.0)))
    bench.show(selected_inputs=(3, 1))
    return bench


def test_the_heading_says_how_many_and_fields_say_where_they_differ(qtbot):
    bench = two(qtbot)
    assert bench.label("inspector_heading").text().startswith("2 inputs, last: ")
    assert label_of(bench, "frequency_hz") == "Frequency ≠"
    assert label_of(bench, "amplitude") == "Amplitude"
    bench.show(selected_inputs=(1,))
    assert label_of(bench, "frequency_hz") == "Frequency"


def test_a_typed_value_sets_all_in_one_step(qtbot):
    bench = two(qtbot)
    bench.type("frequency_hz", "240")
    assert [clip.waveform.frequency_hz for clip in bench.design.clips[::2]] == [
        240.0,
        240.0,
    ]
    assert bench.labels == ["Change frequency of 2 inputs"]
    assert label_of(bench, "frequency_hz") == "Frequency"


def test_steps_move_all_by_the_same_factor(qtbot):
    bench = two(qtbot)
    field = bench.number("frequency_hz")
    field.setFocus()
    for _ in range(3):
        QTest.keyClick(field, Qt.Key.Key_Up)
    first, _, third = (track.clips[0].waveform for track in bench.design.inputs)
    assert first.frequency_hz > 100.0
    assert third.frequency_hz * 2 == first.frequency_hz


def test_what_a_waveform_does_not_have_is_left_alone(qtbot):
    bench = two(qtbot)
    bench.show(selected_inputs=(2, 1))
    bench.type("frequency_hz", "240")
    assert bench.design.inputs[1].clips[0].waveform == Noise()
    bench.choose("kind", "Tap")
    assert [type(track.clips[0].waveform) for track in bench.design.inputs] == [Tap, Tap, Tone]


def test_buttons_mute_and_solo_all(qtbot):
    bench = two(qtbot)
    QTest.mouseClick(bench.panel.findChild(LetterButton, "mute_button"), LEFT)
    assert [track.muted for track in bench.design.inputs] == [True, False, True]


def test_a_drag_held_while_its_input_goes_edits_nothing_more_and_raises_nothing(qtbot):
    bench = two(qtbot)
    field = bench.number("amplitude")
    start = field.rect().center()
    QTest.mousePress(field, LEFT, pos=start)
    QTest.mouseMove(field, start + QPoint(20, 0))
    count = len(bench.edits)
    assert count > 0
    for selected in ((2,), ()):
        bench.show(selected_inputs=selected)
        QTest.mouseMove(field, start + QPoint(60, 0))
    QTest.mouseRelease(field, LEFT, pos=start)
    assert len(bench.edits) == count


def test_of_several_the_heading_says_which_one_is_silent(qtbot):
    first, other = design_of(Tone(), Tone()).inputs
    heading = InputHeading()
    qtbot.addWidget(heading)
    heading.show_input(first, silent=True, batch=(other, first), limb="synthetic-1")
    assert heading._state.text() == "last silent"
    heading.show_input(first, silent=True, batch=(first,), limb="synthetic-1")
    assert heading._state.text() == "silent"


def line_of(window):
    inspector = window.panel("inspector")
    lines = [label for label in inspector.findChildren(LiveText) if label.isVisibleTo(inspector)]
    return lines[0] if lines else None


def retype(line, text):
    line.setFocus()
    line.selectAll()
    QTest.keyClicks(line, text)


def test_it_stands_there_where_there_is_one_and_is_typed_exactly(open_window):
    design = start_design("synthetic-1").with_input(0, gain_curve=((0.1, 1.0), (0.4, 0.25)))
    window = open_window(design)
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


def test_typed_away_it_can_be_typed_again(open_window):
    design = start_design("synthetic-1").with_input(0, gain_curve=((0.1, 0.5),))
    window = open_window(design)
    line = line_of(window)
    line.setFocus()
    line.selectAll()
    QTest.keyClick(line, Qt.Key.Key_Delete)
    assert window.document.design.inputs[0].gain_curve == ()
    assert line_of(window) is line
    QTest.keyClicks(line, "0 0.5")
    assert window.document.design.inputs[0].gain_curve == ((0.0, 0.5),)


def test_a_track_without_one_has_no_line_for_it(open_window):
    window = open_window()
    assert line_of(window) is None
    fields = window.panel("inspector").findChild(InputFields)
    assert "gain_curve" not in {cell.name for cell in fields._fields()}
