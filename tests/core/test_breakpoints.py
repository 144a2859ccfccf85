"""Curves through breakpoints, and what is done to their points."""

import copy
import itertools

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from skinsource.base.errors import InvalidInputError
from skinsource.design.effects.breakpoints import (
    curve_at,
    index_for,
    moved,
    scaled,
    with_point,
    with_segment,
    without,
)
from skinsource.design.effects.level import POINTS, Envelope
from skinsource.specs.breakpoints import SEGMENTS, SlopedPoint, slope_of
from skinsource.specs.spec import Address

LEVELS = st.floats(0.0, 5.0).map(lambda value: round(value, 6))
KINDS = st.sampled_from(SEGMENTS)
GRID = np.linspace(-0.1, 1.3, 1401)


@st.composite
def drawn(draw, kinds=KINDS, gap_s=0.0):
    times = sorted(draw(st.lists(st.integers(0, 1000), min_size=1, max_size=8)))
    times = [time / 1000 for time in times]
    assume(all(b - a >= gap_s for a, b in itertools.pairwise(times)))
    return tuple((time, draw(LEVELS), draw(kinds)) for time in times)


@given(drawn())
def test_a_curve_stays_within_the_levels_that_were_drawn(points):
    levels = [level for _, level, _ in points]
    values = curve_at(points, GRID)
    assert np.isfinite(values).all()
    assert min(levels) <= values.min()
    assert values.max() <= max(levels)
    # And so between each two of them.
    for (x0, y0, _), (x1, y1, _) in itertools.pairwise(points):
        part = values[(x0 <= GRID) & (x1 > GRID)]
        assert ((part >= min(y0, y1)) & (part <= max(y0, y1))).all()


@given(drawn(gap_s=0.001))
def test_a_curve_goes_through_its_points(points):
    times = np.array([time for time, _, _ in points])
    assert curve_at(points, times) == pytest.approx([level for _, level, _ in points], abs=1e-12)
    ends = curve_at(points, np.array([-5.0, 99.0]))
    assert ends.tolist() == [points[0][1], points[-1][1]]


@given(drawn(st.just("smooth"), gap_s=0.001))
def test_a_smooth_curve_is_the_monotone_cubic(points):
    assume(len(points) > 1)
    times, levels = (np.array([point[k] for point in points]) for k in (0, 1))
    inside = GRID[(times[0] <= GRID) & (times[-1] >= GRID)]
    expected = PchipInterpolator(times, levels)(inside)
    assert curve_at(points, inside) == pytest.approx(expected, abs=1e-9)


def test_segments_are_straight_smooth_or_held():
    points = ((0.0, 0.0, "straight"), (1.0, 2.0, "held"), (2.0, 4.0, "smooth"), (3.0, 0.0))
    points = Envelope(points).points
    values = curve_at(points, np.array([0.25, 1.0, 1.99, 2.0, 2.5, 3.0, 4.0]))
    assert values == pytest.approx([0.5, 2.0, 2.0, 4.0, 2.0, 0.0, 0.0])
    assert curve_at(((0.3, 2.0, "smooth"),), GRID).tolist() == [2.0] * GRID.size


@pytest.mark.parametrize("kind", SEGMENTS)
@pytest.mark.parametrize("gap_s", [0.0, 1e-12, 5e-10])
def test_two_points_at_one_time_are_a_jump(kind, gap_s):
    points = ((0.0, 1.0, kind), (0.5, 1.0, kind), (0.5 + gap_s, 3.0, kind), (1.0, 3.0, kind))
    values = curve_at(points, np.array([0.2, 0.499999, 0.5 + 2 * gap_s, 0.7]))
    assert values == pytest.approx([1.0, 1.0, 3.0, 3.0])
    # Of more than two, what lies between does not count.
    more = (*points[:2], (0.5, 9.0, kind), (0.5, 0.0, kind), *points[2:])
    assert np.array_equal(curve_at(more, GRID + 1e-6), curve_at(points, GRID + 1e-6))


@pytest.mark.parametrize("slope", [("2",), (float("inf"),), (2.0, 0.0)])
def test_a_slope_that_is_none_is_refused_alone_and_among_good_ones(slope):
    good, bad = (0.0, 0.5, "smooth"), (0.0, 1.0, "held", *slope)
    for points in ((bad,), (good, bad)):
        assert POINTS.checked((good,)) == (good,)
        with pytest.raises(InvalidInputError, match=r"Envelope\.points .* expected 1 to 10000 poi"):
            Envelope(points)


