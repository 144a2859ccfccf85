"""Limbs of 7 places, 31 outputs and one to three axes at 4 kHz: what is computed, and why not."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.base.measurement_conditions import AXES
from skinsource.design.design import Design, track
from skinsource.design.design_file import open_design, save_design
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.evaluation import evaluate
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.extent import extent
from skinsource.limbs.limb import Limb, LimbMap
from skinsource.limbs.scaling import per_probe_acceleration
from skinsource.limbs.surface.surface import surface_operator
from skinsource.signals.projection import METHODS, project_axes
from skinsource.signals.spectra import magnitude_spectrum, rms

N_INPUTS, N_OUTPUTS, N_TAPS, RATE_HZ = 7, 31, 180, 4000.0
OUTPUTS = (31, 2, 5)
PLAYED = Design(
    limb="made-up",
    scaling="relative",
    inputs=(
        track(7, Tone(frequency_hz=1500.0, duration_s=0.1)),
        track(3, Noise(seed=2), amplitude=-0.5, onset_s=0.05),
        track(7, Tap(), amplitude=2.0, onset_s=0.1),
    ),
)
LONG = PLAYED.with_clip(2, onset_s=15.0)


def limb_along(axes: str, n_taps: int = N_TAPS, **more) -> Limb:
    rng = np.random.default_rng(4)
    around = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    places = rng.uniform(-30, 30, (N_OUTPUTS, 2))
    places[4] = np.nan
    return Limb(
        name="made-up",
        hand_length_mm=100.0,
        synthetic=True,
        map=LimbMap(
            outline=50.0 * np.column_stack((np.cos(around), np.sin(around))),
            output_positions=places,
            input_positions=rng.uniform(-30, 30, (N_INPUTS, 2)),
            hand_length_px=100.0,
        ),
        read_response=lambda place: np.random.default_rng(place).standard_normal(
            (N_OUTPUTS, len(axes), n_taps)
        ),
        sample_rate_hz=RATE_HZ,
        axes=axes,
        shape=(N_INPUTS, N_OUTPUTS, len(axes), n_taps),
        **more,
    )


def plainly(limb: Limb, design: Design) -> np.ndarray:
    """Acceleration, (31, n_axes, n_times), by direct convolution, channel by channel."""
    played = [
        (round(clip.onset_s * RATE_HZ), clip.waveform.samples(RATE_HZ)) for clip in design.clips
    ]
    n_times = max(start + samples.size for start, samples in played) + limb.n_taps - 1
    total = np.zeros((N_OUTPUTS, limb.n_axes, n_times))
    for input_track, (start, samples) in zip(design.inputs, played, strict=True):
        alone = np.zeros_like(total)
        for channel in np.ndindex(N_OUTPUTS, limb.n_axes):
            answer = np.convolve(samples, limb.response_to(input_track.location)[channel])
            alone[channel][start : start + answer.size] = answer
        largest = alone.max() if design.scaling == "upstream" else 1.0
        total += alone * (input_track.amplitude / largest)
    return total


def shown(limb: Limb, design: Design, view: View, *quantities: str, graph=None) -> dict:
    given = sources(design, view) | {"limb_data": limb}
    return (graph or new_graph()).evaluate(quantities, given)


@pytest.mark.parametrize(
    ("measured", "design"),
    [("xz", PLAYED), ("xy", PLAYED), ("z", PLAYED), ("xyz", PLAYED), ("xz", LONG), ("z", LONG)],
)
def test_every_projection_of_the_axes_there_are_is_that_of_plain_convolution(measured, design):
    limb, graph = limb_along(measured), new_graph()
    field = plainly(limb, design)
    there = [axes for axes in AXES if set(axes) <= set(measured)]
    for axes, method, span in product((*there, "xyz"), METHODS, ("record", "loudest")):
        view = View(axes=axes, method=method, outputs=OUTPUTS, span=span)
        values = shown(
            limb,
            design,
            view,
            "output_rms",
            "selected_traces",
            "selected_spectra",
            "trace_error",
            graph=graph,
        )
        signals = project_axes(field, axes, method, measured)
        np.testing.assert_allclose(values["output_rms"], rms(signals, span, RATE_HZ), rtol=1e-10)
        picked = signals[[output - 1 for output in OUTPUTS]]
        tolerance = 1e-12 * np.abs(signals).max()
        np.testing.assert_allclose(values["selected_traces"], picked, atol=tolerance)
        hz, magnitudes = magnitude_spectrum(picked, RATE_HZ)
        np.testing.assert_array_equal(values["selected_spectra"][0], hz)
        np.testing.assert_allclose(values["selected_spectra"][1], magnitudes, atol=tolerance)
        assert values["trace_error"].estimate < 1e-13


def test_upstream_scaling_takes_the_largest_of_the_axes_there_are():
    limb, design = limb_along("xz"), replace(PLAYED, scaling="upstream")
    expected = rms(project_axes(plainly(limb, design), "xz", "mag", "xz"))
    values = shown(limb, design, View(axes="xz", method="mag", outputs=()), "output_rms")
    np.testing.assert_allclose(values["output_rms"], expected, rtol=1e-11)


@pytest.mark.parametrize(("measured", "axes"), [("xz", "y"), ("xz", "xy"), ("z", "x")])
def test_an_axis_that_was_not_measured_is_refused_by_name(measured, axes):
    limb = limb_along(measured)
    message = f"measures along {' and '.join(measured)} only. Choose '{measured}'"
    with pytest.raises(InvalidInputError, match=message):
        shown(limb, PLAYED, View(axes=axes, outputs=OUTPUTS), "output_rms")
    with pytest.raises(InvalidInputError, match=message):
        project_axes(np.zeros((2, len(measured), 9)), axes, "mag", measured)


@pytest.mark.parametrize("axes", ["", "zx", "xx", "q", "xyz", None])
def test_a_limb_whose_axes_are_not_those_of_its_responses_is_refused(axes):
    with pytest.raises(InvalidInputError, match="expected 2 of x, y and z"):
        Limb(
            name="odd",
            hand_length_mm=100.0,
            synthetic=True,
            map=limb_along("xz").map,
            read_response=lambda _: np.zeros((N_OUTPUTS, 2, 9)),
            axes=axes,
            shape=(N_INPUTS, N_OUTPUTS, 2, 9),
        )


def test_probe_scaling_divides_by_the_pulse_only_where_a_pulse_was_played():
    drive = Tone(frequency_hz=200.0, duration_s=0.1).samples(RATE_HZ)
    plain, pulsed = limb_along("xz", per_unit_drive=True), limb_along("xz")
    relative = predict(plain, [drive], [3], scaling="relative")
    np.testing.assert_array_equal(predict(plain, [drive], [3], scaling="probe"), relative)
    taps = per_probe_acceleration(pulsed.response_to(3), RATE_HZ)
    expected = np.convolve(drive, taps[7, 1])
    response = predict(pulsed, [drive], [3], scaling="probe")[7, 1]
    np.testing.assert_allclose(response, expected, atol=1e-12 * np.abs(expected).max())
    assert not np.allclose(response, relative[7, 1], atol=1e-3 * np.abs(expected).max())


def test_the_map_shows_the_outputs_that_have_a_place():
    limb = limb_along("xz")
    operator = surface_operator(limb)
    assert operator.weights.shape[1] == N_OUTPUTS
    assert not operator.weights[:, [4]].nnz
    values = shown(limb, PLAYED, View(axes="xz", outputs=()), "output_levels_db")
    levels = operator.interpolate(values["output_levels_db"])
    inside = levels[np.isfinite(levels)]
    placed = np.delete(values["output_levels_db"], 4)
    assert inside.size
    assert placed.min() - 1e-9 <= inside.min() <= inside.max() <= placed.max() + 1e-9
    energy = 10 ** (values["output_levels_db"] / 20)
    assert 0.0 < extent(energy, limb, (7,)).mean_distance_mm < 100.0


@pytest.mark.parametrize("n_taps", [1, 31, 1024, 1025, 3000])
def test_responses_of_any_length_are_streamed_right(n_taps):
    limb, design = limb_along("z", n_taps), replace(LONG, scaling="upstream")
    values = shown(limb, design, View(outputs=OUTPUTS, axes="z"), "selected_traces")
    signals = plainly(limb, design)[:, 0]
    peak = np.abs(signals).max()
    np.testing.assert_allclose(
        values["selected_traces"], signals[[output - 1 for output in OUTPUTS]], atol=1e-13 * peak
    )


def test_a_response_of_another_shape_than_the_limb_says_is_refused():
    limb = limb_along("xyz")
    limb.n_taps = 179
    with pytest.raises(InvalidInputError, match=r"shape \(31, 3, 180\), expected \(31, 3, 179\)"):
        limb.response_to(1)


def test_outputs_and_places_that_the_limb_does_not_have_are_refused_by_name():
    limb = limb_along("xyz")
    with pytest.raises(InvalidInputError, match=r"made-up has the outputs 1 to 31; .* \[52, 40\]"):
        shown(limb, PLAYED, View(outputs=(52, 3, 40)), "selected_traces")
    elsewhere = PLAYED.with_input(0, location=8)
    with pytest.raises(InvalidInputError, match=r"made-up has the places 1 to 7, .* at place 8"):
        shown(limb, elsewhere, View(outputs=OUTPUTS), "output_rms")


def test_tones_above_half_the_rate_of_the_limb_are_refused():
    slow = limb_along("xyz")
    slow.sample_rate_hz = 1000.0
    with pytest.raises(InvalidInputError, match="half the sample rate of 1000 Hz"):
        shown(slow, PLAYED, View(outputs=OUTPUTS), "output_rms")


def test_a_design_for_a_limb_that_is_not_here_is_read_and_refused_where_it_is_computed(tmp_path):
    design = Design(limb="foot-1", inputs=(track(location=25),))
    save_design(tmp_path / "foot.skinsource", design)
    content = open_design(tmp_path / "foot.skinsource")
    assert content.design == design
    with pytest.raises(InvalidInputError, match="the limb 'foot-1' is not available here; choose"):
        evaluate(content.design, "output_levels_db")
