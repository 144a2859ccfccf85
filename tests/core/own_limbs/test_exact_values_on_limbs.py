"""Exact values on a limb of a lab, against other sums of the same."""

import io
from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from skinsource.errors import InvalidInputError
from skinsource.method_comparison.compared_limb import limb_called
from skinsource.method_comparison.direct_sums import (
    SAMPLES_PER_WINDOW,
    exact_response,
    write_references,
)
from skinsource.method_comparison.made_up import made_up_drive
from skinsource.method_comparison.references import load_reference
from skinsource.method_comparison.scenes import Player, scene_of
from tests.core.own_limbs.compared import keep, tiny
from tests.core.own_limbs.lab_bench import N_TAPS, response


def response_at(scene, channel, sample):
    """One sample of the response, by mpmath, from what the lab handed over."""
    total = mpmath.mpf(0)
    for player in scene.players:
        taps = response(player.location).reshape(-1, N_TAPS)[channel]
        drive = made_up_drive(player.seed, player.n_times)
        end = sample - player.start
        pairs = [
            (mpmath.mpf(float(taps[k])), mpmath.mpf(float(drive[end - k])))
            for k in range(N_TAPS)
            if 0 <= end - k < drive.size
        ]
        total += mpmath.mpf(player.amplitude) * mpmath.fdot(pairs)
    return total


@pytest.mark.parametrize("key", ["S2", "S6"])
def test_exact_values_of_a_limb_agree_with_sums_of_fifty_digits(lab, key):
    scene = scene_of(key, limb_called("lab-1"))
    reference = exact_response(scene)
    random = np.random.default_rng(3)
    with mpmath.workdps(50):
        for _ in range(20):
            c, w, k = (random.integers(0, n) for n in reference.high.shape)
            channel, sample = int(reference.channels[c]), int(reference.samples[c, w, k])
            exact = response_at(scene, channel, sample)
            found = mpmath.mpf(reference.high[c, w, k]) + mpmath.mpf(reference.low[c, w, k])
            assert abs(found - exact) <= reference.bound * reference.peaks[c].max()
    assert reference.bound < 1e-30
    assert scene.response_samples % 400
    assert (reference.samples < scene.response_samples).all()


@pytest.mark.parametrize("key", ["S1", "S6"])
def test_on_the_made_up_limb_they_are_what_comes_with_the_program(key):
    found, kept = exact_response(scene_of(key)), load_reference(key)
    for name in ("channels", "starts", "peaks"):
        np.testing.assert_array_equal(getattr(found, name), getattr(kept, name))
    # The other samples of each window were drawn in another order.
    for name in ("samples", "high"):
        largest, expected = getattr(found, name)[..., 0], getattr(kept, name)[..., 0]
        np.testing.assert_array_equal(largest, expected)


def exact_at(taps, drive, sample):
    """One sample of the convolution, as a fraction."""
    return sum(
        Fraction(float(tap)) * Fraction(float(drive[sample - delay]))
        for delay, tap in enumerate(taps)
        if 0 <= sample - delay < len(drive)
    )


def test_what_is_left_out_of_tiny_taps_is_within_the_bound(user_data):
    """An output 600 dB below another is cut off: pieces of 120 bits in all hold 20 bits of it."""
    taps = np.zeros((1, 2, 1, 5))
    taps[0, 0, 0, 0] = 1.0
    taps[0, 1, 0] = 2.0**-100 * np.array([1.0, -3.0, 1.7, 0.3, -0.1]) / 7.0
    limb = keep("steep", taps)
    scene = replace(scene_of("S1", limb), players=(Player(location=1, seed=1, n_times=40),))
    reference, drive = exact_response(scene), made_up_drive(1, 40)
    deviations = []
    for k, sample in enumerate(reference.samples[1, 0]):
        found = Fraction(reference.high[1, 0, k]) + Fraction(reference.low[1, 0, k])
        deviations.append(abs(exact_at(taps[0, 1, 0], drive, sample) - found))
    peak = reference.peaks[1].max()
    assert 1e-9 * peak < max(deviations) <= reference.bound * peak
    assert reference.bound < 1e-4


def test_long_responses_are_summed_without_rounding(user_data):
    """All of one sign and so many that their sum passes 2^53, unless they are summed in parts."""
    n = 40_000
    taps = np.random.default_rng(2).uniform(0.5, 1.0, (1, 1, 1, n))
    limb = keep("long", taps)
    scene = replace(scene_of("S1", limb), players=(Player(location=1, seed=1, n_times=n),))
    reference, drive = exact_response(scene), made_up_drive(1, n)
    window = int(np.abs(reference.starts - n).argmin())
    exact = exact_at(taps[0, 0, 0], drive, int(reference.samples[0, window, 0]))
    assert reference.high[0, window, 0] == float(exact)
    assert reference.low[0, window, 0] == float(exact - Fraction(float(exact)))


@pytest.mark.parametrize(("rate_hz", "step"), [(5_120.0, 1), (5_130.0, 2), (20_000.0, 4)])
def test_the_largest_of_at_most_512_samples_of_a_window_is_among_them(user_data, rate_hz, step):
    taps = np.random.default_rng(6).normal(size=(1, 1, 1, 3))
    limb = keep("fast", taps, sample_rate_hz=rate_hz)
    n_times = round(0.35 * rate_hz)
    scene = replace(scene_of("S1", limb), players=(Player(location=1, seed=1, n_times=n_times),))
    reference, played = exact_response(scene), np.convolve(taps[0, 0, 0], made_up_drive(1, n_times))
    for w, start in enumerate(reference.starts):
        window = played[start : start + round(0.1 * rate_hz)]
        largest = int(np.argmax(np.abs(window[::step]))) * step
        assert reference.samples[0, w, 0] == start + largest
        assert reference.peaks[0, w] >= np.abs(window[largest]) * (1.0 - 1e-12)


def test_a_turned_input_leaves_out_as_much_as_another(user_data):
    taps = np.array([1.0, 2.0**-110 / 7.0]).reshape(1, 1, 1, 2)
    limb, bounds = keep("steep", taps), []
    for amplitude in (1.0, -1.0):
        player = Player(location=1, seed=1, n_times=40, amplitude=amplitude)
        bounds.append(exact_response(replace(scene_of("S1", limb), players=(player,))).bound)
    assert bounds[0] == bounds[1] > 2.0**-106


def test_responses_that_are_no_numbers_have_no_exact_values(lab, monkeypatch):
    scene = tiny(limb_called("lab-1"))
    limb = scene.limb.load()
    damaged = limb.response_to(7).copy()
    damaged[0, 0, 3] = np.nan
    monkeypatch.setattr(type(limb), "response_to", lambda *_: damaged)
    with pytest.raises(InvalidInputError, match="lab-1: a response to input location 7 is not fin"):
        exact_response(scene)


def test_exact_values_are_the_same_bits_each_time(lab, tmp_path):
    scene = tiny(limb_called("lab-1"))
    contents = []
    for name in ("a", "b"):
        write_references(tmp_path / name, {"S1": exact_response(scene)})
        with np.load(io.BytesIO((tmp_path / name).read_bytes())) as stored:
            contents.append({key: stored[key].tobytes() for key in stored})
    assert contents[0] == contents[1]
    assert load_reference("S1").samples.shape[2] == SAMPLES_PER_WINDOW
