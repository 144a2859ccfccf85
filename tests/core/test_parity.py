"""The measured limbs against figures of the paper, MATLAB, and upstream formulas."""

from pathlib import Path

import numpy as np
import pytest

from skinsource import load_limb, predict, project_axes, sinusoid


def test_impulse_responses_of_limb_1_peak_as_published(measured):
    limb = load_limb("measured-1")
    peaks = np.array([np.abs(limb.response_to(place)).max() for place in range(1, 21)])
    for places, low, high in ((peaks[:10], 15.9, 26.3), (peaks[10:15], 13.3, 22.8)):
        assert places.min() == pytest.approx(low, abs=0.0501)
        assert places.max() == pytest.approx(high, abs=0.0501)
    assert peaks[15:].min() == pytest.approx(5.2, abs=0.0501)
    assert peaks[15:].max() == pytest.approx(14.6, abs=0.0501)


NAME = "model1_location7_sine100_100ms"
OUTPUTS = [20, 24, 32]


def read(folder: Path, what: str, *shape: int) -> np.ndarray:
    values = np.fromfile(folder / f"{NAME}_{what}.f32", "<f4").astype(np.float64)
    return values.reshape(shape, order="F")


@pytest.fixture
def acceleration(measured) -> np.ndarray:
    return predict(load_limb("measured-1"), [sinusoid(100.0, 0.1)], [7], scaling="upstream")


def test_the_response_to_a_sine_is_that_of_matlab(acceleration, matlab_reference):
    reference = read(matlab_reference, "response", 651, 72, 3)
    limit = 1e-7 * np.abs(reference).max()
    np.testing.assert_allclose(acceleration, reference.transpose(1, 2, 0), rtol=0, atol=limit)


@pytest.mark.parametrize(
    ("what", "axes", "method"),
    [("z_outputs", "z", "mag"), ("mag_outputs", "xyz", "mag"), ("rms_outputs", "xyz", "rms")],
)
def test_projections_of_the_response_are_those_of_matlab(
    acceleration, matlab_reference, what, axes, method
):
    reference = read(matlab_reference, what, 651, 3)
    projected_signals = project_axes(acceleration, axes, method)[[n - 1 for n in OUTPUTS]]
    limit = 1e-7 * np.abs(reference).max()
    np.testing.assert_allclose(projected_signals, reference.T, rtol=0, atol=limit)
