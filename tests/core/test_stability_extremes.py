"""Silence, numbers that are none or of extreme sizes, and identities that need no reference."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.design.design import track
from skinsource.engine.transforms import BLOCK_FFT, transform_length
from tests.core.conftest import refused

SEED = 1300
BAD = (np.nan, np.inf, -np.inf, 1e31, -1e31)
# Twelve channels are as good as 216, and quicker.
OUTPUTS = (1, 20, 40, 72)
LENGTHS = [900, 16_000]
METHODS = ("mag", "pca", "rms", "soc")


def noise(n: int, *seed: int) -> np.ndarray:
    return np.random.default_rng((SEED, *seed)).uniform(-1, 1, n)


def synthetic_response(place: int) -> np.ndarray:
    decay = 0.5 ** (np.arange(522) / 60)
    return np.random.default_rng((SEED, place)).uniform(-1, 1, (72, 3, 522)) * decay


@pytest.fixture(scope="module")
def limb(limb_of):
    return limb_of(synthetic_response)


@pytest.mark.parametrize("gap", [700, 6000])
def test_where_nothing_can_arrive_there_is_exactly_nothing(scene, limb, noted, gap):
    hesitant = np.concatenate([np.zeros(40), noise(60, 1), np.zeros(gap), noise(60, 2)])
    shown = scene(
        limb=limb, drives=(hesitant, noise(100, 3)), places=(2, 9), onsets=(300, gap + 2000)
    )
    spans = [(340, 400), (400 + gap, 460 + gap), (gap + 2000, gap + 2100)]
    affected = np.zeros(gap + 2100 + 521, bool)
    for start, end in spans:
        affected[start : end + 521] = True
    for field in shown.both_ways():
        noted("a4 silence", np.count_nonzero(field[..., ~affected]))
        assert field[..., affected].any(axis=(0, 1)).all()


@pytest.mark.parametrize("n_times", LENGTHS)
def test_outputs_without_a_response_and_silent_scenes_are_exactly_still(
    scene, limb_of, noted, n_times
):
    def deaf(place: int) -> np.ndarray:
        response = synthetic_response(place)
        response[10:20] = 0.0
        response[30, 1] = 0.0
        return response

    shown = scene(limb=limb_of(deaf), drives=(noise(n_times, 1), noise(n_times, 2)), places=(4, 5))
    for field in shown.both_ways():
        noted("a4 still", np.count_nonzero(field[10:20]) + np.count_nonzero(field[30, 1]))
    levels = shown.by_engine(OUTPUTS)["output_rms"]
    noted("a4 still", np.count_nonzero(levels[10:20]))
    silent = replace(shown, drives=(np.zeros(n_times), noise(n_times, 2)), amplitudes=(1.0, 0.0))
    for field in silent.both_ways():
        noted("a4 still", np.count_nonzero(field))
    noted("a4 still", np.count_nonzero(silent.by_engine(OUTPUTS)["output_rms"]))


@pytest.mark.parametrize("n_times", LENGTHS)
def test_inputs_that_are_not_heard_change_no_bit(scene, limb, noted, n_times):
    drives = noise(n_times, 1), noise(n_times, 2)
    alone = scene(limb=limb, drives=drives, places=(4, 5))
    beside = scene(
        limb=limb,
        drives=(*drives, noise(n_times, 3), np.zeros(n_times)),
        places=(4, 5, 6, 7),
        amplitudes=(1.0, 1.0, 0.0, 3.0),
    )
    for field, expected in zip(beside.both_ways(), alone.both_ways(), strict=True):
        noted("a4 muted", np.count_nonzero(field != expected))


@pytest.mark.parametrize("n_times", LENGTHS)
@pytest.mark.parametrize("value", BAD)
def test_a_sample_that_is_no_usable_number_is_refused_at_the_door(
    scene, limb, noted, value, n_times
):
    bad = noise(n_times, 2)
    bad[777] = value
    shown = scene(limb=limb, drives=(noise(n_times, 1), bad), places=(4, 5))
    noted("a5 drive", refused(shown.predicted, "drive 2, sample 777 ", str(value)))
    silent = replace(shown, amplitudes=(1.0, 0.0))
    noted("a5 drive", refused(silent.predicted, "drive 2, sample 777 ", str(value)))
    for selected in (0, 1, None):
        action = lambda chosen=selected: shown.by_engine(OUTPUTS, chosen)  # noqa: E731
        noted("a5 engine", refused(action, "place 5, ", "sample 777 ", str(value)))


@pytest.mark.parametrize("n_times", LENGTHS)
@pytest.mark.parametrize("value", BAD)
def test_a_tap_that_is_no_usable_number_is_refused_at_the_door(
    scene, limb_of, noted, value, n_times
):
    def broken(place: int) -> np.ndarray:
        response = synthetic_response(place)
        response[11, 2, 345] = value
        return response

    shown = scene(limb=limb_of(broken), drives=(noise(n_times, 1),), places=(4,))
    texts = "made-up", "location 4", "output 12", "axis z", "tap 345 ", str(value)
    noted("a5 response", refused(shown.predicted, *texts))
    noted("a5 response", refused(lambda: shown.by_engine(OUTPUTS), *texts))


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_amplitudes_and_onsets_that_are_no_numbers_are_refused(scene, limb, noted, value):
    shown = scene(limb=limb, drives=(noise(9, 1),), places=(4,), amplitudes=(value,))
    noted("a5 number", refused(shown.predicted, "amplitudes", str(value)))
    noted("a5 number", refused(lambda: track(location=4, amplitude=value), "amplitude"))
    noted("a5 number", refused(lambda: track(location=4, onset_s=value), "onset_s"))


@pytest.mark.parametrize("n_times", LENGTHS)
@pytest.mark.parametrize("of_drive", [1e-30, 1e-15, 1e30])
@pytest.mark.parametrize("of_response", [1e-30, 1.0, 1e30])
def test_peaks_of_any_size_keep_all_digits(
    scene, limb, limb_of, noted, n_times, of_drive, of_response
):
    def sized(place: int) -> np.ndarray:
        response = synthetic_response(place)
        return response * (of_response / np.abs(response).max())

    drive = noise(n_times, 1)
    drive /= np.abs(drive).max()
    shown = scene(limb=limb_of(sized), drives=(drive * of_drive,), places=(4,))
    random = np.random.default_rng(SEED)
    for field in shown.both_ways():
        for _ in range(6):
            output, axis = int(random.choice(OUTPUTS)), int(random.integers(3))
            time = int(random.integers(n_times + 521))
            exact = float(shown.exact_sample(output, axis, time))
            trace = field[output - 1, axis]
            noted("a6 error", abs(trace[time] - exact) / np.abs(trace).max())
    plain = scene(limb=limb, drives=(drive,), places=(4,))
    size = of_drive * of_response / np.abs(synthetic_response(4)).max()
    for method in METHODS:
        field, expected = (
            either.by_engine(OUTPUTS, method=method)["output_rms"] for either in (shown, plain)
        )
        noted("a6 levels", np.abs(field / size / expected - 1).max())


@pytest.mark.parametrize("n_times", LENGTHS)
def test_subnormal_numbers_are_numbers_like_others(scene, limb, limb_of, noted, n_times):
    def fading(place: int) -> np.ndarray:
        return synthetic_response(place) * 0.5 ** (np.arange(522) * 2.2)

    drive = noise(n_times, 1) * np.maximum(0.5 ** np.minimum(np.arange(n_times) * 2.0, 1070.0), 0)
    tails = scene(limb=limb_of(fading), drives=(drive,), places=(4,))
    small = scene(limb=limb, drives=(noise(n_times, 2) * 1e-310,), places=(4,))
    assert (np.abs(drive[600:]) < 1e-308).all()
    assert (np.abs(tails.limb.response_to(4)[..., 500:]) < 1e-308).all()
    # Predicted once: processors are slow with numbers this small.
    by_tails = [field[19, 1] for field in tails.both_ways()]
    by_small = small.predicted()[19, 1]
    for time in (0, 1, 60, 200, 521):
        exact = float(tails.exact_sample(20, 1, time))
        for trace in by_tails:
            noted("a7 tails", abs(trace[time] - exact) / np.abs(trace).max())
        exact = float(small.exact_sample(20, 1, time))
        noted("a7 peaks", abs(by_small[time] - exact) / np.abs(by_small).max())


@pytest.mark.parametrize("n_times", [2600, 16_000])
def test_a_huge_offset_costs_no_more_than_its_own_digits(scene, limb_of, noted, n_times):
    def without_offset(place: int) -> np.ndarray:
        response = np.round(synthetic_response(place) * 2**20)
        response[..., 0] -= response.sum(axis=-1)
        return response

    drive = 1e8 + np.sin(2 * np.pi * 100 * np.arange(n_times) / 1300)
    shown = scene(limb=limb_of(without_offset), drives=(drive,), places=(4,))
    random = np.random.default_rng(SEED)
    n_fft = transform_length(n_times + 521) if n_times < 5000 else BLOCK_FFT
    for field in shown.both_ways():
        for _ in range(20):
            output, axis = int(random.choice(OUTPUTS)), int(random.integers(3))
            time = int(random.integers(521, n_times))
            exact = float(shown.exact_sample(output, axis, time))
            steady = np.abs(field[output - 1, axis, 521:n_times]).max()
            norms = np.linalg.norm(drive) * np.linalg.norm(
                shown.limb.response_to(4)[output - 1, axis]
            )
            wrong = abs(field[output - 1, axis, time] - exact)
            noted("a8 offset", wrong / steady)
            noted("a8 ratio", wrong / (np.finfo(float).eps * np.log2(n_fft) * norms))


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
