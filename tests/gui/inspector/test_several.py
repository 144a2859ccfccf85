"""Several inputs in the inspector: shown is the last, edited are all."""

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.editors import FieldCell
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
