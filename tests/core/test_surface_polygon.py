"""Polygons: which grid points they hold, and how their edges are split."""

from fractions import Fraction

import numpy as np
import pytest

from skinsource.limbs.surface.surface import (
    count_crossings,
    densified,
    distinct_vertices,
    grid_inside,
)

SQUARE = np.array([[0, 0], [4, 0], [4, 4], [0, 4]], dtype=float)


def holds_exactly(outline, x, y):
    """Closed even-odd rule for one point, in rational numbers."""
    corners = [tuple(Fraction(float(c)) for c in vertex) for vertex in outline]
    px, py = Fraction(float(x)), Fraction(float(y))
    inside = False
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
        turn = (bx - ax) * (py - ay) - (by - ay) * (px - ax)
        within = min(ax, bx) <= px <= max(ax, bx) and min(ay, by) <= py <= max(ay, by)
        if turn == 0 and within:
            return True
        if (ay > py) != (by > py):
            inside ^= (turn > 0) == (by > ay)
    return inside


@pytest.mark.parametrize("seed", range(6))
def test_a_grid_is_masked_as_in_rational_arithmetic(seed):
    random = np.random.default_rng(seed)
    outline = random.integers(0, 20, (9, 2)).astype(float)  # crosses itself, as a rule
    outline = outline[distinct_vertices(outline)]
    x, y = np.arange(-1, 21) * 1.0, np.arange(-2, 42) * 0.5
    expected = [[holds_exactly(outline, column, row) for column in x] for row in y]
    np.testing.assert_array_equal(grid_inside(outline, x, y), expected, err_msg=f"seed {seed}")


def test_points_within_the_tolerance_of_an_edge_are_inside():
    near, far = 0.5e-9, 2e-9
    x = np.array([-far, -near, 2.0, 4 + near, 4 + far])
    np.testing.assert_array_equal(
        grid_inside(SQUARE, x, np.array([2.0]))[0], [False, True, True, True, False]
    )
    y = np.array([-far, -near, 2.0, 4 + near, 4 + far])
    np.testing.assert_array_equal(
        grid_inside(SQUARE, np.array([2.0]), y)[:, 0], [False, True, True, True, False]
    )


@pytest.mark.parametrize("slope", [1e-12, 1e-10, 1e-8, 1e-3])
def test_nearly_level_edges_are_closed_along_their_whole_length(slope):
    outline = np.array([[0, 0], [100, 100 * slope], [100, 50], [0, 50]])
    x = np.arange(0, 101.0)
    on_edge = grid_inside(outline, x, np.array([50 * slope]))[0]
    # Left of the middle the row lies inside, right of it outside by up to half the rise.
    assert on_edge[:51].all()
    assert on_edge[51:].all() == (50 * slope < 1e-9)


def area(outline):
    x, y = outline.T
    return abs(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2


def test_split_edges_are_short_and_keep_the_vertices():
    split = densified(SQUARE * [1, 2.5], 3.0)
    lengths = np.hypot(*(np.roll(split, -1, axis=0) - split).T)
    assert len(split) == 2 + 4 + 2 + 4
    assert lengths.max() <= 3.0
    assert area(split) == pytest.approx(40.0)
    assert {tuple(v) for v in (SQUARE * [1, 2.5])} <= {tuple(v) for v in split}


def test_crossings_are_counted_and_touching_is_none():
    bow_tie = np.array([[0, 0], [4, 4], [4, 0], [0, 4]], dtype=float)
    touching = np.array([[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]], dtype=float)
    assert count_crossings(bow_tie) == 1
    assert count_crossings(SQUARE) == 0
    assert count_crossings(touching) == 0
    angle = np.arange(5) * 4 * np.pi / 5
    assert count_crossings(np.column_stack([np.cos(angle), np.sin(angle)])) == 5


def test_repetitions_are_dropped_and_a_closing_vertex_is_one():
    outline = SQUARE[[0, 1, 1, 2, 3, 3, 0]]
    np.testing.assert_array_equal(outline[distinct_vertices(outline)], SQUARE[[1, 2, 3, 0]])
