"""Edits where chains are full and times are late: refused in a sentence, never raised."""

import math

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.design import edits
from skinsource.design.clips import MAX_EFFECTS, Clip
from skinsource.design.design import Design, Input
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.effects.level import Rectify
from skinsource.design.effects.time import Repeat, Stretch, Trim
from skinsource.design.view import View
from skinsource.design.waveforms.samples import Layers
from skinsource.design.waveforms.tones import Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain

VIEW = View()


def design(*clips, **changes):
    return Design(limb="synthetic-1", inputs=(Input(location=7, clips=clips, **changes),))


FULL = design(Clip(effects=(Rectify(),) * MAX_EFFECTS))
LATE = design(Clip(onset_s=500.0, waveform=Tone(duration_s=200.0)))


@pytest.mark.parametrize(
    "edit",
    [
        lambda edited, at_s: edits.split_clips(edited, VIEW, (1,), at_s),
        lambda edited, at_s: edits.insert_time(edited, VIEW, at_s, 0.5),
        lambda edited, at_s: edits.remove_time(edited, VIEW, at_s - 0.05, at_s),
    ],
    ids=["split", "insert", "remove"],
)
def test_a_clip_that_cannot_be_cut_is_a_refusal(edit):
    assert edit(FULL, 0.1) == Refusal(
        sentence="A clip has at most 32 effects, and cut in two it needs one more; remove one "
        "first."
    )
    assert edit(LATE, 650.0) == Refusal(
        sentence="A clip plays at 650 s, and none can begin after 600 s; cut it before that."
    )


def test_a_full_chain_that_ends_in_a_trim_can_be_cut():
    full = design(Clip(effects=(*(Rectify(),) * (MAX_EFFECTS - 1), Trim(0.0, 0.2))))
    outcome = edits.split_clips(full, VIEW, (1,), 0.1)
    assert isinstance(outcome, Edit)
    assert len(outcome.design.clips) == 2


@pytest.mark.parametrize(
    "effects",
    [(Repeat(times=1000),) * 3, (Repeat(times=1000),) * MAX_EFFECTS, (Stretch(100.0),) * 3],
)
def test_a_clip_that_plays_longer_than_an_hour_is_none(effects):
    with pytest.raises(InvalidInputError, match="expected at most 3600 s"):
        Clip(effects=effects)


def test_layers_do_not_hide_a_clip_without_end():
    inside = Clip(effects=(Repeat(times=1000),))
    with pytest.raises(InvalidInputError, match="expected at most 3600 s"):
        Clip(waveform=Layers((inside,)), effects=(Repeat(times=1000),) * 31)


def test_a_start_that_is_stretched_before_time_0_stays_there():
    short = design(Clip(waveform=Tone(duration_s=0.001)))
    outcome = edits.stretch_clip(short, VIEW, 1, -0.0005, 0.001)
    assert outcome.design.clips[0].onset_s == 0.0


@pytest.mark.parametrize(("start_s", "length_s"), [(1.999, 0.01), (0.5, 1.5)])
def test_the_end_stays_where_a_stretched_start_goes_no_farther(start_s, length_s):
    before = design(Clip(onset_s=1.0, waveform=Tone(duration_s=1.0)))
    [clip] = edits.stretch_clip(before, VIEW, 1, start_s, 2.0).design.clips
    assert clip.end_s == pytest.approx(2.0, abs=1e-12)
    assert clip.duration_s == pytest.approx(length_s, abs=1e-12)


def test_the_start_stays_where_a_stretched_end_goes_no_farther():
    before = design(Clip(onset_s=1.0, waveform=Tone(duration_s=1.0)))
    [clip] = edits.stretch_clip(before, VIEW, 1, 1.0, 1.001).design.clips
    assert (clip.onset_s, clip.duration_s) == (1.0, 0.01)


def test_levels_that_are_no_numbers_make_no_gains():
    train = design(Clip(waveform=WaveletTrain()))
    levels = (0.0, math.nan, 0.0, 0.0, 0.0)
    assert isinstance(edits.equalise_on_skin(train, VIEW, 1, levels, "level"), Refusal)


@pytest.mark.parametrize("kind", ["clips of a track", "parts of layers"])
def test_the_order_of_three_alike_clips_changes_no_bit(kind):
    clips = [Clip(waveform=Tone(frequency_hz), gain=0.3) for frequency_hz in (50.0, 77.0, 131.0)]
    orders = [clips, clips[::-1], [clips[1], clips[0], clips[2]], [clips[2], clips[0], clips[1]]]
    if kind == "parts of layers":
        results = [Layers(tuple(order)).samples(1300.0) for order in orders]
    else:
        results = [
            ss.evaluate(design(*order), "output_levels_db")["output_levels_db"] for order in orders
        ]
    assert all(np.array_equal(each, results[0]) for each in results)
