"""The skin in time: frames belong to their instants, and nothing is transformed for them."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.base.work import counting
from skinsource.design.view import View
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.time_rules import BLOCK_S, Moving, SlidingEnergy, block_of, window_of, z_axis
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


@pytest.fixture(scope="module")
def short():
    quantities = {"moving_z", "moving_vector", "moving_energy", "output_rms"}
    return new_graph().evaluate(quantities, sources(SHORT, VIEW))


@pytest.fixture(scope="module")
def expected():
    """Acceleration as `skinsource.predict` has it."""
    limb = ss.load_limb("synthetic-1")
    drives = np.zeros((2, 260))
    tone, tap = (track.clips[0].waveform.samples(RATE) for track in SHORT.inputs)
    drives[0, : tone.size] = tone
    drives[1, 65 : 65 + tap.size] = -2.0 * tap
    return ss.predict(limb, drives, locations=[7, 13], scaling="probe")


def test_frames_on_samples_are_the_prediction(short, expected):
    n = short["moving_vector"].response_samples
    assert n == expected.shape[-1]
    for sample in (0, 67, 80, 200, n - 1):
        at_s = sample / RATE
        vector = short["moving_vector"].acceleration(at_s)
        assert vector == pytest.approx(expected[..., sample], abs=1e-12)
        along_z = short["moving_z"].acceleration(at_s)
        assert along_z[:, 0] == pytest.approx(expected[:, 2, sample], abs=1e-12)
        length = np.sqrt((expected[..., sample] ** 2).sum(axis=1))
        assert short["moving_vector"].magnitude(at_s) == pytest.approx(length, abs=1e-12)


def test_the_largest_is_that_of_all_outputs_and_samples(short, expected):
    assert short["moving_z"].largest == pytest.approx(np.abs(expected[:, 2]).max())
    lengths = np.sqrt((expected**2).sum(axis=1))
    assert short["moving_vector"].largest == pytest.approx(lengths.max())


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


@pytest.mark.parametrize(("axes", "method"), [("xyz", "mag"), ("z", "mag"), ("xy", "pca")])
def test_a_window_as_long_as_the_record_gives_the_level_of_the_map(axes, method):
    view = replace(VIEW, axes=axes, method=method)
    values = new_graph().evaluate({"moving_energy", "output_rms"}, sources(SHORT, view))
    n = values["moving_energy"].response_samples
    rms = values["moving_energy"].rms((n - 1) / 2 / RATE, n / RATE)
    assert rms == pytest.approx(values["output_rms"], rel=1e-9, abs=1e-12)


def test_frames_transform_nothing_and_run_no_rule(short):
    with counting() as work:
        for k in range(50):
            short["moving_z"].acceleration(k / 700)
            short["moving_vector"].magnitude(k / 700)
            short["moving_energy"].rms(k / 700, 0.02)
    assert (work.forward_transforms, work.inverse_transforms, work.rules_run) == (0, 0, 0)


def test_of_a_short_design_the_playhead_asks_for_nothing():
    graph, quantities = new_graph(), {"moving_z", "moving_energy"}
    first = graph.evaluate(quantities, sources(SHORT, VIEW))
    later = graph.evaluate(quantities, sources(SHORT, replace(VIEW, playhead_s=3 * BLOCK_S)))
    assert graph.work.inverse_transforms == 0
    assert all(first[name] is later[name] for name in quantities)


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


def test_the_next_block_is_all_that_is_transformed_when_the_playhead_comes_to_it():
    graph = new_graph()
    graph.evaluate({"moving_z"}, sources(LONG, VIEW))
    first = graph.work.inverse_transforms
    graph.evaluate({"moving_z"}, sources(LONG, replace(VIEW, playhead_s=BLOCK_S + 1.0)))
    # Two blocks of five, and none of the pass that looked for the largest.
    assert 0 < graph.work.inverse_transforms < first / 2
    graph.evaluate({"moving_z"}, sources(LONG, replace(VIEW, playhead_s=BLOCK_S + 2.0)))
    assert graph.work.inverse_transforms == 0


def test_windows_overlap_by_a_block():
    for block in range(4):
        first, end = window_of(block, 10**6, RATE)
        following, _ = window_of(block + 1, 10**6, RATE)
        assert end - following >= BLOCK_S * RATE
        assert first <= max(block * BLOCK_S - 0.9, 0.0) * RATE
    assert window_of(9, 1000, RATE) == (1000, 1000)
    assert [block_of(time_s) for time_s in (-1.0, 0.0, BLOCK_S, 2.5 * BLOCK_S)] == [0, 0, 1, 2]


def test_a_limb_without_z_says_what_can_be_seen_of_it():
    class Flat:
        name, axes = "flat", "xy"

    with pytest.raises(
        InvalidInputError, match=r"flat was measured along x and y, and not along z.*magnitude"
    ):
        z_axis(Flat())
