"""`predict`: what it refuses, what it takes as it is, and what it remembers of limbs."""

import gc
import re
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import skinsource as ss
from skinsource import Limb, predict
from skinsource.base.errors import InvalidInputError
from skinsource.base.work import counting
from skinsource.engine import prediction
from skinsource.limbs.scaling import SCALINGS

DRIVES = np.random.default_rng(3).standard_normal((20, 325))
PLACES = range(1, 21)


@pytest.fixture(autouse=True)
def nothing_remembered():
    prediction._cached_spectra.cache_clear()
    prediction._cached_gains.cache_clear()
    yield
    prediction._cached_spectra.cache_clear()
    prediction._cached_gains.cache_clear()


@pytest.fixture
def limb() -> Limb:
    return ss.load_limb("synthetic-1")


def test_one_drive_and_one_place_need_no_lists(limb):
    expected = predict(limb, [[1.0, 2.0]], [3], [0.5])
    for drives, places, amplitudes in (
        ([1.0, 2.0], 3, 0.5),
        ([1, 2], np.int64(3), [0.5]),
        (((1, 2),), np.array([3]), (0.5,)),
    ):
        np.testing.assert_array_equal(predict(limb, drives, places, amplitudes), expected)


def test_what_is_handed_over_is_not_changed_and_what_is_returned_may_be(limb):
    drives, taps = DRIVES[:2].copy(), limb.response_to(7).copy()
    drives.flags.writeable = False
    for scaling in SCALINGS:
        first = predict(limb, drives, [7, 8], [2.0, 3.0], scaling)
        copy = first.copy()
        first[...] = 0.0
        assert (predict(limb, drives, [7, 8], [2.0, 3.0], scaling) == copy).all()
    np.testing.assert_array_equal(limb.response_to(7), taps)


@pytest.mark.parametrize(
    ("drives", "places", "amplitudes", "message"),
    [
        *(
            (np.ones((2, 5)), [7, place], None, f"input location {place!r} does not exist")
            for place in (0, 21, -1, True, 2.5, 7.0, "7", None, np.nan, np.True_)
        ),
        *(
            (np.ones((2, 5)), places, None, "does not exist")
            for places in ([[1], [2, 3]], [[1, 2]], np.array([[1, 2]]), [np.array([1])])
        ),
        *(
            (np.ones((2, 5)), places, None, f"{len(places)} locations for 2 drives")
            for places in ([], [1], [1, 2, 3])
        ),
        *(
            (np.ones(shape), [1], None, f"drives has shape {shape}")
            for shape in ((1, 0), (0, 5), (1, 1, 5), ())
        ),
        ([], [], None, "at least one input and one sample"),
        *(
            (np.ones((2, 5)), [1, 2], amplitudes, "expected (2,): one for each drive")
            for amplitudes in ([], [1.0], [1.0, 2.0, 3.0], [[1.0, 2.0]], 1.0)
        ),
        (np.ones((2, 5)), [1, 2], [1j, 2], "amplitudes holds complex"),
        (np.ones((2, 5)), [1, 2], [1.0, 1e300], "expected finite numbers"),
    ],
)
def test_what_cannot_be_predicted_is_refused(limb, drives, places, amplitudes, message):
    with pytest.raises(InvalidInputError, match=re.escape(message)):
        predict(limb, drives, places, amplitudes)
    assert limb.bytes_read == 0


def test_only_the_responses_of_places_in_use_are_read(limb):
    predict(limb, np.ones((3, 10)), [7, 9, 7])
    predict(limb, np.ones((1, 10)), [9])
    assert limb.bytes_read == 2 * 72 * 3 * 522 * 8


@pytest.mark.parametrize("scaling", SCALINGS)
def test_the_second_prediction_transforms_no_response_and_gives_the_same_bits(limb, scaling):
    work, responses = [], []
    for _ in range(2):
        with counting() as counted:
            responses.append(predict(limb, DRIVES, PLACES, scaling=scaling).tobytes())
        work.append(counted.forward_transforms)
    assert work == [20 * (216 + 1), 20]
    assert responses[0] == responses[1]


@pytest.mark.parametrize("scaling", SCALINGS)
def test_of_a_place_that_is_used_alone_spectra_are_kept_from_the_second_time_on(limb, scaling):
    responses, work = [], []
    for _ in range(3):
        with counting() as counted:
            responses.append(predict(limb, DRIVES[:1], [7], [-0.5], scaling=scaling).tobytes())
        work.append((counted.forward_transforms, prediction._cached_spectra()._sum() > 0))
    assert work == [(217, False), (217, True), (1, True)]
    assert responses[0] == responses[1] == responses[2]
    predict(limb, DRIVES[:2], [7, 8], scaling=scaling)
    with counting() as counted:
        predict(limb, DRIVES[:1], [8], scaling=scaling)
    assert counted.forward_transforms == 1


def test_a_gain_belongs_to_a_drive_at_a_place_of_a_limb(limb):
    predict(limb, DRIVES, PLACES, scaling="upstream")
    changed = DRIVES.copy()
    changed[4, 100] += 0.5
    with counting() as again:
        predict(limb, DRIVES, PLACES, scaling="upstream")
    with counting() as step:
        predict(limb, changed, PLACES, scaling="upstream")
    assert again.search_transforms == 0
    assert 0 < step.search_transforms <= 216
    other = ss.load_limb("synthetic-2")
    for used_limb, places in ((limb, (7, 3)), (other, (7, 3)), (limb, (3, 7))):
        response = predict(used_limb, DRIVES[[0, 0]], places, scaling="upstream")
        prediction._cached_gains.cache_clear()
        again = predict(used_limb, DRIVES[[0, 0]], places, scaling="upstream")
        assert response.tobytes() == again.tobytes()


def test_one_input_alone_is_transformed_back_once_and_asks_for_no_second_thread(limb, monkeypatch):
    asked = []
    submit = ThreadPoolExecutor.submit
    monkeypatch.setattr(
        ThreadPoolExecutor, "submit", lambda *task: (asked.append("one"), submit(*task))[1]
    )
    for _ in range(3):
        with counting() as work:
            predict(limb, DRIVES[:1], [7])
        assert work.inverse_transforms == 216
    assert not asked
    predict(limb, DRIVES[:2], [7, 8])
    assert asked


def test_a_limb_that_is_freed_frees_its_spectra():
    limb = ss.load_limb("synthetic-1")
    predict(limb, np.ones((20, 1300)), PLACES, scaling="relative")
    # Half of the budget.
    assert 60e6 < prediction._cached_spectra()._sum() < 70e6
    del limb
    gc.collect()
    assert prediction._cached_spectra()._sum() == 0


def test_threads_predict_the_same(limb):
    expected = predict(limb, DRIVES, PLACES, scaling="upstream")
    prediction._cached_spectra.cache_clear()
    with ThreadPoolExecutor(4) as pool:
        responses = list(
            pool.map(lambda _: predict(limb, DRIVES, PLACES, scaling="upstream"), range(8))
        )
    assert all(response.tobytes() == expected.tobytes() for response in responses)
