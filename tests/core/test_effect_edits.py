"""What is done to the chain of a clip, and to recipes in lists."""

import pytest

from skinsource import Design, Input, View, edits, track
from skinsource.base.errors import InvalidInputError
from skinsource.design.clips import EFFECT_LIST, MAX_EFFECTS, Clip
from skinsource.design.edits.edit import KindSpec, Refusal
from skinsource.design.edits.effects import (
    choices_of,
    moved_part,
    new_part,
    with_part,
    without_part,
)
from skinsource.design.effects import EFFECTS, Envelope, Fade, Repeat, Reverse, Stretch, Trim
from skinsource.design.waveforms import KINDS, Layers, Noise, Tone
from skinsource.specs.models import specs_of

CHAIN = (Reverse(), Fade(), Repeat())
TWO = Clip(id=1, waveform=Tone(duration_s=0.2), effects=CHAIN), Clip(id=2, onset_s=0.3)
INPUTS = Input(location=7, clips=TWO), Input(location=3, clips=(Clip(id=3),))
DESIGN = Design(limb="synthetic-1", inputs=INPUTS)
VIEW = View(selected_clips=(1,))


def chain_of(outcome, id=1):
    assert not isinstance(outcome, Refusal), outcome
    others = [clip for clip in outcome.design.clips if clip.id != id]
    assert all(any(clip is before for before in DESIGN.clips) for clip in others)
    assert outcome.view == VIEW
    return outcome.design.clip(id).effects


@pytest.mark.parametrize("kind", EFFECTS)
def test_every_effect_is_added_at_the_end_or_at_a_place(kind):
    outcome = edits.add_effect(DESIGN, VIEW, (1,), kind.__name__)
    assert outcome.label == f"Add {kind.title.lower()} to clip at 7 (II pad)"
    assert [type(effect) for effect in chain_of(outcome)] == [*map(type, CHAIN), kind]
    first = edits.add_effect(DESIGN, VIEW, (1,), kind.__name__, 0)
    assert [type(effect) for effect in chain_of(first)] == [kind, *map(type, CHAIN)]


def test_a_new_effect_fits_the_clip():
    envelope = chain_of(edits.add_effect(DESIGN, VIEW, (2,), "Envelope"), 2)[0]
    assert envelope.points == ((0.0, 1.0, "straight"), (0.2, 1.0, "straight"))
    assert chain_of(edits.add_effect(DESIGN, VIEW, (2,), "Trim"), 2) == (Trim(0.0, 0.2),)
    assert chain_of(edits.add_effect(DESIGN, VIEW, (2,), "Fade"), 2) == (Fade(0.02, 0.02),)


REVERSE, FADE, REPEAT = CHAIN


@pytest.mark.parametrize(
    ("edit", "given", "chain", "label"),
    [
        ("remove_effect", (1,), (REVERSE, REPEAT), "Remove fade from"),
        ("move_effect", (0, 1), (FADE, REVERSE, REPEAT), "Reorder effects of"),
        ("move_effect", (0, 99), (FADE, REPEAT, REVERSE), "Reorder effects of"),
        ("move_effect", (2, -4), (REPEAT, REVERSE, FADE), "Reorder effects of"),
        ("switch_effect", (1, False), (REVERSE, Fade(on=False), REPEAT), "Switch fade off in"),
        (
            "change_effect_field",
            (1, "in_s", 0.05),
            (REVERSE, Fade(in_s=0.05), REPEAT),
            "Change fade in of",
        ),
    ],
)
def test_an_effect_is_removed_moved_switched_and_changed(edit, given, chain, label):
    outcome = getattr(edits, edit)(DESIGN, VIEW, 1, *given)
    assert chain_of(outcome) == chain
    assert outcome.label == f"{label} clip at 7 (II pad)"


def test_an_envelope_is_that_of_the_last_one_or_a_new_one():
    points = ((0.0, 0.0, "smooth"), (0.1, 1.0, "held"))
    once = edits.set_envelope(DESIGN, VIEW, 1, points)
    assert chain_of(once) == (*CHAIN, Envelope(points))
    other = edits.set_envelope(once.design, VIEW, 1, points[:1])
    assert other.design.clip(1).effects == (*CHAIN, Envelope(points[:1]))
    assert other.label == "Change envelope of clip at 7 (II pad)"