def test_points_of_the_right_form_stay_the_very_same():
    points = tuple((k / 200, 0.5, "straight") for k in range(150))
    assert POINTS.checked(points) is points
    checked = POINTS.checked(((np.float64(0.25), 0, "held"), points[100]))
    assert [type(value) for value in checked[0]] == [float, float, str]
    assert checked[1] is points[100]


@given(drawn(gap_s=0.001), st.lists(st.floats(0.0, 1.2), min_size=1, max_size=4))
def test_points_are_added_without_changing_the_curve(points, times_s):
    after = points
    for time_s in times_s:
        place = index_for(after, time_s)
        after = with_point(after, time_s)
        assert after[place][0] == time_s
    assert len(after) == len(points) + len(times_s)
    assert curve_at(after, GRID) == pytest.approx(curve_at(points, GRID), abs=1e-9)
    assert Envelope(after).points == after


def test_a_point_on_a_smooth_curve_keeps_the_slopes_around_it_and_no_others():
    times = [0.0, 0.1, 0.3, 0.4, 0.6, 0.7, 0.9]
    levels = [0.0, 0.5, 0.7, 0.6, 0.8, 2.0, 2.5]
    points = tuple((time, level, "smooth") for time, level in zip(times, levels, strict=True))
    slope = PchipInterpolator(times, levels).derivative()
    after = with_point(points, 0.65)
    own = {point[0]: slope_of(point) for point in after if slope_of(point) is not None}
    assert own == pytest.approx({time: float(slope(time)) for time in (0.6, 0.65, 0.7)})
    # What was added can be taken out again.
    assert curve_at(without(after, {5}), GRID) == pytest.approx(curve_at(points, GRID), abs=1e-12)


def test_a_slope_of_its_own_is_kept_by_files_copies_and_equality():
    plain, sloped = (0.5, 1.0, "smooth"), SlopedPoint(0.5, 1.0, "smooth", 2.0)
    time_s, level, segment = sloped
    assert (time_s, level, segment) == plain
    assert sloped != plain
    assert plain != sloped
    assert sloped != SlopedPoint(0.5, 1.0, "smooth", 1.0)
    assert hash(sloped) != hash(plain)
    assert copy.deepcopy(sloped) == sloped
    assert repr(sloped) == "(0.5, 1.0, 'smooth', 2.0)"
    with pytest.raises(AttributeError, match="make another one"):
        sloped.slope = 3.0
    both = ((0.0, 0.0, "smooth"), sloped, (1.0, 3.0, "straight"))
    assert Envelope(((0, 0, "smooth"), [0.5, 1, "smooth", 2], (1, 3))).points == both
    assert Envelope(((0.5, 1.0, "smooth", None),)).points == (plain,)
    written = POINTS.encoded(both)
    assert written == [[0.0, 0.0, "smooth"], [0.5, 1.0, "smooth", 2.0], [1.0, 3.0, "straight"]]
    assert Envelope(POINTS.decoded(written, Address())).points == both


def test_a_slope_of_its_own_is_that_of_the_curve():
    points = Envelope(((0.0, 0.0, "smooth"), (0.5, 1.0, "smooth", 1.5), (1.0, 2.0))).points
    beside = curve_at(points, np.array([0.5 - 1e-6, 0.5, 0.5 + 1e-6]))
    assert np.diff(beside) / 1e-6 == pytest.approx([1.5, 1.5], rel=1e-4)


def test_beside_a_step_of_next_to_nothing_the_curve_is_level():
    points = ((0.0, 5e-324, "smooth"), (0.001, 0.0, "smooth"), (0.052, -5e-324, "smooth"))
    assert np.abs(curve_at(points, np.linspace(0.0, 0.052, 9))).max() <= 5e-324


@given(
    drawn(st.just("smooth"), gap_s=0.05),
    st.floats(0.0, 1.0),
    st.floats(-0.3, 0.3),
    st.floats(-2, 2),
)
def test_a_split_curve_that_is_moved_rises_or_falls_throughout_between_its_points(
    points, time_s, by_s, by_value
):
    added, place = with_point(points, time_s), index_for(points, time_s)
    assert moved(added, {place}, 0.0, 0.0) == added
    after = moved(added, {place}, by_s, by_value)
    assert [slope_of(effect) is None for effect in after] == [
        slope_of(effect) is None for effect in added
    ]
    for (x0, y0, _), (x1, y1, _) in itertools.pairwise(after):
        course = np.diff(curve_at(after, np.linspace(x0, np.nextafter(x1, x0), 60)))
        steps = course * np.sign(y1 - y0)
        assert (steps >= -1e-9).all()
        # Not cut off at the level of an end.
        if abs(y1 - y0) > 0.01 and x1 - x0 > 0.01:
            assert (np.abs(course) > 0.0).sum() >= 57


