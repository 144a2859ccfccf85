from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel

from skinsource import fields
from skinsource.design import Design, Input
from skinsource.errors import InvalidInputError
from skinsource.fields import ChoiceSpec, NumberSpec
from skinsource.view import View
from skinsource.waveforms import KINDS, Impulse, Noise, Tap, Tone
from skinsource_gui.panels.inspector import InspectorPanel
from skinsource_gui.theme import DARK
from skinsource_gui.widgets.choice_field import ChoiceField
from skinsource_gui.widgets.field_grid import FieldGrid
from skinsource_gui.widgets.letter_button import LetterButton
from skinsource_gui.widgets.number_field import NumberField
from skinsource_gui.widgets.waveform_kinds import as_kind
from skinsource_gui.widgets.waveform_preview import WaveformPreview

# A tooltip raises its window, which an invisible screen cannot.
pytestmark = pytest.mark.qt_log_ignore("does not support raise", extend=True)


class Bench:
    """A panel and the little of a document that it needs."""

    def __init__(self, qtbot, design, selected=0):
        self.panel = InspectorPanel()
        qtbot.addWidget(self.panel)
        self.design, self.view = design, View(selected_input=selected)
        self.edits = []
        self.panel.design_edited.connect(self._edit)
        self.panel.resize(320, 460)
        self.panel.show_state(self.design, self.view)
        self.panel.show()
        qtbot.waitExposed(self.panel)
        self.panel.activateWindow()
        qtbot.waitUntil(self.panel.isActiveWindow)

    @property
    def one(self):
        return self.design.inputs[self.view.selected_input]

    @property
    def labels(self):
        return [label for label, _, _ in self.edits]

    def number(self, name):
        return self.panel.findChild(NumberField, f"{name}_field")

    def choice(self, name):
        return self.panel.findChild(ChoiceField, f"{name}_field")

    def words(self, name):
        return self.panel.findChild(QLabel, name)

    @property
    def preview(self):
        return self.panel.findChild(WaveformPreview, "waveform_preview")

    def show(self, design=None, **looking):
        self.design = design or self.design
        self.view = replace(self.view, **looking)
        self.panel.show_state(self.design, self.view)

    def type(self, name, text):
        field = self.number(name)
        field.setFocus()
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)

    def choose(self, name, words):
        box = self.choice(name)
        box.setFocus()
        QTest.keyClicks(box, words)

    def results(self):
        waveforms = tuple(one.waveform.samples(1300.0) for one in self.design.inputs)
        return {"input_waveforms": waveforms, "sample_rate_hz": 1300.0}

    def _edit(self, label, design, gesture):
        self.edits.append((label, design, gesture))
        self.show(design)


def design_of(*waveforms):
    design = Design(limb="any")
    for place, waveform in enumerate(waveforms, start=7):
        design = design.adding(Input(location=place, waveform=waveform))
    return design


@pytest.fixture
def bench(qtbot):
    return Bench(qtbot, design_of(Tone(), Noise(seed=5), Tap(), Impulse()))


def test_the_heading_names_the_place(bench):
    assert bench.words("inspector_heading").text() == "Digit II, pad"
    bench.show(selected_input=1)
    assert bench.words("inspector_heading").text() == "Digit III, pad"


def test_without_a_selected_input_it_says_what_to_do(bench):
    bench.show(selected_input=None)
    assert bench.words("inspector_empty").isVisible()
    assert "Select an input" in bench.words("inspector_empty").text()
    bench.show(Design(limb="any"), selected_input=3)
    assert bench.words("inspector_empty").text() == "Click a place on the hand to add an input"
    assert not bench.preview.isVisible()


@pytest.mark.parametrize(
    ("name", "text", "value", "label"),
    [
        ("frequency_hz", "240", 240.0, "Change frequency of input 7"),
        ("phase_rad", "0.5 rad", 0.5, "Change phase of input 7"),
        ("duration_s", "1,5 s", 1.5, "Change duration of input 7"),
    ],
)
def test_typing_into_a_field_of_the_waveform_edits_it(bench, name, text, value, label):
    bench.type(name, text)
    assert getattr(bench.one.waveform, name) == value
    assert bench.edits == [(label, bench.design, None)]


