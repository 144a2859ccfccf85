"""Accuracy of convolution, against exact numbers."""

from collections.abc import Callable

import numpy as np
import pytest

from skinsource.design.waveforms import Noise, Tap, Tone
from skinsource.engine.transforms import BLOCK_FFT, length_at_once
from skinsource.limbs.synthetic import load_synthetic_limb

SEED = 20240607
EPS = float(np.finfo(np.float64).eps)
WINDOW_SAMPLES = 130
#: Below it, relative to the peak of the channel, a window is not looked at: -126 dB.
FAINTEST = 5e-7
#: Three outputs, all axes, and what stands for all of them: traces take long to compute exactly.
OUTPUTS = (1, 29, 52, 72)
LENGTHS = (1, 2, 521, 522, 523, 650, 13_000, 130_000, 780_000)


def whole_numbers(n: int, seed: int) -> np.ndarray:
    """A drive of whole numbers: with those of a limb, float64 sums them exactly in any order."""
    drive = np.random.default_rng((SEED, seed)).integers(-(2**18), 2**18, n).astype(float)
    drive[0] = drive[-1] = 3.0
    return drive


@pytest.fixture(scope="module")
def limb(limb_of):
    """Responses of whole numbers that decay, some 60 dB weaker than others."""

    def respond(place: int) -> np.ndarray:
        random = np.random.default_rng((SEED, 99, place))
        decay = 0.5 ** (np.arange(522) / random.uniform(20, 80, (72, 3, 1)))
        level = 2.0 ** random.integers(10, 21, (72, 1, 1))
        return np.round(level * decay * random.uniform(-1, 1, (72, 3, 522)))

    return limb_of(respond)


def exact_traces(scene, outputs=OUTPUTS) -> np.ndarray:
    """Traces by sums of whole numbers below 2**53, (n_outputs, 3, n_times)."""
    total = np.zeros((len(outputs), 3, scene.padded().shape[1] + 521))
    largest = 0.0
    # Silence before and after a drive adds nothing, but would take most of the time.
    columns = scene.drives, scene.starts(), scene.places, scene.factors()
    for drive, start, place, amplitude in zip(*columns, strict=True):
        taps = scene.limb.response_to(place)
        for index in np.ndindex(len(outputs), 3):
            signal = np.convolve(drive, taps[outputs[index[0]] - 1, index[1]])
            total[index][start : start + signal.size] += amplitude * signal
        largest += abs(amplitude) * np.abs(drive).max() * np.abs(taps).sum(axis=-1).max()
    assert largest < 2**53
    return total


def error(values: np.ndarray, exact: np.ndarray) -> float:
    """Largest difference, relative to the peak of the channel."""
    difference = np.abs(values - exact).max(axis=-1)
    return float((difference / np.abs(exact).max(axis=-1)).max())


def window_error(values: np.ndarray, exact: np.ndarray) -> float:
    """Largest difference, relative to the peak of the window of 100 ms that it lies in."""
    n = exact.shape[-1] // WINDOW_SAMPLES * WINDOW_SAMPLES
    shape = (*exact.shape[:-1], -1, WINDOW_SAMPLES)
    peaks = np.abs(exact[..., :n]).reshape(shape).max(axis=-1)
    differences = np.abs(values - exact)[..., :n].reshape(shape).max(axis=-1)
    audible = peaks > FAINTEST * np.abs(exact).max(axis=-1, keepdims=True)
    return float((differences[audible] / peaks[audible]).max())


def ratio(values: np.ndarray, exact: np.ndarray, scene) -> float:
    """Largest error over eps log2(N) Σ‖drive‖ ‖response‖."""
    n = exact.shape[-1]
    n_fft = length_at_once(n, len(set(scene.places)), 216) or BLOCK_FFT
    bound = np.zeros(exact.shape[:2])
    rows = [output - 1 for output in OUTPUTS]
    for drive, place in zip(scene.drives, scene.places, strict=True):
        taps = scene.limb.response_to(place)[rows]
        bound += np.linalg.norm(drive) * np.linalg.norm(taps, axis=-1)
    return float((np.abs(values - exact).max(axis=-1) / (EPS * np.log2(n_fft) * bound)).max())


