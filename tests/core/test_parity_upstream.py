"""Agreement with the upstream formulas on the measured limbs, worked out in another way.

Nothing here is computed by the library but what is tested: convolutions are direct, directions
come from singular vectors, spectra from explicit sums.
"""

import numpy as np
import pytest

from skinsource.base.measurement_conditions import AXES
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.catalog import load_limb
from skinsource.signals.projection import METHODS, project_axes
from skinsource.signals.spectra import magnitude_spectrum

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


@pytest.mark.parametrize("axes", AXES)
@pytest.mark.parametrize("case", ["two tones", "noise, odd"])
def test_projections_agree_with_those_of_the_direct_response(measured, case, axes):
    expected, acceleration = upstream(case), predicted(case)
    for method in METHODS:
        signal = project_axes(acceleration, axes, method)
        assert_agrees(signal, projected(expected, axes, method))


@pytest.mark.parametrize("case", CASES)
def test_spectra_are_taken_over_all_samples_of_odd_and_even_responses(measured, case):
    for output in (1, 52, 72):
        signal = upstream(case)[output - 1, 2]
        n = signal.size
        bins = np.arange(n // 2 + 1)
        turns = np.outer(bins, np.arange(n)) % n / n
        size = np.abs(np.exp(-2j * np.pi * turns) @ signal) / n
        inner = (bins > 0) & (2 * bins != n)
        size[inner] *= 2
        frequency_hz, magnitude = magnitude_spectrum(predicted(case)[output - 1, 2], RATE_HZ)
        assert_agrees(magnitude, size)
        assert_agrees(frequency_hz, bins * RATE_HZ / n)


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
