"""Prediction on a made-up limb, against numpy's direct convolution."""

import re

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.engine.prediction import predict
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import SCALINGS

SEED = 1300
BYTES_PER_PLACE = 72 * 3 * 522 * 8


def synthetic_response(place: int) -> np.ndarray:
    return np.random.default_rng(place).standard_normal((72, 3, 522))


@pytest.fixture
def limb(limb_of) -> Limb:
    return limb_of(synthetic_response)


def direct_field(place: int, drive: np.ndarray) -> np.ndarray:
    response = synthetic_response(place).reshape(216, 522)
    field = [np.convolve(channel, drive) for channel in response]
    return np.array(field).reshape(72, 3, drive.size + 521)


def direct_sum(places, drives, amplitudes, scaling) -> np.ndarray:
    total = 0.0
    for place, drive, amplitude in zip(places, drives, amplitudes, strict=True):
        field = direct_field(place, drive)
        if scaling == "upstream" and field.max() != 0:
            field = field / field.max()
        total = total + amplitude * field
    return total


def assert_close(values, expected, relative) -> None:
    limit = relative * np.abs(expected).max()
    np.testing.assert_allclose(values, expected, rtol=0, atol=limit, err_msg=f"{SEED=}")


@pytest.mark.parametrize("scaling", ["upstream", "relative"])
@pytest.mark.parametrize("n_times", [1, 2, 521, 522, 523, 1300])
def test_a_response_is_the_full_linear_convolution(limb, n_times, scaling):
    drive = np.random.default_rng(SEED).standard_normal(n_times)
    response = predict(limb, [drive], [7], [1.7], scaling)
    assert response.shape == (72, 3, n_times + 521)
    assert response.dtype == np.float64
    assert_close(response, direct_sum([7], [drive], [1.7], scaling), 1e-14)


@pytest.mark.parametrize("scaling", ["upstream", "relative"])
def test_inputs_add_up_also_at_the_same_place_and_in_opposite_polarity(limb, scaling):
    drives = np.random.default_rng(SEED).standard_normal((4, 130))
    drives[2] = 0.0
    places, amplitudes = [8, 13, 3, 8], [0.5, -2.0, 1.0, 1.25]
    response = predict(limb, drives, places, amplitudes, scaling)
    assert_close(response, direct_sum(places, drives, amplitudes, scaling), 1e-14)


@pytest.mark.parametrize("scaling", SCALINGS)
def test_an_amplitude_of_zero_and_a_silent_drive_contribute_nothing(limb, scaling):
    drives = np.random.default_rng(SEED).standard_normal((3, 65))
    drives[2] = 0.0
    alone = predict(limb, drives[:1], [5], [2.0], scaling)
    response = predict(limb, drives, [5, 6, 7], [2.0, 0.0, 9.0], scaling)
    np.testing.assert_array_equal(response, alone)
    silent = predict(limb, np.zeros((1, 65)), [5], scaling=scaling)
    assert silent.shape == (72, 3, 586)
    assert not silent.any()


def test_upstream_amplitude_is_the_signed_maximum_of_each_input(limb):
    drives = np.random.default_rng(SEED).standard_normal((2, 99))
    assert predict(limb, drives[:1], [1], [2.5]).max() == pytest.approx(2.5, rel=1e-14)
    assert predict(limb, drives[:1], [1], [-2.5]).min() == pytest.approx(-2.5, rel=1e-14)
    both = predict(limb, drives, [1, 2], [2.5, 1.5])
    separate = predict(limb, drives[:1], [1], [2.5]) + predict(limb, drives[1:], [2], [1.5])
    assert_close(both, separate, 1e-14)


def test_only_the_responses_of_places_in_use_are_read(limb):
    assert limb.bytes_read == 0
    predict(limb, np.ones((3, 10)), [7, 9, 7])
    assert limb.bytes_read == 2 * BYTES_PER_PLACE
    predict(limb, np.ones((1, 10)), [9])
    assert limb.bytes_read == 2 * BYTES_PER_PLACE


def test_one_drive_and_one_place_need_no_lists(limb):
    expected = predict(limb, [[1.0, 2.0]], [3], [0.5])
    np.testing.assert_array_equal(predict(limb, [1.0, 2.0], 3, 0.5), expected)
    np.testing.assert_array_equal(predict(limb, [1, 2], np.int64(3), [0.5]), expected)
    np.testing.assert_array_equal(predict(limb, ((1, 2),), np.array([3]), (0.5,)), expected)


def test_what_is_handed_over_is_not_changed(limb):
    drives = np.random.default_rng(SEED).standard_normal((2, 50))
    drives.flags.writeable = False
    for scaling in SCALINGS:
        predict(limb, drives, [7, 8], [2.0, 3.0], scaling)
    np.testing.assert_array_equal(limb.response_to(7), synthetic_response(7))


@pytest.mark.parametrize("place", [0, 21, -1, True, 2.5, 7.0, "7", None, np.nan, np.True_])
def test_a_place_that_does_not_exist_is_refused(limb, place):
    message = re.escape(f"input location {place!r} does not exist")
    with pytest.raises(InvalidInputError, match=message):
        predict(limb, np.ones((1, 5)), [place])
    with pytest.raises(InvalidInputError, match=message):
        predict(limb, np.ones((2, 5)), [7, place])
    assert limb.bytes_read == 0


@pytest.mark.parametrize(
    ("drives", "places", "amplitudes", "message"),
    [
        *(
            (np.ones((2, 5)), places, None, "does not exist")
            for places in ([[1], [2, 3]], [[1, 2]], np.array([[1, 2]]), [np.array([1])])
        ),
        *(
            (np.ones((2, 5)), places, None, f"{len(places)} locations for 2 drives")
            for places in ([], [1], [1, 2, 3])
        ),
        *(
            (drives, [1], None, r"drives (cannot be read as one array|holds complex)")
            for drives in ([[1.0, 2.0], [1.0]], [[1.0], None], "tone", [["1.0"]], [[1j]], None)
        ),
        *(
            (np.ones(shape), [1], None, re.escape(f"drives has shape {shape}"))
            for shape in ((1, 0), (0, 5), (1, 1, 5), ())
        ),
        ([], [], None, "at least one input and one sample"),
        *(
            (np.ones((2, 5)), [1, 2], amplitudes, r"expected \(2,\): one for each drive")
            for amplitudes in ([], [1.0], [1.0, 2.0, 3.0], [[1.0, 2.0]], 1.0)
        ),
        *(
            (np.ones((2, 5)), [1, 2], amplitudes, "cannot be read as one array|holds complex")
            for amplitudes in (["a", "b"], [[1], [2, 3]], [1j, 2], [None, 1])
        ),
        (np.ones((2, 5)), [1, 2], [1.0, 1e300], "expected finite numbers"),
    ],
)
def test_what_does_not_fit_together_is_refused(limb, drives, places, amplitudes, message):
    with pytest.raises(InvalidInputError, match=message):
        predict(limb, drives, places, amplitudes)


def test_an_unknown_scaling_is_refused_with_the_known_ones(limb):
    with pytest.raises(InvalidInputError, match="choose from upstream, relative, probe"):
        predict(limb, np.ones((1, 5)), [1], scaling="none")