def level_error(rms: np.ndarray, exact: np.ndarray, share: float = 1.0) -> float:
    """Largest error of the RMS of `OUTPUTS`, a ``share`` of the exact one and relative to that."""
    expected = np.sqrt(np.square(exact / 2**20).sum(axis=(1, 2)) / exact.shape[-1]) * 2**20
    return float(np.abs(chosen(rms) / expected - share).max())


def chosen(field: np.ndarray) -> np.ndarray:
    """The rows of `OUTPUTS`."""
    return field[[output - 1 for output in OUTPUTS]]


@pytest.mark.parametrize("n_inputs", [1, 4, 20])
@pytest.mark.parametrize("n_times", [650, 2600, 13_000])
def test_many_inputs_of_any_length_are_summed_to_the_last_digits(
    scene, limb, noted, n_inputs, n_times
):
    shown = scene(
        limb=limb,
        drives=tuple(whole_numbers(n_times - 13 * k, k) for k in range(n_inputs)),
        places=tuple(range(1, n_inputs + 1)),
        onsets=tuple(13 * k for k in range(n_inputs)),
    )
    exact = exact_traces(shown)
    for selected in (0, None):
        values = shown.by_engine(OUTPUTS, selected, method="mag")
        noted("a1 error", error(values["axis_traces"], exact))
        noted("a1 ratio", ratio(values["axis_traces"], exact, shown))
        noted("a1 levels", level_error(values["output_rms"], exact))
    traces = chosen(shown.predicted())
    noted("a1 error", error(traces, exact))
    noted("a1 ratio", ratio(traces, exact, shown))


@pytest.mark.parametrize("left", 0.5 ** np.array([0, 1, 2, 2.5, 3, 4, 7, 14, 27]))
@pytest.mark.parametrize("n_times", [1300, 9000])
def test_levels_of_inputs_that_cancel_keep_all_digits(scene, limb, limb_of, noted, left, n_times):
    def partly(place: int) -> np.ndarray:
        return np.concatenate([limb.response_to(5)[:, :1], limb.response_to(place)[:, 1:]], axis=1)

    drive = whole_numbers(n_times, 1)
    same = scene(limb=limb, drives=(drive, drive), places=(5, 5), amplitudes=(1.0, left - 1.0))
    other = scene(
        limb=limb_of(partly), drives=(drive, drive), places=(5, 6), amplitudes=(1.0, left - 1.0)
    )
    alone = exact_traces(scene(limb=limb, drives=(drive,), places=(5,)))
    for selected in (0, 1, None):
        levels = same.by_engine(OUTPUTS, selected, method="mag")["output_rms"]
        noted("a1 cancelled", level_error(levels, alone, left))
        levels = other.by_engine(OUTPUTS, selected, axes="x")["output_rms"]
        noted("a1 one axis", level_error(levels, alone[:, :1], left))


@pytest.fixture(scope="module")
def ringing(references, limb_of):
    """Stored drives, fields and a limb whose outputs get the stored responses, each weaker."""
    stored = dict(np.load(references / "convolution.npz"))
    weaker = 2.0 ** -np.arange(72)[:, None, None]

    def respond(place: int) -> np.ndarray:
        return stored["responses"][[0, 1, 0]] * weaker

    stored["limb"] = limb_of(respond)
    stored["weaker"] = weaker
    return stored


@pytest.mark.parametrize("number", [0, 1, 2])
def test_vectors_of_fifty_digits_are_met(scene, ringing, noted, number):
    shown = scene(limb=ringing["limb"], drives=(ringing["drives"][number],), places=(3,))
    exact = ringing["fields"][number][[0, 1, 0]] * ringing["weaker"]
    for field in shown.both_ways():
        noted("a1 mpmath", error(field, exact))
        if number == 2:
            quiet = np.abs(exact[..., 900:1030]).max(axis=-1) / np.abs(exact).max(axis=-1)
            assert (quiet > FAINTEST).all()
            assert (quiet < 1e-5).all()
            noted("a3 mpmath", window_error(field, exact))


