from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from skinsource.design.design import Design
from skinsource.design.edits.edit import as_kind
from skinsource.design.effects.time import Stretch, Trim
from skinsource.design.waveforms import KINDS
from skinsource.design.waveforms.pulses import Noise
from skinsource.design.waveforms.samples import Recording
from skinsource.design.waveforms.tones import Tone
from skinsource.specs.samples import Samples
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import FieldGrid


def test_the_heading_names_the_place(bench):
    assert bench.label("inspector_heading").text() == "Digit II, pad"
    bench.show(selected_inputs=(2,))
    assert bench.label("inspector_heading").text() == "Digit III, pad"


def test_without_a_selected_input_it_says_what_to_do(bench):
    bench.show(selected_inputs=())
    assert bench.label("inspector_empty").isVisible()
    assert "Select an input" in bench.label("inspector_empty").text()
    bench.show(Design(limb="synthetic-1"), selected_inputs=(4,))
    assert bench.label("inspector_empty").text() == "Click a place on the hand to add an input"
    assert not bench.preview.isVisible()


@pytest.mark.parametrize(
    ("name", "text", "value", "label"),
    [
        ("frequency_hz", "240", 240.0, "Change frequency of input at 7 (II pad)"),
        ("phase_rad", "0.5 rad", 0.5, "Change phase of input at 7 (II pad)"),
        ("duration_s", "1,5 s", 1.5, "Change duration of input at 7 (II pad)"),
    ],
)
def test_typing_into_a_field_of_the_waveform_edits_it(bench, name, text, value, label):
    bench.type(name, text)
    assert getattr(bench.track.clips[0].waveform, name) == value
    assert bench.edits == [(label, bench.design, None)]


@pytest.mark.parametrize(
    ("name", "text", "value"), [("amplitude", "-2 m/s²", -2.0), ("onset_s", "35", 0.035)]
)
def test_amplitude_belongs_to_the_input_and_onset_to_its_clip(bench, name, text, value):
    bench.type(name, text)
    assert getattr(bench.track if name == "amplitude" else bench.track.clips[0], name) == value
    assert bench.labels[0].endswith("of input at 7 (II pad)")


def test_the_window_is_chosen_from_its_options(bench):
    bench.choose("window", "Han")
    assert bench.track.clips[0].waveform.window == "hanning"
    assert bench.labels[-1] == "Change window of input at 7 (II pad)"


def test_steps_of_a_burst_share_a_gesture(bench):
    field = bench.number("frequency_hz")
    field.setFocus()
    for _ in range(3):
        QTest.keyClick(field, Qt.Key.Key_Up)
    assert len(bench.edits) == 3
    assert len({gesture for _, _, gesture in bench.edits}) == 1
    assert bench.number("frequency_hz") is field
    assert field.hasFocus()


def test_the_place_can_be_chosen_by_its_number(bench):
    bench.choose("location", "15")
    assert bench.track.location == 15
    # The list follows each key, in one gesture.
    assert bench.labels[-1].endswith(" to 15 (V base)")
    assert len({gesture for _, _, gesture in bench.edits}) == 1
    assert bench.label("inspector_heading").text() == "Digit V, base"


def test_choosing_what_is_chosen_already_edits_nothing(bench):
    bench.choice("location").activated.emit(bench.choice("location").currentIndex())
    bench.choice("kind").activated.emit(bench.choice("kind").currentIndex())
    assert bench.edits == []


def test_another_kind_of_waveform_keeps_what_both_share(bench):
    bench.type("duration_s", "350")
    bench.choose("window", "Han")
    bench.choose("kind", "Noise")
    assert bench.track.clips[0].waveform == Noise(duration_s=0.35, window="hanning")
    assert bench.labels[-1] == "Change waveform of input at 7 (II pad)"
    assert bench.number("frequency_hz") is None or not bench.number("frequency_hz").isVisible()
    assert bench.number("seed").isVisible()


def test_a_shared_number_that_is_not_allowed_becomes_the_nearest_that_is():
    assert as_kind(Tone(duration_s=0.002), Noise, 1300.0).duration_s == 0.01


