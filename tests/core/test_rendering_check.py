"""The check of traces notices a wrong sample, and passes right ones."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.design.design import Design, track
from skinsource.design.signal_path import drive_of
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.gains import ExactVoice, trace_error_of
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.spectra import ResponseSpectrum
from skinsource.engine.transforms import forward
from skinsource.limbs.synthetic import load_synthetic_limb

DESIGN = Design(
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(), onset_s=0.1),
        track(location=3, waveform=Noise(seed=2), amplitude=-0.5, colour=1),
        track(location=18, waveform=Tap(), amplitude=3.0, colour=2),
    ),
)
VIEW = View(outputs=(29, 52, 61), axes="xyz")


@pytest.mark.parametrize("scaling", ["upstream", "relative", "probe"])
@pytest.mark.parametrize("selected", [(), (1,), (3,)])
def test_traces_of_the_engine_pass_the_check(scaling, selected):
    design, view = replace(DESIGN, scaling=scaling), replace(VIEW, selected_inputs=selected)
    error = new_graph().evaluate({"trace_error"}, sources(design, view))["trace_error"]
    assert 0 < error.estimate < 1e-14
    assert error.estimate < error.bound


def test_silence_and_no_outputs_have_no_error():
    for design, view in ((replace(DESIGN, inputs=()), VIEW), (DESIGN, replace(VIEW, outputs=()))):
        assert new_graph().evaluate({"trace_error"}, sources(design, view))["trace_error"] is None


def test_an_exact_sample_is_that_of_plain_convolution():
    drive = drive_of(Noise(seed=5).samples(1300.0))
    taps = load_synthetic_limb(1).response_to(9)
    response = ResponseSpectrum(taps, forward(taps, 1152), 1152)
    voice = ExactVoice(drive=drive, delay_samples=40, weight=2.0, response=response)
    plain = np.concatenate((np.zeros(40), 2.0 * np.convolve(drive.samples, taps[28, 1])))
    for time in (0, 39, 40, 41, 200, 299, 300, 700, 820):
        assert float(voice.exact(29, 1, time)) == pytest.approx(plain[time], abs=1e-15)


def test_a_wrong_trace_is_noticed():
    drive = drive_of(Tone().samples(1300.0))
    taps = load_synthetic_limb(1).response_to(7)
    response = ResponseSpectrum(taps, forward(taps, 1152), 1152)
    voice = ExactVoice(drive=drive, delay_samples=0, weight=1.0, response=response)
    trace = np.convolve(drive.samples, taps[28, 2])[None, None]
    right = trace_error_of(trace, (29,), (2,), [voice])
    wrong = trace_error_of(trace * (1 + 1e-6), (29,), (2,), [voice])
    assert right.estimate < 1e-14 < 1e-8 < wrong.estimate


def test_an_error_in_a_short_sound_within_a_long_silence_is_noticed():
    drive = drive_of(Tap().samples(1300.0))
    taps = load_synthetic_limb(1).response_to(7)
    response = ResponseSpectrum(taps, forward(taps, 1152), 1152)
    voice = ExactVoice(drive=drive, delay_samples=60_000, weight=1.0, response=response)
    trace = np.zeros((1, 1, 78_000))
    field = np.convolve(drive.samples, taps[28, 2])
    trace[0, 0, 60_000 : 60_000 + field.size] = field
    assert trace_error_of(trace, (29,), (2,), [voice]).estimate < 1e-14
    assert trace_error_of(trace * (1 + 1e-6), (29,), (2,), [voice]).estimate > 1e-8


@pytest.mark.parametrize("wrong", [1e-9, -3e-6])
def test_the_estimate_is_four_times_the_largest_error_found(wrong):
    drive = drive_of(Tone().samples(1300.0))
    taps = load_synthetic_limb(1).response_to(7)
    response = ResponseSpectrum(taps, forward(taps, 1152), 1152)
    voice = ExactVoice(drive=drive, delay_samples=0, weight=1.0, response=response)
    trace = np.convolve(drive.samples, taps[28, 2])[None, None] + wrong
    error = trace_error_of(trace, (29,), (2,), [voice])
    assert error.estimate == pytest.approx(4 * abs(wrong) / np.abs(trace).max(), rel=1e-5)


def test_the_bound_grows_with_the_number_of_butterflies_of_a_transform():
    drive = drive_of(Tap().samples(1300.0))
    taps = load_synthetic_limb(1).response_to(7)
    trace = np.convolve(drive.samples, taps[28, 2])[None, None]
    bounds = {}
    for n_fft in (1024, 2**15):
        response = ResponseSpectrum(taps, forward(taps, n_fft), n_fft)
        voice = ExactVoice(drive=drive, delay_samples=0, weight=1.0, response=response)
        bounds[n_fft] = trace_error_of(trace, (29,), (2,), [voice]).bound
    # A few units in the last place of drive times response, for each of so many stages.
    norms = np.linalg.norm(drive.samples) * np.linalg.norm(taps[28, 2])
    unit = np.finfo(np.float64).eps * norms / np.abs(trace).max()
    assert 3 * 10 * unit <= bounds[1024] <= 30 * 10 * unit
    assert bounds[2**15] / bounds[1024] == pytest.approx(15 / 10)
