"""Limbs of other sizes and rates: through the whole graph, against plain convolution."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.base.measurement_conditions import AXES
from skinsource.design import edits
from skinsource.design.design import Design, track
from skinsource.design.design_file import open_design, save_design
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import FREQUENCY, PHASE, Tone
from skinsource.engine.evaluation import evaluate
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.limb import Limb, LimbMap
from skinsource.limbs.locations import input_name, output_name
from skinsource.signals.projection import METHODS, project_axes
from skinsource.signals.spectra import magnitude_spectrum, rms

N_INPUTS, N_OUTPUTS, N_TAPS, RATE_HZ = 7, 10, 200, 2000.0
OUTPUTS = (10, 2, 5)
SHORT = Design(
    limb="made-up",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=600.0, duration_s=0.3)),
        track(location=3, waveform=Noise(seed=2), amplitude=-0.5, onset_s=0.05),
        track(location=7, waveform=Tap(), amplitude=2.0, onset_s=0.1),
    ),
)
LONG = SHORT.with_clip(2, onset_s=30.0)
WANTED = (
    "input_waveforms",
    "limb_map",
    "output_rms",
    "output_levels_db",
    "response_time_s",
    "selected_spectra",
    "selected_traces",
    "surface_levels_db",
    "trace_error",
)


def synthetic_limb(n_taps: int = N_TAPS) -> Limb:
    rng = np.random.default_rng(4)
    around = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    return Limb(
        name="made-up",
        hand_length_mm=100.0,
        synthetic=True,
        map=LimbMap(
            outline=50.0 * np.column_stack((np.cos(around), np.sin(around))),
            output_positions=rng.uniform(-30, 30, (N_OUTPUTS, 2)),
            input_positions=rng.uniform(-30, 30, (N_INPUTS, 2)),
            hand_length_px=100.0,
        ),
        read_response=lambda place: np.random.default_rng(place).standard_normal(
            (N_OUTPUTS, 3, n_taps)
        ),
        sample_rate_hz=RATE_HZ,
        shape=(N_INPUTS, N_OUTPUTS, 3, n_taps),
    )


def plainly(limb: Limb, design: Design) -> np.ndarray:
    """Acceleration, (10, 3, n_times), by direct convolution, channel by channel."""
    played = [
        (round(clip.onset_s * RATE_HZ), clip.waveform.samples(RATE_HZ)) for clip in design.clips
    ]
    n_times = max(start + samples.size for start, samples in played) + limb.n_taps - 1
    total = np.zeros((N_OUTPUTS, 3, n_times))
    for input_track, (start, samples) in zip(design.inputs, played, strict=True):
        alone = np.zeros_like(total)
        for channel in np.ndindex(N_OUTPUTS, 3):
            answer = np.convolve(samples, limb.response_to(input_track.location)[channel])
            alone[channel][start : start + answer.size] = answer
        largest = alone.max() if design.scaling == "upstream" else 1.0
        total += alone * (input_track.amplitude / largest)
    return total


def shown(limb: Limb, design: Design, view: View, span: str, graph=None) -> dict:
    given = sources(design, replace(view, span=span)) | {"limb_data": limb}
    return (graph or new_graph()).evaluate(WANTED, given)


@pytest.mark.parametrize("design", [SHORT, LONG], ids=["at once", "streamed"])
@pytest.mark.parametrize("scaling", ["upstream", "relative"])
def test_every_quantity_is_that_of_plain_convolution(design, scaling):
    limb, graph = synthetic_limb(), new_graph()
    design = replace(design, scaling=scaling)
    field = plainly(limb, design)
    for axes in AXES:
        for method in METHODS:
            for span in ("record", "loudest"):
                view = View(axes=axes, method=method, outputs=OUTPUTS)
                values = shown(limb, design, view, span, graph)
                signals = project_axes(field, axes, method)
                peak = np.abs(signals).max()
                expected = rms(signals, span, RATE_HZ)
                np.testing.assert_allclose(values["output_rms"], expected, rtol=1e-11)
                picked = signals[[output - 1 for output in OUTPUTS]]
                np.testing.assert_allclose(values["selected_traces"], picked, atol=1e-13 * peak)
                hz, magnitudes = magnitude_spectrum(picked, RATE_HZ)
                np.testing.assert_array_equal(values["selected_spectra"][0], hz)
                np.testing.assert_allclose(
                    values["selected_spectra"][1], magnitudes, atol=1e-13 * peak
                )
    assert values["trace_error"].estimate < 1e-14
    assert values["response_time_s"][1] == 1 / RATE_HZ
    levels = values["surface_levels_db"]
    inside = np.isfinite(levels)
    assert inside.any()
    assert levels[inside].max() <= values["output_levels_db"].max() + 1e-9


@pytest.mark.parametrize("n_taps", [1, 31, 1024, 1025, 3000])
def test_responses_of_any_length_are_streamed_right(n_taps):
    limb = synthetic_limb(n_taps)
    design = replace(LONG, scaling="upstream")
    values = shown(limb, design, View(outputs=OUTPUTS, axes="z"), "record")
    signals = plainly(limb, design)[:, 2]
    peak = np.abs(signals).max()
    np.testing.assert_allclose(
        values["selected_traces"], signals[[output - 1 for output in OUTPUTS]], atol=1e-13 * peak
    )


def test_prediction_takes_the_limb_as_it_is():
    limb = synthetic_limb()
    drive = Noise(seed=1).samples(RATE_HZ)
    response = predict(limb, [drive], [7], scaling="relative")
    expected = np.convolve(drive, limb.response_to(7)[9, 2])
    assert response.shape == (N_OUTPUTS, 3, drive.size + N_TAPS - 1)
    np.testing.assert_allclose(response[9, 2], expected, atol=1e-12)
    with pytest.raises(InvalidInputError, match="the whole numbers 1 to 7"):
        predict(limb, [drive], [8])


def test_a_response_of_another_shape_than_the_limb_says_is_refused():
    limb = synthetic_limb()
    limb.n_taps = 199
    with pytest.raises(InvalidInputError, match=r"shape \(10, 3, 200\), expected \(10, 3, 199\)"):
        limb.response_to(1)


def test_outputs_and_places_that_the_limb_does_not_have_are_refused_by_name():
    limb = synthetic_limb()
    with pytest.raises(InvalidInputError, match=r"made-up has the outputs 1 to 10; .* \[29, 52\]"):
        shown(limb, SHORT, View(outputs=(29, 3, 52)), "record")
    elsewhere = SHORT.with_input(0, location=8)
    with pytest.raises(InvalidInputError, match=r"made-up has the places 1 to 7, .* at place 8"):
        shown(limb, elsewhere, View(outputs=OUTPUTS), "record")


def test_tones_above_half_the_rate_of_the_limb_are_refused():
    slow = synthetic_limb()
    slow.sample_rate_hz = 1000.0
    with pytest.raises(InvalidInputError, match="half the sample rate of 1000 Hz"):
        shown(slow, SHORT, View(outputs=OUTPUTS), "record")


def test_values_leave_to_the_limb_what_it_has():
    rate = synthetic_limb()
    rate.sample_rate_hz = 10_000.0
    high = SHORT.with_clip(1, waveform=Tone(frequency_hz=4000.0))
    values = shown(rate, high, View(outputs=OUTPUTS), "record")
    assert np.isfinite(values["output_levels_db"]).all()
    low = SHORT.with_clip(1, waveform=Tone(frequency_hz=0.01))
    assert np.isfinite(
        shown(synthetic_limb(), low, View(outputs=OUTPUTS), "record")["output_rms"]
    ).all()
    assert Design(limb="foot-1", inputs=(track(location=9000),)).inputs[0].location == 9000


def test_a_design_for_a_limb_that_is_not_here_is_read_and_refused_where_it_is_computed(tmp_path):
    design = Design(limb="foot-1", inputs=(track(location=25),))
    save_design(tmp_path / "foot.skinsource", design)
    content = open_design(tmp_path / "foot.skinsource")
    assert content.design == design
    with pytest.raises(InvalidInputError, match="the limb 'foot-1' is not available here; choose"):
        evaluate(content.design, "output_levels_db")


def test_places_that_have_no_name_here_are_called_by_their_number():
    assert input_name(7).name == "Digit II, pad"
    assert input_name(25).name == "Place 25, not on this hand"
    assert output_name(80).short_name == "not on this limb"
    assert (
        edits.place_input(replace(SHORT, limb="synthetic-1"), View(), 25).label
        == "Place input at 25 (not on this hand)"
    )


@pytest.mark.parametrize(
    ("rate_hz", "highest"), [(1300.0, 649.0), (1301.0, 650.0), (2000.5, 1000.0), (1e6, 100_000.0)]
)
def test_the_highest_frequency_is_a_whole_one_below_half_the_rate(rate_hz, highest):
    assert FREQUENCY.at_rate(rate_hz).maximum == highest
    assert PHASE.at_rate(rate_hz) is PHASE