def test_a_slope_that_was_kept_gives_way_where_the_curve_would_turn_back():
    points = Envelope(((0.0, 0.0, "smooth", 0.0), (0.5, 1.0, "smooth", 4.0), (1.0, 2.0))).points
    # As steep as before as long as the rise allows it; then three times the rise; then level.
    for by_value, slope in ((0.2, 4.0), (-0.6, 2.4), (-1.0, 0.0), (1.5, 0.0)):
        assert slope_of(moved(points, {1}, 0.0, by_value)[1]) == pytest.approx(slope)
    # So it does where a point beside it moves, or is taken out.
    assert slope_of(moved(points, {2}, 0.0, -0.8)[1]) == pytest.approx(1.2)
    steep = (points[0], (0.2, 0.1, "smooth"), (0.5, 0.2, "smooth"), *points[1:])
    steep = (*steep[:2], SlopedPoint(0.4, 0.9, "smooth", 5.0), (0.5, 1.6, "smooth"), (0.9, 1.7))
    assert slope_of(without(Envelope(steep).points, {3})[2]) == pytest.approx(3 * 0.8 / 0.5)


def test_points_and_their_slopes_are_scaled_about_a_place():
    points = ((0.0, 0.0, "smooth"), (0.4, 1.0, "smooth"), (1.0, 3.0, "straight"))
    added = with_point(points, 0.2)
    after = scaled(added, {0, 1, 2, 3}, (0.0, 0.0), 0.5, 2.0)
    assert curve_at(after, GRID / 2) == pytest.approx(2 * curve_at(points, GRID), abs=1e-9)
    held = ((0.0, 1.0, "straight"), (0.2, 2.0, "held"), (0.4, 0.5, "smooth"))
    after = scaled(held, {0, 1, 2}, (0.0, 1.0), 2.0, 0.5)
    assert [point[:2] for point in after] == [(0.0, 1.0), (0.4, 1.5), (0.8, 0.75)]


@given(drawn(), st.sets(st.integers(-1, 9)), st.floats(-2, 2), st.floats(-9, 9))
def test_moved_points_stay_in_order_and_within_what_is_allowed(points, indices, by_s, by_value):
    after = moved(points, indices, by_s, by_value)
    assert Envelope(after).points == after
    chosen = [k for k in indices if 0 <= k < len(points)]
    for k in range(len(points)):
        if k not in chosen:
            assert after[k] == points[k]
    steps = {round(after[k][0] - points[k][0], 9) for k in chosen}
    assert len(steps) <= 1
    assert all(abs(step) <= abs(by_s) + 1e-9 for step in steps)


def test_a_moved_point_stops_at_its_neighbours():
    points = ((0.0, 1.0, "straight"), (0.5, 1.0, "held"), (1.0, 1.0, "smooth"))
    assert moved(points, {1}, 0.2, 0.5)[1] == (pytest.approx(0.7), 1.5, "held")
    assert moved(points, {1}, 9.0, -3.0)[1] == (1.0, 0.0, "held")
    assert moved(points, {1}, -9.0, 0.0)[1] == (0.0, 1.0, "held")
    assert [x for x, _, _ in moved(points, {1, 2}, 3.0, 0.0)] == [0.0, 3.5, 4.0]
    assert moved(points, {0, 1, 2}, -3.0, 0.0) == points


@given(drawn(), st.sets(st.integers(0, 9)), st.floats(-1, 3), st.floats(-1, 3))
def test_scaled_points_stay_in_order(points, indices, factor_t, factor_v):
    after = scaled(points, indices, (0.3, 1.0), factor_t, factor_v)
    assert Envelope(after).points == after
    assert all(after[k] == points[k] for k in range(len(points)) if k not in indices)
    assert [point[2] for point in after] == [point[2] for point in points]


def test_points_are_taken_out_but_for_one_and_go_on_otherwise():
    points = ((0.0, 1.0, "straight"), (0.2, 2.0, "held"))
    assert without(points, {0}) == points[1:]
    assert without(points, {0, 1}) == points[:1]
    assert without(points, {7}) == points
    assert with_segment(points, 1, "smooth") == (points[0], (0.2, 2.0, "smooth"))
    with pytest.raises(InvalidInputError, match="choose from straight, smooth, held"):
        with_segment(points, 1, "wavy")
