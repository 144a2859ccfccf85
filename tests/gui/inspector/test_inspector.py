"""Buttons and preview of the inspector, the way of the keys through it, and several inputs."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from skinsource.design.waveforms import Noise, Recording, Tap, Tone, WaveletTrain
from skinsource_gui.fields.text_field import LiveText
from skinsource_gui.plots.preview import WaveformPreview
from skinsource_gui.qt.buttons import LetterButton
from skinsource_gui.shell.focus import tab_stops
from tests.gui.inspector.bench import Bench, design_of


def test_mute_and_solo_are_buttons_of_the_track(bench):
    bench.open("track_fold")
    for name, field in (("mute_button", "muted"), ("solo_button", "solo")):
        button = bench.panel.findChild(LetterButton, name)
        QTest.mouseClick(button, Qt.MouseButton.LeftButton)
        assert getattr(bench.track, field)
        assert button.isChecked()
        button.setFocus()
        QTest.keyClick(button, Qt.Key.Key_Space)
        assert not getattr(bench.track, field)
    assert bench.labels == [
        "Mute input at 7 (II pad)",
        "Unmute input at 7 (II pad)",
        "Solo input at 7 (II pad)",
        "End solo of input at 7 (II pad)",
    ]


def test_the_preview_shows_the_selected_input_and_its_length(bench):
    bench.show(selected_inputs=(3,))
    bench.panel.show_results(bench.results())
    assert bench.preview.duration_s == pytest.approx(21 / 1300)
    # Nothing has to be computed anew for another one to be shown.
    bench.show(selected_inputs=(1,))
    assert bench.preview.duration_s == pytest.approx(0.2)
    # A clip of a newer design has no results yet.
    bench.panel.show_results({"clip_waveforms": (), "inputs": (), "sample_rate_hz": 1300.0})
    assert bench.preview.duration_s is None
    bench.panel.show_problem("No limb of that name")
    assert bench.preview.message == "No limb of that name"


def test_a_recording_has_a_button_that_asks_for_its_file(bench):
    actions = []
    bench.panel.action_requested.connect(actions.append)
    assert bench.panel.findChild(QPushButton, "recording_button") is None
    bench.show(bench.design.with_clip(1, waveform=Recording()))
    button = bench.panel.findChild(QPushButton, "recording_button")
    assert button.text() == "Choose file…"
    button.click()
    assert actions == ["import_recording"]


def test_tab_leads_through_the_fields_in_reading_order(bench):
    bench.show(bench.design.with_clip(1, waveform=Noise()))
    stops = [stop.objectName() for stop in tab_stops(bench.panel, ())]
    assert stops == [
        "draw_button",
        "location_field",
        "amplitude_field",
        "scaling",
        *("onset_s_field", "duration_s_field", "kind_field", "seed_field"),
        *("low_hz_field", "high_hz_field", "window_field"),
        *("effects_fold", "add_effect", "track_fold"),
    ]


@pytest.fixture
def preview(qtbot):
    widget = WaveformPreview()
    qtbot.addWidget(widget)
    widget.resize(420, 140)
    widget.set_look(0)
    widget.show()
    return widget


def test_one_loud_sample_in_a_minute_is_seen(preview):
    samples = np.zeros(78_000)
    samples[41_234] = 1.0
    preview.show_samples(samples, 1300.0)
    picture = preview.grab().toImage()
    # Right of the middle, just below the top.
    drawn = [column for column in range(420) if picture.pixelColor(column, 20).blue() > 150]
    inked = [column for column in drawn if picture.pixelColor(column, 20).red() < 120]
    assert inked
    assert all(215 <= column <= 225 for column in inked)


@pytest.mark.parametrize("n_samples", [600, 2600])
def test_a_tone_whose_samples_miss_its_peak_reaches_it(preview, n_samples):
    preview.show_samples(np.sin(0.5 * np.pi * np.arange(n_samples) + np.pi / 4), 1300.0)
    picture = preview.grab().toImage()
    # Samples alone end 20 px below the top.
    highest = 140 - 2
    for x in range(100, 300, 10):
        inked = [
            y
            for y in range(highest // 2)
            if any(picture.pixelColor(x + k, y).red() < 120 for k in range(5))
        ]
        assert min(inked) <= 8


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
    line = next(line for line in bench.panel.findChildren(LiveText) if line.isVisible())
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
