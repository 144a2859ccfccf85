"""Snapshots side by side: alike in level, and how they differ."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skinsource as ss
from skinsource import Design, View, edits, track
from skinsource.base.decibels import FLOOR_DB
from skinsource.base.errors import InvalidInputError
from skinsource.design import comparing
from skinsource.design.design import EDITED, Snapshot, louder, shown_snapshot
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.edits.view import change_texts
from skinsource.design.waveforms import Noise, Tone

DESIGN = Design(
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(), amplitude=0.7),
        track(location=12, waveform=Noise(), onset_s=0.05, amplitude=-0.2),
    ),
)
OTHER = DESIGN.with_input(0, amplitude=0.123).with_input(1, location=3)
THIRD = DESIGN.with_input(0, location=9)
MATCHED = View(levels_matched=True)
levels = st.lists(st.floats(-200.0, 60.0), min_size=3, max_size=3).map(np.array)


def apply(design, view, outcome):
    assert isinstance(outcome, Edit), outcome
    return outcome.design, outcome.view


def store(design, view, number):
    return apply(design, view, edits.store_snapshot(design, view, number))


def toggle(design, view):
    other = comparing.other_snapshot(view.snapshots, design)
    return apply(design, view, edits.show_snapshot(design, view, other.number))


@pytest.mark.parametrize("scaling", ["upstream", "relative", "probe"])
def test_a_louder_design_is_so_much_louder_everywhere(scaling):
    design = replace(DESIGN, scaling=scaling)
    before = ss.evaluate(design, "output_levels_db")["output_levels_db"]
    after = ss.evaluate(louder(design, 0.5), "output_levels_db")["output_levels_db"]
    np.testing.assert_allclose(after, before + 20 * np.log10(0.5), rtol=0, atol=1e-9)


def test_a_gain_of_one_changes_nothing_and_too_large_ones_are_refused():
    assert louder(DESIGN, 1.0) is DESIGN
    assert comparing.matching_gain(-12.3, -12.3) == 1.0
    assert (
        comparing.matching_gain(FLOOR_DB, -12.3) == comparing.matching_gain(-12.3, FLOOR_DB) == 1.0
    )
    assert comparing.matching_gain(-20.0, 0.0) == pytest.approx(10.0, rel=1e-15)
    assert comparing.loudest_db([-3.0, -20.0]) == -3.0
    texts = [comparing.gain_text(gain) for gain in (10.0, 0.5, 1.004, 0.0)]
    assert texts == ["+20.0 dB", "\N{MINUS SIGN}6.0 dB", "", ""]
    with pytest.raises(InvalidInputError):
        louder(DESIGN, 1e6)
    with pytest.raises(InvalidInputError):
        comparing.loudest_db([])


def test_what_lies_far_below_the_loudest_makes_no_difference():
    mine = np.array([0.0, -30.0, -100.0, FLOOR_DB, np.nan])
    theirs = np.array([-6.0, -20.0, -70.0, -50.0, np.nan])
    expected = [6.0, -10.0, 0.0, -10.0, np.nan]
    np.testing.assert_array_equal(comparing.difference_db(mine, theirs), expected)


def test_a_snapshot_takes_the_place_of_the_one_with_its_number_and_stands_last():
    view = View()
    for design, number in ((DESIGN, 1), (OTHER, 2), (THIRD, 1)):
        stored, view = store(design, view, number)
        assert stored is design
    assert [(snapshot.number, snapshot.design) for snapshot in view.snapshots] == [
        (2, OTHER),
        (1, THIRD),
    ]


def test_a_new_title_is_that_of_the_shown_snapshot_too_and_of_those_that_have_no_other():
    design, view = DESIGN, View()
    for number, stored in enumerate((replace(THIRD, title="Own"), OTHER, DESIGN), 1):
        design, view = store(stored, view, number)
    for title in ("Sof", "Soft"):
        design, view = apply(design, view, change_texts(design, view, title=title))
        assert shown_snapshot(view.snapshots, design).number == 3
    design, view = apply(
        design, view, change_texts(replace(design, limb="synthetic-2"), view, title="b")
    )
    assert [each.design.title for each in view.snapshots] == ["Own", "Soft", "Soft"]


@pytest.mark.parametrize("edit", ["store_snapshot", "show_snapshot", "forget_snapshot"])
def test_other_numbers_are_refused(edit):
    for number in (0, 5, -1, None, "1"):
        assert isinstance(getattr(edits, edit)(DESIGN, View(), number), Refusal)


def test_one_key_goes_to_and_fro_between_equal_ones_too_where_there_are_no_others():
    assert comparing.other_snapshot((), DESIGN) is None
    _, view = store(DESIGN, View(), 1)
    assert comparing.other_snapshot(view.snapshots, DESIGN) is None
    assert "is snapshot 1, and nothing else" in comparing.why_no_comparison(view.snapshots)
    _, view = store(DESIGN, view, 2)
    design, numbers = DESIGN, []
    for _ in range(4):
        numbers.append(comparing.other_snapshot(view.snapshots, design).number)
        design, view = toggle(design, view)
    assert numbers == [1, 2, 1, 2]
    # Where another one differs, it comes first.
    _, view = store(OTHER, view, 3)
    assert comparing.other_snapshot(view.snapshots, DESIGN).number == 3


def test_from_an_edited_design_the_way_leads_to_what_was_stored_and_back():
    _, view = store(DESIGN, View(), 1)
    _, view = toggle(OTHER, view)
    design, view = toggle(THIRD, view)
    assert design == DESIGN
    assert toggle(design, view)[0] == THIRD
    refused = edits.show_snapshot(OTHER, view, EDITED)
    assert isinstance(refused, Refusal)
    assert "store it first" in refused.sentence


def test_with_levels_matched_the_way_back_leads_to_the_same_numbers():
    _, view = store(DESIGN, MATCHED, 1)
    _, view = store(OTHER, view, 2)
    there = edits.show_snapshot(OTHER, view, 1, 1.0)
    back = edits.show_snapshot(there.design, there.view, 2, 1 / 3)
    assert back.design is OTHER
    assert back.view.match_gain(back.design) == 1 / 3
    assert there.view.match_gain(there.design) == 1.0
    assert isinstance(edits.show_snapshot(DESIGN, view, 2, 1e7), Refusal)


def test_only_the_snapshot_that_is_shown_has_its_gain_and_what_is_edited_has_none():
    _, view = store(OTHER, MATCHED, 1)
    _, view = store(DESIGN, view, 2)
    view = edits.show_snapshot(DESIGN, view, 2, 0.5).view
    assert view.match_gain(DESIGN) == 0.5
    assert view.match_gain(THIRD) == 1.0
    assert replace(view, levels_matched=False).match_gain(DESIGN) == 1.0
    assert edits.match_levels(DESIGN, replace(view, levels_matched=False), on=True).view == view
    # Under another number too it stays as loud as it is.
    assert store(DESIGN, view, 3)[1].match_gain(DESIGN) == 0.5


def test_to_keep_a_gain_is_an_edit_of_all_amplitudes():
    _, view = store(OTHER, MATCHED, 1)
    view = edits.show_snapshot(OTHER, view, 1, 0.5).view
    outcome = edits.keep_match_gain(OTHER, view)
    assert outcome.label == "Apply \N{MINUS SIGN}6.0 dB"
    assert outcome.design == louder(OTHER, 0.5)
    assert outcome.view.match_gain(outcome.design) == 1.0
    assert isinstance(edits.keep_match_gain(outcome.design, outcome.view), Refusal)


def test_designs_are_alike_where_amplitudes_differ_by_rounding_alone():
    assert comparing.same_but_rounding(louder(OTHER, 1 + 1e-12), OTHER)
    assert not comparing.same_but_rounding(louder(OTHER, 1.001), OTHER)
    assert not comparing.same_but_rounding(replace(OTHER, inputs=OTHER.inputs[:1]), OTHER)
    assert not comparing.same_but_rounding(DESIGN, OTHER)


def test_a_number_is_taken_once():
    twice = (Snapshot(number=1, design=DESIGN), Snapshot(number=1, design=OTHER))
    with pytest.raises(InvalidInputError, match="different ones"):
        View(snapshots=twice)
    with pytest.raises(InvalidInputError):
        View(snapshots=(DESIGN,))


actions = st.lists(st.sampled_from(["edit", "toggle", 1, 2, 3]), max_size=20)


@given(actions=actions)
def test_whatever_is_done_two_turns_of_the_key_lead_back(actions):
    design, view, amplitude = DESIGN, View(), 1.0
    for what in actions:
        if what == "edit":
            amplitude += 1.0
            design = design.with_input(0, amplitude=amplitude)
        elif what == "toggle" and comparing.other_snapshot(view.snapshots, design):
            before, differs = design, any(snapshot.played != design for snapshot in view.snapshots)
            design, view = toggle(design, view)
            assert (design != before) == differs
            assert toggle(design, view)[0] == before
        elif what != "toggle":
            design, view = store(design, view, what)


OLD, NEW = (Snapshot(number=1, design=design) for design in (DESIGN, OTHER))
LATER, ANEW = Snapshot(number=2, design=DESIGN), Snapshot(number=1, design=DESIGN, gain=2.0)


@pytest.mark.parametrize(
    ("before", "after", "present", "expected"),
    [
        ((OLD,), (NEW,), (NEW, LATER), (OLD, LATER)),
        ((), (OLD,), (OLD, LATER), (LATER,)),
        ((OLD,), (), (LATER,), (OLD, LATER)),
        ((OLD,), (), (ANEW, LATER), (ANEW, LATER)),  # stored where it was free
        ((LATER, OLD), (OLD, LATER), (OLD, LATER), (LATER, OLD)),
        ((), (), (LATER,), (LATER,)),
    ],
)
def test_a_change_of_snapshots_is_taken_back_and_what_was_stored_since_stays(
    before, after, present, expected
):
    assert comparing.restored_snapshots(before, after, present) == expected


def test_the_frequency_of_a_design_is_that_of_the_clips_that_play():
    low = track(7, Tone(frequency_hz=50.0))
    muted_clip = replace(low, clips=(replace(low.clips[0], muted=True),))
    muted = muted_clip, replace(low, muted=True)
    design = Design(limb="synthetic-1", inputs=(*muted, track(8, Tone(frequency_hz=100.0))))
    assert comparing.frequency_of(design) == 100.0
