"""Long scenes: checked as short ones are, stopped when asked to, nothing held or drawn twice."""

import gc
from dataclasses import replace

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError, Stopped
from skinsource.base.measurement_conditions import AXES
from skinsource.design.design import Design, track
from skinsource.design.signal_path import Part, SignalPath, UnitVoice
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.drives import Drives
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.streaming import StreamedVibration
from skinsource.engine.transforms import Blocks
from skinsource.limbs.synthetic import load_synthetic_limb
from skinsource.signals.loudest_window import SPANS
from skinsource.signals.projection import METHODS

LONG = Design(
    scaling="upstream",
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=100.0, duration_s=14.0)),
        track(location=3, waveform=Noise(seed=2, duration_s=2.0), onset_s=6.0, amplitude=-0.5),
        track(location=3, waveform=Tap(), onset_s=1.0),
    ),
)
VIEW = View(axes="xyz", method="pca", outputs=(29, 52), selected_inputs=(2,))
ALL = ("output_rms", "selected_traces", "selected_spectra", "axis_spectra")


@pytest.fixture(scope="module")
def convolved() -> np.ndarray:
    """Projected signals (72 outputs, n_times) of the long scene, by convolution with numpy."""
    limb = load_synthetic_limb(1)
    played = [(round(clip.onset_s * 1300), clip.waveform.samples(1300.0)) for clip in LONG.clips]
    n_times = max(start + samples.size for start, samples in played) + 521
    total = np.zeros((72, 3, n_times))
    for input_track, (start, samples) in zip(LONG.inputs, played, strict=True):
        field = np.zeros((72, 3, samples.size + 521))
        for channel in np.ndindex(72, 3):
            field[channel] = np.convolve(samples, limb.response_to(input_track.location)[channel])
        # As upstream scales: by the largest value of the field, not of its magnitude.
        total[..., start : start + field.shape[-1]] += field * (input_track.amplitude / field.max())
    return np.array([along_main_axis(output) for output in total])


def along_main_axis(output: np.ndarray) -> np.ndarray:
    """Component (n_times,) of the vibration (3, n_times) along its first principal axis."""
    vectors, _, _ = np.linalg.svd(output - output.mean(axis=1, keepdims=True), full_matrices=False)
    axis = vectors[:, 0]
    return (axis * np.sign(axis[np.argmax(np.abs(axis))])) @ output


class Countdown:
    """Asks to stop once it was asked so many times."""

    def __init__(self, times: int) -> None:
        self.left = times

    def __call__(self) -> bool:
        self.left -= 1
        return self.left < 0


@pytest.mark.parametrize("scaling", ["upstream", "relative", "probe"])
def test_traces_of_a_long_scene_are_checked_too(scaling):
    design = Design(limb=LONG.limb, inputs=LONG.inputs, scaling=scaling)
    values = new_graph().evaluate({"trace_error", "n_fft"}, sources(design, VIEW))
    assert values["n_fft"] is None
    assert 0.0 < values["trace_error"].estimate < 1e-14
    assert values["trace_error"].estimate < values["trace_error"].bound


def test_a_long_silence_has_no_error_and_no_levels():
    silent = LONG.with_input(0, amplitude=0.0).with_input(1, muted=True).with_input(2, muted=True)
    values = new_graph().evaluate(("trace_error", "output_rms"), sources(silent, VIEW))
    assert values["trace_error"] is None
    assert not values["output_rms"].any()


@pytest.mark.parametrize("times", [1, 5, 10, 20, 30, 40])
def test_a_long_scene_stops_wherever_it_is_asked_to_and_is_right_afterwards(times, convolved):
    graph = new_graph()
    with pytest.raises(Stopped):
        graph.evaluate(ALL, sources(LONG, VIEW), Countdown(times))
    # The old request to stop is of no concern any more.
    values = graph.evaluate(ALL, sources(LONG, VIEW))
    levels = np.sqrt(np.mean(np.square(convolved), axis=-1))
    np.testing.assert_allclose(values["output_rms"], levels, rtol=1e-12)
    expected = convolved[[number - 1 for number in VIEW.outputs]]
    peak = np.abs(expected).max()
    np.testing.assert_allclose(values["selected_traces"], expected, rtol=0, atol=1e-13 * peak)
    # Amplitudes of the parts of a signal; there is no highest one where the samples are odd.
    spectra = 2 / expected.shape[1] * np.abs(np.fft.rfft(expected))
    assert expected.shape[1] % 2 == 1
    spectra[:, 0] /= 2
    found_spectra = values["selected_spectra"][1]
    np.testing.assert_allclose(found_spectra, spectra, rtol=0, atol=1e-12 * spectra.max())


def test_a_request_to_stop_does_not_outlive_its_question():
    graph = new_graph()
    wants_to_stop = False
    graph.evaluate(["output_rms"], sources(LONG, VIEW), lambda: wants_to_stop)
    wants_to_stop = True
    values = graph.evaluate(["selected_traces"], sources(LONG, VIEW))
    assert values["selected_traces"].any()


