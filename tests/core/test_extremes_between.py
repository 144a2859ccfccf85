"""How far waves reach between samples, where samples alone would lie."""

import tracemalloc

import numpy as np
import pytest

from skinsource.base.errors import Stopped
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.evaluation import evaluate
from skinsource.signals.resampling import EXTREMES_ERROR, FINER, extremes_between, finer

RATE_HZ = 1300.0
# The filter alone.
FILTER_ERROR = 0.003


def of(extremes):
    return extremes.low * extremes.sizes, extremes.high * extremes.sizes


def band_limited(*shape, seed=1):
    """Noise up to 600 Hz at 1300 Hz."""
    spectrum = np.fft.rfft(np.random.default_rng(seed).standard_normal(shape))
    spectrum[..., round(600 / 650 * spectrum.shape[-1]) :] = 0.0
    return np.fft.irfft(spectrum, shape[-1])


def dense_extremes(dense):
    """Extremes of the points from each sample to before the next."""
    cells = dense[..., :-1].reshape(*dense.shape[:-1], -1, FINER)
    last = dense[..., -1:]
    return (
        np.concatenate((cells.min(axis=-1), last), axis=-1),
        np.concatenate((cells.max(axis=-1), last), axis=-1),
    )


@pytest.mark.parametrize("frequency_hz", [30.0, 130.0, 325.0, 1300 / 3, 520.0, 599.0])
@pytest.mark.parametrize("phase", [0.0, np.pi / 4, 1.1])
def test_within_every_period_a_tone_reaches_its_peak_whatever_its_samples_miss(frequency_hz, phase):
    tone = np.sin(2 * np.pi * frequency_hz * np.arange(1300) / RATE_HZ + phase)
    low, high = of(extremes_between(tone[np.newaxis]))
    n_period = int(np.ceil(RATE_HZ / frequency_hz)) + 1
    # Where the record begins and ends hard, it rings.
    for reached in (high[0, 40:-40], -low[0, 40:-40]):
        highest = np.lib.stride_tricks.sliding_window_view(reached, n_period).max(axis=-1)
        assert highest.min() >= 1.0 - EXTREMES_ERROR
        assert highest.max() <= 1.0 + FILTER_ERROR


def test_they_are_those_of_the_wave_that_is_drawn_from_close_by():
    signals = band_limited(3, 1001)
    extremes = extremes_between(signals)
    expected = dense_extremes(finer(np.arange(1001) / RATE_HZ, signals)[1])
    peak = np.abs(signals).max()
    for got, expected_values in zip(of(extremes), expected, strict=True):
        np.testing.assert_allclose(got, expected_values, rtol=0, atol=FILTER_ERROR * peak)
    assert extremes.range == pytest.approx((expected[0].min(), expected[1].max()), abs=0.01 * peak)


def test_of_signals_along_several_axes_the_wave_is_the_length_of_the_vector():
    axes = band_limited(2, 3, 700)
    dense = finer(np.arange(700) / RATE_HZ, axes)[1]
    expected = dense_extremes(np.sqrt(np.square(dense).sum(axis=1)))
    for got, expected_values in zip(of(extremes_between(axes)), expected, strict=True):
        np.testing.assert_allclose(
            got, expected_values, rtol=0, atol=2 * FILTER_ERROR * np.abs(axes).max()
        )


@pytest.mark.parametrize(("first", "end"), [(0, 9), (3, 120), (400, 432), (880, 900), (899, 900)])
def test_a_stretch_has_the_extremes_that_it_has_in_the_whole(first, end):
    signals = band_limited(2, 900)
    whole, part = (extremes_between(signals, *ends) for ends in ((), (first, end)))
    for got, expected_values in zip(of(part), of(whole.part(first, end)), strict=True):
        np.testing.assert_allclose(got, expected_values, rtol=0, atol=1e-5 * np.abs(signals).max())


@pytest.mark.parametrize("peak", [5e-324, 1e-300, 1e-12, 1e300])
def test_no_signal_is_too_small_or_too_large(peak):
    extremes = extremes_between(peak * np.sign(band_limited(1, 300)))
    low, high = extremes.range
    assert low <= -peak < peak <= high
    assert np.isfinite((low, high)).all()


def test_silence_stays_silent_and_a_single_sample_stays_alone():
    silent = extremes_between(np.zeros((2, 100)))
    assert not silent.low.any()
    assert not silent.high.any()
    alone = extremes_between(np.array([[-2.0]]))
    assert alone.range == (-2.0, -2.0)
    assert extremes_between(np.zeros((0, 100))).range == (0.0, 0.0)
    assert extremes_between(np.zeros((1, 0))).low.shape == (1, 0)


def test_however_long_signals_are_they_take_little_more_memory_than_the_result():
    signals = np.tile(band_limited(6, 2000), 50)
    extremes_between(signals[:, :100])
    tracemalloc.start()
    extremes = extremes_between(signals)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most <= extremes.low.nbytes + extremes.high.nbytes + 4e6


def test_it_can_be_stopped_between_blocks():
    asked = []

    def stop():
        asked.append(None)
        return len(asked) == 3

    with pytest.raises(Stopped):
        extremes_between(np.zeros((6, 100_000)), stop=stop)


@pytest.mark.parametrize("method", ["mag", "pca"])
def test_those_of_selected_outputs_belong_to_the_wave_of_their_projection(method):
    tones = (track(location=3, waveform=Tone(frequency_hz=325.0, duration_s=0.4)),)
    design = Design(limb="synthetic-1", inputs=tones)
    view = View(axes="xyz", method=method, outputs=(29, 52))
    names = "selected_extremes", "axis_traces", "selected_projection", "response_time_s"
    quantities = evaluate(design, *names, view=view)
    dense = finer(quantities["response_time_s"], quantities["axis_traces"])[1]
    expected = dense_extremes(quantities["selected_projection"].signals(dense))
    peak = np.abs(dense).max()
    for got, values in zip(of(quantities["selected_extremes"]), expected, strict=True):
        np.testing.assert_allclose(got, values, rtol=0, atol=2 * FILTER_ERROR * peak)
