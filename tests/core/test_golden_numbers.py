"""Numbers known from the paper's figures, computed from the measured limbs elsewhere."""

import numpy as np
import pytest

from skinsource.base.decibels import decibels
from skinsource.engine.prediction import predict
from skinsource.limbs.catalog import load_limb
from skinsource.signals.generators import sinusoid
from skinsource.signals.projection import project_axes
from skinsource.signals.spectra import rms

WRIST = [43, 44, 45, 46, 52, 53, 54, 55]


def rms_along_x(places: list[int]) -> np.ndarray:
    """RMS at outputs 19, 21, 24 and 32 for ten periods of 200 Hz in limb 3."""
    drive = sinusoid(200.0, 0.05, window_name="tukey")
    assert drive.shape == (65,)
    acceleration = predict(load_limb("measured-3"), [drive] * len(places), places)
    return rms(project_axes(acceleration, "x"))[[18, 20, 23, 31]]


@pytest.mark.parametrize(
    ("places", "expected"),
    [
        ([8], [0.2110, 0.1966, 0.0215, 0.0035]),
        ([13], [0.2119, 0.1828, 0.1346, 0.0286]),
        ([8, 13], [0.0240, 0.3570, 0.1301, 0.0296]),
    ],
)
def test_two_inputs_interfere_as_in_figure_2f(measured, places, expected):
    np.testing.assert_allclose(rms_along_x(places), expected, rtol=0, atol=5.1e-5)


def test_the_interference_is_destructive_at_output_19_and_constructive_at_21(measured):
    together, separate = rms_along_x([8, 13]), rms_along_x([8]) + rms_along_x([13])
    assert together[0] / separate[0] == pytest.approx(0.06, abs=0.005)
    assert together[1] / separate[1] == pytest.approx(0.94, abs=0.005)


@pytest.mark.parametrize(
    ("frequency_hz", "loudest_db", "hand_db", "wrist_db"),
    [
        (50.0, -7.3, -20.5, -24.8),
        (100.0, -6.2, -26.1, -37.0),
        (200.0, -6.2, -36.1, -44.1),
        (400.0, -6.2, -46.4, -49.2),
    ],
)
def test_levels_fall_with_distance_and_frequency_as_in_figure_2b(
    measured, frequency_hz, loudest_db, hand_db, wrist_db
):
    drive = sinusoid(frequency_hz, 0.2, window_name="tukey")
    assert drive.shape == (260,)
    acceleration = predict(load_limb("measured-1"), [drive], [7])
    level_db = decibels(rms(project_axes(acceleration, "xyz", "mag")))
    assert level_db.max() == pytest.approx(loudest_db, abs=0.0501)
    assert np.median(level_db[:42]) == pytest.approx(hand_db, abs=0.0501)
    wrist = level_db[[output - 1 for output in WRIST]]
    assert np.median(wrist) == pytest.approx(wrist_db, abs=0.0501)


def test_impulse_responses_of_limb_1_peak_as_published(measured):
    limb = load_limb("measured-1")
    peaks = np.array([np.abs(limb.response_to(place)).max() for place in range(1, 21)])
    for places, low, high in ((peaks[:10], 15.9, 26.3), (peaks[10:15], 13.3, 22.8)):
        assert places.min() == pytest.approx(low, abs=0.0501)
        assert places.max() == pytest.approx(high, abs=0.0501)
    assert peaks[15:].min() == pytest.approx(5.2, abs=0.0501)
    assert peaks[15:].max() == pytest.approx(14.6, abs=0.0501)
