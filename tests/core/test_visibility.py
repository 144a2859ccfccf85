"""Which outputs an outline vertex sees, and what its value is made of."""

import numpy as np
import pytest

from skinsource.limbs.surface import surface

SQUARE = np.array([[0, 0], [100, 0], [100, 100], [0, 100]], dtype=float)
# Two prongs, 20 wide and 40 apart, on a base 20 high.
FORK = np.array(
    [[0, 0], [80, 0], [80, 100], [60, 100], [60, 20], [20, 20], [20, 100], [0, 100]], dtype=float
)


def test_the_rule_gives_the_published_pairs_at_every_vertex(measured):
    from skinsource.limbs.dataset.store import load_measured_limb

    map_ = load_measured_limb(1).map
    unit = surface.raster_unit(map_.outline, map_.hand_length_px)
    ours = surface.boundary_by_sight(map_.outline, map_.output_positions, unit)
    published = surface.boundary_from_table(map_.visibility, map_.outline, map_.output_positions)
    assert unit == 1.0
    assert len(map_.outline) == 1505
    np.testing.assert_array_equal(ours.weights > 0, published.weights > 0)
    np.testing.assert_allclose(ours.weights, published.weights, atol=1e-13)
    assert len(ours.blind) == len(ours.single) == 0


def test_in_a_convex_outline_everything_is_seen_both_ways():
    random = np.random.default_rng(0)
    starts, ends = random.uniform(0, 100, (2, 300, 2))
    region = surface.sight_region(SQUARE, 1.0)
    assert surface.sees(region, starts, ends).all()
    assert surface.sees(region, ends, starts).all()


def test_across_the_gap_of_a_fork_nothing_is_seen():
    region = surface.sight_region(FORK, 1.0)
    starts = np.array([[0, 100], [0, 100], [0, 100], [20, 100.0]])
    ends = np.array([[70, 90], [10, 50], [10.5, 10.5], [61, 100]])
    np.testing.assert_array_equal(surface.sees(region, starts, ends), [False, True, True, False])


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e4])
def test_sight_does_not_depend_on_the_unit_of_length(scale):
    random = np.random.default_rng(3)
    starts, ends = random.uniform(0, 80, (2, 400, 2))
    expected = surface.sees(surface.sight_region(FORK, 1.0), starts, ends)
    region = surface.sight_region(FORK * scale, 1.0 * scale)
    assert 0.05 < expected.mean() < 0.95
    np.testing.assert_array_equal(surface.sees(region, starts * scale, ends * scale), expected)


def test_sight_agrees_with_closely_spaced_samples_of_the_line():
    random = np.random.default_rng(4)
    region = surface.sight_region(FORK, 1.0)
    starts, ends = random.uniform(-2, 102, (2, 500, 2))
    share = np.linspace(0, 1, 2001)[:, None, None]
    line = region.raster_coordinates((starts + share * (ends - starts)).reshape(-1, 2))
    # Within the traced border, the raster's own linear interpolation is at least one half of
    # full; outside by a raster unit or more it is nothing.
    cell = np.floor(line).astype(int)
    aside = line - cell
    level = np.zeros(len(line))
    rows, columns = region.filled.shape
    for right in (0, 1):
        for up in (0, 1):
            column = np.clip(cell[:, 0] + right, 0, columns - 1)
            row = np.clip(cell[:, 1] + up, 0, rows - 1)
            part = np.abs(1 - right - aside[:, 0]) * np.abs(1 - up - aside[:, 1])
            level += region.filled[row, column] * part
    level = level.reshape(2001, 500).min(axis=0)
    visible = surface.sees(region, starts, ends)
    assert 0.1 < visible.mean() < 0.9
    assert level[visible].min() >= 0.5
    assert level[~visible].max() < 1.0


def test_the_nearest_two_come_in_order_and_equals_by_number():
    outputs = np.array([[90.0, 50.0], [50.0, 90.0], [50.0, 10.0]])
    index, distance = surface.nearest_visible(
        surface.sight_region(SQUARE, 1.0), np.array([[100.0, 100.0], [0.0, 50.0]]), outputs
    )
    np.testing.assert_array_equal(index, [[0, 1], [1, 2]])
    np.testing.assert_allclose(distance[0], np.hypot(10, 50))


def test_a_vertex_takes_both_neighbours_weighted_by_the_other_one_s_distance():
    outputs = np.array([[30.0, 0.0], [np.nan, np.nan], [0.0, 10.0]])
    boundary = surface.boundary_by_sight(SQUARE, outputs, 1.0)
    np.testing.assert_allclose(boundary.weights[0], [0.25, 0.0, 0.75])
    assert len(boundary.blind) == len(boundary.single) == 0


def test_a_vertex_that_sees_one_output_takes_its_value():
    outputs = np.array([[10.0, 90.0], [70.0, 90.0]])
    boundary = surface.boundary_by_sight(FORK, outputs, 1.0)
    tip_left, tip_right = 7, 2
    np.testing.assert_array_equal(boundary.weights[tip_left], [1.0, 0.0])
    np.testing.assert_array_equal(boundary.weights[tip_right], [0.0, 1.0])
    assert {tip_left, tip_right} <= set(boundary.single.tolist())
    np.testing.assert_allclose(boundary.weights.sum(axis=1), 1.0, atol=1e-15)


def test_vertices_that_see_none_lie_between_their_neighbours_along_the_outline():
    outputs = np.array([[10.0, 30.0], [10.0, 60.0]])
    outline = surface.densified(FORK, 10.0)
    boundary = surface.boundary_by_sight(outline, outputs, 1.0)
    (tip,) = np.flatnonzero((outline == (60, 100)).all(axis=1))
    assert tip in boundary.blind
    before, after = (boundary.weights[boundary.blind[k] + step] for k, step in ((0, -1), (-1, 1)))
    low, high = np.minimum(before, after), np.maximum(before, after)
    of_blind = boundary.weights[boundary.blind]
    assert ((of_blind >= low - 1e-12) & (of_blind <= high + 1e-12)).all()
    np.testing.assert_allclose(boundary.weights.sum(axis=1), 1.0, atol=1e-15)


def test_where_all_outputs_lie_outside_the_straight_distance_has_to_do():
    outputs = np.array([[300.0, 0.0], [400.0, 0.0], [900.0, 900.0]])
    boundary = surface.boundary_by_sight(SQUARE, outputs, 1.0)
    assert len(boundary.blind) == 4
    np.testing.assert_allclose(boundary.weights[1], [0.6, 0.4, 0.0])


def test_a_given_table_is_followed_and_its_blind_vertices_lie_between_others():
    outputs = np.array([[10.0, 10.0], [90.0, 90.0], [np.nan, np.nan]])
    table = np.full((4, 3), np.nan)
    table[0, :2] = 3.0, 1.0
    table[1, 1] = 5.0
    table[2, 2] = 1.0  # an output without a place
    boundary = surface.boundary_from_table(table, SQUARE, outputs)
    np.testing.assert_allclose(boundary.weights[0], [0.25, 0.75, 0])
    np.testing.assert_array_equal(boundary.weights[1], [0, 1, 0])
    np.testing.assert_array_equal(boundary.single, [1])
    np.testing.assert_array_equal(boundary.blind, [2, 3])
    np.testing.assert_allclose(boundary.weights[2:, 0], [0.25 / 3, 0.5 / 3])
