"""The skin in time, and how far waves reach between samples."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource import View
from skinsource.base.errors import InvalidInputError, Stopped
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.time_rules import (
    BLOCK_S,
    Moving,
    SlidingEnergy,
    _z_axis,
    block_of,
    moving_window,
)
from skinsource.signals.resampling import (
    EXTREMES_ERROR,
    FINER,
    extremes_between,
    finer,
    peaks_between,
)
from skinsource.signals.sampling import values_at

RATE = 1300.0
SHORT = ss.Design(
    limb="synthetic-1",
    inputs=(
        ss.track(7, ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)),
        ss.track(13, ss.waveforms.Tap(), onset_s=0.05, amplitude=-2.0),
    ),
)
LONG = replace(SHORT, inputs=(ss.track(7, ss.waveforms.Noise(duration_s=60.0, seed=4)),))
VIEW = View(axes="xyz", method="mag", outputs=(29, 52))


def moving(signals, first=0, n_times=None):
    return Moving(
        signals=signals,
        first=first,
        sample_rate_hz=RATE,
        response_samples=n_times or first + signals.shape[-1],
        largest=1.0,
        delay_s=0.052,
    )


@pytest.mark.parametrize("name", ["moving_z", "moving_vector"])
def test_what_moves_before_time_0_through_an_equaliser_is_at_its_own_time(name):
    at = ss.ActuatorAt(actuator="example-voice-coil", model=ss.actuators.load("example-voice-coil"))
    through = ss.Actuation(actuators=(at,), equaliser=ss.equalising.RegularisedInverse())
    design = replace(SHORT, inputs=SHORT.inputs[:1], actuation=through)
    wanted = (name, "axis_traces", "response_time_s")
    values = ss.evaluate(design, *wanted, view=replace(VIEW, delay_removed=False))
    times_s, traces = values["response_time_s"], values["axis_traces"]
    assert times_s[0] < -0.01
    strongest = int(np.abs(traces[0]).max(axis=0).argmax())
    for k in (strongest - 40, strongest, strongest + 7):
        moves = values[name].acceleration(float(times_s[k]))[VIEW.outputs[0] - 1]
        np.testing.assert_allclose(moves, traces[0, -moves.size :, k], rtol=0, atol=1e-9)


@pytest.mark.parametrize("frequency_hz", [25.0, 217.0, 598.0])
def test_between_samples_a_tone_is_the_tone(frequency_hz):
    times = np.arange(400) / RATE
    tone = np.sin(2 * np.pi * frequency_hz * times + 0.3)
    moving_ = moving(tone[None, None, :])
    for at in (150.1, 200.5, 233.999, 180.0):
        exact = np.sin(2 * np.pi * frequency_hz * at / RATE + 0.3)
        assert moving_.acceleration(at / RATE)[0, 0] == pytest.approx(exact, abs=3e-6)


def test_outside_of_the_response_there_is_silence():
    moving_ = moving(np.ones((2, 3, 50)))
    for at in (-1.0, 50.0, 70.0, -64.5, 114.5):
        acceleration = moving_.acceleration(at / RATE)
        assert acceleration.shape == (2, 3)
        assert (
            abs(acceleration).max() < 1e-3 if at in (-64.5, 114.5) else (acceleration == 0.0).all()
        )
    assert (values_at(np.ones((2, 50)), 1e6) == 0.0).all()


def test_the_sliding_rms_is_that_of_the_samples_in_the_window():
    rng = np.random.default_rng(5)
    samples = rng.standard_normal((3, 200))
    sums = np.concatenate([np.zeros((3, 1)), np.cumsum(samples**2, axis=1)], axis=1)
    moving_ = SlidingEnergy(
        sums=sums, first=40, sample_rate_hz=RATE, response_samples=240, largest=3.0, delay_s=0.0
    )
    # An odd window lies around a sample.
    rms = moving_.rms((40 + 100) / RATE, 21 / RATE)
    assert rms == pytest.approx(np.sqrt((samples[:, 90:111] ** 2).mean(axis=1)))
    # Half way to the next one, half of each mean square.
    later = np.sqrt(
        ((samples[:, 90:111] ** 2).mean(axis=1) + (samples[:, 91:112] ** 2).mean(axis=1)) / 2
    )
    assert moving_.rms((40 + 100.5) / RATE, 21 / RATE) == pytest.approx(later)
    # An even one around the middle between two.
    rms = moving_.rms((40 + 100.5) / RATE, 20 / RATE)
    assert rms == pytest.approx(np.sqrt((samples[:, 91:111] ** 2).mean(axis=1)))
    # What lies before is silence, and counts as much.
    rms = moving_.rms(40 / RATE, 21 / RATE)
    assert rms == pytest.approx(np.sqrt((samples[:, :11] ** 2).sum(axis=1) / 21))
    assert (moving_.rms(10.0, 0.02) == 0.0).all()
    with pytest.raises(InvalidInputError, match="window_s is 0"):
        moving_.rms(0.0, 0.0)


def test_of_a_long_design_two_blocks_are_kept_which_are_its_traces():
    graph = new_graph()
    quantities = {"moving_z", "selected_traces"}
    view = replace(VIEW, axes="z")
    for playhead_s in (0.0, 20.0, 59.0):
        looked = replace(view, playhead_s=playhead_s)
        values = graph.evaluate(quantities, sources(LONG, looked))
        moving_, traces = values["moving_z"], values["selected_traces"]
        assert moving_.signals[[28, 51], 0] == pytest.approx(
            traces[:, moving_.first : moving_.end], abs=1e-12
        )
        assert moving_.first <= playhead_s * RATE < moving_.end
        assert moving_.signals.shape[-1] <= (2 * BLOCK_S + 2.0) * RATE + 1
    assert moving_.largest >= np.abs(traces).max() * (1 - 1e-12)
    every = replace(view, outputs=tuple(range(1, 73)))
    whole = graph.evaluate({"selected_traces"}, sources(LONG, every))["selected_traces"]
    assert moving_.largest == pytest.approx(np.abs(whole).max())


def test_windows_overlap_by_a_block():
    for block in range(4):
        first, end = moving_window(block, 10**6, None, RATE)
        following, _ = moving_window(block + 1, 10**6, None, RATE)
        assert end - following >= BLOCK_S * RATE
        assert first <= max(block * BLOCK_S - 0.9, 0.0) * RATE
    assert moving_window(9, 1000, None, RATE) == (1000, 1000)
    assert [block_of(time_s) for time_s in (-1.0, 0.0, BLOCK_S, 2.5 * BLOCK_S)] == [0, 0, 1, 2]


def test_a_limb_without_z_says_what_can_be_seen_of_it():
    class Flat:
        name, axes = "flat", "xy"

    with pytest.raises(
        InvalidInputError, match=r"flat was measured along x and y, not along z.*magnitude"
    ):
        _z_axis(Flat())


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
    ends = (cells.min(axis=-1), cells.max(axis=-1))
    return tuple(np.concatenate((end, last), axis=-1) for end in ends)


@pytest.mark.parametrize("frequency_hz", [30.0, 130.0, 325.0, 1300 / 3, 520.0, 599.0])
@pytest.mark.parametrize("phase", [0.0, np.pi / 4, 1.1])
def test_within_every_period_a_tone_reaches_its_peak_whatever_its_samples_miss(frequency_hz, phase):
    tone = np.sin(2 * np.pi * frequency_hz * np.arange(1300) / RATE + phase)
    low, high = of(extremes_between(tone[np.newaxis]))
    n_period = int(np.ceil(RATE / frequency_hz)) + 1
    # Where the record begins and ends hard, it rings.
    for reached in (high[0, 40:-40], -low[0, 40:-40]):
        highest = np.lib.stride_tricks.sliding_window_view(reached, n_period).max(axis=-1)
        assert highest.min() >= 1.0 - EXTREMES_ERROR
        assert highest.max() <= 1.0 + FILTER_ERROR


@pytest.mark.parametrize("frequency_hz", [30.0, 325.0, 1300 / 3, 520.0, 600.0])
def test_the_peak_of_a_train_is_that_of_its_formula_whatever_its_samples_miss(frequency_hz):
    shift = np.linspace(0.0, 1.0, 50)[:, np.newaxis]

    def wavelet(middle):
        time_s = (np.arange(1300) - middle - shift) / RATE
        return np.cos(2 * np.pi * frequency_hz * time_s) * np.exp(-((time_s / 0.03) ** 2))

    expected = pytest.approx(np.ones(50), rel=0.005)  # 0.04 dB
    train = wavelet(300.3) - 0.9 * wavelet(800.0)
    assert peaks_between(train) == expected
    assert peaks_between(train, 600, 1000) / 0.9 == expected
    # The length of a vector.
    assert peaks_between(np.stack((0.6 * train, -0.8 * train), axis=1)) == expected


def test_they_are_those_of_the_wave_that_is_drawn_from_close_by():
    signals = band_limited(3, 1001)
    extremes = extremes_between(signals)
    expected = dense_extremes(finer(np.arange(1001) / RATE, signals)[1])
    peak = np.abs(signals).max()
    for got, expected_values in zip(of(extremes), expected, strict=True):
        np.testing.assert_allclose(got, expected_values, rtol=0, atol=FILTER_ERROR * peak)
    assert extremes.range == pytest.approx((expected[0].min(), expected[1].max()), abs=0.01 * peak)


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
    assert peak < peaks_between(peak * np.sign(band_limited(1, 300)))[0] < np.inf


def test_silence_stays_silent_and_a_single_sample_stays_alone():
    silent = extremes_between(np.zeros((2, 100)))
    assert not silent.low.any()
    assert not silent.high.any()
    alone = extremes_between(np.array([[-2.0]]))
    assert alone.range == (-2.0, -2.0)
    assert extremes_between(np.array([[[3.0], [4.0]]])).range == (5.0, 5.0)
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