def test_every_kind_can_become_every_other():
    for kind in KINDS:
        for other in KINDS:
            assert type(as_kind(kind(), other, 1300.0)) is other


def test_a_whole_number_stays_whole(bench):
    bench.show(selected_inputs=(2,))
    bench.type("seed", "12")
    assert bench.track.clips[0].waveform.seed == 12
    assert isinstance(bench.track.clips[0].waveform.seed, int)


@pytest.mark.parametrize(
    ("index", "text"), [(2, "16.2 ms (21 samples), fixed"), (3, "one sample, fixed")]
)
def test_a_length_that_is_fixed_is_told_in_words(bench, index, text):
    bench.show(selected_inputs=(index + 1,))
    assert bench.label("fixed_length").text() == text
    bench.show(selected_inputs=(1,))
    assert bench.label("fixed_length") is None or not bench.label("fixed_length").isVisible()


@pytest.mark.parametrize(
    ("frequency", "warned"), [("24.9", True), ("25", False), ("600", False), ("601", True)]
)
def test_a_frequency_outside_the_measured_band_is_remarked(bench, frequency, warned):
    bench.type("frequency_hz", frequency)
    note = bench.label("frequency_hz_note")
    assert note.isVisible() is warned
    assert ("outside the measured band (25 to 600 Hz)" in note.text()) is warned
    assert bench.track.clips[0].waveform.frequency_hz == float(frequency)


def test_a_number_that_is_not_allowed_says_why_below_it_and_edits_nothing(bench):
    bench.type("frequency_hz", "9000")
    note = bench.label("frequency_hz_note")
    assert note.isVisible()
    assert "to 649 Hz" in note.text()
    assert bench.edits == []
    QTest.keyClick(bench.number("frequency_hz"), Qt.Key.Key_Escape)
    assert not note.isVisible()


def test_what_was_typed_for_one_input_never_reaches_another(bench):
    field = bench.number("amplitude")
    field.setFocus()
    QTest.keyClicks(field, "55")
    bench.show(selected_inputs=(2,))
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert [track.amplitude for track in bench.design.inputs] == [1.0] * 4


def test_how_long_a_clip_lasts_with_its_effects_is_said_where_it_differs(bench):
    design = bench.design
    clip = design.inputs[0].clips[0]
    bench.show(design.with_clip(clip.id, effects=(Trim(start_s=0.0, duration_s=0.1),)))
    lasts = bench.label("played_length")
    assert lasts.isVisible()
    assert lasts.text() == "100 ms with its effects"
    # The waveform's own length can still be changed, and typing it is not ended by the row.
    bench.type("duration_s", "0.05 s")
    assert not lasts.isVisible()
    bench.show(design.with_clip(clip.id, effects=(Stretch(factor=2.0),)))
    assert lasts.text() == "400 ms with its effects"
    bench.show(design)
    assert not lasts.isVisible()


def test_a_recording_that_keeps_its_size_has_a_gain_without_a_unit_and_the_peak(bench):
    def strength():
        cells = bench.panel.findChild(FieldGrid).findChildren(FieldCell)
        cell = next(cell for cell in cells if cell.name == "amplitude")
        return cell.label.text(), cell.field.spec.unit

    def peak():
        return bench.label("peak").text() if bench.label("peak") else ""

    assert strength() == ("Amplitude", "m/s²")
    samples = Samples(values=4.88 * np.hanning(301), sample_rate_hz=1300.0, unit="m/s²")
    clip = replace(bench.track.clips[0], waveform=Recording(samples))
    bench.show(bench.design.with_input(0, clips=(clip,)))
    assert strength() == ("Gain", "")
    assert peak() == "4.88 m/s²"
    bench.type("amplitude", "0.5")
    assert bench.track.amplitude == 0.5
    assert peak() == "2.44 m/s²"
    normalised = replace(samples, values=samples.values / 4.88, unit="")
    bench.show(bench.design.with_clip(clip.id, waveform=Recording(normalised)))
    assert strength() == ("Amplitude", "m/s²")
    assert not bench.label("peak").isVisible()
