"""Interpolating values with a surface operator."""

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.limbs.limb import LimbMap
from skinsource.limbs.surface.surface import surface_operator_from_map

OUTLINE = np.array([[0, 0], [40, 0], [40, 60], [0, 60]], dtype=float)


@pytest.fixture(scope="module")
def operator():
    outputs = np.full((72, 2), np.nan)
    outputs[:4] = [[10, 10], [30, 12], [28, 45], [9, 50]]
    limb_map = LimbMap(
        outline=OUTLINE,
        output_positions=outputs,
        input_positions=np.zeros((20, 2)),
        hand_length_px=60.0,
    )
    return surface_operator_from_map(limb_map, 60.0)


def values_of(first_four):
    return np.concatenate([first_four, np.full(68, np.nan)])


def test_outputs_without_a_place_are_ignored_whatever_their_value(operator):
    expected = operator.interpolate(np.concatenate([[1.0, 2, 3, 4], np.zeros(68)]))
    for other in (np.nan, np.inf, -np.inf, 1e300):
        values = np.concatenate([[1.0, 2, 3, 4], np.full(68, other)])
        np.testing.assert_array_equal(operator.interpolate(values), expected)


def test_frames_come_last_and_equal_single_pictures(operator):
    frames = np.random.default_rng(2).normal(size=(72, 5))
    pictures = operator.interpolate(frames)
    assert pictures.shape == (61, 41, 5)
    for frame in range(5):
        np.testing.assert_allclose(
            pictures[..., frame], operator.interpolate(frames[:, frame]), atol=1e-14
        )
    assert operator.interpolate(frames[:, :0]).shape == (61, 41, 0)


def test_minus_infinity_counts_as_minus_200_db(operator):
    picture = operator.interpolate(values_of([-np.inf, -20.0, -20.0, -20.0]))
    expected = operator.interpolate(values_of([-200.0, -20.0, -20.0, -20.0]))
    np.testing.assert_array_equal(picture, expected)
    assert np.nanmin(picture) == pytest.approx(-200.0)
    assert picture[45, 28] == pytest.approx(-20.0)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_value_that_is_no_number_is_refused_by_the_output_s_number(operator, bad):
    with pytest.raises(InvalidInputError, match=r"output 2, 4;"):
        operator.interpolate(values_of([0.0, bad, 0.0, bad]))
    frames = np.zeros((72, 3))
    frames[2, 1] = bad
    with pytest.raises(InvalidInputError, match=r"output 3;"):
        operator.interpolate(frames)


@pytest.mark.parametrize("shape", [(71,), (73,), (3, 72), (72, 2, 2), ()])
def test_values_of_another_shape_are_refused(operator, shape):
    with pytest.raises(InvalidInputError, match="one value per output"):
        operator.interpolate(np.zeros(shape))
