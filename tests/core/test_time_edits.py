"""Edits of the time of a design: inserted and removed, its markers, loop and gain curves."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource.design import edits
from skinsource.design.clips import Marker
from tests.core.clips_bench import DESIGN, RATE_HZ, VIEW, times, total


@settings(max_examples=60, deadline=None, derandomize=True)
@given(times, st.integers(1, 500).map(lambda k: k / 1000))
def test_time_that_was_inserted_and_removed_again_changes_no_sound(at_s, length_s):
    there = edits.insert_time(DESIGN, VIEW, at_s, length_s).design
    at, by = round(at_s * RATE_HZ, 6), round(length_s * RATE_HZ)
    for place in range(4):
        before, after = total(DESIGN, place), total(there, place)
        first = int(np.ceil(at - 1e-6))
        np.testing.assert_allclose(after[:first], before[:first], rtol=0, atol=1e-9)
        gap = slice(first, int(np.ceil(at + length_s * RATE_HZ - 1e-6)))
        assert np.abs(after[gap]).max(initial=0.0) == 0.0
        if abs(by - length_s * RATE_HZ) < 1e-9:
            later = after[first + by :]
            np.testing.assert_allclose(later, before[first : 5000 - by], rtol=0, atol=1e-9)
    back = edits.remove_time(there, VIEW, at_s, at_s + length_s).design
    for place in range(4):
        np.testing.assert_allclose(total(back, place), total(DESIGN, place), rtol=0, atol=1e-9)
    assert [marker.time_s for marker in back.markers] == pytest.approx([0.05, 0.4, 0.9])
    assert back.loop_s == pytest.approx(DESIGN.loop_s)


def test_time_that_is_removed_takes_what_plays_then():
    design = edits.remove_time(DESIGN, VIEW, 0.2, 0.4).design
    for place in range(4):
        before, after = total(DESIGN, place), total(design, place)
        np.testing.assert_allclose(after[:260], before[:260], rtol=0, atol=1e-9)
        np.testing.assert_allclose(after[260:4000], before[520:4260], rtol=0, atol=1e-9)
    assert design.markers == (
        Marker(time_s=0.05, name="first"),
        Marker(time_s=0.2),
        Marker(time_s=0.7),
    )
    assert design.loop_s == (0.1, pytest.approx(0.4))
    assert design.inputs[1].gain_curve == (
        (0.0, 1.0),
        (0.2, pytest.approx(0.8)),
        (0.2, pytest.approx(0.6)),
        (0.8, 0.0),
    )


def test_a_loop_within_time_that_goes_is_gone():
    assert edits.remove_time(DESIGN, VIEW, 0.05, 0.7).design.loop_s is None


def test_markers_are_set_moved_named_and_taken_away():
    added = edits.add_marker(DESIGN, VIEW, 0.7, "end")
    assert added.design.markers == (*DESIGN.markers, Marker(time_s=0.7, name="end"))
    moved = edits.move_marker(added.design, VIEW, 3, 0.8).design
    named = edits.rename_marker(moved, VIEW, 3, "very end").design
    assert named.markers[3] == Marker(time_s=0.8, name="very end")
    assert edits.remove_marker(named, VIEW, 3).design == DESIGN


def test_loop_and_gain_curve_are_set_and_taken_away():
    looped = edits.set_loop(DESIGN, VIEW, (0.0, 1.0))
    assert looped.design.loop_s == (0.0, 1.0)
    assert edits.set_loop(looped.design, VIEW, None).design.loop_s is None
    curved = edits.set_gain_curve(DESIGN, VIEW, 1, ((0.0, 1.0), (2.0, 0.5)))
    assert curved.design.inputs[0].gain_curve == ((0.0, 1.0), (2.0, 0.5))
    assert curved.label == "Change gain curve of input at 7 (II pad)"
