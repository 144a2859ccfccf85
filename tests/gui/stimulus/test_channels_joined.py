"""The picture of a channel holds together, and shows no more than there is."""

import numpy as np

from skinsource_gui.pages.stimulus.page import joined


def test_stretches_that_overlap_are_drawn_as_they_are():
    extremes = np.array([[0.0, 1.0, -2.0], [3.0, 4.0, 1.5]])
    np.testing.assert_array_equal(joined(extremes), extremes)


def test_stretches_apart_reach_to_the_end_of_the_one_before():
    rising = np.array([[0.0, 3.0], [1.0, 4.0]])
    np.testing.assert_array_equal(joined(rising), [[0.0, 1.0], [1.0, 4.0]])
    np.testing.assert_array_equal(joined(rising[:, ::-1]), [[3.0, 0.0], [4.0, 3.0]])
