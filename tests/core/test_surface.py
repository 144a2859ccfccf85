"""The surface operator against MATLAB's, on the published and built-in limbs, and values on it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import csr_array

from skinsource.base.conventions import VOLAR_OUTPUTS
from skinsource.base.errors import InvalidInputError
from skinsource.limbs.limb import LimbMap
from skinsource.limbs.surface.surface import surface_operator, surface_operator_from_map

LIMBS = (1, 2, 3, 4)


@pytest.fixture
def measured_limb(measured):
    from skinsource.limbs.dataset.store import load_measured_limb

    return load_measured_limb


@pytest.mark.parametrize("own_sight", [False, True])
def test_limb_1_has_matlab_s_weights(measured_limb, matlab_reference, own_sight):
    limb = measured_limb(1)
    without_table = {"visibility": None, "densify": False} if own_sight else {}
    limb_map = replace(limb.map, **without_table)
    ours = surface_operator_from_map(limb_map, limb.hand_length_mm).weights.copy()
    starts = np.fromfile(matlab_reference / "model-1-rowptr.u32", "<u4").astype(np.int64)
    outputs = np.fromfile(matlab_reference / "model-1-indices.u8", "u1")
    shares = np.fromfile(matlab_reference / "model-1-weights.f32", "<f4")
    # MATLAB's export drops weights up to 1e-6; ours are all kept.
    ours.data[ours.data <= 1e-6] = 0.0
    ours.eliminate_zeros()
    published = csr_array((shares.astype(float), outputs.astype(int), starts), shape=ours.shape)
    published.sort_indices()
    np.testing.assert_array_equal(ours.indptr, published.indptr)
    np.testing.assert_array_equal(ours.indices, published.indices)
    # Half a unit in the last place of float32 is 3e-8.
    np.testing.assert_allclose(ours.data, published.data, rtol=0, atol=5e-8)


@pytest.mark.parametrize("number", LIMBS)
def test_a_measured_limb_has_the_published_mask_and_sound_weights(measured_limb, number):
    from skinsource.limbs.dataset.store import store_path

    operator = surface_operator(measured_limb(number))
    np.testing.assert_array_equal(operator.mask, np.load(store_path())[f"masks/{number}"])
    assert operator.fallback_count == operator.blind_vertices == operator.single_vertices == 0
    assert operator.warnings == ()
    totals = operator.weights.sum(axis=1)
    np.testing.assert_allclose(totals, operator.mask.ravel(), atol=1e-13)
    assert operator.weights.data.min() >= -1e-12
    volar = operator.weights[:, np.array(VOLAR_OUTPUTS) - 1]
    assert volar.nnz == 0


def test_each_output_stands_out_at_its_own_place(limb):
    operator = surface_operator(limb)
    for output in np.flatnonzero(np.isfinite(limb.map.output_positions[:, 0])):
        x, y = limb.output_positions_mm[output]
        picture = operator.interpolate(np.eye(72)[output])
        row, column = np.abs(operator.y_mm - y).argmin(), np.abs(operator.x_mm - x).argmin()
        assert picture[row, column] > 0.7, f"output {output + 1}"
        row, column = np.unravel_index(np.nanargmax(picture), picture.shape)
        # The rim takes its values from the nearest outputs, so the peak may be a ridge.
        assert np.hypot(operator.x_mm[column] - x, operator.y_mm[row] - y) < 15.0


def test_rows_increase_towards_the_fingertips_and_columns_away_from_the_thumb(limb):
    operator = surface_operator(limb, spacing_mm=2.0)
    values = np.nan_to_num(limb.map.output_positions)
    across, along = np.moveaxis(operator.interpolate(values), -1, 0)
    rows, columns = np.nonzero(operator.mask)
    assert np.corrcoef(rows, along[operator.mask])[0, 1] > 0.99
    assert np.corrcoef(columns, across[operator.mask])[0, 1] > 0.9
    assert np.all(np.diff(operator.x_mm) > 0)
    assert np.all(np.diff(operator.y_mm) > 0)


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
