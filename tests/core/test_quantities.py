"""The quantities of the studio: what they are, and what an edit makes run again."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.decibels import decibels
from skinsource.design import Design, Input
from skinsource.field_memory import FieldMemory
from skinsource.graph import Graph
from skinsource.limb import Limb, LimbMap
from skinsource.projection import AXES, METHODS, project_axes
from skinsource.quantities import RULES, new_graph, sources
from skinsource.response import SCALINGS, predict
from skinsource.signals import sinusoid
from skinsource.spectra import magnitude_spectrum, rms
from skinsource.view import View
from skinsource.waveforms import Impulse, Noise, Tap, Tone

FOUR = Design(
    limb="synthetic-1",
    inputs=(
        Input(location=7, waveform=Tone(frequency_hz=100.0)),
        Input(location=8, waveform=Noise(seed=2), amplitude=-0.5),
        Input(location=7, waveform=Tap(), amplitude=2.0, onset_s=0.05),
        Input(location=16, waveform=Impulse(), amplitude=0.25, onset_s=0.1),
    ),
)


def made_up_response(place: int) -> np.ndarray:
    return np.random.default_rng(place).standard_normal((72, 3, 522))


class Studio:
    """A graph like that of the studio, on a made-up limb."""

    def __init__(self) -> None:
        nowhere = LimbMap(
            outline=np.zeros((3, 2)),
            output_positions=np.zeros((72, 2)),
            input_positions=np.zeros((20, 2)),
            hand_length_px=1.0,
        )
        self.limb = Limb(
            name="synthetic-1",
            hand_length_mm=175.0,
            synthetic=True,
            map=nowhere,
            read_response=made_up_response,
        )
        self.memory = FieldMemory()
        self.graph = Graph(*RULES, self.memory.unit_fields)

    def show(self, design: Design, *wanted: str, view: View | None = None) -> list:
        given = sources(design, view or View()) | {"limb_data": self.limb}
        results = self.graph.evaluate(wanted, given)
        return [results[name] for name in wanted]


@pytest.fixture
def studio() -> Studio:
    return Studio()


def predicted(studio: Studio, design: Design, heard: list[int]) -> np.ndarray:
    """Prediction from drives that are laid out by hand at 1300 Hz."""
    starts = {0: 0, 1: 0, 2: 65, 3: 130}
    played = {k: design.inputs[k].waveform.samples(1300.0) for k in heard}
    n_times = max(starts[k] + samples.size for k, samples in played.items())
    drives = np.zeros((len(heard), n_times))
    for row, (k, samples) in zip(drives, played.items(), strict=True):
        row[starts[k] : starts[k] + samples.size] = samples
    chosen = [design.inputs[k] for k in heard]
    places, amplitudes = [one.location for one in chosen], [one.amplitude for one in chosen]
    return predict(studio.limb, drives, places, amplitudes, design.scaling)


@pytest.mark.parametrize("scaling", SCALINGS)
def test_skin_acceleration_is_the_prediction_bit_for_bit_through_all_edits(studio, scaling):
    design = replace(FOUR, scaling=scaling)
    edits = [
        (design, [0, 1, 2, 3]),
        (design.with_input(1, amplitude=0.0), [0, 1, 2, 3]),
        (design.with_input(0, waveform=Tone(frequency_hz=222.0)), [0, 1, 2, 3]),
        (design.with_input(2, muted=True), [0, 1, 3]),
        (design.with_input(3, solo=True).with_input(1, solo=True), [1, 3]),
        (design, [0, 1, 2, 3]),
    ]
    for edited, heard in edits:
        (found,) = studio.show(edited, "skin_acceleration")
        np.testing.assert_array_equal(found, predicted(studio, edited, heard))


def test_dragging_an_amplitude_computes_no_field(studio):
    studio.show(FOUR, "output_levels_db")
    assert studio.memory.fields_computed == 4
    for amplitude in (0.5, 0.25, -1.0):
        studio.show(FOUR.with_input(0, amplitude=amplitude), "output_levels_db")
    assert studio.memory.fields_computed == 4
    assert studio.graph.runs["output_levels_db"] == 4


def test_a_change_of_one_frequency_of_four_computes_one_field(studio):
    studio.show(FOUR, "output_levels_db")
    studio.show(FOUR.with_input(0, waveform=Tone(frequency_hz=101.0)), "output_levels_db")
    assert studio.memory.fields_computed == 5


@pytest.mark.parametrize("change", [{"muted": True}, {"solo": True}, {"colour": 7}])
def test_muting_and_soloing_computes_no_field(studio, change):
    design = Design(limb="synthetic-1", inputs=(Input(location=3), *FOUR.inputs[:2]))
    studio.show(design, "output_levels_db")
    studio.show(design.with_input(1, **change), "output_levels_db")
    studio.show(design, "output_levels_db")
    assert studio.memory.fields_computed == 3


def test_muting_a_shorter_input_computes_no_field(studio):
    studio.show(FOUR, "output_levels_db")
    for k in (2, 3):
        studio.show(FOUR.with_input(k, muted=True), "output_levels_db")
    assert studio.memory.fields_computed == 4


def test_only_the_places_that_are_heard_are_read(studio):
    studio.show(FOUR.with_input(3, muted=True), "skin_acceleration")
    assert studio.limb.bytes_read == 2 * 72 * 3 * 522 * 8
    studio.show(FOUR, "input_waveforms", "drives", "drive_time_s", "response_time_s")
    assert studio.limb.bytes_read == 3 * 72 * 3 * 522 * 8


def test_drives_alone_need_no_response(studio):
    studio.show(FOUR, "input_waveforms", "drives", "drive_time_s")
    assert studio.limb.bytes_read == 0
    assert studio.memory.fields_computed == 0
    unneeded = {"unit_fields", "skin_acceleration", "projected", "surface", "selected_spectra"}
    assert not unneeded & set(studio.graph.runs)


def test_what_is_hidden_does_not_run(studio):
    studio.show(FOUR, "selected_traces")
    unneeded = {"selected_spectra", "output_rms", "output_levels_db", "surface", "limb_map"}
    assert not unneeded & set(studio.graph.runs)


def test_selecting_outputs_projects_nothing_again(studio):
    studio.show(FOUR, "selected_traces", "output_levels_db")
    studio.show(FOUR, "selected_traces", "output_levels_db", view=View(outputs=(3, 1)))
    assert studio.graph.runs["projected"] == 1
    assert studio.graph.runs["output_levels_db"] == 1
    assert studio.graph.runs["selected_traces"] == 2


def test_changing_axes_predicts_nothing_again(studio):
    studio.show(FOUR, "output_levels_db")
    studio.show(FOUR, "output_levels_db", view=View(axes="z"))
    assert studio.graph.runs["skin_acceleration"] == 1
    assert studio.graph.runs["projected"] == 2


@pytest.mark.parametrize("axes", AXES)
def test_quantities_follow_from_the_prediction(studio, axes):
    for method in METHODS:
        view = View(axes=axes, method=method, outputs=(52, 29, 1), delay_removed=True)
        names = ("output_rms", "output_levels_db", "selected_traces", "selected_spectra")
        found_rms, levels, traces, spectra = studio.show(FOUR, *names, view=view)
        signal = project_axes(predicted(studio, FOUR, [0, 1, 2, 3]), axes, method)
        np.testing.assert_array_equal(found_rms, rms(signal))
        np.testing.assert_array_equal(levels, decibels(rms(signal)))
        np.testing.assert_array_equal(traces, signal[[51, 28, 0]])
        for part, expected in zip(
            spectra, magnitude_spectrum(signal[[51, 28, 0]], 1300.0), strict=True
        ):
            np.testing.assert_array_equal(part, expected)


def test_drives_lie_on_one_time_axis_and_responses_on_a_longer_one(studio):
    drives, time_s, response_time_s = studio.show(FOUR, "drives", "drive_time_s", "response_time_s")
    assert drives.shape == (4, 260)
    np.testing.assert_allclose(time_s, np.arange(260) / 1300.0, rtol=1e-15)
    np.testing.assert_allclose(response_time_s, np.arange(781) / 1300.0, rtol=1e-15)
    np.testing.assert_array_equal(drives[0], sinusoid(100.0, 0.2, window_name="tukey"))
    assert np.flatnonzero(drives[2]).tolist() == list(range(65, 86))
    assert np.flatnonzero(drives[3]).tolist() == [130]
    (shifted_s,) = studio.show(FOUR, "response_time_s", view=View(delay_removed=True))
    np.testing.assert_allclose(shifted_s, response_time_s - 0.052, rtol=0, atol=1e-15)


def test_what_each_input_plays_is_there_even_when_it_is_muted(studio):
    design = FOUR.with_input(0, muted=True)
    played, drives = studio.show(design, "input_waveforms", "drives")
    assert [samples.size for samples in played] == [260, 260, 21, 1]
    assert drives.shape == (3, 260)


@pytest.mark.parametrize("inputs", [(), (Input(location=7, muted=True),)])
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


def test_the_graph_of_the_studio_knows_every_field_of_design_and_view():
    given = sources(FOUR, View())
    assert {"limb", "inputs", "scaling", "axes", "method", "outputs"} <= set(given)
    results = new_graph().evaluate(["audible", "amplitudes"], given)
    assert results["amplitudes"] == (1.0, -0.5, 2.0, 0.25)


def test_results_cannot_be_written_to(studio):
    wanted = ("drives", "skin_acceleration", "projected", "output_rms", "selected_traces")
    for array in studio.show(FOUR, *wanted):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0.0
