"""Several inputs in the inspector: shown is the last, edited are all."""

from dataclasses import replace

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource_gui.fields.text_field import LiveText
from tests.gui.inspector.bench import Bench, design_of

LEFT = Qt.MouseButton.LeftButton


def two(qtbot):
    bench = Bench(qtbot, design_of(Tone(frequency_hz=100.0), Noise(), Tone(frequency_hz=50.0)))
    bench.show(selected_inputs=(3, 1))
    return bench


def test_the_heading_says_how_many_and_fields_say_where_they_differ(qtbot):
    bench = two(qtbot)
    assert bench.label("inspector_heading").text() == "2 inputs selected · Tone"
    field = bench.number("frequency_hz")
    assert (field.text(), field.placeholderText(), field.unit_text) == ("", "mixed", "")
    assert bench.number("amplitude").text() == "1"
    assert bench.choice("location").shown_text == "mixed"
    bench.show(selected_inputs=(1,))
    assert (field.text(), field.unit_text) == ("100", "Hz")
    assert bench.choice("location").shown_text.startswith("7 ")


def test_several_selected_clips_are_counted_in_the_heading_and_in_the_history(qtbot):
    bench = two(qtbot)
    heading = bench.label("inspector_heading")
    tone, noise, _ = bench.design.clips
    (last,) = bench.design.adding(bench.design.inputs[2]).inputs[3:]
    several = replace(bench.design.inputs[2], clips=(*bench.design.inputs[2].clips, *last.clips))
    design = replace(bench.design, inputs=(*bench.design.inputs[:2], several))
    ids = tuple(clip.id for clip in several.clips)
    bench.show(design, selected_inputs=(3,), selected_clips=ids)
    assert heading.text() == "2 clips selected · Tone"
    bench.type("frequency_hz", "80")
    assert bench.labels == ["Change frequency of 2 clips"]
    bench.show(selected_inputs=(1, 2), selected_clips=(tone.id, noise.id))
    assert heading.text() == "2 clips selected"
    bench.show(selected_clips=(tone.id,), selected_inputs=(1,))
    assert heading.text() == "Clip 1 of 1 · Tone"


def test_a_mixed_list_is_an_empty_line_and_what_is_typed_sets_all(qtbot):
    trains = (WaveletTrain(frequencies_hz=(50.0,)), WaveletTrain(frequencies_hz=(60.0, 70.0)))
    bench = Bench(qtbot, design_of(*trains))
    bench.show(selected_inputs=(1, 2))
    line = bench.panel.findChild(LiveText, "frequencies_hz_field") or next(
        line for line in bench.panel.findChildren(LiveText) if line.isVisible()
    )
    assert (line.text(), line.placeholderText()) == ("", "mixed")
    line.setFocus()
    QTest.keyClicks(line, "80, 90")
    assert {track.clips[0].waveform.frequencies_hz for track in bench.design.inputs} == {
        (80.0, 90.0)
    }


def test_a_mixed_number_that_is_left_without_typing_stays_as_it_is(qtbot):
    bench = two(qtbot)
    bench.type("frequency_hz", "")
    field = bench.number("frequency_hz")
    field.begin_editing()
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert bench.edits == []
    assert field.placeholderText() == "mixed"


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