@pytest.mark.parametrize(
    ("name", "text", "value"), [("amplitude", "-2 m/s²", -2.0), ("onset_s", "35", 0.035)]
)
def test_amplitude_and_onset_belong_to_the_input(bench, name, text, value):
    bench.type(name, text)
    assert getattr(bench.one, name) == value
    assert bench.labels[0].endswith("of input 7")


def test_the_window_is_chosen_from_its_options(bench):
    bench.choose("window", "Han")
    assert bench.one.waveform.window == "hanning"
    assert bench.labels[-1] == "Change window of input 7"


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
    assert bench.one.location == 15
    # The list follows each key, in one gesture.
    assert bench.labels[-1].endswith(" to 15")
    assert len({gesture for _, _, gesture in bench.edits}) == 1
    assert bench.words("inspector_heading").text() == "Digit V, base"


def test_choosing_what_is_chosen_already_edits_nothing(bench):
    bench.choice("location").activated.emit(bench.choice("location").currentIndex())
    bench.choice("kind").activated.emit(bench.choice("kind").currentIndex())
    assert bench.edits == []


def test_another_kind_of_waveform_keeps_what_both_share(bench):
    bench.type("duration_s", "350")
    bench.choose("window", "Han")
    bench.choose("kind", "Noise")
    assert bench.one.waveform == Noise(duration_s=0.35, window="hanning")
    assert bench.labels[-1] == "Change waveform of input 7"
    assert bench.number("frequency_hz") is None or not bench.number("frequency_hz").isVisible()
    assert bench.number("seed").isVisible()


def test_a_shared_number_that_is_not_allowed_becomes_the_nearest_that_is():
    assert as_kind(Tone(duration_s=0.002), "Noise").duration_s == 0.01


def test_every_kind_can_become_every_other():
    for one in KINDS:
        for other in KINDS:
            assert type(as_kind(one(), other.__name__)) is other


def test_a_whole_number_stays_whole(bench):
    bench.show(selected_input=1)
    bench.type("seed", "12")
    assert bench.one.waveform.seed == 12
    assert isinstance(bench.one.waveform.seed, int)


@pytest.mark.parametrize(
    ("index", "words"), [(2, "16.2 ms (21 samples), fixed"), (3, "one sample, fixed")]
)
def test_a_length_that_is_fixed_is_told_in_words(bench, index, words):
    bench.show(selected_input=index)
    assert bench.words("fixed_length").text() == words
    bench.show(selected_input=0)
    assert bench.words("fixed_length") is None or not bench.words("fixed_length").isVisible()


@pytest.mark.parametrize(
    ("frequency", "warned"), [("24.9", True), ("25", False), ("600", False), ("601", True)]
)
def test_a_frequency_outside_the_measured_band_is_remarked(bench, frequency, warned):
    bench.type("frequency_hz", frequency)
    note = bench.words("frequency_hz_note")
    assert note.isVisible() is warned
    assert ("outside the measured band (25 to 600 Hz)" in note.text()) is warned
    assert bench.one.waveform.frequency_hz == float(frequency)


def test_a_number_that_is_not_allowed_says_why_below_it_and_edits_nothing(bench):
    bench.type("frequency_hz", "9000")
    note = bench.words("frequency_hz_note")
    assert note.isVisible()
    assert "1 to 649 Hz" in note.text()
    assert bench.edits == []
    QTest.keyClick(bench.number("frequency_hz"), Qt.Key.Key_Escape)
    assert not note.isVisible()


def test_what_was_typed_for_one_input_never_reaches_another(bench):
    field = bench.number("amplitude")
    field.setFocus()
    QTest.keyClicks(field, "55")
    bench.show(selected_input=1)
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert [one.amplitude for one in bench.design.inputs] == [1.0] * 4


def test_mute_and_solo_are_buttons(bench):
    for name, field in (("mute_button", "muted"), ("solo_button", "solo")):
        button = bench.panel.findChild(LetterButton, name)
        QTest.mouseClick(button, Qt.MouseButton.LeftButton)
        assert getattr(bench.one, field)
        assert button.isChecked()
        button.setFocus()
        QTest.keyClick(button, Qt.Key.Key_Space)
        assert not getattr(bench.one, field)
    assert bench.labels == [
        "Mute input 7",
        "Unmute input 7",
        "Solo input 7",
        "End solo of input 7",
    ]


