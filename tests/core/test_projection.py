"""Projections, against sums and singular vectors worked out output by output."""

import numpy as np
import pytest

from skinsource.base.conventions import AXES
from skinsource.base.errors import InvalidInputError
from skinsource.signals.projection import METHODS, project_axes

SEED = 20240405
SEVERAL = [axes for axes in AXES if len(axes) > 1]


def moving(n_outputs: int, n_times: int, seed: int = SEED) -> np.ndarray:
    """Correlated three-axis noise with an offset, which tells centred from plain data."""
    random = np.random.default_rng(seed)
    mixing = random.standard_normal((n_outputs, 3, 3))
    noise = random.standard_normal((n_outputs, 3, n_times))
    return mixing @ noise + random.standard_normal((n_outputs, 3, 1))


def first_singular_vector(rows: np.ndarray) -> np.ndarray:
    """First principal axis of (n_axes, n_times), largest coefficient positive."""
    centred = rows.T - rows.T.mean(axis=0)
    axis = np.linalg.svd(centred, full_matrices=False)[2][0]
    return axis * np.sign(axis[np.argmax(np.abs(axis))])


def direct(data: np.ndarray, axes: str, method: str) -> np.ndarray:
    result = []
    for output in data:
        rows = output[["xyz".index(axis) for axis in axes]]
        sizes = np.sqrt(np.mean(rows**2, axis=1))
        weights = {
            "soc": np.ones(len(rows)),
            "rms": sizes / np.hypot.reduce(sizes),
            "pca": first_singular_vector(rows),
        }
        result.append(np.hypot.reduce(rows) if method == "mag" else weights[method] @ rows)
    return np.array(result)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("axes", SEVERAL)
@pytest.mark.parametrize(("n_outputs", "n_times"), [(1, 40), (2, 651), (7, 523), (72, 100)])
def test_projections_agree_with_a_direct_computation(axes, method, n_outputs, n_times):
    data = moving(n_outputs, n_times)
    expected = direct(data, axes, method)
    projected = project_axes(data, axes, method)
    assert projected.shape == (n_outputs, n_times)
    limit = 1e-12 * np.abs(expected).max()
    np.testing.assert_allclose(projected, expected, rtol=0, atol=limit, err_msg=f"{SEED=}")


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("axis", "xyz")
def test_a_single_axis_is_itself_whatever_the_method(axis, method):
    data = moving(4, 30)
    projected = project_axes(data, axis, method)
    np.testing.assert_array_equal(projected, data[:, "xyz".index(axis)])
    assert not np.shares_memory(projected, data)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("axes", AXES)
def test_a_silent_output_stays_silent_beside_others(axes, method):
    data = moving(3, 100)
    data[1] = 0.0
    projected = project_axes(data, axes, method)
    assert not projected[1].any()
    assert projected[0].any()
    assert projected[2].any()
    assert not project_axes(np.zeros((1, 3, 50)), axes, method).any()


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("exponent", [-900, -500, 500, 900])
def test_doubling_doubles_bit_for_bit_far_beyond_where_squares_exist(method, exponent):
    data = moving(6, 80)
    projected = project_axes(np.ldexp(data, exponent), "xyz", method)
    np.testing.assert_array_equal(projected, np.ldexp(project_axes(data, "xyz", method), exponent))


@pytest.mark.parametrize("shape", [(72, 3), (72, 2, 100), (3,), (1, 72, 3, 5), (72, 100, 3)])
def test_a_wrong_shape_is_refused(shape):
    with pytest.raises(InvalidInputError, match=r"expected \(n_outputs, 3, n_times\)"):
        project_axes(np.zeros(shape))


def test_unknown_axes_and_methods_are_refused_with_the_known_ones():
    with pytest.raises(InvalidInputError, match="choose from x, y, z, xy"):
        project_axes(moving(1, 5), "yx")
    with pytest.raises(InvalidInputError, match="choose from mag, pca, rms, soc"):
        project_axes(moving(1, 5), "xyz", "norm")
