"""The hands that are drawn for the synthetic limbs."""

import numpy as np
import pytest

from skinsource.limbs.hand import HAND_LENGTH_PX, drawn_hand
from skinsource.limbs.surface.outline import count_crossings, grid_inside
from skinsource.limbs.synthetic import SYNTHETIC_LIMBS

# From fingertip to elbow, and from radial to ulnar.
COLUMNS = (
    (20, 22, 24, 23, 26, 34, 27, 52, 54, 57, 56, 59, 58, 60, 69, 68),
    (1, 3, 6, 5, 8, 7, 9, 43, 45, 48, 47, 50, 49, 51, 70),
    (41, 42, 40),
)
ROWS = (
    *((2, 1), (4, 3), (11, 10), (13, 12), (20, 19), (22, 21), (29, 28), (31, 30)),
    *((39, 36, 27, 18, 9), (53, 52, 44, 43), (55, 54, 46, 45), (37, 35, 26, 17, 8)),
    *((40, 38, 34, 25, 16, 7), (67, 68, 69, 70, 71), (57, 48), (58, 49), (61, 62)),
)


@pytest.fixture(scope="module", params=SYNTHETIC_LIMBS)
def shape(request):
    return drawn_hand(request.param)


def is_inside(point, outline):
    return grid_inside(outline, point[:1], point[1:])[0, 0]


def test_the_outline_is_a_simple_counter_clockwise_polygon(shape):
    x, y = shape.outline.T
    assert np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) > 0
    assert count_crossings(shape.outline) == 0
    assert np.linalg.norm(np.diff(shape.outline, axis=0), axis=1).max() < 16


def test_a_hand_is_400_pixels_long_and_its_digits_stand_in_order(shape):
    assert HAND_LENGTH_PX == 400.0
    assert np.linalg.norm(shape.digit_axes[2][-1] - shape.wrist) == pytest.approx(400.0)
    for end in (0, -1):
        assert (np.diff([axis[end][0] for axis in shape.digit_axes]) > 0).all()


def test_every_place_lies_inside_the_outline(shape):
    for point in (*shape.output_positions, *shape.input_positions):
        assert is_inside(point, shape.outline)
        assert np.linalg.norm(point - shape.outline, axis=1).min() > 4


def test_places_stand_in_order(shape):
    for column in COLUMNS:
        assert (np.diff(shape.output_positions[np.array(column) - 1, 1]) < 0).all(), column
    for row in ROWS:
        assert (np.diff(shape.output_positions[np.array(row) - 1, 0]) > 0).all(), row
    tips, pads, bases = shape.input_positions[:15].reshape(3, 5, 2)
    assert (tips[:, 1] > pads[:, 1]).all()
    assert (pads[:, 1] > bases[:, 1]).all()


def test_the_map_of_a_limb_carries_the_drawing_without_volar_outputs(shape):
    limb_map = shape.limb_map()
    assert limb_map.outline is shape.outline
    assert limb_map.input_positions is shape.input_positions
    assert limb_map.unplaced == (61, 62, 63, 64, 65, 66)
    dorsal = np.isfinite(limb_map.output_positions)
    assert np.array_equal(limb_map.output_positions[dorsal], shape.output_positions[dorsal])
