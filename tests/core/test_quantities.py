"""The quantities of the studio: what they are, and what an edit makes run again."""

from dataclasses import replace
from inspect import signature

import numpy as np
import pytest

from skinsource.base.decibels import decibels
from skinsource.base.measurement_conditions import AXES
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Impulse, Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import RULES, new_graph, sources
from skinsource.engine.shared import Shared
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import SCALINGS
from skinsource.signals.generators import sinusoid
from skinsource.signals.projection import METHODS, project_axes
from skinsource.signals.spectra import magnitude_spectrum, rms

FOUR = Design(
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=100.0)),
        track(location=8, waveform=Noise(seed=2), amplitude=-0.5),
        track(location=7, waveform=Tap(), amplitude=2.0, onset_s=0.05),
        track(location=16, waveform=Impulse(), amplitude=0.25, onset_s=0.1),
    ),
)


def synthetic_response(place: int) -> np.ndarray:
    return np.random.default_rng(place).standard_normal((72, 3, 522))


class Studio:
    """A graph like that of the studio, on a made-up limb."""

    def __init__(self, limb: Limb) -> None:
        self.limb = limb
        self.graph = new_graph()

    def show(self, design: Design, *quantities: str, view: View | None = None) -> list:
        given = sources(design, view or View()) | {"limb_data": self.limb}
        results = self.graph.evaluate(quantities, given)
        return [results[name] for name in quantities]


@pytest.fixture
def studio(limb_of) -> Studio:
    return Studio(limb_of(synthetic_response))


def predicted(studio: Studio, design: Design, audible: list[int]) -> np.ndarray:
    """Prediction from drives that are laid out by hand at 1300 Hz."""
    starts = {0: 0, 1: 0, 2: 65, 3: 130}
    played = {k: design.inputs[k].clips[0].waveform.samples(1300.0) for k in audible}
    n_times = max(starts[k] + samples.size for k, samples in played.items())
    drives = np.zeros((len(audible), n_times))
    for row, (k, samples) in zip(drives, played.items(), strict=True):
        row[starts[k] : starts[k] + samples.size] = samples
    chosen = [design.inputs[k] for k in audible]
    places, amplitudes = [track.location for track in chosen], [track.amplitude for track in chosen]
    return predict(studio.limb, drives, places, amplitudes, design.scaling)


@pytest.mark.parametrize("scaling", SCALINGS)
def test_traces_are_those_of_the_prediction_through_all_edits(studio, scaling):
    design = replace(FOUR, scaling=scaling)
    edits = [
        (design, [0, 1, 2, 3]),
        (design.with_input(1, amplitude=0.0), [0, 1, 2, 3]),
        (design.with_clip(1, waveform=Tone(frequency_hz=222.0)), [0, 1, 2, 3]),
        (design.with_input(2, muted=True), [0, 1, 3]),
        (design.with_input(3, solo=True).with_input(1, solo=True), [1, 3]),
        (design, [0, 1, 2, 3]),
    ]
    for edited, audible in edits:
        (traces,) = studio.show(edited, "axis_traces")
        expected = predicted(studio, edited, audible)[[28, 51]]
        np.testing.assert_allclose(traces, expected, atol=1e-14 * np.abs(expected).max())


def test_only_the_places_that_are_heard_are_read(studio):
    studio.show(FOUR.with_input(3, muted=True), "output_levels_db")
    assert studio.limb.bytes_read == 2 * 72 * 3 * 522 * 8
    studio.show(FOUR, "output_levels_db")
    assert studio.limb.bytes_read == 3 * 72 * 3 * 522 * 8


def test_waveforms_alone_need_no_response(studio):
    studio.show(FOUR, "input_waveforms", "response_time_s")
    assert studio.limb.bytes_read == 0
    assert not {"others_spectrum", "edited_response", "surface"} & set(studio.graph.runs)


def test_what_is_hidden_does_not_run(studio):
    studio.show(FOUR, "selected_traces")
    unneeded = {"selected_spectra", "output_rms", "output_levels_db", "surface", "limb_map"}
    assert not unneeded & set(studio.graph.runs)


@pytest.mark.parametrize("axes", AXES)
def test_quantities_follow_from_the_prediction(studio, axes):
    for method in METHODS:
        view = View(axes=axes, method=method, outputs=(52, 29, 1), delay_removed=True)
        names = ("output_rms", "output_levels_db", "selected_traces", "selected_spectra")
        found_rms, levels, traces, spectra = studio.show(FOUR, *names, view=view)
        signal = project_axes(predicted(studio, FOUR, [0, 1, 2, 3]), axes, method)
        peak = np.abs(signal).max()
        np.testing.assert_allclose(found_rms, rms(signal), rtol=1e-12)
        np.testing.assert_allclose(levels, decibels(rms(signal)), atol=1e-10)
        np.testing.assert_allclose(traces, signal[[51, 28, 0]], atol=1e-13 * peak)
        frequency_hz, magnitudes = magnitude_spectrum(signal[[51, 28, 0]], 1300.0)
        np.testing.assert_array_equal(spectra[0], frequency_hz)
        np.testing.assert_allclose(spectra[1], magnitudes, atol=1e-13 * peak)


def test_the_response_is_longer_than_the_stimulus_by_one_response(studio):
    (time_s,) = studio.show(FOUR, "response_time_s")
    np.testing.assert_allclose(time_s, np.arange(781) / 1300.0, rtol=1e-15)
    (shifted_s,) = studio.show(FOUR, "response_time_s", view=View(delay_removed=True))
    np.testing.assert_allclose(shifted_s, time_s - 0.052, rtol=0, atol=1e-15)


def test_what_each_input_plays_is_there_even_when_it_is_muted(studio):
    (played,) = studio.show(FOUR.with_input(0, muted=True), "input_waveforms")
    assert [samples.size for samples in played] == [260, 260, 21, 1]
    np.testing.assert_array_equal(played[0], sinusoid(100.0, 0.2, window_name="tukey"))


@pytest.mark.parametrize("inputs", [(), (track(location=7, muted=True),)])
def test_where_nothing_is_heard_everything_is_silent_and_nothing_fails(studio, inputs):
    design = Design(limb="synthetic-1", inputs=inputs)
    for method in METHODS:
        names = ("output_rms", "output_levels_db", "selected_traces", "selected_spectra")
        found_rms, levels, traces, _ = studio.show(design, *names, view=View(method=method))
        assert not found_rms.any()
        assert (levels == -200.0).all()
        assert traces.shape == (2, 522)
    assert studio.limb.bytes_read == 0


def test_selecting_no_output_gives_no_trace(studio):
    traces, (frequency_hz, magnitudes) = studio.show(
        FOUR, "selected_traces", "selected_spectra", view=View(outputs=())
    )
    assert traces.shape == (0, 781)
    assert magnitudes.shape == (0, frequency_hz.size)


def test_results_cannot_be_written_to(studio):
    quantities = ("others_spectrum", "axis_traces", "output_rms", "selected_traces")
    for array in studio.show(FOUR, *quantities):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0.0


def test_evaluation_starts_from_what_quantities_depend_on_and_from_nothing_else():
    given = sources(FOUR, View())
    looked = View(time_range_s=(0.0, 0.1), panels=(("skin", (("map_style", "sensors"),)),))
    texts = dict.fromkeys(("title", "author", "notes", "licence"), "words")
    assert sources(replace(FOUR, **texts), looked) == given
    rules = (*RULES, *Shared().rules())
    needed = {name for rule in rules for name in signature(rule).parameters}
    assert given.keys() - {"span"} <= needed
