"""Sites at one place, or nearly so."""

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.limbs.surface.operator import (
    check_values_of_shared_places,
    first_at_same_place,
    pairs_at_same_place,
)


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
