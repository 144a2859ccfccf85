"""Recipes in lists: what a new one may be, and how the history names what is done to them."""

from dataclasses import replace

import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design import edits
from skinsource.design.clips import EFFECT_LIST, Clip
from skinsource.design.design import Design, track
from skinsource.design.edits.edit import KindSpec
from skinsource.design.edits.effects import (
    choices_of,
    moved_part,
    new_part,
    part_text,
    with_part,
    without_part,
)
from skinsource.design.effects import EFFECTS
from skinsource.design.effects.level import Fade
from skinsource.design.effects.time import Reverse
from skinsource.design.view import View
from skinsource.design.waveforms import KINDS
from skinsource.design.waveforms.pulses import Noise
from skinsource.design.waveforms.samples import Layers
from skinsource.design.waveforms.tones import Tone
from skinsource.specs.models import specs_of

PARTS = specs_of(Layers)["parts"]
A, B, C = Clip(waveform=Tone(50.0)), Clip(waveform=Noise(seed=3)), Clip(onset_s=0.25)


def test_a_new_part_of_layers_is_a_clip_of_any_waveform():
    choices = choices_of(PARTS.of)
    assert type(choices) is KindSpec
    assert [name for name, _ in choices.options] == [kind.__name__ for kind in KINDS]
    for kind in KINDS:
        made = new_part(PARTS.of, kind.__name__)
        assert type(made) is Clip
        assert type(made.waveform) is kind


def test_a_new_effect_fits_the_clip_that_holds_it():
    assert {name for name, _ in choices_of(EFFECT_LIST.of).options} == {
        kind.__name__ for kind in EFFECTS
    }
    short = Clip(waveform=Tone(100.0, duration_s=0.02))
    assert new_part(EFFECT_LIST.of, "Fade", short) == Fade(0.005, 0.005)
    assert new_part(EFFECT_LIST.of, "Fade") == Fade()


def test_what_cannot_be_chosen_is_refused_by_name():
    with pytest.raises(InvalidInputError, match="Clip is 'Fade', expected one of Tone, Chirp"):
        new_part(PARTS.of, "Fade")


def test_a_part_is_called_by_its_label_or_by_what_it_plays():
    assert part_text(B) == "Noise"
    assert part_text(replace(B, label="soft")) == "soft"
    assert part_text(replace(B, muted=True)) == "Noise (off)"
    assert part_text(Reverse(on=False)) == "Reverse (off)"


@pytest.mark.parametrize(
    ("after", "label"),
    [
        ((A, B, C, A), "Add to parts of"),
        (without_part((A, B, C), 1), "Remove from parts of"),
        (moved_part((A, B, C), 0, 2), "Reorder parts of"),
        (with_part((A, B, C), 1, C), "Change parts of"),
        (with_part((A, B, C), 1, replace(B, gain=0.5)), "Change parts of"),
    ],
)
def test_the_history_says_what_was_done_to_a_list(after, label):
    design = Design(limb="synthetic-1").adding(track(location=7, waveform=Layers((A, B, C))))
    (only,) = design.inputs
    done = edits.change_field(design, View(), (only.id,), "parts", after)
    assert done.label == f"{label} input at 7 (II pad)"
    assert done.design.inputs[0].clips[0].waveform == Layers(after)


def test_a_part_moves_as_far_as_there_is_room():
    assert moved_part((A, B, C), 0, 2) == (B, C, A)
    assert moved_part((A, B, C), 2, -4) == (C, A, B)
    assert moved_part((A, B, C), 1, 9) == (A, C, B)
    assert without_part((A, B, C), 2) == (A, B)


def test_what_is_allowed_in_a_part_follows_from_the_rate_of_the_limb():
    of = PARTS.at_rate(2000.0).of
    waveform = specs_of(Clip)["waveform"].at_rate(of.rate_hz)
    assert specs_of(Tone)["frequency_hz"].at_rate(waveform.rate_hz).maximum == 999.0
