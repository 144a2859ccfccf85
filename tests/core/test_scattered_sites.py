"""Sites on one line, at one place, or nearly so; checked by rational arithmetic."""

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


def test_sites_that_span_a_plane_are_no_line():
    assert site_line(RANDOM) is None
    assert site_line(np.array([[0.0, 0], [1000, 0], [500, 1e-6]])) is None
    assert site_line(np.array([[0.0, 0], [1000, 0], [500, 1e-8]])) is not None


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
