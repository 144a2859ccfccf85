"""What edits of clips leave beside what they are about: selections, rests, silence, distances."""

import pytest

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.edits.edit import Refusal
from skinsource.design.effects.level import Fade
from skinsource.design.effects.time import Trim
from skinsource.design.view import View
from skinsource.design.waveforms.samples import Layers
from skinsource.design.waveforms.tones import Tone

VIEW = View()


def design(*clips):
    return Design(limb="synthetic-1", inputs=(Input(location=7, clips=clips),))


@pytest.mark.parametrize(
    ("gone", "selected"), [((2,), (3,)), ((4,), (3,)), ((1,), (2,)), ((3, 4), (2,))]
)
def test_where_clips_are_removed_the_next_one_is_selected_or_else_the_last(gone, selected):
    four = design(*(Clip(onset_s=onset_s) for onset_s in (0.0, 1.0, 1.9, 4.0)))
    assert edits.remove_clips(four, VIEW, gone).view.selected_clips == selected


def test_a_clip_shorter_than_a_drag_leaves_is_trimmed_to_itself():
    short = design(
        Clip(onset_s=0.5, waveform=Tone(duration_s=0.2), effects=(Trim(0.1, 0.0004), Fade()))
    )
    whole = design(Clip(onset_s=0.5, waveform=Layers((Clip(effects=(Trim(0.1, 0.0004),)),))))
    [clip] = edits.trim_clip(whole, VIEW, 1, 0.2, 0.9).design.clips
    assert (clip.onset_s, clip.duration_s) == (0.5, pytest.approx(0.0004, abs=1e-15))
    [clip] = edits.trim_clip(short, VIEW, 1, 0.5, 0.5002).design.clips
    assert clip.duration_s == pytest.approx(0.001, abs=1e-15)


def test_a_fade_out_has_only_the_room_that_the_fade_in_leaves():
    before = design(Clip(waveform=Tone(duration_s=1.0)))
    [clip] = edits.fade_clip(before, VIEW, 1, 0.7, 0.9).design.clips
    assert clip.effects == (Fade(0.7, 0.3),)


def test_parts_that_lie_side_by_side_but_were_not_are_not_joined():
    tone = Tone(duration_s=1.0)
    first = Clip(waveform=tone, effects=(Trim(0.0, 0.3),))
    second = Clip(waveform=tone, onset_s=0.3, effects=(Trim(0.5, 0.2),))
    assert isinstance(edits.join_clips(design(first, second), VIEW, (1, 2)), Refusal)


def test_a_loop_that_would_end_too_late_is_gone():
    looped = Design(limb="synthetic-1", loop_s=(1100.0, 1190.0))
    assert edits.insert_time(looped, VIEW, 0.0, 10.0).design.loop_s == (1110.0, 1200.0)
    assert edits.insert_time(looped, VIEW, 0.0, 11.0).design.loop_s is None
    late = Design(limb="synthetic-1", loop_s=(1195.0, 1199.0))
    assert edits.insert_time(late, VIEW, 0.0, 10.0).design.loop_s is None


def test_what_was_silent_as_a_group_stays_silent_apart():
    parts = (Clip(muted=True), Clip(onset_s=0.3))
    group = design(Clip(waveform=Layers(parts), muted=True))
    assert [clip.muted for clip in edits.ungroup_clips(group, VIEW, (1,)).design.clips] == [
        True,
        True,
    ]
    layered = design(Clip(waveform=Layers(parts)))
    assert [clip.muted for clip in edits.ungroup_clips(layered, VIEW, (1,)).design.clips] == [
        True,
        False,
    ]


def test_a_fragment_of_lower_tracks_begins_with_the_first_of_them():
    tracks = tuple(Input(location=place, clips=(Clip(),)) for place in (7, 9, 11, 13))
    four = Design(limb="synthetic-1", inputs=tracks)
    fragment = edits.fragment_of(four, (2, 4))
    assert [(lane.location, lane.offset) for lane in fragment.lanes] == [(9, 0), (13, 2)]
    pasted = edits.paste_fragment(four, View(selected_inputs=(1,)), fragment, 0.5)
    assert [len(track.clips) for track in pasted.design.inputs] == [2, 1, 2, 1]
