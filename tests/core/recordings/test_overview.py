"""The picture of a whole file: least and largest of each stretch."""

from itertools import pairwise

import numpy as np
import pytest
import soundfile
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource.readers.reader import Overview


@given(
    n=st.integers(1, 400),
    columns=st.integers(1, 50),
    cuts=st.lists(st.integers(0, 400), max_size=6),
)
@settings(max_examples=100, deadline=None)
def test_stretches_are_those_of_the_whole_however_it_is_cut(n, columns, cuts):
    values = np.random.default_rng(n).standard_normal(n)
    overview = Overview(n, columns)
    for part in np.split(values, sorted(min(cut, n) for cut in cuts)):
        overview.add(part[np.newaxis])
    edges = [k * n // min(columns, n) for k in range(min(columns, n) + 1)]
    pieces = [values[a:b] for a, b in pairwise(edges)]
    np.testing.assert_array_equal(overview.extremes[0], [piece.min() for piece in pieces])
    np.testing.assert_array_equal(overview.extremes[1], [piece.max() for piece in pieces])
    assert overview.done == n


def test_missing_numbers_do_not_hide_the_others():
    overview = Overview(4, 2)
    overview.add(np.array([[np.nan, 3.0, np.nan, np.nan]]))
    np.testing.assert_array_equal(overview.extremes, [[3.0, np.nan], [3.0, np.nan]])


def test_a_file_is_surveyed_in_the_process(tmp_path, process):
    values = np.zeros((300_000, 2))
    values[100_000:150_000, 1] = 0.5
    values[200_000, 1] = -0.25
    soundfile.write(tmp_path / "a.wav", values, 48_000, "FLOAT")
    overview = process.overview(tmp_path / "a.wav", "1", 300_000, 30)
    assert overview.shape == (2, 30)
    assert (overview[1] == 0.5).nonzero()[0].tolist() == list(range(10, 15))
    assert overview[0].min() == pytest.approx(-0.25)
    assert np.argmin(overview[0]) == 20
