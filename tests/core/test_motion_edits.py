"""Motions in a design: what is refused, and how paths are typed."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource.base.errors import InvalidInputError
from skinsource.design import edits
from skinsource.design.design import MAX_INPUTS, Design, Input
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.motions import (
    MOTIONS,
    Alternation,
    ApparentMotion,
    Phantom,
    Sweep,
    TapSequence,
    TravellingPhase,
    path_of,
    with_path_of,
)
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Tap
from tests.core.motions_bench import PATHS


@pytest.mark.parametrize(
    ("kind", "changes"),
    [
        *(
            (kind, {"path": bad})
            for kind in MOTIONS
            for bad in ((), (3,), (3, 0), [3, 4], (3, "4"))
        ),
        *((kind, {"onset_s": -0.1}) for kind in MOTIONS),
        *((kind, {"amplitude": -1.0}) for kind in MOTIONS),
        *((kind, {"waveform": "Tone"}) for kind in MOTIONS),
        (Phantom, {"path": (3, 3)}),
        (Phantom, {"path": (3, 4, 5)}),
        (Phantom, {"position": 1.01}),
        (TravellingPhase, {"waveform": Tap()}),
        (TravellingPhase, {"speed_m_s": 0.0}),
        (TapSequence, {"taps": 0}),
        (Alternation, {"rounds": 1.5}),
        (Alternation, {"spacing_s": 0.0}),
        (Sweep, {"overlap": 1.5}),
    ],
)
def test_what_no_motion_can_do_is_named(kind, changes):
    with pytest.raises(InvalidInputError, match=rf"^{kind.__name__}\.{next(iter(changes))} is"):
        kind(**changes)


@pytest.mark.parametrize("kind", MOTIONS)
def test_a_motion_is_added_beside_what_is_there_and_selected(kind):
    design = Design(limb="synthetic-1", inputs=(Input(location=7), Input(location=16)))
    outcome = edits.add_motion(design, View(selected_inputs=(1,)), kind())
    assert isinstance(outcome, Edit)
    assert outcome.design.inputs[:2] == design.inputs
    added = outcome.design.inputs[2:]
    assert outcome.view.selected_inputs == tuple(track.id for track in added)
    assert outcome.label == f"Add {kind.title.lower()} at {len(added)} places"
    for track, written in zip(added, kind().tracks(), strict=True):
        assert (track.location, track.amplitude) == (written.location, written.amplitude)
        assert [replace(clip, id=0) for clip in track.clips] == list(written.clips)
    assert len({clip.id for clip in outcome.design.clips}) == len(outcome.design.clips)
    assert len({track.colour for track in added}) == len(added)


def test_a_motion_that_does_not_fit_is_refused():
    full = Design(limb="synthetic-1", inputs=(Input(location=1),) * (MAX_INPUTS - 1))
    outcome = edits.add_motion(full, View(), Phantom())
    assert isinstance(outcome, Refusal)
    assert "Phantom takes 2 inputs more" in outcome.sentence
    assert isinstance(edits.add_motion(full, View(), None), Refusal)
    late = edits.add_motion(Design(limb="synthetic-1"), View(), Alternation(onset_s=600.0))
    assert isinstance(late, Refusal)
    assert "onset_s" in late.sentence


@given(PATHS, st.sampled_from(MOTIONS))
def test_a_motion_can_follow_the_path_of_another(path, kind):
    leader = ApparentMotion(path=path, amplitude=2.5, onset_s=1.5)
    followers = with_path_of(kind(), leader)
    assert type(followers) is kind
    assert (followers.amplitude, followers.onset_s) == (2.5, 1.5)
    moving = tuple(place for k, place in enumerate(path) if k == 0 or place != path[k - 1])
    expected_path = {Phantom: tuple(dict.fromkeys(path))[:2], Sweep: moving}.get(kind, path)
    assert followers.path == (expected_path if len(expected_path) > 1 else kind().path)
    assert with_path_of(leader, followers).path == followers.path


@pytest.mark.parametrize(
    "text", ["16, 18, 20", "16 18 20", "16-18-20", " 16,18 ,20;", "16 → 18 → 20"]
)
def test_a_path_can_be_typed(text):
    assert path_of(text) == (16, 18, 20)


@pytest.mark.parametrize("text", ["16, x", "1.5 2", "99999999 1", "２, 3", "16,, -a"])
def test_what_is_no_path_is_named(text):
    with pytest.raises(InvalidInputError, match="the path has"):
        path_of(text)


def test_an_empty_path_is_one():
    assert path_of(" ,") == ()
