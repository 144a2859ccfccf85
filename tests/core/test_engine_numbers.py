"""Direct sums against every way to the numbers of a design: at once, streamed, predict, sweep."""

from itertools import product

import numpy as np
import pytest

import skinsource as ss
from skinsource import Clip, Limb, LimbMap, View, decibels
from skinsource.base.conventions import AXES
from skinsource.base.errors import InvalidInputError
from skinsource.design.design import Design, Input, audible_inputs, track
from skinsource.design.signal_path import drive_of
from skinsource.design.waveforms.pulses import Impulse, Noise, Tap
from skinsource.design.waveforms.tones import FREQUENCY, PHASE, Tone
from skinsource.engine.evaluation import Evaluator
from skinsource.engine.gains import ExactVoice, peaks_of, trace_error_of, unit_gains
from skinsource.engine.quantities import graphs_that_share, new_graph, sources
from skinsource.engine.spectra import ResponseSpectrum
from skinsource.engine.transforms import BLOCK_FFT, Blocks, forward, inverse, transform_length
from skinsource.limbs.locations import input_name, output_name
from skinsource.limbs.scaling import SCALINGS, per_probe_acceleration
from skinsource.limbs.synthetic import load_synthetic_limb
from skinsource.signals.projection import METHODS, project_axes
from skinsource.signals.spectra import magnitude_spectrum, peak_hold_spectrum, rms
from skinsource.studies.sweeps.measuring import Measurer
from skinsource.studies.sweeps.plan import Plan

N_INPUTS, N_OUTPUTS, RATE_HZ = 7, 10, 2000.0
OUTPUTS = (10, 2, 5)
WAVEFORMS = (
    Tone(frequency_hz=600.0, duration_s=0.3),
    Noise(seed=2),
    Tap(),
    Impulse(),
    Noise(seed=9, duration_s=2.1),
)
PROJECTIONS = list(product(AXES, METHODS))
N_DESIGNS = 7
QUANTITIES = (
    "axis_levels_db",
    "moving_energy",
    "moving_vector",
    "output_levels_db",
    "output_rms",
    "response_time_s",
    "rms_of_windows",
    "selected_axis_peak_spectra",
    "selected_axis_spectra",
    "selected_spectra",
    "selected_traces",
    "surface_levels_db",
    "trace_error",
    "windows",
)


