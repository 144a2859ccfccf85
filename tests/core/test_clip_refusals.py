"""Edits of clips and of time that cannot be done: each is refused with one sentence."""

import pytest

from skinsource.design import edits
from skinsource.design.clips import MAX_CLIPS, Clip
from skinsource.design.design import MAX_INPUTS, Design, Input
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone
from tests.core.clips_bench import DESIGN, VIEW

FULL = Design(limb="synthetic-1", inputs=(Input(location=1, clips=(Clip(),) * MAX_CLIPS),))
CROWD = Design(limb="synthetic-1", inputs=(Input(location=1),) * MAX_INPUTS)
LANES = edits.fragment_of(DESIGN, (1, 3))


@pytest.mark.parametrize(
    "outcome",
    [
        edits.add_clip(DESIGN, VIEW, 9, 0.0, Tap()),
        edits.add_clip(DESIGN, VIEW, 1, -0.1, Tap()),
        edits.add_clip(DESIGN, VIEW, 1, 0.0, None),
        edits.add_clip(FULL, VIEW, 1, 0.0, Tap()),
        edits.move_clips(DESIGN, VIEW, (9,), 0.1),
        edits.move_clips(DESIGN, VIEW, (1,), float("nan")),
        edits.move_clips(DESIGN, VIEW, (1,), 0.1, 0.5),
        edits.copy_clips(FULL, VIEW, (1,), 0.1),
        edits.repeat_clips(DESIGN, VIEW, (1,), 1),
        edits.repeat_clips(DESIGN, VIEW, (1,), 10**9),
        edits.repeat_clips(DESIGN, VIEW, (5,), 1000 * 1000),
        edits.split_clips(DESIGN, VIEW, (1,), 0.05),
        edits.split_clips(DESIGN, VIEW, (1,), None),
        edits.split_clips(FULL, VIEW, (1,), 0.1),
        edits.join_clips(DESIGN, VIEW, (1, 2)),
        edits.join_clips(DESIGN, VIEW, ()),
        edits.trim_clip(DESIGN, VIEW, 9, 0.0, 1.0),
        edits.trim_clip(DESIGN, VIEW, 1, float("nan"), 1.0),
        edits.set_clips(DESIGN, VIEW, (1,), "id", 3),
        edits.set_clips(DESIGN, VIEW, (1,), "gain", "loud"),
        edits.remove_clips(DESIGN, VIEW, ()),
        edits.cut_clips(DESIGN, VIEW, ()),
        edits.paste_fragment(DESIGN, VIEW, LANES, -1.0),
        edits.paste_fragment(DESIGN, VIEW, LANES, None),
        edits.paste_fragment(FULL, VIEW, LANES, 0.0),
        edits.paste_fragment(CROWD, View(selected_inputs=(100,)), LANES, 0.0),
        edits.insert_time(DESIGN, VIEW, 0.1, 0.0),
        edits.insert_time(DESIGN, VIEW, -0.1, 1.0),
        edits.insert_time(DESIGN, VIEW, 0.0, 600.0),
        edits.remove_time(DESIGN, VIEW, 0.3, 0.2),
        edits.remove_time(DESIGN, VIEW, "0", 1.0),
        edits.add_marker(DESIGN, VIEW, -1.0),
        edits.move_marker(DESIGN, VIEW, 3, 0.1),
        edits.move_marker(DESIGN, VIEW, 0, float("inf")),
        edits.rename_marker(DESIGN, VIEW, 0, "two\nlines"),
        edits.remove_marker(DESIGN, VIEW, -1),
        edits.set_loop(DESIGN, VIEW, (1.0, 1.0)),
        edits.set_gain_curve(DESIGN, VIEW, 1, ((0.0, -1.0),)),
        edits.set_gain_curve(DESIGN, VIEW, 9, ()),
        edits.move_playhead(DESIGN, VIEW, -1.0),
    ],
)
def test_what_cannot_be_done_is_refused_with_one_sentence(outcome):
    assert isinstance(outcome, Refusal)
    assert outcome.sentence.endswith(".")
    assert len(outcome.sentence) < 400


def test_edits_lead_to_edits():
    assert isinstance(edits.select_clips(DESIGN, VIEW, (1,)), Edit)


@pytest.mark.parametrize(
    ("at_s", "message"),
    [
        (0.2, "The selected clip begins at 0.2 s: there is nothing to split; put the"),
        (0.3, "The selected clip ends at 0.3 s: there is nothing to split; put the"),
        (0.1, "None of the selected clips plays at 0.1 s; put the playhead inside"),
    ],
)
def test_a_split_where_a_clip_begins_or_ends_says_so(at_s, message):
    clip = Clip(onset_s=0.2, waveform=Tone(frequency_hz=100.0, duration_s=0.1))
    design = Design(limb="synthetic-1", inputs=(Input(location=1, clips=(clip,)),))
    outcome = edits.split_clips(design, View(), (design.clips[0].id,), at_s)
    assert outcome.sentence.startswith(message)
    two = design.with_input(0, clips=(clip, Clip(onset_s=0.2, waveform=Tap())))
    ids = tuple(clip.id for clip in two.clips)
    assert edits.split_clips(two, View(), ids, 0.2).sentence.startswith("A selected clip begins")