def test_the_preview_shows_the_selected_input_and_its_length(bench):
    bench.show(selected_input=2)
    bench.panel.show_results(bench.results())
    assert bench.preview.duration_s == pytest.approx(21 / 1300)
    bench.show(selected_input=0)
    assert bench.preview.duration_s is None
    bench.panel.show_results(bench.results())
    assert bench.preview.duration_s == pytest.approx(0.2)


def test_results_of_another_number_of_inputs_are_not_shown(bench):
    bench.panel.show_results({"input_waveforms": (np.ones(5),), "sample_rate_hz": 1300.0})
    assert bench.preview.duration_s is None


def test_a_problem_stands_in_place_of_the_preview(bench):
    bench.panel.show_results(bench.results())
    bench.panel.show_problem("No limb of that name")
    assert bench.preview.words == "No limb of that name"
    assert bench.preview.duration_s is None


def test_an_old_preview_turns_pale_only_after_a_while(bench, qtbot):
    bench.panel.show_results(bench.results())
    fresh = bench.preview.grab().toImage()
    bench.panel.show_stale(True)
    assert bench.preview.grab().toImage() == fresh
    qtbot.waitUntil(lambda: bench.preview.grab().toImage() != fresh)
    bench.panel.show_results(bench.results())
    assert bench.preview.grab().toImage() == fresh


def test_undoing_a_change_of_kind_leaves_the_keys_in_the_panel(bench):
    before = bench.design
    bench.show(bench.design.with_input(0, waveform=Noise()))
    bench.number("seed").setFocus()
    bench.show(before)
    assert bench.choice("kind").hasFocus()


def test_tab_leads_through_the_fields_in_reading_order(bench):
    bench.show(bench.design.with_input(0, waveform=Noise()))
    bench.choice("kind").setFocus()
    visited = []
    for _ in range(6):
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
        visited.append(QApplication.focusWidget().objectName())
    assert visited == [
        f"{name}_field"
        for name in ("seed", "duration_s", "window", "amplitude", "onset_s", "location")
    ]


def test_two_fields_stand_side_by_side_where_there_is_room(bench, qtbot):
    grid = bench.panel.findChild(FieldGrid)
    assert grid.pairs == 1
    bench.panel.resize(620, 300)
    qtbot.waitUntil(lambda: grid.pairs == 2)
    bench.panel.resize(320, 300)
    qtbot.waitUntil(lambda: grid.pairs == 1)


def test_the_panel_takes_over_a_theme_and_fits_its_smallest_dock(bench):
    light = bench.panel.grab().toImage()
    bench.panel.show_theme(DARK)
    assert bench.panel.grab().toImage() != light
    assert bench.panel.minimumSizeHint().width() <= 300
    assert bench.panel.minimumSizeHint().height() <= 260


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """A kind of waveform that the panel has never seen, whose numbers depend on each other."""

    title: ClassVar[str] = "Sweep"

    low_hz: float = fields.number(
        50.0, NumberSpec(label="Start", unit="Hz", minimum=1, maximum=600)
    )
    high_hz: float = fields.number(90.0, NumberSpec(label="End", unit="Hz", minimum=1, maximum=600))
    law: str = fields.choice("a", ChoiceSpec(label="Law", options=(("a", "Line"), ("b", "Bow"))))
    duration_s: float = fields.number(
        0.5, NumberSpec(label="Duration", unit="s", minimum=0.1, maximum=9)
    )

    def __post_init__(self):
        if self.low_hz >= self.high_hz:
            raise InvalidInputError("a sweep goes from a lower to a higher frequency")


def test_a_new_kind_of_waveform_is_edited_without_a_change_of_the_panel(qtbot):
    bench = Bench(qtbot, design_of(Sweep()))
    bench.type("high_hz", "120")
    bench.choose("law", "Bow")
    assert bench.one.waveform == Sweep(high_hz=120.0, law="b")
    assert bench.labels == ["Change end of input 7", "Change law of input 7"]


def test_numbers_that_do_not_go_together_are_refused_with_the_reason(qtbot):
    bench = Bench(qtbot, design_of(Sweep()))
    bench.type("low_hz", "95")
    assert bench.edits == []
    assert bench.number("low_hz").value_si == 50.0
    assert bench.words("low_hz_note").text() == "a sweep goes from a lower to a higher frequency"
