"""What an edit of clips makes the engine do, and above all what it leaves out."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.quantities import new_graph, sources

RATE_HZ = 1300.0
#: Onsets on samples and between them.
TONES = tuple(
    Clip(waveform=Tone(frequency_hz=60.0 + 31 * k, duration_s=0.06), onset_s=0.0503 + 0.05 * k)
    for k in range(9)
)
CLIPS = (*TONES, Clip(waveform=Noise(seed=3), onset_s=0.1))
DESIGN = Design(
    limb="synthetic-1",
    inputs=(Input(location=7, clips=CLIPS), track(3, Tap(), onset_s=1.0)),
    scaling="probe",
)
WANTED = ("output_rms", "clip_waveforms", "input_waveforms")


@pytest.fixture
def show():
    graph = new_graph()

    def show(design=DESIGN, quantities=WANTED):
        return graph.evaluate(quantities, sources(design, View())), graph.work

    show()
    return show


def drawn_and_transformed(work) -> tuple[int, int, int]:
    return work.samples_drawn, work.forward_transforms, work.inverse_transforms


@pytest.mark.parametrize("id", [1, 4, 10])
def test_a_clip_moved_by_whole_samples_draws_nothing_and_takes_one_transform(show, id):
    for k in (1, 7, 40):
        onset_s = DESIGN.clip(id).onset_s + k / RATE_HZ
        _, work = show(DESIGN.with_clip(id, onset_s=onset_s))
        assert drawn_and_transformed(work) == (0, 1, 0)


def test_another_gain_draws_nothing_and_takes_one_transform(show):
    _, work = show(DESIGN.with_clip(4, gain=0.3))
    assert drawn_and_transformed(work) == (0, 1, 0)


def test_a_clip_that_changed_is_drawn_and_no_other(show):
    changed = DESIGN.with_clip(2, waveform=Tone(frequency_hz=333.0, duration_s=0.1))
    _, work = show(changed)
    # One more than on samples: the clip begins between two.
    assert drawn_and_transformed(work) == (131, 1, 0)


def test_a_clip_between_samples_is_drawn_where_it_now_begins(show):
    _, work = show(DESIGN.with_clip(2, onset_s=0.1004))
    assert drawn_and_transformed(work) == (79, 1, 0)


def test_a_whole_track_moved_by_whole_samples_draws_and_transforms_nothing(show):
    later = tuple(replace(clip, onset_s=clip.onset_s + 13 / RATE_HZ) for clip in CLIPS)
    ids = tuple(replace(clip, id=k) for k, clip in enumerate(later, start=1))
    _, work = show(DESIGN.with_input(0, clips=ids))
    assert drawn_and_transformed(work) == (0, 0, 0)


def test_a_track_scaled_draws_and_transforms_nothing(show):
    _, work = show(DESIGN.with_input(0, amplitude=0.3))
    assert drawn_and_transformed(work) == (0, 0, 0)


def test_the_order_of_clips_costs_nothing(show):
    turned = DESIGN.inputs[0].clips[::-1]
    _, work = show(DESIGN.with_input(0, clips=turned))
    assert drawn_and_transformed(work) == (0, 0, 0)


def test_a_gain_curve_draws_nothing_and_takes_one_transform(show):
    _, work = show(DESIGN.with_input(0, gain_curve=((0.1, 0.0), (0.3, 1.0))))
    assert drawn_and_transformed(work) == (0, 1, 0)


def test_a_muted_clip_is_neither_drawn_nor_transformed():
    muted = Clip(waveform=Noise(seed=77, duration_s=2.0), onset_s=0.03, muted=True)
    more = DESIGN.with_input(0, clips=(*DESIGN.inputs[0].clips, muted))
    works = []
    for design in (DESIGN, more):
        graph = new_graph()
        values = graph.evaluate({"output_rms", "input_waveforms"}, sources(design, View()))
        works.append((graph.work, values["output_rms"]))
    assert works[0][0] == works[1][0]
    np.testing.assert_array_equal(works[0][1], works[1][1])


def test_muting_and_hearing_a_clip_again_draws_nothing(show):
    muted = DESIGN.with_clip(4, muted=True)
    assert drawn_and_transformed(show(muted)[1]) == (0, 1, 0)
    assert drawn_and_transformed(show(DESIGN)[1]) == (0, 0, 0)


def test_the_same_waveform_is_drawn_once_however_often_it_stands():
    clips = tuple(Clip(waveform=Noise(seed=3), onset_s=k / 130) for k in range(50))
    design = Design(limb="synthetic-1", inputs=(Input(location=7, clips=clips),))
    graph = new_graph()
    graph.evaluate(WANTED, sources(design, View()))
    assert graph.work.samples_drawn == 260


def test_what_clips_play_is_told_for_each_muted_or_not(show):
    muted = DESIGN.with_clip(4, muted=True).with_clip(5, gain=9.0)
    values, _ = show(muted)
    first, second = values["clip_waveforms"]
    assert [len(first), len(second)] == [10, 1]
    # From the sample before its onset on, before its gain.
    own_s = np.arange(first[4].size) / RATE_HZ - (0.2503 - 325 / RATE_HZ)
    assert first[4] == pytest.approx(CLIPS[4].waveform.samples(RATE_HZ, 0.2503 - 325 / RATE_HZ))
    assert own_s[0] < 0
    assert not any(samples.flags.writeable for samples in (*first, *second))


def test_what_a_changed_clip_plays_is_told_anew_and_the_others_are_the_very_same(show):
    before, _ = show()
    after, _ = show(DESIGN.with_clip(3, waveform=Tap()))
    first = after["clip_waveforms"][0]
    assert first[2].size < before["clip_waveforms"][0][2].size
    assert first[2].max() == pytest.approx(1.0, abs=0.02)
    same = [a is b for a, b in zip(first, before["clip_waveforms"][0], strict=True)]
    assert same == [k != 2 for k in range(10)]
