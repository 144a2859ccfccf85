"""The inspector: what is typed and chosen, said beside its fields, and done to several inputs."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QPushButton, QScrollArea, QToolButton, QWidget

from skinsource import Actuation, Clip, Design, Input, actuators
from skinsource.actuators.actuation import ActuatorAt
from skinsource.design.effects import Repeat, Reverse, Stretch, Trim
from skinsource.design.waveforms import Drawn, Formula, Noise, Recording, Tap, Tone, WaveletTrain
from skinsource.design.waveforms.tones import Chirp, Glide
from skinsource.specs.samples import Samples
from skinsource_gui.fields.editors import FieldCell, TextLine
from skinsource_gui.fields.inputs import played_hz_text
from skinsource_gui.fields.text_field import LiveText
from skinsource_gui.qt.buttons import LetterButton
from skinsource_gui.qt.labels import how_to_add
from skinsource_gui.shell.focus import tab_stops
from tests.gui.inspector.bench import Bench, design_of


def test_without_a_selected_input_it_says_what_to_do(bench):
    bench.show(selected_inputs=())
    assert bench.label("inspector_empty").isVisible()
    assert "Select an input" in bench.label("inspector_empty").text()
    bench.show(Design(limb="synthetic-1"), selected_inputs=(4,))
    assert bench.label("inspector_empty").text() == how_to_add()


def test_without_a_selected_input_title_and_sentence_of_the_design_are_edited(bench):
    bench.show(replace(bench.design, notes="One.\nOf the speaker."), selected_inputs=())
    bench.panel.setFocus()
    title, sentence = bench.panel.findChildren(TextLine)
    assert title.hasFocus()
    QTest.keyClicks(title, "Soft")
    bench.show()
    QTest.keyClick(title, Qt.Key.Key_Tab)
    assert (sentence.hasFocus(), sentence.text()) == (True, "One.")
    QTest.keyClicks(sentence, "Two.")
    QTest.keyClick(sentence, Qt.Key.Key_Return)
    assert (bench.design.title, bench.design.notes) == ("Soft", "Two.\nOf the speaker.")


@pytest.mark.parametrize(
    ("of", "name", "text", "value"),
    [
        (lambda track: track.clips[0].waveform, "frequency_hz", "240", 240.0),
        (lambda track: track.clips[0].waveform, "duration_s", "1,5 s", 1.5),
        (lambda track: track.clips[0], "onset_s", "35", 0.035),
        (lambda track: track, "amplitude", "-2 m/s²", -2.0),
    ],
)
def test_what_is_typed_belongs_to_the_waveform_the_clip_or_the_input(bench, of, name, text, value):
    bench.type(name, text)
    assert getattr(of(bench.track), name) == value
    label = f"Change {name.split('_')[0]} of input at 7 (II pad)"
    assert bench.edits == [(label, bench.design, None)]


def test_the_place_can_be_chosen_by_its_number(bench):
    bench.choose("location", "15")
    assert bench.track.location == 15
    # The list follows each key, in one gesture.
    assert bench.labels[-1].endswith(" to 15 (V base)")
    assert len({gesture for _, _, gesture in bench.edits}) == 1
    assert bench.choice("location").shown_text == "15 · V base"


def test_another_kind_of_waveform_keeps_what_both_share(bench):
    bench.type("duration_s", "350")
    bench.choose("window", "Han")
    bench.choose("kind", "Noise")
    assert bench.track.clips[0].waveform == Noise(duration_s=0.35, window="hanning")
    assert bench.labels[-1] == "Change waveform of input at 7 (II pad)"
    assert bench.number("frequency_hz") is None or not bench.number("frequency_hz").isVisible()
    assert bench.number("seed").isVisible()


@pytest.mark.parametrize(
    ("index", "text"), [(2, "16.2 ms (21 samples), fixed"), (3, "one sample, fixed")]
)
def test_a_length_that_is_fixed_is_told_in_words(bench, index, text):
    bench.show(selected_inputs=(index + 1,))
    assert bench.label("fixed_length").text() == text
    bench.show(selected_inputs=(1,))
    assert bench.label("fixed_length") is None or not bench.label("fixed_length").isVisible()


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
    assert lasts.text() == "100 ms"
    assert not bench.label("played_hz")
    # The waveform's own length can still be changed, and typing it is not ended by the row.
    bench.type("duration_s", "0.05 s")
    assert not lasts.isVisible()
    bench.show(design.with_clip(clip.id, effects=(Stretch(factor=2.0),)))
    assert lasts.text() == "400 ms"
    assert bench.label("played_hz").isVisible()
    assert bench.label("played_hz").text() == "50 Hz"
    bench.show(design)
    assert not lasts.isVisible()


@pytest.mark.parametrize(
    ("waveform", "effects", "played"),
    [
        (Chirp(), (Trim(duration_s=0.6), Stretch(to_s=1.0)), "15–222"),
        (Chirp(100.0, 400.0, law="logarithmic"), (Reverse(), Trim(0.5)), "200–100"),
        (Chirp(), (Repeat(), Trim(duration_s=0.6)), ""),
        (Noise(), (Trim(duration_s=0.1), Stretch()), "12.5–300"),
        (Glide(), (Trim(duration_s=0.1), Stretch()), ""),
    ],
)
def test_frequencies_are_those_of_the_part_that_effects_leave(waveform, effects, played):
    text = played_hz_text(Clip(waveform=waveform, effects=effects))
    assert text.removesuffix(" Hz") == played


def test_the_gain_of_a_clip_is_shown_beside_others_and_wherever_it_is_not_1(bench):
    def label():
        cells = [cell for cell in bench.panel.fields if cell.name == "gain"]
        return cells[0].label.text() if cells else ""

    def of_track():
        text = bench.label("whole_track")
        return text.text() if text is not None and text.isVisible() else ""

    assert (label(), of_track()) == ("", "")
    louder, other = Clip(id=9, waveform=Tone(), gain=0.5), Clip(id=10, waveform=Tone())
    bench.show(bench.design.with_input(0, clips=(louder, other)))
    assert (label(), of_track()) == ("Clip gain", "2 clips")
    gain, onset = (bench.number(name).parent() for name in ("gain", "onset_s"))
    assert gain.parent() is onset.parent()
    bench.show(bench.design.with_input(0, clips=(louder,)))
    assert (label(), of_track()) == ("Clip gain", "")
    # One that becomes 1 can be typed again, until another clip or design is shown.
    bench.type("gain", "1")
    assert bench.track.clips[0].gain == 1.0
    assert label() == "Clip gain"
    bench.panel.start_over()
    bench.show()
    assert label() == ""
    bench.show(selected_inputs=(2,))
    assert label() == ""
    bench.show(bench.design.with_input(1, clips=(replace(louder, id=11),)))
    assert label() == "Clip gain"
    # Clips of several tracks: amplitude and place change all clips of these.
    both = bench.design.with_input(0, clips=(louder, other)).with_clip(11, gain=1.0)
    bench.show(both, selected_inputs=(1, 2), selected_clips=(9, 11))
    assert (label(), of_track()) == ("Clip gain", "2 tracks, 3 clips")
    bench.show(selected_inputs=(2, 3), selected_clips=(11, both.inputs[2].clips[0].id))
    assert (label(), of_track()) == ("Clip gain", "")


def test_a_recording_that_keeps_its_size_has_a_gain_without_a_unit_and_the_peak(bench):
    def strength():
        cell = bench.number("amplitude").parent()
        return cell.label.text(), cell.field.spec.unit

    def peak():
        return bench.label("peak").text() if bench.label("peak") else ""

    assert strength() == ("Amplitude", "m/s²")
    samples = Samples(values=4.88 * np.hanning(301), sample_rate_hz=1300.0, unit="m/s²")
    clip = replace(bench.track.clips[0], waveform=Recording(samples))
    bench.show(bench.design.with_input(0, clips=(clip,)))
    assert strength() == ("Input gain", "×")
    assert peak() == "4.88 m/s²"
    bench.type("amplitude", "0.5")
    assert bench.track.amplitude == 0.5
    assert peak() == "2.44 m/s²"
    normalised = replace(samples, values=samples.values / 4.88, unit="")
    bench.show(bench.design.with_clip(clip.id, waveform=Recording(normalised)))
    assert strength() == ("Amplitude", "m/s²")
    for factor, shown in ((3, "1.5 m/s²"), (0.92, "0.46 m/s²"), (1, "")):
        waveform = Formula(text=f"{factor} * sin(6.28 * 50 * t)")
        bench.show(bench.design.with_clip(clip.id, waveform=waveform))
        bench.panel.show_results(bench.results())
        assert strength() == (("Input gain", "×") if factor == 3 else ("Amplitude", "m/s²"))
        assert peak() == shown


QUIET = Samples(values=0.8 * np.hanning(301), sample_rate_hz=1300.0)


@pytest.mark.parametrize("waveform", [Formula(text="3 * sin(6.28 * 50 * t)"), Recording(QUIET)])
def test_a_muted_clip_says_so_and_keeps_its_peak_unless_others_are_heard(qtbot, waveform):
    def show(*clips):
        bench.show(bench.design.with_input(0, clips=clips), selected_clips=(clips[0].id,))
        bench.panel.show_results(bench.results())
        says = [label.text() for label in bench.panel.findChildren(QLabel) if label.isVisible()]
        # It is that of the whole track, however many clips it has.
        assert "Track peak" in says
        return "Input gain" in says, bench.label("peak").text(), "muted" in says

    bench = Bench(qtbot, design_of(waveform))
    (clip,) = bench.track.clips
    _, peak, _ = before = show(clip)
    assert before == (True, peak, False)
    assert show(replace(clip, muted=True)) == (True, peak, True)
    heard = replace(clip, id=77, waveform=Formula(text="sin(6.28 * 50 * t)"))
    assert show(replace(clip, muted=True), heard) == (True, "1 m/s²", True)


def test_a_place_that_is_not_on_this_hand_is_named_and_can_be_left(bench):
    bench.show(bench.design.with_input(0, location=25))
    heading = bench.label("inspector_heading")
    assert heading.toolTip() == "Input place 25: Place 25, not on this hand"
    box = bench.choice("location")
    assert (box.value, box.shown_text) == ("25", "25 (not available)")
    assert bench.edits == []
    box.choose("3")
    assert bench.track.location == 3
    assert "not available" not in box.shown_text


def test_frequencies_end_at_half_the_rate_of_the_limb(bench):
    bench.panel.show_results(bench.results() | {"sample_rate_hz": 4000.0})
    bench.type("frequency_hz", "1500")
    assert bench.track.clips[0].waveform.frequency_hz == 1500.0
    bench.type("frequency_hz", "2000")
    assert "to 1999 Hz" in bench.label("frequency_hz_note").text()
    assert bench.track.clips[0].waveform.frequency_hz == 1500.0
    # It is said until another field is used.
    bench.type("amplitude", "0.5")
    assert "to 1999 Hz" not in bench.label("frequency_hz_note").text()
    # What this limb cannot play is shown as it is.
    bench.show(bench.design.with_clip(1, waveform=Tone(frequency_hz=5000.0)))
    assert bench.number("frequency_hz").value_si == 5000.0


def retype(line, text):
    line.setFocus()
    line.selectAll()
    QTest.keyClicks(line, text)


def test_a_formula_that_a_design_refuses_stays_as_it_is_typed_with_the_reason(qtbot):
    bench = Bench(qtbot, design_of(Formula(text="t")))
    line = bench.panel.findChild(LiveText, "text_field")
    cell = next(cell for cell in bench.panel.findChildren(FieldCell) if cell.name == "text")
    retype(line, "1/t")
    assert bench.track.clips[0].waveform.text == "t"
    assert line.text() == "1/t"
    assert "column 2: / is infinite at 0 s" in cell.note
    retype(line, "3*t")
    assert (bench.track.clips[0].waveform.text, cell.note) == ("3*t", "")
    bench.show(design_of(Formula(text="tanh(t)")))
    assert line.text() == "tanh(t)"


def test_the_gain_curve_of_a_track_is_typed_where_there_is_one(qtbot):
    def lines():
        lines = bench.panel.findChildren(LiveText)
        return [line for line in lines if line.isVisibleTo(bench.panel)]

    design = design_of(Tone())
    bench = Bench(qtbot, design)
    bench.open("track_fold")
    assert lines() == []
    bench.show(design.with_input(0, gain_curve=((0.1, 1.0), (0.4, 0.25))))
    (line,) = lines()
    assert (line.accessibleName(), line.toPlainText()) == ("Gain curve", "100 1; 400 0.25")
    retype(line, "100 1; 50 0.125")
    assert "comes after" in line.problem
    line.selectAll()
    QTest.keyClick(line, Qt.Key.Key_Delete)
    assert bench.track.gain_curve == ()
    assert lines() == [line]
    QTest.keyClicks(line, "0 0.5")
    assert bench.track.gain_curve == ((0.0, 0.5),)


def test_the_heading_says_which_clip_is_edited_and_typing_is_for_it(qtbot):
    clips = (Clip(id=1, waveform=Tone()), Clip(id=2, waveform=Noise(), onset_s=0.5))
    bench = Bench(qtbot, Design(limb="synthetic-1", inputs=(Input(location=7, clips=clips),)))
    bench.panel.resize(400, 460)
    bench.show(selected_clips=(2,))
    assert bench.label("inspector_heading").text() == "Clip 2 of 2 · Noise"
    bench.type("duration_s", "50")
    assert [clip.duration_s for clip in bench.track.clips] == [0.2, 0.05]
    bench.show(selected_clips=(1,))
    assert bench.label("inspector_heading").text() == "Clip 1 of 2 · Tone"


def test_what_an_amplitude_means_is_said_and_chosen_beside_it(bench):
    meaning = bench.panel.findChild(QToolButton, "scaling")
    assert meaning.text() == "at the probe"
    assert all(action.toolTip() for action in meaning.menu().actions())
    next(a for a in meaning.menu().actions() if a.text() == "Equal drives").trigger()
    assert bench.design.scaling == "relative"
    assert meaning.text() == "of the measuring pulse"
    assert meaning.accessibleName() == "Scaling: Equal drives"
    coil = ActuatorAt(actuator="Coil", model=actuators.load("example-resonant"))
    chosen = Actuation(actuators=(coil,))
    bench.show(design=replace(bench.design, scaling="probe", actuation=chosen))
    for text in (meaning.text(), meaning.toolTip(), meaning.accessibleName()):
        assert text.endswith("at the actuator")


@pytest.mark.parametrize("waveform", [Tone(), WaveletTrain(), Drawn()])
def test_the_first_fields_of_a_clip_stand_in_240_px_without_scrolling(qtbot, waveform):
    bench = Bench(qtbot, design_of(waveform))
    bench.panel.resize(240, 372)
    QTest.qWait(1)
    area = bench.panel.findChild(QScrollArea, "inspector_fields")
    own = [cell for cell in area.findChildren(FieldCell) if cell.isVisible()][:5]
    assert own[0].name == "kind"
    for cell in own:
        bottom = cell.mapTo(area.viewport(), cell.rect().bottomLeft()).y()
        assert bottom <= area.viewport().height(), cell.name
    for name in ("location", "amplitude", "onset_s", "kind"):
        field = bench.panel.findChild(QWidget, f"{name}_field")
        assert field.visibleRegion().boundingRect().height() > 20


def test_another_clip_is_shown_from_the_top(qtbot):
    bench = Bench(qtbot, design_of(Noise(), Tone()))
    bench.panel.resize(240, 300)
    bar = bench.panel.findChild(QScrollArea, "inspector_fields").verticalScrollBar()
    qtbot.waitUntil(lambda: bar.maximum() > 0)
    bar.setValue(bar.maximum())
    bench.show(selected_inputs=(2,))
    assert bar.value() == 0


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
    assert [label.split(" input")[0] for label in bench.labels[1::2]] == ["Unmute", "End solo of"]


@pytest.mark.parametrize(
    ("waveform", "name", "text", "action"),
    [
        (Recording(), "recording_button", "Choose file…", "import_recording"),
        (Drawn(), "draw_button", "Draw…", "draw_clip"),
    ],
    ids=["recording", "drawn"],
)
def test_what_plays_samples_has_a_button_for_where_they_come_from(
    bench, waveform, name, text, action
):
    actions = []
    bench.panel.action_requested.connect(actions.append)
    assert bench.panel.findChild(QPushButton, name) is None
    bench.show(bench.design.with_clip(1, waveform=waveform))
    button = bench.panel.findChild(QPushButton, name)
    assert button.text() == text
    button.click()
    assert actions == [action]
    assert bench.view.selected_clips == (1,)


def test_tab_leads_through_the_fields_in_reading_order(bench):
    bench.show(bench.design.with_clip(1, waveform=Noise()))
    stops = [stop.objectName() for stop in tab_stops(bench.panel, ())]
    assert stops == [
        "location_field",
        "amplitude_field",
        "scaling",
        *("onset_s_field", "duration_s_field", "kind_field", "seed_field"),
        *("low_hz_field", "high_hz_field", "window_field"),
        *("effects_fold", "add_effect", "track_fold"),
    ]


LEFT = Qt.MouseButton.LeftButton


def two(qtbot):
    bench = Bench(qtbot, design_of(Tone(frequency_hz=100.0), Noise(), Tone(frequency_hz=50.0)))
    bench.show(selected_inputs=(3, 1))
    return bench


def test_the_heading_says_how_many_and_fields_say_where_they_differ(qtbot):
    bench = two(qtbot)
    assert bench.label("inspector_heading").text() == "2 inputs · Tone"
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
    several = (*bench.design.inputs[2].clips, Clip(id=9, waveform=Tone()))
    design, ids = bench.design.with_input(2, clips=several), tuple(clip.id for clip in several)
    bench.show(design, selected_inputs=(3,), selected_clips=ids)
    assert heading.text() == "2 clips · Tone"
    bench.type("frequency_hz", "80")
    assert bench.labels == ["Change frequency of 2 clips"]
    bench.show(selected_inputs=(1, 2), selected_clips=(tone.id, noise.id))
    assert heading.text() == "2 clips"
    bench.show(selected_clips=(tone.id,), selected_inputs=(1,))
    assert heading.text() == "Clip 1 of 1 · Tone"
    # Clips are counted where a command on clips acts on as many.
    bench.show(selected_clips=(tone.id,), selected_inputs=(1, 3))
    assert heading.text() == "2 inputs, first clips · Tone"


def test_a_mixed_list_is_an_empty_line_and_what_is_typed_sets_all(qtbot):
    trains = (WaveletTrain(frequencies_hz=(50.0,)), WaveletTrain(frequencies_hz=(60.0, 70.0)))
    bench = Bench(qtbot, design_of(*trains))
    bench.show(selected_inputs=(1, 2))
    line = next(line for line in bench.panel.findChildren(LiveText) if line.isVisible())
    assert (line.text(), line.placeholderText()) == ("", "mixed")
    line.setFocus()
    QTest.keyClicks(line, "abc")
    QTest.keyClick(line, Qt.Key.Key_Escape)
    assert (line.text(), bench.edits) == ("", [])
    QTest.keyClicks(line, "80, 90")
    assert {clip.waveform.frequencies_hz for clip in bench.design.clips} == {(80.0, 90.0)}


def test_mixed_names_and_peaks_say_so_and_a_typed_name_names_all(qtbot):
    samples = Samples(values=np.hanning(780), sample_rate_hz=1300.0)
    louder = replace(samples, values=2 * samples.values)
    bench = Bench(qtbot, design_of(Recording(louder, name="a"), Recording(samples, name="b")))
    bench.show(selected_inputs=(1, 2))
    line = bench.panel.findChild(TextLine, "name_field")
    assert (line.text(), line.placeholderText()) == ("", "mixed")
    assert bench.label("peak").text() == "mixed"
    retype(line, "b")
    QTest.keyClick(line, Qt.Key.Key_Return)
    assert {clip.waveform.name for clip in bench.design.clips} == {"b"}
    assert line.placeholderText() == ""


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


def test_of_clips_of_different_kinds_only_fields_that_all_have_are_shown(qtbot):
    recording = Recording(Samples(values=np.hanning(780), sample_rate_hz=1300.0), name="a")
    bench = Bench(qtbot, design_of(Tone(), recording, Tone(duration_s=0.6)))

    def shown(*ids):
        bench.show(selected_inputs=ids)
        return {cell.name for cell in bench.panel.fields} - {"location", "amplitude", "onset_s"}

    # The length is also that of kinds that have no field for it.
    assert shown(2, 1) == {"kind", "duration_s"}
    assert bench.number("duration_s").placeholderText() == "mixed"
    bench.type("duration_s", "50")
    assert [clip.waveform.duration_s for clip in bench.design.clips[:2]] == [0.05, 0.6]
    assert shown(1, 2) == {"kind"}
    assert bench.label("fixed_length").text() == "mixed"
    assert bench.panel.findChild(QPushButton, "recording_button") is None
    assert shown(3, 2) == {"kind"}
    assert bench.label("fixed_length").text() == "600 ms (780 samples)"
    bench.choose("kind", "Tap")
    assert [type(clip.waveform) for clip in bench.design.clips] == [Tone, Tap, Tap]


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
