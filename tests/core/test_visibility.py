"""Which outputs an outline vertex sees, and what its value is made of."""

import numpy as np
import pytest

from skinsource.limbs.surface.outline import (
    boundary_by_sight,
    boundary_from_table,
    densified,
    distances_inside,
    nearest_visible,
    raster_unit,
    sees,
    sight_region,
)

SQUARE = np.array([[0, 0], [100, 0], [100, 100], [0, 100]], dtype=float)
# Two prongs, 20 wide and 40 apart, on a base 20 high.
FORK = np.array(
    [[0, 0], [80, 0], [80, 100], [60, 100], [60, 20], [20, 20], [20, 100], [0, 100]], dtype=float
)


def square_with_slit(width):
    left, right = 50 - width / 2, 50 + width / 2
    slit = [[right, 100], [right, 20], [left, 20], [left, 100]]
    return np.array([[0, 0], [100, 0], [100, 100], *slit, [0, 100]], dtype=float)


def test_the_rule_gives_the_published_pairs_at_every_vertex(measured):
    from skinsource.limbs.dataset.store import load_measured_limb

    map_ = load_measured_limb(1).map
    unit = raster_unit(map_.outline, map_.hand_length_px)
    ours = boundary_by_sight(map_.outline, map_.output_positions, unit)
    published = boundary_from_table(map_.visibility, map_.outline, map_.output_positions, unit)
    assert unit == 1.0
    assert len(map_.outline) == 1505
    np.testing.assert_array_equal(ours.weights > 0, published.weights > 0)
    np.testing.assert_allclose(ours.weights, published.weights, atol=1e-13)
    assert len(ours.blind) == len(ours.single) == 0


def test_across_the_gap_of_a_fork_nothing_is_seen():
    region = sight_region(FORK, 1.0)
    starts = np.array([[0, 100], [0, 100], [0, 100], [20, 100.0]])
    ends = np.array([[70, 90], [10, 50], [10.5, 10.5], [61, 100]])
    np.testing.assert_array_equal(sees(region, starts, ends), [False, True, True, False])


@pytest.mark.parametrize(("width", "visible"), [(2, True), (4, True), (8, False), (20, False)])
def test_a_gap_is_seen_through_up_to_twice_the_tolerance(width, visible):
    region = sight_region(square_with_slit(width), 1.0)
    # As high as the slit is long: the raster also fills slits it has closed.
    answer = sees(region, np.array([[10.0, 60.0]]), np.array([[90.0, 61.5]]))
    assert answer[0] == visible


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e4])
def test_sight_does_not_depend_on_the_unit_of_length(scale):
    random = np.random.default_rng(3)
    starts, ends = random.uniform(0, 80, (2, 400, 2))
    expected = sees(sight_region(FORK, 1.0), starts, ends)
    region = sight_region(FORK * scale, 1.0 * scale)
    assert 0.05 < expected.mean() < 0.95
    np.testing.assert_array_equal(sees(region, starts * scale, ends * scale), expected)


def test_sight_agrees_with_closely_spaced_samples_of_the_line():
    random = np.random.default_rng(4)
    region = sight_region(FORK, 1.0)
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
    visible = sees(region, starts, ends)
    assert 0.1 < visible.mean() < 0.9
    assert level[visible].min() >= 0.5
    assert level[~visible].max() < 1.0


def test_outside_the_raster_nothing_is_seen():
    region = sight_region(SQUARE, 1.0)
    starts = np.array([[50.0, 50.0], [-500.0, 50.0]])
    assert not sees(region, starts, np.array([[50.0, 900.0], [-600.0, 50.0]])).any()


def test_the_nearest_two_come_in_order_and_equals_by_number():
    outputs = np.array([[90.0, 50.0], [50.0, 90.0], [50.0, 10.0]])
    index, distance = nearest_visible(
        sight_region(SQUARE, 1.0), np.array([[100.0, 100.0], [0.0, 50.0]]), outputs
    )
    np.testing.assert_array_equal(index, [[0, 1], [1, 2]])
    np.testing.assert_allclose(distance[0], np.hypot(10, 50))


NOWHERE = (np.nan, np.nan)