def limb_of_taps(n_taps: int, axes: str, **more) -> Limb:
    """A limb of another shape and rate than the published ones; output 5 is not on its map."""
    rng = np.random.default_rng(4)
    outputs = rng.uniform(-30, 30, (N_OUTPUTS, 2))
    outputs[4] = np.nan
    around = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    return Limb(
        name="made-up",
        hand_length_mm=100.0,
        synthetic=True,
        map=LimbMap(
            outline=50.0 * np.column_stack((np.cos(around), np.sin(around))),
            output_positions=outputs,
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


@pytest.fixture
def limb_of_designs(monkeypatch):
    """Give a function that makes designs mean a limb with so many taps."""

    def use(n_taps: int = 200, axes: str = "xyz") -> Limb:
        limb = limb_of_taps(n_taps, axes)
        monkeypatch.setattr("skinsource.engine.shared.load_limb", lambda *_: limb)
        return limb

    return use


def drawn(seed: int) -> Design:
    """A design of some inputs, of which at least one is heard."""
    rng = np.random.default_rng(seed)
    inputs = []
    for number in range(rng.integers(1, 6)):
        clips = tuple(
            Clip(
                waveform=WAVEFORMS[rng.integers(len(WAVEFORMS))],
                onset_s=int(rng.integers(0, 400)) / RATE_HZ,
                gain=float(rng.choice((1.0, -0.7))),
            )
            for _ in range(rng.integers(1, 4))
        )
        amplitude = float(rng.choice((1.0, -0.5, 2.0, 0.0))) if number else 0.3
        location, muted = int(rng.integers(1, N_INPUTS + 1)), bool(number and rng.integers(4) == 0)
        inputs.append(Input(location=location, clips=clips, amplitude=amplitude, muted=muted))
    scaling = SCALINGS[seed % len(SCALINGS)]
    return Design(limb="made-up", inputs=tuple(inputs), scaling=scaling)


def drives_of(design: Design) -> list[np.ndarray]:
    """Samples of each input that is heard, before its amplitude, of equal length."""
    heard = audible_inputs(design.inputs)
    played = [
        [
            (round(clip.onset_s * RATE_HZ), clip.gain * clip.waveform.samples(RATE_HZ))
            for clip in source.clips
        ]
        for source in heard
    ]
    n_times = max(start + samples.size for clips in played for start, samples in clips)
    drives = np.zeros((len(heard), n_times))
    for drive, clips in zip(drives, played, strict=True):
        for start, samples in clips:
            drive[start : start + samples.size] += samples
    return list(drives)


def direct(limb: Limb, design: Design) -> np.ndarray:
    """Acceleration, (n_outputs, n_axes, n_times), by direct convolution, channel by channel."""
    total = 0.0
    for source, drive in zip(audible_inputs(design.inputs), drives_of(design), strict=True):
        taps = limb.response_to(source.location)
        if design.scaling == "probe":
            taps = per_probe_acceleration(taps, RATE_HZ)
        rows = [
            np.convolve(drive, channel) for channel in taps.reshape(limb.n_axes * N_OUTPUTS, -1)
        ]
        alone = np.array(rows).reshape(N_OUTPUTS, limb.n_axes, -1)
        largest = alone.max() if design.scaling == "upstream" else 1.0
        total = total + alone * (source.amplitude / largest)
    return total


@pytest.fixture(params=["at once", "streamed"])
def way(request, monkeypatch):
    if request.param == "streamed":
        for module in ("voice_rules", "prediction"):
            monkeypatch.setattr(f"skinsource.engine.{module}.length_at_once", lambda *_: None)
    return request.param


@pytest.mark.parametrize("seed", range(N_DESIGNS))
def test_every_way_gives_what_direct_sums_give(limb_of_designs, way, seed):
    measured = ("xyz", "xz", "xyz", "z", "xyz", "xy", "xyz")[seed]
    limb = limb_of_designs((200, 1, 31, 200, 1024, 1025, 3000)[seed], measured)
    design = drawn(seed)
    field, graph = direct(limb, design), new_graph()
    heard, largest = audible_inputs(design.inputs), np.abs(field).max()
    predicted = ss.predict(
        limb,
        drives_of(design),
        [source.location for source in heard],
        [source.amplitude for source in heard],
        design.scaling,
    )
    np.testing.assert_allclose(predicted, field, rtol=0, atol=1e-13 * largest)
    # "xyz" means all axes that there are.
    there = [each for each in PROJECTIONS if each[0] == "xyz" or set(each[0]) <= set(measured)]
    step = N_DESIGNS if measured == "xyz" else 2
    for number, (axes, method) in enumerate(there[seed % step :: step]):
        span = ("record", "loudest")[number % 2]
        view = View(
            axes=axes,
            method=method,
            span=span,
            outputs=OUTPUTS,
            selected_inputs=((), (1,))[number // 2 % 2],
            windows_cut="length",
            window_s=0.077,
        )
        values = graph.evaluate(QUANTITIES, sources(design, view))
        signals = project_axes(field, axes, method, measured)
        rows = [output - 1 for output in OUTPUTS]
        peak, chosen = np.abs(signals).max(), signals[rows]
        expected = rms(signals, span, RATE_HZ)
        np.testing.assert_allclose(values["output_rms"], expected, rtol=1e-11)
        np.testing.assert_allclose(values["output_levels_db"], decibels(expected), atol=1e-9)
        np.testing.assert_allclose(values["selected_traces"], chosen, rtol=0, atol=1e-13 * peak)
        hz, magnitudes = magnitude_spectrum(chosen, RATE_HZ)
        np.testing.assert_array_equal(values["selected_spectra"][0], hz)
        np.testing.assert_allclose(
            values["selected_spectra"][1], magnitudes, rtol=0, atol=1e-13 * peak
        )
        # Along each axis, whichever are chosen.
        for name, spectrum in (("", magnitude_spectrum), ("peak_", peak_hold_spectrum)):
            np.testing.assert_allclose(
                values[f"selected_axis_{name}spectra"][1],
                spectrum(field[rows], RATE_HZ)[1],
                rtol=0,
                atol=1e-12 * largest,
            )
        np.testing.assert_allclose(
            values["axis_levels_db"], decibels(rms(field, span, RATE_HZ)).T, atol=1e-9
        )
        cut = values["windows"]
        within = ss.windowed_rms(signals, cut.window_samples, cut.first_sample)[: cut.count]
        np.testing.assert_allclose(
            values["rms_of_windows"], within, rtol=1e-9, atol=1e-11 * within.max(initial=0.0)
        )
        instant = values["moving_vector"].acceleration(17 / RATE_HZ)
        np.testing.assert_allclose(instant, field[..., 17], rtol=0, atol=1e-12 * largest)
        n = field.shape[-1]
        record = values["moving_energy"].rms((n - 1) / 2 / RATE_HZ, n / RATE_HZ)
        np.testing.assert_allclose(record, rms(signals), rtol=1e-9)
        assert values["moving_vector"].largest == pytest.approx(
            np.sqrt(np.square(field).sum(axis=1)).max()
        )
        assert 0.0 < values["trace_error"].estimate < 1e-13
        assert values["trace_error"].estimate < values["trace_error"].bound
        assert values["response_time_s"].size == n
        assert values["response_time_s"][1] == 1 / RATE_HZ
        inside = values["surface_levels_db"][np.isfinite(values["surface_levels_db"])]
        assert inside.max() <= values["output_levels_db"].max() + 1e-9
    plan = Plan(designs=(("drawn", design),), outputs=OUTPUTS, axes=axes, method=method)
    metrics = Measurer(plan).measure(1)
    for output, signal in zip(OUTPUTS, chosen, strict=True):
        assert metrics[f"output_{output}_rms"] == pytest.approx(rms(signal), rel=1e-11)
        assert metrics[f"output_{output}_peak"] == pytest.approx(np.abs(signal).max(), rel=1e-11)


def test_no_bit_depends_on_what_was_asked_before(limb_of_designs):
    limb_of_designs()
    make, evaluator, rng = graphs_that_share(), Evaluator(), np.random.default_rng(5)
    shared, names = (make(), make()), ("output_rms", "selected_traces", "axis_spectra")
    design = drawn(4)
    for step in range(24):
        index = int(rng.integers(len(design.inputs)))
        clip = design.inputs[index].clips[0]
        design = design.with_input(
            index, amplitude=float(rng.uniform(-2, 2)), muted=bool(index and rng.integers(4) == 0)
        ).with_clip(clip.id, onset_s=int(rng.integers(0, 200)) / RATE_HZ)
        design = drawn(step) if step % 8 == 7 else design
        view = View(
            outputs=tuple(int(k) for k in rng.permutation(N_OUTPUTS)[:3] + 1),
            method=str(rng.choice(METHODS)),
            selected_inputs=(design.inputs[index % len(design.inputs)].id,),
        )
        anew = new_graph().evaluate(names, sources(design, view))
        values = shared[step % 2].evaluate(names, sources(design, view))
        by_script = evaluator.evaluate(design, names, view)
        for name in names:
            np.testing.assert_array_equal(values[name], anew[name], err_msg=f"{step}, {name}")
            for row, expected in zip(by_script[name], anew[name], strict=True):
                peak = np.abs(expected).max()
                np.testing.assert_allclose(row, expected, rtol=1e-10, atol=1e-12 * peak)


@pytest.mark.parametrize("inputs", [(), (track(location=7, muted=True),)])
def test_where_nothing_is_heard_everything_is_silent(limb_of_designs, way, inputs):
    limb, design = limb_of_designs(), Design(limb="made-up", inputs=inputs)
    for method, span in product(METHODS, ("record", "loudest")):
        view = View(method=method, span=span, outputs=OUTPUTS)
        values = new_graph().evaluate(QUANTITIES, sources(design, view))
        assert (values["output_levels_db"] == -200.0).all()
        assert not values["selected_traces"].any()
        assert not values["rms_of_windows"].any()
        assert values["moving_vector"].largest == 0.0
        assert not values["moving_energy"].rms(0.1, 0.02).any()
        assert values["trace_error"] is None
    assert limb.bytes_read == 0


@pytest.mark.parametrize("axes", ["xyz", "z"])
def test_no_selected_outputs_give_empty_traces_and_spectra_also_after_some(
    limb_of_designs, way, axes
):
    limb_of_designs()
    graph, design = new_graph(), drawn(4)
    names = ("axis_traces", "axis_spectra", "selected_traces", "selected_peak_spectra")
    for outputs in ((), OUTPUTS, ()):
        view = View(outputs=outputs, axes=axes, method="pca", selected_inputs=(1,))
        values = graph.evaluate((*names, "trace_error"), sources(design, view))
        n_times = values["selected_traces"].shape[-1]
        assert values["axis_traces"].shape == (len(outputs), len(axes), n_times)
        assert values["axis_spectra"].shape == (len(outputs), len(axes), n_times // 2 + 1)
        assert len(values["selected_peak_spectra"][1]) == len(outputs)
    assert values["trace_error"] is None
    assert graph.work.inverse_transforms == graph.work.forward_transforms == 0


def test_what_a_limb_does_not_have_is_refused_by_name(limb_of_designs):
    limb, design = limb_of_designs(), drawn(4)
    with pytest.raises(InvalidInputError, match=r"made-up has the outputs 1 to 10; .* \[29, 52\]"):
        ss.evaluate(design, "selected_traces", view=View(outputs=(29, 3, 52)))
    with pytest.raises(InvalidInputError, match=r"made-up has the places 1 to 7, .* at place 8"):
        ss.evaluate(design.with_input(0, location=8), "output_rms")
    with pytest.raises(InvalidInputError, match="the whole numbers 1 to 7"):
        ss.predict(limb, [1.0], [8])
    limb.sample_rate_hz = 1000.0
    high = Design(limb="made-up", inputs=(track(7, Tone(frequency_hz=600.0)),))
    with pytest.raises(InvalidInputError, match="half the sample rate of 1000 Hz"):
        ss.evaluate(high, "output_rms")
    limb.n_taps = 199
    with pytest.raises(InvalidInputError, match=r"shape \(10, 3, 200\), expected \(10, 3, 199\)"):
        limb.response_to(1)


@pytest.mark.parametrize(("measured", "axes"), [("xz", "y"), ("xz", "xy"), ("z", "x")])
def test_an_axis_that_was_not_measured_is_refused_by_name(limb_of_designs, measured, axes):
    limb_of_designs(axes=measured)
    message = f"measures along {' and '.join(measured)} only. Choose '{measured}'"
    with pytest.raises(InvalidInputError, match=message):
        new_graph().evaluate({"output_rms"}, sources(drawn(4), View(axes=axes, outputs=OUTPUTS)))
    with pytest.raises(InvalidInputError, match=message):
        project_axes(np.zeros((2, len(measured), 9)), axes, "mag", measured)


@pytest.mark.parametrize("axes", ["", "zx", "xx", "q", "xyz", None])
def test_a_limb_whose_axes_are_not_those_of_its_responses_is_refused(limb_of, axes):
    with pytest.raises(InvalidInputError, match="expected 2 of x, y and z"):
        limb_of(lambda _: np.zeros((N_OUTPUTS, 2, 9)), axes=axes, shape=(N_INPUTS, N_OUTPUTS, 2, 9))


def test_probe_scaling_divides_by_the_pulse_only_where_a_pulse_was_played():
    limb, drive = limb_of_taps(200, "xz", per_unit_drive=True), Tone().samples(RATE_HZ)
    by_probe, relative = (ss.predict(limb, drive, 3, scaling=way) for way in ("probe", "relative"))
    np.testing.assert_array_equal(by_probe, relative)


def test_a_limb_that_is_not_here_is_refused_and_its_places_are_called_by_their_number():
    with pytest.raises(InvalidInputError, match="the limb 'foot-1' is not available here; choose"):
        ss.evaluate(Design(limb="foot-1", inputs=(track(location=25),)), "output_levels_db")
    assert input_name(25).name == "Place 25, not on this hand"
    assert output_name(80).short_name == "not on this limb"


@pytest.mark.parametrize(
    ("rate_hz", "highest"), [(1300.0, 649.0), (1301.0, 650.0), (2000.5, 1000.0), (1e6, 100_000.0)]
)
def test_the_highest_frequency_is_a_whole_one_below_half_the_rate(rate_hz, highest):
    assert FREQUENCY.at_rate(rate_hz).maximum == highest
    assert PHASE.at_rate(rate_hz) is PHASE


def test_outputs_that_move_alike_in_all_directions_are_named(limb_of):
    turns = 2 * np.pi * 100 * np.arange(522) / 522
    turning = np.zeros((72, 3, 522))
    turning[:, 0], turning[:, 1] = np.cos(turns), np.sin(turns)
    turning[9, 1] *= 0.5
    limb = limb_of(lambda _: turning.copy())
    design = Design(limb="synthetic-1", inputs=(track(7, Impulse()),), scaling="upstream")
    for method, expected in (("pca", (1, 29)), ("rms", ())):
        view = View(axes="xyz", method=method, outputs=(1, 10, 29))
        given = sources(design, view) | {"limb_data": limb}
        values = new_graph().evaluate({"selected_without_main_axis"}, given)
        assert values["selected_without_main_axis"] == expected


def response_of(taps: np.ndarray, n_fft: int) -> ResponseSpectrum:
    return ResponseSpectrum(taps, n_fft, forward(taps, n_fft))


@pytest.mark.parametrize("waveform", [Tone(), Impulse(), Noise(seed=1), Noise(duration_s=8.0)])
@pytest.mark.parametrize("place", [7, 20])
def test_the_pruned_search_finds_the_maximum_of_the_full_one(waveform, place):
    drive, taps = drive_of(waveform.samples(1300.0)), load_synthetic_limb(1).response_to(place)
    n_fft = transform_length(drive.samples.size + 521)
    spectrum, response = forward(drive.samples, n_fft), response_of(taps, n_fft)
    full = inverse(response.values * spectrum, n_fft).reshape(216, -1)
    [peak] = peaks_of([drive.samples], [spectrum], [response])
    assert peak == full.max()
    [streamed] = peaks_of([drive.samples], [], [response_of(taps, BLOCK_FFT)])
    assert streamed == pytest.approx(full.max(), rel=1e-13)


ALL_NEGATIVE = np.broadcast_to(-0.1 - np.exp(-np.arange(522) / 100), (72, 3, 522)).copy()


@pytest.mark.parametrize("n_times", [1, 300, 2 * Blocks(522).n_samples - 521, 5000])
def test_only_a_positive_maximum_is_divided_by(n_times):
    samples = 3.0 + np.random.default_rng(n_times).uniform(size=n_times)
    hardly_positive = ALL_NEGATIVE.copy()
    hardly_positive[40, 2] *= -1e-6
    largest = np.convolve(samples, hardly_positive[40, 2]).max()
    n_fft = transform_length(n_times + 521)

    def ways(size, taps):
        drive = drive_of(size * samples)
        whole = [drive], [forward(drive.samples, n_fft)], [response_of(taps, n_fft)]
        return whole, ([drive], [], [response_of(taps, BLOCK_FFT)])

    for arguments in ways(1.0, ALL_NEGATIVE):
        # The power of two that the drive was divided by.
        assert unit_gains(*arguments) == [2.0]
    for arguments in ways(1e-200, ALL_NEGATIVE * 1e-30):
        assert unit_gains(*arguments) == [arguments[0][0].factor]
    for arguments in ways(1.0, hardly_positive):
        # The gain is that of the scaled samples: so many times as large.
        assert unit_gains(*arguments)[0] * largest == pytest.approx(2.0, rel=1e-6)


def test_transforms_give_the_same_bits_alone_and_together():
    rng = np.random.default_rng(3)
    for n in (1821, 1822, 1920):
        signals = rng.standard_normal((7, n))
        together, spectra = forward(signals, n), forward(signals, n)
        for k, signal in enumerate(signals):
            np.testing.assert_array_equal(forward(signal[None], n)[0], together[k])
            back = inverse(spectra[k : k + 1], n)[0]
            np.testing.assert_array_equal(back, inverse(spectra, n)[k])


def checked_trace(waveform, delay: int, n_fft: int = 1152) -> tuple[np.ndarray, ExactVoice]:
    """A trace of output 29 along z by direct convolution, and the voice that makes it."""
    drive, taps = drive_of(waveform.samples(1300.0)), load_synthetic_limb(1).response_to(7)
    response = response_of(taps, n_fft)
    voice = ExactVoice(drive=drive, delay_samples=delay, weight=2.0, response=response)
    field = 2.0 * np.convolve(drive.samples, taps[28, 2])
    trace = np.zeros((1, 1, delay + field.size + delay // 4))
    trace[0, 0, delay : delay + field.size] = field
    return trace, voice


@pytest.mark.parametrize(("waveform", "delay"), [(Tone(), 0), (Noise(seed=5), 40), (Tap(), 60_000)])
def test_the_check_of_traces_knows_right_samples_from_wrong_ones(waveform, delay):
    trace, voice = checked_trace(waveform, delay)
    for time in (0, delay, delay + 1, trace.shape[-1] - 1):
        assert float(voice.exact(29, 2, time)) == pytest.approx(trace[0, 0, time], abs=1e-15)
    peak = np.abs(trace).max()
    for wrong in (0.0, 1e-9, -3e-6):
        estimate = trace_error_of(trace + wrong, (29,), (2,), [voice]).estimate
        assert estimate == pytest.approx(4 * abs(wrong) / peak, rel=1e-4, abs=1e-14)
    assert trace_error_of(trace * (1 + 1e-6), (29,), (2,), [voice]).estimate > 1e-8
