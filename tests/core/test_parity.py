"""The measured limbs against figures of the paper, MATLAB, and upstream formulas."""

from pathlib import Path

import numpy as np
import pytest

from skinsource.base.decibels import decibels
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.catalog import load_limb
from skinsource.signals.generators import sinusoid
from skinsource.signals.projection import METHODS, project_axes
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


NAME = "model1_location7_sine100_100ms"
OUTPUTS = [20, 24, 32]


def read(folder: Path, what: str, *shape: int) -> np.ndarray:
    values = np.fromfile(folder / f"{NAME}_{what}.f32", "<f4").astype(np.float64)
    return values.reshape(shape, order="F")


@pytest.fixture
def acceleration(measured) -> np.ndarray:
    return predict(load_limb("measured-1"), [sinusoid(100.0, 0.1)], [7])


def test_the_response_to_a_sine_is_that_of_matlab(acceleration, matlab_reference):
    reference = read(matlab_reference, "response", 651, 72, 3)
    assert_agrees(acceleration, reference.transpose(1, 2, 0), 1e-7)


@pytest.mark.parametrize(
    ("what", "axes", "method"),
    [("z_outputs", "z", "mag"), ("mag_outputs", "xyz", "mag"), ("rms_outputs", "xyz", "rms")],
)
def test_projections_of_the_response_are_those_of_matlab(
    acceleration, matlab_reference, what, axes, method
):
    reference = read(matlab_reference, what, 651, 3)
    projected_signals = project_axes(acceleration, axes, method)[[n - 1 for n in OUTPUTS]]
    assert_agrees(projected_signals, reference.T, 1e-7)


RATE_HZ = 1300


def tukey_tone(frequency_hz: float, n: int) -> np.ndarray:
    """Sine under MATLAB's tukeywin(n, 0.25)."""
    x = np.linspace(0, 1, n)
    rise = (1 + np.cos(np.pi / 0.125 * (x - 0.125))) / 2
    fall = (1 + np.cos(np.pi / 0.125 * (x - 1 + 0.125))) / 2
    envelope = np.select([x < 0.125, x > 0.875], [rise, fall], 1.0)
    return np.sin(2 * np.pi * frequency_hz * np.arange(n) / RATE_HZ) * envelope


def taps(*milliseconds: int) -> list[np.ndarray]:
    """Pulses of MATLAB's hanning(21) from round(1300 t) on, zeros around, of equal length."""
    pulse = 0.5 * (1 - np.cos(2 * np.pi * np.arange(1, 22) / 22))
    starts = [(13 * ms + 5) // 10 for ms in milliseconds]
    return [np.pad(pulse, (start, max(starts) - start)) for start in starts]


def noise(n: int) -> np.ndarray:
    return np.random.default_rng(n).uniform(-1, 1, n)


CASES = {
    "one tone": (1, [tukey_tone(100, 260)], [7], [1.0]),
    "two tones": (3, [tukey_tone(200, 65), tukey_tone(200, 65)], [8, 13], [1.0, 1.0]),
    "taps together": (3, taps(0, 0, 0, 0), [7, 8, 9, 10], [1.0] * 4),
    "taps apart": (4, taps(0, 5, 25, 100), [7, 8, 9, 9], [1.0, -0.5, 2.0, 0.0]),
    "noise, odd": (2, [noise(1000)], [5], [0.7]),
    "noise, even": (2, [noise(131)], [5], [0.7]),
}


def upstream(case: str) -> np.ndarray:
    """Sum of direct convolutions, each divided by its signed maximum, (72, 3, n + 521)."""
    model, drives, places, amplitudes = CASES[case]
    limb = load_limb(f"measured-{model}")
    total = 0.0
    for drive, place, amplitude in zip(drives, places, amplitudes, strict=True):
        channels = limb.response_to(place).reshape(216, 522)
        field = np.array([np.convolve(channel, drive) for channel in channels])
        total = total + amplitude * field / field.max()
    return total.reshape(72, 3, -1)


def predicted(case: str) -> np.ndarray:
    model, drives, places, amplitudes = CASES[case]
    return predict(load_limb(f"measured-{model}"), drives, places, amplitudes)


def projected(acceleration: np.ndarray, axes: str, method: str) -> np.ndarray:
    """Upstream's projection, output by output, sample by time first."""
    result = []
    for output in acceleration:
        signal = output[["xyz".index(axis) for axis in axes]].T
        if len(axes) == 1:
            result.append(signal[:, 0])
        elif method == "mag":
            result.append(np.linalg.norm(signal, axis=1))
        elif method == "soc":
            result.append(sum(signal[:, k] for k in range(len(axes))))
        elif method == "rms":
            sizes = [np.sqrt(np.vdot(column, column) / len(column)) for column in signal.T]
            result.append(signal @ (np.array(sizes) / np.linalg.norm(sizes)))
        else:
            centred = signal - np.mean(signal, axis=0)
            axis = np.linalg.svd(centred, full_matrices=False)[2][0]
            result.append(signal @ (axis * np.sign(axis[np.abs(axis).argmax()])))
    return np.array(result)


def assert_agrees(value: np.ndarray, expected: np.ndarray, relative: float = 1e-12) -> None:
    assert np.shape(value) == np.shape(expected)
    limit = relative * np.abs(expected).max()
    np.testing.assert_allclose(value, expected, rtol=0, atol=limit)


@pytest.mark.parametrize("case", CASES)
def test_responses_agree_with_direct_convolutions(measured, case):
    assert_agrees(predicted(case), upstream(case))


@pytest.mark.parametrize("method", METHODS)
def test_a_design_gives_the_levels_that_upstream_gives_for_all_n_plus_521_samples(measured, method):
    inputs = (
        track(location=8, waveform=Tone(frequency_hz=200.0, duration_s=0.05)),
        track(location=13, waveform=Tap(), amplitude=-0.5, onset_s=7 / 1300),
        track(location=3, waveform=Noise(), muted=True),
    )
    design, view = Design(limb="measured-3", inputs=inputs, scaling="upstream"), View(method=method)
    levels = new_graph().evaluate(["output_rms"], sources(design, view))["output_rms"]
    drives = [tukey_tone(200, 65), np.pad(taps(5)[0], (0, 65 - 28))]
    limb, total = load_limb("measured-3"), 0.0
    for drive, place, amplitude in zip(drives, [8, 13], [1.0, -0.5], strict=True):
        channels = limb.response_to(place).reshape(216, 522)
        field = np.array([np.convolve(channel, drive) for channel in channels])
        total = total + amplitude * field / field.max()
    signal = projected(total.reshape(72, 3, -1), "xyz", method)
    assert signal.shape == (72, 65 + 521)
    assert_agrees(levels, np.sqrt((signal**2).sum(axis=1) / (65 + 521)))