def test_no_more_than_some_blocks_lie_between_two_chances_to_stop():
    asked = Countdown(10**9)
    new_graph().evaluate(ALL, sources(LONG, VIEW), asked)
    n_blocks = 14 * 1300 / Blocks(522).n_samples
    assert 10**9 - asked.left > n_blocks


def test_responses_to_all_outputs_are_not_copied(monkeypatch):
    # Of a large limb they take gigabytes.
    streamed = new_graph().evaluate(["streamed_vibration"], sources(LONG, VIEW))[
        "streamed_vibration"
    ]
    multiplied, spectra = [], StreamedVibration._spectra

    def note(self, segments, values):
        multiplied.append(values)
        return spectra(self, segments, values)

    monkeypatch.setattr(StreamedVibration, "_spectra", note)
    first, block = next(streamed.blocks_of(range(1, 73), (0, 1, 2)))
    assert np.shares_memory(multiplied[0], streamed._stack.values)
    again, whole = next(streamed.blocks())
    assert again == first
    np.testing.assert_array_equal(block, whole)
    _, turned = next(streamed.blocks_of(range(72, 0, -1), (2, 0, 1)))
    np.testing.assert_allclose(turned, whole[::-1, (2, 0, 1)], rtol=0, atol=1e-12 * whole.max())
    next(streamed.blocks_of((30, 2), (0, 1, 2)))
    assert multiplied[-1].shape[-1] == 6


def test_a_drive_that_is_in_use_is_not_drawn_again_however_small_the_memory():
    drives = Drives(budget_bytes=0, clips_bytes=0)
    voice = UnitVoice(SignalPath((Part(Noise(seed=5)),)), location=1)
    first = drives.drawn(voice, 1300.0)
    assert drives.drawn(voice, 1300.0) is first
    samples = first.samples.copy()
    del first
    gc.collect()
    np.testing.assert_array_equal(drives.drawn(voice, 1300.0).samples, samples)


def test_each_long_waveform_is_drawn_once_whatever_is_asked_first(monkeypatch):
    monkeypatch.setattr(
        "skinsource.engine.drives.Drives", lambda: Drives(budget_bytes=0, clips_bytes=0)
    )
    graph = new_graph()
    graph.evaluate((*ALL, "input_waveforms", "trace_error"), sources(LONG, VIEW))
    drawn = sum(track.clips[0].waveform.samples(1300.0).size for track in LONG.inputs)
    assert graph.work.samples_drawn == drawn


class Broken(Tone):
    """A tone with one sample that is no number."""

    __slots__ = ()

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> np.ndarray:
        values = Tone.samples(self, sample_rate_hz, shift_s).copy()
        values[17] = np.nan
        return values


@pytest.mark.parametrize("duration_s", [0.5, 14.0])
def test_a_bad_sample_is_refused_by_the_place_of_its_input_and_its_number(duration_s):
    bad = track(location=12, waveform=Broken(duration_s=duration_s))
    with pytest.raises(InvalidInputError, match=f"place 12, {Broken.title}: sample 17 is nan"):
        new_graph().evaluate(ALL, sources(LONG.adding(bad), VIEW))


PANELS_NEED = (
    "input_waveforms",
    "limb_map",
    "output_levels_db",
    "response_time_s",
    "sample_rate_hz",
    "selected_peak_spectra",
    "selected_spectra",
    "selected_traces",
    "selected_without_main_axis",
    "surface",
    "surface_levels_db",
    "trace_error",
)


@pytest.mark.parametrize("span", SPANS)
@pytest.mark.parametrize("duration_s", [3.0, 11.0, 12.0, 20.0, 30.0, 60.0])
def test_however_long_the_scene_no_output_need_be_selected(duration_s, span):
    design = LONG.with_clip(1, waveform=Tone(frequency_hz=100.0, duration_s=duration_s))
    design = replace(design, inputs=design.inputs[::2])
    graph = new_graph()
    # The longest are summed as those of 20 s are, three times as long: each method and axis once.
    fewer = duration_s > 20.0
    for k, axes in enumerate(AXES):
        for method in (METHODS[k % len(METHODS)],) if fewer else METHODS:
            view = View(axes=axes, method=method, outputs=(), span=span, selected_inputs=(1,))
            values = graph.evaluate(PANELS_NEED, sources(design, view))
            n_times = values["response_time_s"].size
            assert n_times == round(duration_s * 1300) + 521
            assert values["selected_traces"].shape == (0, n_times)
            for spectra in ("selected_spectra", "selected_peak_spectra"):
                frequency_hz, magnitudes = values[spectra]
                assert magnitudes.shape == (0, frequency_hz.size)
            assert values["trace_error"] is None
            assert values["output_levels_db"].max() > -100.0


def test_traces_of_no_output_of_a_long_scene_transform_nothing():
    graph = new_graph()
    looked = replace(VIEW, outputs=())
    graph.evaluate({"streamed_vibration"}, sources(LONG, looked))
    graph.evaluate({"axis_traces", "axis_spectra"}, sources(LONG, looked))
    assert graph.work.inverse_transforms == graph.work.forward_transforms == 0