@pytest.mark.parametrize("streamed", [False, True])
def test_the_synthetic_limb_s_own_scenes_are_met(scene, noted, streamed):
    limb = load_synthetic_limb(1)
    recipes = (Tone(frequency_hz=100.0), Noise(seed=4, duration_s=1.0), Tap())
    shown = scene(
        limb=limb,
        drives=tuple(recipe.samples(1300.0) for recipe in recipes),
        places=(7, 3, 16),
        amplitudes=(1.0, -0.3, 2.5),
        onsets=(0, 16_000 if streamed else 40, 260),
    )
    random = np.random.default_rng(SEED)
    for field in shown.both_ways():
        for _ in range(60):
            output, axis = int(random.choice(OUTPUTS)), int(random.integers(3))
            trace = field[output - 1, axis]
            time = int(random.choice(np.flatnonzero(trace)))
            exact = float(shown.exact_sample(output, axis, time))
            noted("a1 synthetic", abs(trace[time] - exact) / np.abs(trace).max())


@pytest.mark.parametrize("n_times", [1300, 13_000])
def test_upstream_s_scaling_divides_by_the_exact_maximum(scene, noted, n_times):
    limb, random = load_synthetic_limb(1), np.random.default_rng(SEED)
    drive = Noise(seed=5, duration_s=n_times / 1300).samples(1300.0)
    plain = scene(limb=limb, drives=(drive,), places=(7,))
    shown = scene(limb=limb, drives=(drive,), places=(7,), amplitudes=(1.7,), scaling="upstream")
    for field in shown.both_ways():
        output, axis, time = (int(k) for k in np.unravel_index(field.argmax(), field.shape))
        largest = plain.exact_sample(output + 1, axis, time)
        for _ in range(40):
            time = int(random.integers(field.shape[-1]))
            exact = 1.7 * float(plain.exact_sample(output + 1, axis, time) / largest)
            noted("a1 upstream", abs(field[output, axis, time] - exact) / 1.7)


@pytest.mark.parametrize("n_times", LENGTHS)
def test_any_length_is_met(scene, limb, noted, n_times):
    shown = scene(limb=limb, drives=(whole_numbers(n_times, 1),), places=(11,))
    exact = exact_traces(shown)
    noted("a2 predict", error(chosen(shown.predicted()), exact))
    values = shown.by_engine(OUTPUTS, method="mag")
    noted("a2 engine", error(values["axis_traces"], exact))
    noted("a2 levels", level_error(values["output_rms"], exact))


@pytest.fixture(scope="module")
def quantised(limb_of):
    """Responses of the synthetic limb, rounded to whole numbers."""
    synthetic = load_synthetic_limb(1)

    def respond(place: int) -> np.ndarray:
        taps = synthetic.response_to(place)
        return np.round(taps * (2**20 / np.abs(taps).max(axis=-1, keepdims=True)))

    return limb_of(respond)


@pytest.fixture(params=["limb", "quantised"])
def responding(request) -> Callable:
    """Give each of the two limbs of whole numbers."""
    return request.getfixturevalue(request.param)


@pytest.mark.parametrize("below_db", [40, 80, 114, 120])
@pytest.mark.parametrize("later", [700, 4000, 9000])
@pytest.mark.parametrize("place", [7, 16])
def test_a_quiet_burst_after_a_loud_one_keeps_its_digits(
    scene, responding, noted, below_db, later, place
):
    quieter = 2.0 ** -round(below_db / 6.0206)
    shown = scene(
        limb=responding,
        drives=(whole_numbers(130, 1), whole_numbers(130, 2) * quieter),
        places=(7, place),
        onsets=(0, later),
    )
    exact = exact_traces(shown, tuple(range(1, 73)))
    for field in shown.both_ways():
        noted("a3 window", window_error(field, exact))


@pytest.mark.parametrize("n_times", [30, 1300, 9000])
def test_the_tails_of_responses_keep_their_digits(scene, quantised, noted, n_times):
    shown = scene(limb=quantised, drives=(whole_numbers(n_times, 3),), places=(15,))
    exact = exact_traces(shown)
    for field in shown.both_ways():
        noted("a3 tails", window_error(chosen(field), exact))
