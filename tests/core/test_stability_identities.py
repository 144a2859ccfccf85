"""What must hold whatever the numbers are: no reference is needed."""

from dataclasses import replace

import numpy as np
import pytest

SEED = 1300
OUTPUTS = (1, 20, 40, 72)
LENGTHS = [900, 16_000]


def noise(n: int, *seed: int) -> np.ndarray:
    return np.random.default_rng((SEED, *seed)).uniform(-1, 1, n)


def synthetic_response(place: int) -> np.ndarray:
    decay = 0.5 ** (np.arange(522) / 60)
    return np.random.default_rng((SEED, place)).uniform(-1, 1, (72, 3, 522)) * decay


@pytest.fixture(scope="module")
def limb(limb_of):
    return limb_of(synthetic_response)


def difference(values: np.ndarray, expected: np.ndarray) -> float:
    """Largest difference, relative to the peak of the channel."""
    peak = np.abs(expected).max(axis=-1)
    return float((np.abs(values - expected).max(axis=-1) / peak).max())


@pytest.mark.parametrize("onset", [0, 1, 137, 16_000])
def test_a_single_sample_gives_the_response_and_a_later_one_the_same_later(
    scene, limb, noted, onset
):
    single = scene(limb=limb, drives=(np.ones(1),), places=(4,), onsets=(onset,))
    for field in single.both_ways():
        noted("a9 impulse", difference(field[..., onset:], limb.response_to(4)))
    drive = noise(300, 1)
    once = scene(limb=limb, drives=(drive,), places=(4,)).both_ways()
    later = scene(limb=limb, drives=(drive,), places=(4,), onsets=(onset,)).both_ways()
    for field, expected in zip(later, once, strict=True):
        noted("a9 shift", difference(field[..., onset:], expected))


METHODS = ("mag", "pca", "rms", "soc")


@pytest.fixture(scope="module", params=LENGTHS)
def once(request, scene, limb):
    """Give a scene, its field both ways, and its levels by method."""
    drives = noise(request.param, 1), noise(request.param, 2)
    single = scene(limb=limb, drives=drives, places=(4, 5), amplitudes=(0.7, -0.3))
    levels = {way: single.by_engine(OUTPUTS, method=way)["output_rms"] for way in METHODS}
    return single, single.both_ways(), levels


@pytest.mark.parametrize("power", [-90, -7, 1, 90])
def test_powers_of_two_scale_every_bit(once, limb_of, noted, power):
    once, fields, levels = once
    drives, size = once.drives, 2.0**power
    louder = limb_of(lambda place: synthetic_response(place) * size)
    scaled = [
        replace(once, drives=(drives[0] * size, drives[1] * size)),
        replace(once, limb=louder),
    ]
    if abs(power) < 10:
        scaled.append(replace(once, amplitudes=(0.7 * size, -0.3 * size)))
    for scaled_scene in scaled:
        for field, expected in zip(scaled_scene.both_ways(), fields, strict=True):
            noted("a9 powers", np.count_nonzero(field != expected * size))
        for method, expected in levels.items():
            field = scaled_scene.by_engine(OUTPUTS, method=method)["output_rms"]
            noted("a9 powers", np.count_nonzero(field != expected * size))


@pytest.mark.parametrize("n_times", LENGTHS)
def test_prediction_is_linear(scene, limb, noted, n_times):
    x, y = noise(n_times, 1), noise(n_times, 2)
    together = scene(limb=limb, drives=(2.5 * x - 0.75 * y,), places=(4,)).both_ways()
    separate = scene(limb=limb, drives=(x, y), places=(4, 4), amplitudes=(2.5, -0.75)).both_ways()
    for field, expected in zip(together, separate, strict=True):
        noted("a9 sum", difference(field, expected))


@pytest.mark.parametrize("n_times", LENGTHS)
def test_neither_the_order_of_inputs_nor_the_selection_matters(scene, limb, noted, n_times):
    random = np.random.default_rng(SEED)
    drives = [noise(n_times, k) for k in range(6)]
    places, amplitudes = (
        [3, 3, 20, 1, 8, 13],
        [float(amplitude) for amplitude in random.uniform(-2, 2, 6)],
    )
    inputs = list(zip(drives, places, amplitudes, strict=True))
    scenes = []
    for order in (range(6), random.permutation(6), random.permutation(6)):
        columns = tuple(zip(*(inputs[k] for k in order), strict=True))
        scenes.append(scene(limb=limb, drives=columns[0], places=columns[1], amplitudes=columns[2]))
    expected = scenes[0].predicted()
    for order_scene in scenes:
        for field in (*order_scene.both_ways(), order_scene.by_engine(selected=3)["axis_traces"]):
            noted("a9 order", difference(field, expected))
