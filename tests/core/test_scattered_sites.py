"""Sites on one line, at one place, or nearly so; checked by rational arithmetic."""

from fractions import Fraction

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.limbs.surface.natural_neighbour import scattered_sites, site_line
from skinsource.limbs.surface.operator import (
    check_values_of_shared_places,
    first_at_same_place,
    pairs_at_same_place,
)

SEED = 20240607
RANDOM = np.random.default_rng(SEED).uniform(0, 1000, (40, 2))
#: Whole numbers, so that sites on them are on one line exactly.
DIRECTIONS = ((1, 0), (0, 1), (3, 4), (-7, 2), (1, -1), (1, 1000))


def exact_line_weights(sites, point):
    """Share of each site in the place of its line that is nearest to the point, and how far it is.

    Of all stretches between two sites, the shortest that holds that place.
    """
    exact = [tuple(Fraction(float(c)) for c in site) for site in sites]
    q = tuple(Fraction(float(c)) for c in point)
    nearest = []
    for i, a in enumerate(exact):
        for j, b in enumerate(exact):
            along = tuple(b[k] - a[k] for k in (0, 1))
            length = sum(part * part for part in along)
            part = sum((q[k] - a[k]) * along[k] for k in (0, 1))
            share = min(max(part / length, Fraction(0)), Fraction(1)) if length else Fraction(0)
            away = sum((a[k] + share * along[k] - q[k]) ** 2 for k in (0, 1))
            nearest.append((away, length, i, j, share))
    away, _, i, j, share = min(nearest)
    weights = [Fraction(0)] * len(exact)
    weights[i] += 1 - share
    weights[j] += share
    return [float(weight) for weight in weights], away


def on_a_line(direction, count, random):
    places = random.choice(4000, count, replace=False) - 1500
    return np.outer(places, direction) / 8.0 + np.array([33.0, -57.5])


@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("count", [1, 2, 3, 9])
def test_on_a_line_weights_equal_those_of_rational_arithmetic(direction, count):
    random = np.random.default_rng(SEED + count)
    sites = on_a_line(direction, count, random)
    low, size = sites.min(axis=0), max(np.ptp(sites, axis=0).max(), 16.0)
    around = np.round((low + random.uniform(-0.5, 1.5, (24, 2)) * size) * 8) / 8
    between = random.dirichlet(np.full(count, 0.3), 12) @ sites
    points = np.concatenate([around, between, sites])
    scattered = scattered_sites(sites)
    interpolation = scattered.weights_at(points)
    assert scattered.on_a_line
    assert not interpolation.fallback.any()
    for point, weights, outside in zip(
        points, interpolation.weights.toarray(), interpolation.outside, strict=True
    ):
        expected, away = exact_line_weights(sites, point)
        note = f"{SEED=}, {sites=}, {point=}"
        np.testing.assert_allclose(weights, expected, rtol=0, atol=1e-13, err_msg=note)
        assert outside == (float(away) > (1e-9 * np.ptp(sites, axis=0).max()) ** 2), note


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_at_a_site_of_a_line_the_value_is_its_own(direction):
    sites = on_a_line(direction, 30, np.random.default_rng(SEED))
    interpolation = scattered_sites(sites).weights_at(sites)
    np.testing.assert_array_equal(interpolation.weights.toarray(), np.eye(30))
    assert not interpolation.outside.any()


def test_one_site_counts_everywhere():
    interpolation = scattered_sites(np.array([[3.0, 4.0]])).weights_at(
        np.array([[3.0, 4.0], [0.0, 0.0], [1e9, -1e9]])
    )
    np.testing.assert_array_equal(interpolation.weights.toarray(), np.ones((3, 1)))
    np.testing.assert_array_equal(interpolation.outside, [False, True, True])


def test_between_two_sites_values_run_linearly_and_beyond_them_the_nearer_counts():
    points = np.array([[0.0, 0], [2, 0], [2, 3], [8, 0], [-1, 0], [9, 5]])
    interpolation = scattered_sites(np.array([[8.0, 0], [0, 0]])).weights_at(points)
    np.testing.assert_array_equal(
        interpolation.weights.toarray(),
        [[0, 1], [0.25, 0.75], [0.25, 0.75], [1, 0], [0, 1], [1, 0]],
    )
    np.testing.assert_array_equal(interpolation.outside, [False, False, True, False, True, True])


@pytest.mark.parametrize("gap", [4e-9, 1e-7, 1e-3])
def test_close_neighbours_on_a_line_keep_their_digits(gap):
    sites = np.array([[0.0, 0.0], [300.0, 400.0], [600.0, 800.0]])
    step = np.round(gap * 1e3 * 2**40) / 2**40 * np.array([3.0, 4.0])
    sites = np.concatenate([sites, sites[1:2] + step])
    points = sites[1] + np.linspace(-2, 3, 41)[:, None] * step
    weights = scattered_sites(sites).weights_at(points).weights.toarray()
    expected = [exact_line_weights(sites, point)[0] for point in points]
    # A point is a float: half its last digit is so much of the way between the neighbours.
    np.testing.assert_allclose(weights, expected, rtol=0, atol=1e-13 + 1e-15 / gap)


