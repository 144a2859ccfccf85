"""Parts of clips: split, joined and trimmed, and sounding as before."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource.design import edits
from skinsource.design.edits.edit import Refusal
from skinsource.design.effects.time import Trim
from skinsource.design.waveforms.pulses import Tap
from tests.core.clips_bench import DESIGN, RATE_HZ, VIEW, times, total


@settings(max_examples=60, deadline=None, derandomize=True)
@given(times, st.integers(0, 599).map(lambda k: k / 1300))
def test_what_was_split_sounds_as_before_and_joins_to_what_it_was(at_s, onset_s):
    for cut_s in (at_s, onset_s):
        outcome = edits.split_clips(DESIGN, VIEW, (1, 2, 3, 4, 5), cut_s)
        if isinstance(outcome, Refusal):
            playing = [clip for clip in DESIGN.clips if clip.onset_s < cut_s < clip.end_s]
            assert (
                playing == []
                or min(min(cut_s - clip.onset_s, clip.end_s - cut_s) for clip in playing) < 1e-8
            )
            continue
        for place in range(4):
            after, expected = total(outcome.design, place), total(DESIGN, place)
            np.testing.assert_allclose(after, expected, rtol=0, atol=1e-9)
        ids = tuple(clip.id for clip in outcome.design.clips)
        again = edits.join_clips(outcome.design, outcome.view, ids)
        assert again.design == DESIGN


def test_parts_of_parts_join_to_what_they_were_in_one_go():
    design = DESIGN
    for at_s in (0.17, 0.2, 0.1503):
        design = edits.split_clips(
            design, VIEW, tuple(clip.id for clip in design.clips), at_s
        ).design
    assert len(design.inputs[0].clips) == 5
    part = edits.split_clips(DESIGN, VIEW, (1,), 0.2)
    assert [clip.id for clip in part.design.inputs[0].clips] == [1, 6, 2]
    assert part.view.selected_clips == (6,)
    assert part.design.clip(6).effects == (Trim(start_s=0.1, duration_s=0.1),)
    whole = edits.join_clips(design, VIEW, tuple(clip.id for clip in design.clips))
    assert whole.design == DESIGN
    assert whole.view.selected_clips == (2,)


@pytest.mark.parametrize("change", [{"gain": 2.0}, {"onset_s": 0.21}, {"waveform": Tap()}])
def test_parts_that_differ_or_lie_apart_do_not_join(change):
    part = edits.split_clips(DESIGN, VIEW, (1,), 0.2).design.with_clip(6, **change)
    assert isinstance(edits.join_clips(part, VIEW, (1, 6)), Refusal)


@pytest.mark.parametrize(
    ("ends", "onset_s", "effects"),
    [
        ((0.15, 0.3), 0.15, (Trim(start_s=0.05, duration_s=0.15),)),
        ((0.1, 0.25), 0.1, (Trim(start_s=0.0, duration_s=0.15),)),
        ((0.1, 0.3), 0.1, ()),
        ((-5.0, 9.0), 0.1, ()),
        ((0.2, 0.1), 0.2, (Trim(start_s=0.1, duration_s=0.001),)),
    ],
)
def test_ends_that_are_dragged_trim_and_come_back(ends, onset_s, effects):
    outcome = edits.trim_clip(DESIGN, VIEW, 1, *ends)
    clip = outcome.design.clip(1)
    assert (clip.onset_s, clip.effects) == (onset_s, effects)
    assert edits.trim_clip(outcome.design, VIEW, 1, 0.1, 0.3).design == DESIGN


def test_what_is_trimmed_stands_still():
    trimmed = edits.trim_clip(DESIGN, VIEW, 1, 0.1503, 0.2207).design
    after, before = (
        total(trimmed, 0),
        total(DESIGN, 0) - total(edits.set_clips(DESIGN, VIEW, (1,), "muted", True).design, 0),
    )
    muted = edits.set_clips(trimmed, VIEW, (2,), "muted", True).design
    after = total(muted, 0)
    inside = np.zeros(5000, bool)
    inside[int(np.ceil(0.1503 * RATE_HZ)) : int(np.ceil(0.2207 * RATE_HZ))] = True
    np.testing.assert_allclose(after, np.where(inside, before, 0.0), rtol=0, atol=1e-9)
