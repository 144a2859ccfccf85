"""The surface operator against MATLAB's, and on the published and the built-in limbs."""

import numpy as np
import pytest
from scipy.sparse import csr_array

from skinsource.base.measurement_conditions import VOLAR_OUTPUTS
from skinsource.limbs.limb import LimbMap
from skinsource.limbs.surface.surface import surface_operator, surface_operator_from_map
from skinsource.limbs.synthetic import load_synthetic_limb

LIMBS = (1, 2, 3, 4)


@pytest.fixture
def measured_limb(measured):
    from skinsource.limbs.dataset.store import load_measured_limb

    return load_measured_limb


def without_table(limb_map):
    return LimbMap(
        outline=limb_map.outline,
        output_positions=limb_map.output_positions,
        input_positions=limb_map.input_positions,
        hand_length_px=limb_map.hand_length_px,
        densify=False,
    )


@pytest.mark.parametrize("own_sight", [False, True])
def test_limb_1_has_matlab_s_weights(measured_limb, matlab_reference, own_sight):
    limb = measured_limb(1)
    limb_map = without_table(limb.map) if own_sight else limb.map
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


def test_each_output_stands_out_at_its_own_place():
    limb = load_synthetic_limb(1)
    operator = surface_operator(limb)
    scale = limb.hand_length_mm / limb.map.hand_length_px
    for output in np.flatnonzero(np.isfinite(limb.map.output_positions[:, 0])):
        x, y = limb.map.output_positions[output] * scale
        picture = operator.interpolate(np.eye(72)[output])
        row, column = np.abs(operator.y_mm - y).argmin(), np.abs(operator.x_mm - x).argmin()
        assert picture[row, column] > 0.7, f"output {output + 1}"
        row, column = np.unravel_index(np.nanargmax(picture), picture.shape)
        # The rim takes its values from the nearest outputs, so the peak may be a ridge.
        assert np.hypot(operator.x_mm[column] - x, operator.y_mm[row] - y) < 15.0


def test_rows_increase_towards_the_fingertips_and_columns_away_from_the_thumb():
    limb = load_synthetic_limb(1)
    operator = surface_operator(limb, spacing_mm=2.0)
    values = np.nan_to_num(limb.map.output_positions)
    across, along = np.moveaxis(operator.interpolate(values), -1, 0)
    rows, columns = np.nonzero(operator.mask)
    assert np.corrcoef(rows, along[operator.mask])[0, 1] > 0.99
    assert np.corrcoef(columns, across[operator.mask])[0, 1] > 0.9
    assert np.all(np.diff(operator.x_mm) > 0)
    assert np.all(np.diff(operator.y_mm) > 0)
