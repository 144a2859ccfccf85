"""The engine's numbers, against plain convolution with numpy."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.base.measurement_conditions import AXES
from skinsource.design.design import Design, audible_inputs, track
from skinsource.design.signal_path import drive_of
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Impulse, Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.gains import peaks_of
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.spectra import ResponseSpectrum
from skinsource.engine.transforms import BLOCK_FFT, Blocks, forward, inverse, transform_length
from skinsource.limbs.limb import Limb
from skinsource.limbs.synthetic import load_synthetic_limb
from skinsource.signals.projection import METHODS, project_axes

RATE_HZ = 1300.0
DESIGN = Design(
    scaling="upstream",
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=100.0)),
        track(location=3, waveform=Noise(seed=2), amplitude=-0.5, onset_s=0.05, colour=1),
        track(location=7, waveform=Tap(), amplitude=2.0, onset_s=0.1, colour=2),
        track(location=16, waveform=Impulse(), amplitude=0.25, onset_s=0.3, colour=3),
    ),
)
ALL = ("output_rms", "selected_traces", "selected_spectra")
OUTPUTS = (1, 29, 52, 61)


@pytest.fixture(scope="module")
def limb() -> Limb:
    return load_synthetic_limb(1)


def plainly(limb: Limb, design: Design) -> np.ndarray:
    """Field (72, 3, n_times) by direct convolution, channel by channel."""
    audible = audible_inputs(design.inputs)
    played = [
        (round(clip.onset_s * RATE_HZ), clip.waveform.samples(RATE_HZ))
        for track in audible
        for clip in track.clips
    ]
    n_times = max(start + samples.size for start, samples in played) + 521
    total = np.zeros((72, 3, n_times))
    for input_track, (start, samples) in zip(audible, played, strict=True):
        field = np.zeros_like(total)
        for channel in np.ndindex(72, 3):
            answer = np.convolve(samples, limb.response_to(input_track.location)[channel])
            field[channel][start : start + answer.size] = answer
        largest = field.max() if design.scaling == "upstream" else 1.0
        total += field * (input_track.amplitude / largest)
    return total


def shown(design: Design, view: View, quantities=ALL, graph=None) -> dict:
    return (graph or new_graph()).evaluate(quantities, sources(design, view))


def same_bits(values, expected, what: str) -> None:
    pairs = (
        zip(values, expected, strict=True) if isinstance(values, tuple) else [(values, expected)]
    )
    for a, b in pairs:
        np.testing.assert_array_equal(a, b, err_msg=what)


@pytest.mark.parametrize("scaling", ["upstream", "relative"])
@pytest.mark.parametrize("selected", [(), (1,), (4,)])
def test_levels_traces_and_spectra_are_those_of_plain_convolution(limb, scaling, selected):
    design = replace(DESIGN, scaling=scaling)
    field = plainly(limb, design)
    for axes in AXES:
        for method in METHODS:
            view = View(axes=axes, method=method, outputs=OUTPUTS, selected_inputs=selected)
            values = shown(design, view)
            signals = project_axes(field, axes, method)
            peak = np.abs(signals).max()
            expected_rms = np.sqrt(np.mean(signals**2, axis=1))
            # Each output against itself, however quiet, and however its axes cancel.
            np.testing.assert_allclose(values["output_rms"], expected_rms, rtol=1e-12)
            chosen = signals[[output - 1 for output in OUTPUTS]]
            np.testing.assert_allclose(values["selected_traces"], chosen, atol=1e-13 * peak)
            magnitude = np.abs(np.fft.rfft(chosen)) / chosen.shape[-1]
            magnitude[:, 1 : (chosen.shape[-1] + 1) // 2] *= 2
            np.testing.assert_allclose(
                values["selected_spectra"][1], magnitude, atol=1e-13 * peak, rtol=0
            )


def test_results_do_not_depend_on_what_was_asked_before():
    graph, rng = new_graph(), np.random.default_rng(5)
    view = View(axes="xyz", method="pca", outputs=OUTPUTS, selected_inputs=(2,))
    design = DESIGN
    for _ in range(30):
        index = int(rng.integers(4))
        design = design.with_input(
            index,
            amplitude=float(rng.uniform(-2, 2)),
            muted=bool(rng.integers(4) == 0),
        ).with_clip(index + 1, onset_s=float(rng.integers(0, 200)) / RATE_HZ)
        view = replace(
            view,
            selected_inputs=(1 + int(rng.integers(4)),),
            outputs=tuple(int(k) for k in rng.permutation(72)[:3] + 1),
            method=str(rng.choice(METHODS)),
        )
        values, anew = shown(design, view, graph=graph), shown(design, view)
        for name in ALL:
            same_bits(values[name], anew[name], f"seed 5, {name}")


def test_two_inputs_that_cancel_keep_their_digits(limb):
    tone = Tone(frequency_hz=100.0)
    design = Design(
        limb="synthetic-1",
        scaling="relative",
        inputs=(
            track(location=7, waveform=tone),
            track(location=7, waveform=tone, amplitude=-(1 - 1e-6), colour=1),
        ),
    )
    alone = shown(replace(design, inputs=design.inputs[:1]), View(selected_inputs=()))
    both = shown(design, View(selected_inputs=(2,)))
    np.testing.assert_allclose(both["output_rms"], 1e-6 * alone["output_rms"], rtol=1e-9)


def test_nothing_is_felt_before_a_drive_nor_522_samples_after_it():
    design = Design(
        limb="synthetic-1",
        inputs=(
            track(location=7, waveform=Tone(duration_s=0.1), onset_s=0.5),
            track(location=8, waveform=Tone(duration_s=0.1), onset_s=1.5, colour=1),
        ),
    )
    traces = shown(design, View(outputs=OUTPUTS, selected_inputs=(1,)))["selected_traces"]
    assert not traces[:, :650].any()
    assert traces[:, 650 : 650 + 130 + 521].any()
    assert not traces[:, 650 + 130 + 521 : 1950].any()


def test_onset_and_amplitude_by_powers_of_two_are_exact():
    view = View(outputs=OUTPUTS, selected_inputs=(1,), axes="z")
    once = shown(DESIGN.with_input(0, amplitude=1.0), view, ("axis_traces",))["axis_traces"]
    scaled = replace(
        DESIGN,
        inputs=tuple(replace(track, amplitude=track.amplitude * 8) for track in DESIGN.inputs),
    )
    eight = shown(scaled, view, ("axis_traces",))["axis_traces"]
    np.testing.assert_array_equal(eight, 8 * once)


@pytest.mark.parametrize("waveform", [Tone(), Tap(), Impulse(), Noise(seed=1), Noise(seed=9)])
@pytest.mark.parametrize("place", [1, 7, 20])
def test_the_pruned_search_finds_the_maximum_of_the_full_one(limb, waveform, place):
    drive = drive_of(waveform.samples(RATE_HZ))
    n_fft = transform_length(drive.samples.size + 521)
    taps = limb.response_to(place)
    response = ResponseSpectrum(taps, forward(taps, n_fft), n_fft)
    spectrum = forward(drive.samples, n_fft)
    full = float(inverse(response.values * spectrum, n_fft).max())
    [peak] = peaks_of([drive.samples], [spectrum], [response])
    assert peak.value == full
    field = inverse(response.values * spectrum, n_fft).reshape(216, -1)
    assert field[peak.channel, peak.time] == full


def test_transforms_give_the_same_bits_alone_and_together():
    rng = np.random.default_rng(3)
    for n in (1821, 1822, 1000):
        signals = rng.standard_normal((7, n))
        together = forward(signals, n)
        for k, signal in enumerate(signals):
            np.testing.assert_array_equal(forward(signal[None], n)[0], together[k])
    spectra = forward(rng.standard_normal((7, 1920)), 1920)
    for k, spectrum in enumerate(spectra):
        np.testing.assert_array_equal(inverse(spectrum[None], 1920)[0], inverse(spectra, 1920)[k])


@pytest.mark.parametrize("length", [1, 521, 522, 523, 575, 576, 577, 6144, 100_000])
def test_the_ladder_holds_the_length_and_wastes_at_most_a_third(length):
    n_fft = transform_length(length)
    assert n_fft >= length
    assert n_fft % 64 == 0
    assert length < 577 or n_fft < length * 4 / 3 + 64


@pytest.mark.parametrize("scaling", ["upstream", "relative"])
def test_a_long_scene_is_streamed_to_the_same_numbers(limb, scaling):
    design = Design(
        limb="synthetic-1",
        scaling=scaling,
        inputs=(
            track(location=7, waveform=Tone(frequency_hz=90.0, duration_s=0.3)),
            track(location=4, waveform=Noise(seed=2, duration_s=3.0), onset_s=13.0, colour=1),
        ),
    )
    field = plainly(limb, design)
    view = View(outputs=OUTPUTS, axes="xyz", method="soc", selected_inputs=(1,))
    values = shown(design, view)
    signals = field.sum(axis=1)
    np.testing.assert_allclose(
        values["output_rms"], np.sqrt(np.mean(signals**2, axis=1)), rtol=1e-11
    )
    chosen = signals[[output - 1 for output in OUTPUTS]]
    peak = np.abs(chosen).max()
    np.testing.assert_allclose(values["selected_traces"], chosen, atol=1e-13 * peak)
    assert not values["selected_traces"][:, 390 + 521 : 16_900].any()


def test_the_maximum_of_a_long_drive_is_found_block_by_block(limb):
    drive = drive_of(Noise(seed=4, duration_s=8.0).samples(RATE_HZ)).samples
    taps = limb.response_to(9)
    response = ResponseSpectrum(taps, forward(taps, BLOCK_FFT), BLOCK_FFT)
    n_fft = transform_length(drive.size + 521)
    full = inverse(forward(taps, n_fft) * forward(drive[None], n_fft), n_fft)
    assert drive.size > 2 * Blocks(522).n_samples
    [peak] = peaks_of([drive], [], [response])
    assert peak.value == pytest.approx(full.max(), rel=1e-13)
    assert full.reshape(216, -1)[peak.channel, peak.time] == full.max()


def test_outputs_that_move_alike_in_all_directions_are_named(limb_of):
    turns = 2 * np.pi * 100 * np.arange(522) / 522
    turning = np.zeros((72, 3, 522))
    turning[:, 0], turning[:, 1] = np.cos(turns), np.sin(turns)
    turning[9, 1] *= 0.5
    limb = limb_of(lambda _: turning.copy())
    design = Design(
        limb="synthetic-1", inputs=(track(location=7, waveform=Impulse()),), scaling="upstream"
    )
    for method, expected in (("pca", (1, 29)), ("rms", ())):
        view = View(axes="xyz", method=method, outputs=(1, 10, 29))
        given = sources(design, view) | {"limb_data": limb}
        values = new_graph().evaluate({"selected_without_main_axis"}, given)
        assert values["selected_without_main_axis"] == expected


@pytest.mark.parametrize("onset_s", [0.0, 0.1])
@pytest.mark.parametrize("axes", ["xyz", "z"])
def test_no_selected_outputs_give_empty_traces_and_spectra_also_after_some(onset_s, axes):
    design = DESIGN.with_clip(1, onset_s=onset_s)
    graph = new_graph()
    quantities = ("axis_traces", "axis_spectra", "selected_traces", "selected_spectra")
    for outputs in ((), OUTPUTS, ()):
        view = View(outputs=outputs, axes=axes, method="pca", selected_inputs=(1,))
        values = graph.evaluate(quantities, sources(design, view))
        n_times = values["selected_traces"].shape[-1]
        assert values["selected_traces"].shape == (len(outputs), n_times)
        assert values["axis_traces"].shape == (len(outputs), len(axes), n_times)
        assert values["axis_spectra"].shape == (len(outputs), len(axes), n_times // 2 + 1)
        assert values["axis_spectra"].dtype == np.complex128
        assert values["selected_spectra"][1].shape == (len(outputs), n_times // 2 + 1)
