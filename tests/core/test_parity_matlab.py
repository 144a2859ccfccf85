"""Agreement with what MATLAB made from the measured dataset (float32, column-major)."""

from pathlib import Path

import numpy as np
import pytest

from skinsource.engine.prediction import predict
from skinsource.limbs.catalog import load_limb
from skinsource.signals.generators import sinusoid
from skinsource.signals.projection import project_axes

NAME = "model1_location7_sine100_100ms"
OUTPUTS = [20, 24, 32]


def read(folder: Path, what: str, *shape: int) -> np.ndarray:
    values = np.fromfile(folder / f"{NAME}_{what}.f32", "<f4").astype(np.float64)
    return values.reshape(shape, order="F")


@pytest.fixture
def acceleration(measured) -> np.ndarray:
    return predict(load_limb("measured-1"), [sinusoid(100.0, 0.1)], [7])


def assert_agrees(values: np.ndarray, reference: np.ndarray) -> None:
    assert values.shape == reference.shape
    limit = 1e-7 * np.abs(reference).max()
    np.testing.assert_allclose(values, reference, rtol=0, atol=limit)


def test_the_response_to_a_sine_is_that_of_matlab(acceleration, matlab_reference):
    reference = read(matlab_reference, "response", 651, 72, 3)
    assert_agrees(acceleration, reference.transpose(1, 2, 0))


@pytest.mark.parametrize(
    ("what", "axes", "method"),
    [("z_outputs", "z", "mag"), ("mag_outputs", "xyz", "mag"), ("rms_outputs", "xyz", "rms")],
)
def test_projections_of_the_response_are_those_of_matlab(
    acceleration, matlab_reference, what, axes, method
):
    reference = read(matlab_reference, what, 651, 3)
    projected = project_axes(acceleration, axes, method)[[output - 1 for output in OUTPUTS]]
    assert_agrees(projected, reference.T)
