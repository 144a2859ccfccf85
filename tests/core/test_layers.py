"""Clips in a group play as one waveform, and what they play is what they play on a track."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource import Clip, Design, Input, View, edits
from skinsource.base.errors import FileFormatError, InvalidInputError
from skinsource.design.edits.edit import Refusal
from skinsource.design.effects.time import Trim
from skinsource.design.waveforms import KINDS, Layers, Noise, Tap, Tone
from skinsource.signals.sampling import NEAR
from skinsource.specs.models import decode, encode
from skinsource.specs.spec import Address
from tests.core.clips_bench import total

RATE_HZ = 1300.0
TONE = Tone(frequency_hz=77.0, duration_s=0.1, window="none")
PARTS = (
    Clip(waveform=TONE, onset_s=0.0103),
    Clip(waveform=Noise(seed=3), onset_s=0.05, gain=-0.5),
    Clip(waveform=Tap(), onset_s=0.1, muted=True),
    Clip(waveform=TONE, effects=(Trim(start_s=0.02, duration_s=0.05),)),
)


@settings(max_examples=50, deadline=None, derandomize=True)
@given(st.floats(0.0, 0.3), st.permutations(PARTS))
def test_a_group_plays_what_its_parts_play_there(onset_s, parts):
    group = Clip(waveform=Layers(parts=tuple(parts)), onset_s=onset_s)
    alone = [replace(part, onset_s=part.onset_s + onset_s) for part in PARTS]
    # An onset that is nearer than this to a sample is on it.
    atol = 2 * np.pi * TONE.frequency_hz * NEAR / RATE_HZ
    np.testing.assert_allclose(total(group), total(*alone), rtol=0, atol=atol)


@pytest.mark.parametrize("shift", [0.0, 0.3])
def test_a_product_is_that_of_the_formulas(shift):
    slow = Tone(frequency_hz=5.0, duration_s=0.2, window="none", phase_rad=0.5)
    both = Layers(parts=(Clip(waveform=TONE, gain=2.0), Clip(waveform=slow)), mode="product")
    samples = both.samples(RATE_HZ, shift / RATE_HZ)
    own_s = (np.arange(samples.size) - shift) / RATE_HZ
    expected = 2.0 * np.sin(2 * np.pi * 77.0 * own_s) * np.sin(2 * np.pi * 5.0 * own_s + 0.5)
    expected[(own_s < 0) | (own_s >= 0.1 - 1e-9)] = 0.0
    np.testing.assert_allclose(samples, expected, rtol=0, atol=1e-9)
    assert both.duration_s == 0.2


def test_a_group_of_muted_parts_is_silent_and_as_long():
    silent = Layers(parts=tuple(replace(part, muted=True) for part in PARTS))
    assert not silent.samples(RATE_HZ).any()
    assert silent.samples(RATE_HZ).size == 325
    assert silent.duration_s == pytest.approx(0.25)


def nested(depth: int) -> Layers:
    layers = Layers()
    for _ in range(depth - 1):
        layers = Layers(parts=(Clip(waveform=layers, gain=0.9),))
    return layers


def test_groups_stand_in_groups_up_to_a_depth():
    deep = nested(15)
    np.testing.assert_allclose(
        deep.samples(RATE_HZ), 0.9**14 * Tone().samples(RATE_HZ), rtol=1e-12, atol=1e-15
    )
    assert decode(encode(deep), KINDS, Address()) == deep
    with pytest.raises(InvalidInputError, match="recipes within recipes at most 32 deep"):
        nested(17)


def test_a_tree_nested_too_deep_is_refused_before_its_clips_are_made(monkeypatch):
    tree = encode(Clip())
    for _ in range(16):
        tree = {"kind": "Clip", "waveform": {"kind": "Layers", "parts": [tree, tree]}}
    clips, check = [], Clip.__post_init__
    monkeypatch.setattr(Clip, "__post_init__", lambda clip: (clips.append(clip), check(clip)))
    with pytest.raises(FileFormatError, match="deep"):
        decode(tree["waveform"], KINDS, Address())
    assert not clips


class CountedTap(Tap):
    """A tap that counts how often it is asked for its duration."""

    count = 0

    @property
    def duration_s(self):
        CountedTap.count += 1
        return super().duration_s


def test_groups_in_groups_compute_their_length_once():
    clip, CountedTap.count = Clip(waveform=CountedTap()), 0
    for _ in range(12):
        clip = Clip(waveform=Layers(parts=(clip, clip)))
    assert clip.duration_s == Tap().duration_s
    assert CountedTap.count <= 3


@pytest.mark.parametrize("parts", [(), (TONE,), (Clip(),) * 101])
def test_an_impossible_group_is_refused_by_name(parts):
    with pytest.raises(InvalidInputError, match=r"Layers\.parts is"):
        Layers(parts)


DESIGN = Design(
    limb="synthetic-1", inputs=(Input(location=1, clips=PARTS), Input(location=2, clips=(Clip(),)))
)
VIEW = View(selected_inputs=(1,))


def test_clips_that_are_grouped_sound_as_before_and_come_back():
    grouped = edits.group_clips(DESIGN, VIEW, (1, 2, 3))
    assert [clip.id for clip in grouped.design.inputs[0].clips] == [1, 4]
    assert grouped.design.clip(1).onset_s == 0.0103
    assert grouped.view.selected_clips == (1,)
    assert grouped.label == "Group 3 clips"
    np.testing.assert_allclose(
        total(*grouped.design.inputs[0].clips), total(*PARTS), rtol=0, atol=1e-8
    )
    louder = grouped.design.with_clip(1, gain=2.0)
    freed = edits.ungroup_clips(louder, VIEW, (1,))
    back = [replace(clip, id=0) for clip in freed.design.inputs[0].clips]
    assert back == [replace(part, gain=2.0 * part.gain) for part in PARTS[:3]] + [PARTS[3]]
    assert freed.view.selected_clips == tuple(clip.id for clip in freed.design.inputs[0].clips[:3])
    assert freed.label == "Ungroup clip"


@pytest.mark.parametrize(("muted", "expected"), [(True, [True, True]), (False, [True, False])])
def test_what_was_silent_as_a_group_stays_silent_apart(muted, expected):
    group = Clip(waveform=Layers((Clip(muted=True), Clip(onset_s=0.3))), muted=muted)
    design = Design(limb="synthetic-1", inputs=(Input(location=7, clips=(group,)),))
    freed = edits.ungroup_clips(design, VIEW, (1,)).design
    assert [clip.muted for clip in freed.clips] == expected


def test_a_product_and_what_has_effects_stay_groups():
    product = edits.group_clips(DESIGN, VIEW, (1, 2), "product").design
    assert product.clip(1).waveform.mode == "product"
    summed = edits.group_clips(DESIGN, VIEW, (1, 2)).design.with_clip(1, effects=(Trim(),))
    for outcome in (
        edits.ungroup_clips(product, VIEW, (1,)),
        edits.ungroup_clips(summed, VIEW, (1,)),
        edits.ungroup_clips(DESIGN, VIEW, (1,)),
        edits.group_clips(DESIGN, VIEW, (1, 5)),
        edits.group_clips(DESIGN, VIEW, ()),
        edits.group_clips(DESIGN, VIEW, (1, 2), "mean"),
    ):
        assert isinstance(outcome, Refusal)
