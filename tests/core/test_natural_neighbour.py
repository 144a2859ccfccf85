"""Sibson's weights against rational arithmetic, what must hold for any sites, and equal places."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.limbs.surface.natural_neighbour import (
    natural_neighbour_weights,
    snapped_to_lattice,
    triangulate,
)
from skinsource.limbs.surface.operator import (
    check_values_of_shared_places,
    first_at_same_place,
    pairs_at_same_place,
)

RANDOM = np.random.default_rng(20240607).uniform(0, 1000, (60, 2))


def points_within(sites, count, seed):
    """Random means of the sites: always inside their hull."""
    shares = np.random.default_rng(seed).dirichlet(np.full(len(sites), 0.2), count)
    return shares @ sites


@pytest.mark.parametrize("distance", [1e-12, 1e-9, 1e-8, 1e-7, 1e-5, 1e-2])
def test_near_a_site_the_weights_stay_sound(distance):
    sites = snapped_to_lattice(RANDOM)
    offsets = np.random.default_rng(1).normal(size=sites.shape) * distance
    inner = np.all((sites > 150) & (sites < 850), axis=1)
    points = (sites + offsets)[inner]
    weights = natural_neighbour_weights(triangulate(sites), points).weights
    np.testing.assert_allclose(weights @ sites, points, atol=1e-7)
    assert weights.toarray()[:, inner].diagonal().min() >= 1 - distance


def test_on_an_edge_of_the_hull_interpolation_is_linear_between_its_ends():
    sites = np.array([[0, 0], [8, 0], [12, 3], [8, 10], [0, 10], [3, 4], [7, 6]], dtype=float)
    points = np.array([[2, 0], [7.5, 0], [0, 2.5], [10, 1.5], [4, 10]])
    result = natural_neighbour_weights(triangulate(sites), points)
    weights, fallback = result.weights, result.fallback
    expected = np.zeros((5, 7))
    expected[0, [0, 1]] = 0.75, 0.25
    expected[1, [0, 1]] = 0.0625, 0.9375
    expected[2, [0, 4]] = 0.75, 0.25
    expected[3, [1, 2]] = 0.5, 0.5
    expected[4, [3, 4]] = 0.5, 0.5
    assert not fallback.any()
    np.testing.assert_allclose(weights.toarray(), expected, atol=1e-14)


def test_a_cavity_that_runs_in_a_ring_is_cut_and_interpolated_linearly():
    sound = triangulate(RANDOM)
    everything_inside = np.tile([0.0, 0.0, 0.0, -1.0], (len(sound.corners), 1))
    # The area of each triangle stays: the linear weights need it.
    everything_inside[:, 0] = sound.circles[:, 0]
    everything_inside[:, 3] = -1e12
    points = points_within(RANDOM, 50, 2)
    result = natural_neighbour_weights(replace(sound, circles=everything_inside), points)
    weights, fallback = result.weights, result.fallback
    assert fallback.all()
    assert np.diff(weights.indptr).max() <= 3
    np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-13)
    np.testing.assert_allclose(weights @ RANDOM, points, atol=1e-9)


def test_the_lattice_keeps_half_pixels_of_the_published_size_and_is_fine_elsewhere():
    halves = np.array([[0.0, 0.0], [395.0, 1054.0], [10.5, 700.5], [11.5, 3.5]])
    np.testing.assert_array_equal(snapped_to_lattice(halves), halves)
    for scale in (1e-3, 1.0, 1e3):
        moved = snapped_to_lattice(RANDOM * scale) - RANDOM * scale
        assert np.abs(moved).max() <= 1000 * scale / 2**14


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