@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-12, 1e-10, 2.4e-10, 3e-10, 1e-9, 1e-8, 1e-6, 1e-3])
@pytest.mark.parametrize("angle_rad", [0.0, 0.7])
@pytest.mark.parametrize("shift", [0.0, 1e6])
def test_sites_hardly_off_a_line_are_interpolated_soundly(off, angle_rad, shift):
    random = np.random.default_rng(SEED)
    straight = np.column_stack([random.uniform(0, 1000, 40), 500 * off * random.uniform(-1, 1, 40)])
    cosine, sine = np.cos(angle_rad), np.sin(angle_rad)
    sites = straight @ np.array([[cosine, sine], [-sine, cosine]]) + shift
    points = random.dirichlet(np.full(40, 0.2), 500) @ sites
    interpolation = scattered_sites(sites).weights_at(points)
    assert interpolation.weights.data.min() >= 0, f"{SEED=}"
    np.testing.assert_allclose(interpolation.weights.sum(axis=1), 1.0, atol=1e-14)
    np.testing.assert_allclose(
        interpolation.weights @ sites, points, rtol=0, atol=1e-6, err_msg=f"{SEED=}"
    )
    assert not interpolation.fallback.any(), f"{SEED=}"


def test_sites_that_span_a_plane_are_no_line():
    assert site_line(RANDOM) is None
    assert site_line(np.array([[0.0, 0], [1000, 0], [500, 1e-6]])) is None
    assert site_line(np.array([[0.0, 0], [1000, 0], [500, 1e-8]])) is not None


def test_points_outside_the_hull_are_flagged_and_no_others():
    square = np.array([[0.0, 0], [8, 0], [8, 8], [0, 8], [3, 4]])
    points = np.array([[2.0, -3], [9, 9], [8.5, 2], [4, 4], [3, 4], [0, 0], [8, 1], [8 + 1e-9, 1]])
    interpolation = scattered_sites(square).weights_at(points)
    np.testing.assert_array_equal(interpolation.outside, [1, 1, 1, 0, 0, 0, 0, 1])
    np.testing.assert_allclose(interpolation.weights.toarray()[1], [0, 0, 1, 0, 0])


def test_near_duplicates_share_one_weight_and_others_are_as_without_them():
    twins = np.concatenate([RANDOM, RANDOM[3:5] + 5e-7, RANDOM[3:4] - np.array([0, 5e-7])])
    inside = np.random.default_rng(SEED).dirichlet(np.full(40, 0.2), 300) @ RANDOM
    plain = scattered_sites(RANDOM).weights_at(inside).weights.toarray()
    weights = scattered_sites(twins).weights_at(inside).weights.toarray()
    np.testing.assert_array_equal(weights[:, 40], weights[:, 3])
    np.testing.assert_array_equal(weights[:, 42], weights[:, 3])
    np.testing.assert_array_equal(weights[:, 41], weights[:, 4])
    weights[:, 3] += weights[:, 40] + weights[:, 42]
    weights[:, 4] += weights[:, 41]
    np.testing.assert_allclose(weights[:, :40], plain, rtol=0, atol=1e-14)


def test_all_sites_at_one_place_share_the_value():
    interpolation = scattered_sites(np.full((4, 2), 7.5)).weights_at(np.array([[7.5, 7.5], [0, 0]]))
    np.testing.assert_array_equal(interpolation.weights.toarray(), np.full((2, 4), 0.25))


def test_a_chain_of_near_duplicates_is_one_site():
    # The first and the third are one only through the last.
    sites = np.array([[0.0, 0], [500, 500], [1.6e-6, 0], [0.8e-6, 0], [1000, 0]])
    np.testing.assert_array_equal(first_at_same_place(sites, 1000.0), [0, 1, 0, 0, 4])


def test_two_values_for_one_place_are_refused_by_both_names():
    outputs = np.array([[np.nan, np.nan], [10, 10], [500, 20], [10, 10 + 1e-8], [700, 900]])
    pairs = pairs_at_same_place(outputs, 1000.0)
    assert pairs == ((1, 3),)
    check_values_of_shared_places(np.array([1.0, 2.0, 3.0, 2.0, 5.0]), pairs)
    with pytest.raises(InvalidInputError, match=r"outputs 2 and 4 .* given 2 and 7"):
        check_values_of_shared_places(np.array([1.0, 2.0, 3.0, 7.0, 5.0]), pairs)
    frames = np.zeros((5, 3))
    frames[3, 2] = -0.5
    with pytest.raises(InvalidInputError, match=r"outputs 2 and 4 .* given 0 and -0\.5"):
        check_values_of_shared_places(frames, pairs)
    assert pairs_at_same_place(outputs, 1.0) == ()


def test_no_points_give_no_rows_on_a_line_either():
    interpolation = scattered_sites(np.array([[0.0, 0], [1, 1]])).weights_at(np.zeros((0, 2)))
    assert interpolation.weights.shape == (0, 2)
    assert interpolation.outside.shape == (0,)
