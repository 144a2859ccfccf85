"""What `predict` remembers of limbs: bounded, freed with them, and without effect on numbers."""

import gc
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from scipy.signal import fftconvolve

import skinsource as ss
from skinsource.base.work import counting
from skinsource.engine import prediction
from skinsource.engine.prediction import SpectraOfLimbs

DRIVES = np.random.default_rng(3).standard_normal((20, 325))
PLACES = range(1, 21)


@pytest.fixture(autouse=True)
def nothing_cached_spectra():
    prediction._cached_spectra.cache_clear()
    prediction._cached_gains.cache_clear()
    yield
    prediction._cached_spectra.cache_clear()
    prediction._cached_gains.cache_clear()


@pytest.fixture
def limb() -> ss.Limb:
    return ss.load_limb("synthetic-1")


@pytest.mark.parametrize("scaling", ["relative", "upstream", "probe"])
def test_the_second_prediction_transforms_no_response_and_gives_the_same_bits(limb, scaling):
    with counting() as first:
        expected = ss.predict(limb, DRIVES, PLACES, scaling=scaling)
    with counting() as second:
        response = ss.predict(limb, DRIVES, PLACES, scaling=scaling)
    assert first.forward_transforms == 20 * (216 + 1)
    assert second.forward_transforms == 20
    assert response.tobytes() == expected.tobytes()


@pytest.mark.parametrize("scaling", ["relative", "upstream", "probe"])
def test_of_a_place_that_is_used_alone_spectra_are_kept_from_the_second_time_on(limb, scaling):
    responses, work = [], []
    for _ in range(3):
        with counting() as counted:
            responses.append(ss.predict(limb, DRIVES[:1], [7], [-0.5], scaling=scaling).tobytes())
        work.append((counted.forward_transforms, prediction._cached_spectra().held_bytes > 0))
    assert work == [(217, False), (217, True), (1, True)]
    assert responses[0] == responses[1] == responses[2]


def test_where_one_drive_of_several_changed_only_its_maximum_is_searched_for(limb):
    ss.predict(limb, DRIVES, PLACES)
    changed = DRIVES.copy()
    changed[4, 100] += 0.5
    with counting() as again:
        ss.predict(limb, DRIVES, PLACES)
    with counting() as step:
        response = ss.predict(limb, changed, PLACES)
    assert again.search_transforms == 0
    assert 0 < step.search_transforms <= 216
    prediction._cached_gains.cache_clear()
    assert response.tobytes() == ss.predict(limb, changed, PLACES).tobytes()


def test_the_same_drive_elsewhere_or_on_another_limb_has_a_gain_of_its_own(limb):
    drives = np.vstack((DRIVES[0], DRIVES[0]))
    other = ss.load_limb("synthetic-2")
    for used_limb, places in ((limb, (7, 3)), (other, (7, 3)), (limb, (3, 7))):
        response = ss.predict(used_limb, drives, places)
        prediction._cached_gains.cache_clear()
        assert response.tobytes() == ss.predict(used_limb, drives, places).tobytes()


def test_one_input_alone_is_transformed_back_once(limb):
    with counting() as work:
        ss.predict(limb, DRIVES[:1], [7])
    assert work.inverse_transforms == 216


@pytest.mark.parametrize("n_times", [1, 325, 1300, 5200])
def test_one_input_alone_is_the_convolution_however_it_is_cut_into_parts(limb, n_times):
    drive = np.random.default_rng(5).standard_normal(n_times)
    expected = fftconvolve(limb.response_to(7), drive[None, None], axes=-1)
    # Transformed and forgotten, transformed and kept, remembered.
    for _ in range(3):
        response = ss.predict(limb, drive, 7, scaling="relative")
        np.testing.assert_allclose(response, expected, rtol=0, atol=1e-13 * np.abs(expected).max())


def test_what_is_predicted_may_be_written_to_without_effect_on_the_next(limb):
    first = ss.predict(limb, DRIVES[:1], [7])
    copy = first.copy()
    first[...] = 0.0
    assert (ss.predict(limb, DRIVES[:1], [7]) == copy).all()


ONE = 216 * (576 // 2 + 1) * 16


def test_the_limbs_lengths_and_scalings_that_were_not_used_for_longest_go_first():
    first, second = ss.load_limb("synthetic-1"), ss.load_limb("synthetic-2")
    spectra = SpectraOfLimbs(budget_bytes=3 * ONE)
    spectra.of(first, [1], "relative", 576)
    spectra.of(first, [1], "probe", 576)
    spectra.of(second, [1], "relative", 576)
    assert spectra.held_bytes == 3 * ONE
    spectra.of(first, [1], "relative", 576)
    spectra.of(first, [2], "relative", 576)
    assert spectra.held_bytes == 3 * ONE
    with counting() as work:
        spectra.of(first, [2, 1], "relative", 576)
        spectra.of(first, [1], "probe", 576)
    assert work.forward_transforms == 0
    with counting() as work:
        spectra.of(second, [1], "relative", 576)
    assert work.forward_transforms == 216


@pytest.mark.parametrize("fitting", [0, 2])
def test_what_is_larger_than_the_budget_is_given_and_kept_as_far_as_it_fits(limb, fitting):
    spectra = SpectraOfLimbs(budget_bytes=fitting * ONE)
    for counted in (4, 4 - fitting):
        with counting() as work:
            used = spectra.of(limb, [3, 3, 4, 5, 6], "relative", 576)
        assert work.forward_transforms == counted * 216
        assert spectra.held_bytes == fitting * ONE
        for spectrum, place in zip(used, (3, 3, 4, 5, 6), strict=True):
            expected = np.fft.rfft(limb.response_to(place), 576)
            np.testing.assert_allclose(spectrum.values, expected, rtol=0, atol=1e-12)


def test_a_limb_that_is_freed_frees_its_spectra():
    limb = ss.load_limb("synthetic-1")
    ss.predict(limb, DRIVES[:2], [1, 2])
    assert prediction._cached_spectra().held_bytes > 0
    del limb
    gc.collect()
    assert prediction._cached_spectra().held_bytes == 0


def test_threads_predict_the_same(limb):
    expected = ss.predict(limb, DRIVES, PLACES)
    prediction._cached_spectra.cache_clear()
    with ThreadPoolExecutor(4) as pool:
        responses = list(pool.map(lambda _: ss.predict(limb, DRIVES, PLACES), range(8)))
    assert all(response.tobytes() == expected.tobytes() for response in responses)
