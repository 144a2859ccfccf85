"""Kinds of waveforms in the inspector and in words, one of them new."""

from dataclasses import dataclass, replace
from itertools import product
from typing import ClassVar

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design import waveforms
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.design_file import open_design, save_design
from skinsource.design.edits.edit import as_kind
from skinsource.design.effects.level import Fade
from skinsource.design.effects.time import Stretch
from skinsource.design.waveforms.tones import Tone
from skinsource.specs import fields
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.grid import FieldGrid
from skinsource_gui.fields.inputs import clip_text, figure_text, full_label
from skinsource_gui.fields.units import value_text
from skinsource_gui.plots.pictures import stimulus_text
from tests.gui.inspector.bench import Bench, design_of


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

    def samples(self, sample_rate_hz, shift_s=0.0):
        time_s = np.arange(round(self.duration_s * sample_rate_hz)) / sample_rate_hz
        rise_hz_per_s = (self.high_hz - self.low_hz) / self.duration_s
        return np.sin(2 * np.pi * (self.low_hz + rise_hz_per_s * time_s / 2) * time_s)

    def __post_init__(self):
        if self.low_hz >= self.high_hz:
            raise InvalidInputError("a sweep goes from a lower to a higher frequency")


@pytest.fixture(autouse=True)
def _it_is_named_where_kinds_are_named(monkeypatch):
    """As CONTRIBUTING says, and nothing else."""
    monkeypatch.setattr(waveforms, "KINDS", (*waveforms.KINDS, Sweep))


def test_a_new_kind_of_waveform_is_chosen_in_the_panel(qtbot):
    bench = Bench(qtbot, design_of(Tone(duration_s=0.3)))
    bench.choose("kind", "Sweep")
    assert bench.track.clips[0].waveform == Sweep(duration_s=0.3)


def test_every_kind_can_become_every_other():
    for kind, other in product(waveforms.KINDS, repeat=2):
        assert type(as_kind(kind(), other, 1300.0)) is other


def test_a_new_kind_of_waveform_is_saved_and_opened(tmp_path):
    design = replace(design_of(Sweep(low_hz=30.0, law="b"), Tone()), limb="synthetic-1")
    path = tmp_path / "sweep.skinsource"
    save_design(path, design)
    assert open_design(path).design == design


def test_a_new_kind_of_waveform_is_edited_without_a_change_of_the_panel(qtbot):
    bench = Bench(qtbot, design_of(Sweep()))
    bench.type("high_hz", "120")
    bench.choose("law", "Bow")
    assert bench.track.clips[0].waveform == Sweep(high_hz=120.0, law="b")
    assert bench.labels == [f"Change {name} of input at 7 (II pad)" for name in ("end", "law")]


def test_numbers_that_do_not_go_together_are_refused_with_the_reason(qtbot):
    bench = Bench(qtbot, design_of(Sweep()))
    bench.type("low_hz", "95")
    assert bench.edits == []
    assert bench.number("low_hz").value_si == 50.0
    assert bench.label("low_hz_note").text() == "a sweep goes from a lower to a higher frequency."


@pytest.mark.parametrize("kind", [waveforms.WaveletTrain, waveforms.Glide, waveforms.Formula])
def test_fields_that_hold_much_fit_the_panel_whatever_was_shown_before(qtbot, kind):
    bench = Bench(qtbot, design_of(kind()))
    grid = bench.panel.findChild(FieldGrid)
    bench.panel.resize(1000, 460)
    qtbot.waitUntil(lambda: grid.width() > 900)
    bench.panel.resize(300, 460)
    qtbot.waitUntil(lambda: grid.width() <= 300)


def test_a_length_that_follows_from_other_fields_is_said_anew(qtbot):
    bench = Bench(qtbot, design_of(waveforms.Gabor()))
    assert bench.label("fixed_length").text() == "50.9 ms (66 samples)"
    bench.type("cycles", "8")
    assert bench.label("fixed_length").text() == "102 ms (132 samples)"


@pytest.mark.parametrize(
    ("waveform", "figure", "whole"),
    [
        (waveforms.Tone(), "Tone 100 Hz", ""),
        (waveforms.Impulse(), "Impulse", ""),
        (waveforms.WaveletTrain((84.1,)), "Wavelet train 84.1 Hz", None),
        (waveforms.Glide(), "Glide 60–240 Hz", None),
        (waveforms.Chirp(start_hz=600.0, end_hz=25.0), "Chirp 600–25 Hz", ""),
        (waveforms.Noise(), "Noise 25–600 Hz", " (seed 0)"),
        (waveforms.Square(), "Square 100 Hz", " (duty 0.5)"),
        (waveforms.Layers(), "Layers", " (Tone 100 Hz)"),
    ],
)
def test_a_waveform_is_named_with_its_frequencies_and_in_full_with_more(waveform, figure, whole):
    assert figure_text(waveform) == figure
    assert whole is None or full_label(waveform) == f"{figure}{whole}"


@pytest.mark.parametrize("kind", waveforms.KINDS, ids=lambda kind: kind.__name__)
def test_no_kind_is_told_without_a_number_that_it_has(kind):
    waveform = kind()
    for name, spec in specs_of(waveform).items():
        if isinstance(spec, NumberSpec) and spec.unit != "rad" and name != "duration_s":
            number = value_text(getattr(waveform, name), spec.unit, digits=4).split()[0]
            assert number in full_label(waveform), name


@pytest.mark.parametrize(
    ("effect", "text", "through"),
    [
        (Fade(), "Tone 100 Hz", "200 ms through fade"),
        (Stretch(to_s=0.1), "Tone 100 Hz, stretched ×0.5", "100 ms through stretch ×0.5"),
        (
            Stretch(factor=2.0, pitch="stays"),
            "Tone 100 Hz",
            "400 ms through stretch ×2 that keeps frequencies",
        ),
        (Stretch(factor=2.0, on=False), "Tone 100 Hz", "200 ms"),
    ],
)
def test_words_on_a_clip_say_by_what_it_is_stretched(effect, text, through):
    clip = Clip(waveform=Tone(frequency_hz=100.0, duration_s=0.2), effects=(effect,))
    assert clip_text(clip) == text
    design = Design(limb="synthetic-1", inputs=(Input(location=7, clips=(clip,)),))
    assert stimulus_text(design).endswith(f": Tone 100 Hz, {through}")