@pytest.mark.parametrize(
    ("outline", "outputs", "vertex", "weights", "kind"),
    [
        # Both neighbours, each weighted by the distance of the other one.
        (SQUARE, [(30.0, 0.0), NOWHERE, (0.0, 10.0)], 0, [0.25, 0.0, 0.75], ""),
        # An output on the vertex; of two there the one of the lower number.
        (SQUARE, [(100.0, 100.0), (50.0, 50.0)], 2, [1.0, 0.0], ""),
        (SQUARE, [(50.0, 50.0), (100.0, 100.0), (100.0, 100.0)], 2, [0.0, 1.0, 0.0], ""),
        # The only output that is seen, on either prong, and the only one that there is.
        (FORK, [(10.0, 90.0), (70.0, 90.0)], 7, [1.0, 0.0], "single"),
        (FORK, [(10.0, 90.0), (70.0, 90.0)], 2, [0.0, 1.0], "single"),
        (FORK, [NOWHERE, (10.0, 90.0)], 2, [0.0, 1.0], "blind"),
    ],
)
def test_a_vertex_takes_the_values_of_the_outputs_that_it_sees(
    outline, outputs, vertex, weights, kind
):
    boundary = boundary_by_sight(outline, np.array(outputs), 1.0)
    np.testing.assert_allclose(boundary.weights[vertex], weights, atol=1e-15)
    np.testing.assert_allclose(boundary.weights.sum(axis=1), 1.0, atol=1e-15)
    assert (vertex in boundary.single) == (kind == "single")
    assert (vertex in boundary.blind) == (kind == "blind")


def test_a_vertex_that_sees_none_takes_the_two_with_the_shortest_way_inside():
    # Straight across the gap the third is nearest by far; by the way inside it is the farthest.
    outputs = np.array([[10.0, 30.0], [10.0, 60.0], [20.0, 95.0]])
    boundary = boundary_by_sight(FORK, outputs, 1.0)
    tip = 3  # (60, 100)
    assert tip in boundary.blind
    np.testing.assert_array_equal(boundary.weights[tip] > 0, [True, True, False])
    region = sight_region(FORK, 1.0)
    near, far = distances_inside(region, FORK[[tip]], outputs[:2])[0]
    assert boundary.weights[tip, 0] == pytest.approx(far / (near + far))


def test_ways_inside_go_round_corners_and_are_a_few_percent_long_at_most():
    outline = densified(FORK, 4.0)
    region = sight_region(outline, 1.0)
    ways = distances_inside(region, np.array([[70.0, 95.0], [5.0, 5.0]]), np.array([[10.0, 95.0]]))
    corners = np.array([[70, 95], [58, 22], [22, 22], [10, 95.0]])  # cut by the tolerance
    shortest = np.hypot(*np.diff(corners, axis=0).T).sum()
    # The corners are widened by two units, which shortens the way by no more than eight.
    assert shortest - 8 <= ways[0, 0] <= shortest * 1.028 + 2
    straight = np.hypot(5, 90)
    assert straight - 1e-9 <= ways[1, 0] <= straight * 1.028


def test_outputs_outside_are_reached_from_the_nearest_place_inside():
    outputs = np.array([[300.0, 0.0], [400.0, 0.0], [900.0, 900.0]])
    way = distances_inside(sight_region(SQUARE, 1.0), SQUARE[[0]], outputs[:1])
    assert way[0, 0] == pytest.approx(300.0)
    boundary = boundary_by_sight(SQUARE, outputs, 1.0)
    assert len(boundary.blind) == 4
    np.testing.assert_array_equal(boundary.weights[1] > 0, [True, True, False])


def test_where_no_way_leads_the_straight_distance_has_to_do():
    # Two squares joined by a bridge too thin for the raster.
    bridge = [[20, 9.99], [80, 9.99], [80, 0], [100, 0], [100, 20], [80, 20], [80, 10.01]]
    outline = np.array([[0, 0], [20, 0], *bridge, [20, 10.01], [20, 20], [0, 20]]) + 0.3
    outputs = np.array([[10.0, 10.0], [5.0, 10.0]])
    right = 4
    way = distances_inside(sight_region(outline, 1.0), outline[[right]], outputs)
    assert np.isinf(way).all()
    boundary = boundary_by_sight(outline, outputs, 1.0)
    near, far = np.hypot(*(outline[right] - outputs).T)
    assert boundary.weights[right, 0] == pytest.approx(far / (near + far))


def test_a_given_table_is_followed_and_its_blind_vertices_are_led_inside():
    outputs = np.array([[10.0, 10.0], [90.0, 90.0], [np.nan, np.nan]])
    table = np.full((4, 3), np.nan)
    table[0, :2] = 3.0, 1.0
    table[1, 1] = 5.0
    table[2, 2] = 1.0  # an output without a place
    boundary = boundary_from_table(table, SQUARE, outputs, 1.0)
    np.testing.assert_allclose(boundary.weights[0], [0.25, 0.75, 0])
    np.testing.assert_array_equal(boundary.weights[1], [0, 1, 0])
    np.testing.assert_array_equal(boundary.single, [1])
    np.testing.assert_array_equal(boundary.blind, [2, 3])
    assert boundary.weights[2, 1] > 0.8
    assert boundary.weights[3, 0] == pytest.approx(0.5, abs=0.01)


def test_the_raster_stays_small_where_the_hand_length_is_tiny():
    assert raster_unit(SQUARE, 398.1017) == 1.0
    assert raster_unit(SQUARE * 1e6, 1e-6) >= 100e6 / 4100
