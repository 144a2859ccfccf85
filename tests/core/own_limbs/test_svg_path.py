"""Outlines drawn in SVG: paths of lines, curves and arcs."""

import numpy as np
import pytest

from skinsource.limbs.svg_path import outline_of, path_lines


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("M1 2L3 4 5 6Z", [[1, 2], [3, 4], [5, 6]]),
        ("m1,2 3,4 v-1 H0", [[1, 2], [4, 6], [4, 5], [0, 5]]),
        ("M0-1.5.5-2e1", [[0, -1.5], [0.5, -20]]),
    ],
)
def test_straight_paths_are_read_point_by_point(text, expected):
    (line,) = path_lines(text)
    np.testing.assert_allclose(line, expected)


def test_curves_and_arcs_lie_where_they_should():
    (quarter,) = path_lines("M1 0A1 1 0 0 1 0 1")
    np.testing.assert_allclose(np.hypot(*quarter.T), 1.0)
    (large,) = path_lines("M1 0a1 1 0 1 1-1-1")  # the long way round, with flags apart
    np.testing.assert_allclose(np.hypot(*(large - (0, 0)).T), 1.0, atol=1e-12)
    assert large[:, 0].min() < -0.99
    (joined,) = path_lines("M1 0a1 1 0 11-1-1")
    np.testing.assert_array_equal(joined, large)
    (cubic,) = path_lines("M0 0C0 4 4 4 4 0S8-4 8 0")
    t = np.linspace(0, 1, 25)[12]
    np.testing.assert_allclose(cubic[12], [3 * t**2 * (1 - t) * 4 + t**3 * 4, 3 * t * (1 - t) * 4])
    np.testing.assert_allclose(cubic[36], [6, -3])
    (smooth,) = path_lines("M0 0Q1 2 2 0T4 0")
    np.testing.assert_allclose(smooth[[12, 36]], [[1, 1], [3, -1]])


@pytest.mark.parametrize("bad", ["", "L1 2", "M1", "M1 2 3", "M1 2 L x y", "M1 2 z 5"])
def test_what_is_no_outline_is_refused(bad):
    with pytest.raises(ValueError, match="path"):
        outline_of(f'<svg><path d="{bad}"/></svg>'.encode())
