"""Exact values of the benchmark: what is stored is what comes out of exact arithmetic."""

import importlib.util
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
import pytest

from skinsource.errors import FileFormatError
from skinsource.files.assets import data_folder
from skinsource.limb import N_TAPS
from skinsource.method_comparison.compared_limb import sha256_of
from skinsource.method_comparison.made_up import (
    DRIVE_EXPONENT,
    RESPONSE_EXPONENT,
    made_up_drive,
    made_up_limb,
    made_up_response,
    whole_drive,
    whole_response,
)
from skinsource.method_comparison.references import FILE_NAME, WINDOW_SAMPLES, load_reference
from skinsource.method_comparison.scenes import SCENES, scene_of

SCRIPT = Path(__file__).parents[1] / "references" / "comparison" / "make_references.py"
RESPONSES_SHA256 = "37350e40367e0f626dd31c3b5e813522258d9654784263e515085348bd5d059d"


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("make_references", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_responses_are_the_same_bits_on_every_machine():
    assert sha256_of(made_up_limb()) == RESPONSES_SHA256


def test_responses_and_drives_are_whole_numbers_that_float64_holds():
    response, drive = whole_response(7), whole_drive(100, 5000)
    assert np.abs(response).max() < 2**40
    assert np.abs(drive).max() <= 2**39
    assert [Fraction(x) for x in made_up_response(7)[3, 1, 60:70]] == [
        int(k) * Fraction(2) ** RESPONSE_EXPONENT for k in response[3, 1, 60:70]
    ]
    assert [Fraction(x) for x in made_up_drive(100, 5000)[:9]] == [
        int(k) * Fraction(2) ** DRIVE_EXPONENT for k in drive[:9]
    ]


def test_neither_responses_nor_drives_fit_float32():
    """Otherwise rounding of what goes in would be missing from the error of float32."""
    for values in (made_up_response(7)[:, 2, 80], made_up_drive(100, 100)):
        assert (values.astype(np.float32) != values).mean() > 0.9


def test_different_places_and_seeds_differ():
    assert (made_up_response(1) != made_up_response(2)).any()
    first, second = made_up_drive(100, 4000), made_up_drive(101, 4000)
    assert abs(np.corrcoef(first, second)[0, 1]) < 0.06


def test_nothing_arrives_at_once_and_little_is_left_at_the_end():
    response = np.abs(made_up_response(7))
    assert not response[..., :12].any()
    assert response[..., -1].max() < 1e-5 * response.max()


def test_the_made_up_limb_reads_only_what_is_touched():
    limb = made_up_limb()
    assert limb.bytes_read == 0
    np.testing.assert_array_equal(limb.response_to(4), made_up_response(4))


@pytest.mark.parametrize("key", [scene.key for scene in SCENES])
def test_stored_values_agree_with_sums_of_fifty_digits(key):
    scene, reference = scene_of(key), load_reference(scene_of(key).reference)
    random = np.random.default_rng(3)
    with mpmath.workdps(50):
        for _ in range(4):
            c, w, k = (random.integers(0, n) for n in reference.high.shape)
            channel, sample = int(reference.channels[c]), int(reference.samples[c, w, k])
            exact = response_at(scene, channel, sample)
            stored = mpmath.mpf(reference.high[c, w, k]) + mpmath.mpf(reference.low[c, w, k])
            assert abs(stored - exact) <= mpmath.mpf(2) ** -76 * abs(exact), (key, c, w, k)


def response_at(scene, channel, sample):
    """One sample of the response, by mpmath."""
    total = mpmath.mpf(0)
    for player in scene.players:
        taps = made_up_response(player.location)[channel // 3, channel % 3]
        end = sample - player.start + 1
        drive = made_up_drive(player.seed, min(player.n_times, max(end, 0)))
        begin = max(end - N_TAPS, 0)
        pairs = [
            (mpmath.mpf(float(drive[n])), mpmath.mpf(float(taps[end - 1 - n])))
            for n in range(begin, drive.size)
        ]
        total += mpmath.mpf(player.amplitude) * mpmath.fdot(pairs)
    return total


def test_the_script_makes_what_is_stored(script):
    scene, stored = scene_of("S6"), load_reference("S6")
    starts = script.window_starts(scene)
    np.testing.assert_array_equal(starts, stored.starts)
    made = script.reference_of(scene, starts[:2])
    np.testing.assert_array_equal(made["channels"], stored.channels)
    np.testing.assert_array_equal(made["high"], stored.high[:, :2])
    np.testing.assert_array_equal(made["low"], stored.low[:, :2])
    np.testing.assert_array_equal(made["peaks"], stored.peaks[:, :2])


@pytest.mark.parametrize("key", sorted({scene.reference for scene in SCENES}))
def test_the_largest_sample_of_each_window_is_stored(key):
    reference = load_reference(key)
    np.testing.assert_array_equal(np.abs(reference.high).max(axis=2), reference.peaks)
    assert (reference.samples >= reference.starts[None, :, None]).all()
    assert (reference.samples < reference.starts[None, :, None] + WINDOW_SAMPLES).all()
    assert reference.samples.max() < scene_of(key).response_samples


def test_the_quiet_burst_is_120_db_below_the_loud_one():
    reference = load_reference("S6")
    windows = np.arange(reference.starts.size)
    loud = reference.peaks[:, windows < 4].max(axis=1)
    quiet = reference.peaks[:, (windows >= 12) & (windows < 18)].max(axis=1)
    assert (np.abs(20 * np.log10(quiet / loud) + 120) < 6).all()
    assert (reference.peaks == 0.0).any(), "no silence between the bursts"


def test_the_stored_values_are_small_enough_to_ship():
    assert (data_folder() / FILE_NAME).stat().st_size < 300_000


def test_a_damaged_file_is_explained(tmp_path):
    path = tmp_path / FILE_NAME
    for content in (b"", b"PK\x03\x04 nonsense", (data_folder() / FILE_NAME).read_bytes()[:5000]):
        path.write_bytes(content)
        with pytest.raises(FileFormatError, match="Install SkinSource studio again"):
            load_reference("S1", path)
    with pytest.raises(FileFormatError, match="cannot be read"):
        load_reference("S9")
