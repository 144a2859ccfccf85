"""Spectra in which a tone reads its amplitude, whatever is around it."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError, Stopped
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.quantities import new_graph, sources

RATE = 1300.0


def tone(frequency_hz, duration_s, *, amplitude=1.0, before_s=0.0, after_s=0.0):
    time_s = np.arange(round(duration_s * RATE)) / RATE
    silence = (np.zeros(round(part * RATE)) for part in (before_s, after_s))
    before, after = silence
    return np.concatenate((before, amplitude * np.sin(2 * np.pi * frequency_hz * time_s), after))


@pytest.mark.parametrize("frequency_hz", [25.0, 60.0, 100.37, 250.5, 333.3, 599.9])
@pytest.mark.parametrize("duration_s", [0.5, 3.0])
def test_a_sine_reads_its_amplitude_at_its_frequency(frequency_hz, duration_s):
    frequencies, amplitude = ss.peak_hold_spectrum(tone(frequency_hz, duration_s), RATE)
    assert amplitude.max() == pytest.approx(1.0, rel=0.012)
    assert abs(frequencies[np.argmax(amplitude)] - frequency_hz) <= 0.5 + 1e-9


def test_silence_around_a_tone_changes_nothing():
    alone = ss.peak_hold_spectrum(tone(100.0, 1.0), RATE)[1]
    for before_s, after_s in ((0.0, 2.0), (1.0, 0.0), (3.0, 5.0)):
        placed = tone(100.0, 1.0, before_s=before_s, after_s=after_s)
        amplitude = ss.peak_hold_spectrum(placed, RATE)[1]
        assert amplitude.max() == pytest.approx(alone.max(), rel=0.01)


def test_each_frequency_holds_its_own_peak():
    signal = np.concatenate(
        (tone(80.0, 1.0, amplitude=0.5), tone(0.0, 0.5), tone(300.0, 1.0, amplitude=2.0))
    )
    frequencies, amplitude = ss.peak_hold_spectrum(signal, RATE)
    assert amplitude[np.argmin(abs(frequencies - 80))] == pytest.approx(0.5, rel=0.01)
    assert amplitude[np.argmin(abs(frequencies - 300))] == pytest.approx(2.0, rel=0.01)
    assert amplitude[np.argmin(abs(frequencies - 190))] < 0.1


def test_constant_and_alternating_signals_read_their_value():
    for signal, at in ((np.ones(1300), 0), (np.resize([1.0, -1.0], 1300), -1)):
        assert ss.peak_hold_spectrum(signal, RATE)[1][at] == pytest.approx(1.0)


def test_it_equals_a_plain_loop_over_windows():
    signal = np.random.default_rng(7).normal(size=(2, 3, 900))
    frequencies, amplitude = ss.peak_hold_spectrum(signal, RATE)
    n = round(0.25 * RATE)
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(n) / n)
    padded = np.pad(signal, ((0, 0), (0, 0), (n - 1, n - 1)))
    expected = np.zeros_like(amplitude)
    for start in range(0, padded.shape[-1] - n + 1, n // 8):
        turns = np.exp(-2j * np.pi * np.outer(np.arange(n), frequencies) / RATE)
        part = np.abs((padded[..., start : start + n] * window) @ turns) / window.sum()
        part[..., 1:-1] *= 2
        expected = np.maximum(expected, part)
    assert frequencies[-1] == RATE / 2
    np.testing.assert_allclose(amplitude, expected, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("scale", [1e-200, 1e150])
def test_very_small_and_very_large_signals_keep_their_shape(scale):
    usual = ss.peak_hold_spectrum(tone(100.0, 0.5), RATE)[1]
    scaled = ss.peak_hold_spectrum(scale * tone(100.0, 0.5), RATE)[1]
    np.testing.assert_allclose(scaled / scale, usual, rtol=1e-12, atol=1e-15)


def test_one_sample_is_enough_none_is_not_and_it_can_be_stopped():
    assert ss.peak_hold_spectrum([1.0], RATE)[1].max() == pytest.approx(4 / 325, rel=1e-3)
    with pytest.raises(InvalidInputError, match="at least one sample"):
        ss.peak_hold_spectrum([], RATE)
    with pytest.raises(Stopped):
        ss.peak_hold_spectrum(np.ones(10), RATE, stop=lambda: True)


def test_the_quantity_is_the_spectrum_of_the_traces():
    design = Design(limb="synthetic-1", inputs=(track(location=7, waveform=Tone(60.0)),))
    names = ("selected_traces", "selected_peak_spectra")
    values = new_graph().evaluate(names, sources(design, View(outputs=(20, 5))))
    expected = ss.peak_hold_spectrum(values["selected_traces"], RATE)
    for part, expected_part in zip(values["selected_peak_spectra"], expected, strict=True):
        np.testing.assert_allclose(part, expected_part, rtol=1e-12)