@pytest.mark.parametrize(
    ("edit", "given", "message"),
    [
        ("add_effect", ((9,), "Fade"), "No clip is selected"),
        ("add_effect", ((1,), "Echo"), "No effect is called 'Echo'; there are Envelope, Fade"),
        ("remove_effect", (1, 3), "no longer there"),
        ("move_effect", (9, 0, 0), "no longer there"),
        ("switch_effect", (1, 0, 7), "Reverse.on is 7, expected True or False"),
        ("change_effect_field", (1, 1, "depth", 7), "no longer there"),
        ("change_effect_field", (1, 1, "in_s", -1.0), "Fade.in_s is -1.0"),
        ("set_envelope", (1, ()), "Envelope.points"),
    ],
)
def test_what_cannot_be_done_is_refused_with_a_reason(edit, given, message):
    outcome = getattr(edits, edit)(DESIGN, VIEW, *given)
    assert isinstance(outcome, Refusal)
    assert message in outcome.sentence


def test_a_chain_has_an_end_in_number_and_in_time():
    design = DESIGN
    for _ in range(MAX_EFFECTS):
        design = edits.add_effect(design, VIEW, (3,), "Reverse").design
    for refused in (
        edits.add_effect(design, VIEW, (3,), "Reverse"),
        edits.set_envelope(design, VIEW, 3, ((0.0, 1.0),)),
    ):
        assert refused.sentence == "A clip has at most 32 effects; remove one first."
    often = edits.change_effect_field(DESIGN, VIEW, 1, 2, "times", 1000).design
    twice = edits.add_effect(often, VIEW, (1,), "Repeat").design
    refused = edits.change_effect_field(twice, VIEW, 1, 3, "times", 1000)
    assert refused.sentence.startswith("Clip lasts 200000 s, expected at most 3600 s")


def test_a_clip_that_becomes_layers_has_what_it_was_as_the_first_one():
    before = edits.change_kind(DESIGN, VIEW, (2,), "Noise").design
    layers = edits.change_kind(before, VIEW, (2,), "Layers").design.clip(3).waveform
    assert [part.waveform for part in layers.parts] == [before.clip(3).waveform] == [Noise()]


def test_a_stretched_clip_keeps_how_it_is_stretched():
    design = edits.add_effect(DESIGN, VIEW, (3,), "Stretch").design
    design = edits.change_effect_field(design, VIEW, 3, 0, "pitch", "stays").design
    design = edits.change_effect_field(design, VIEW, 3, 0, "to_s", 0.3).design
    design = edits.stretch_clip(design, VIEW, 3, 0.0, 0.6).design
    assert design.clip(3).effects == (Stretch(3.0, 0.0, "stays"),)
    assert design.clip(3).duration_s == pytest.approx(0.6)


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
    with pytest.raises(InvalidInputError, match="Clip 'Fade' is not known; choose from Tone"):
        new_part(PARTS.of, "Fade")
    short = Clip(waveform=Tone(100.0, duration_s=0.02))
    assert new_part(EFFECT_LIST.of, "Fade", short) == Fade(0.005, 0.005)


@pytest.mark.parametrize(
    ("after", "expected", "label"),
    [
        ((A, B, C, A), (A, B, C, A), "Add to parts of"),
        (without_part((A, B, C), 1), (A, C), "Remove from parts of"),
        (moved_part((A, B, C), 0, 2), (B, C, A), "Reorder parts of"),
        (moved_part((A, B, C), 2, -4), (C, A, B), "Reorder parts of"),
        (moved_part((A, B, C), 1, 9), (A, C, B), "Reorder parts of"),
        (with_part((A, B, C), 1, C), (A, C, C), "Change parts of"),
    ],
)
def test_the_history_says_what_was_done_to_a_list(after, expected, label):
    design = Design(limb="synthetic-1", inputs=(track(7, Layers((A, B, C))),))
    done = edits.change_field(design, View(), (1,), "parts", after)
    assert done.label == f"{label} input at 7 (II pad)"
    assert done.design.clips[0].waveform == Layers(expected)


def test_what_is_allowed_in_a_part_follows_from_the_rate_of_the_limb():
    of = PARTS.at_rate(2000.0).of
    waveform = specs_of(Clip)["waveform"].at_rate(of.rate_hz)
    assert specs_of(Tone)["frequency_hz"].at_rate(waveform.rate_hz).maximum == 999.0
