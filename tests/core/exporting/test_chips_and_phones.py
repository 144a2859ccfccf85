"""Formats of driver chips and phones: the facts of their makers, read from what was written."""

import json
import re
from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.base.errors import InvalidInputError
from skinsource.export.formats import format_named
from skinsource.export.formats.chips import envelope_of
from skinsource.export.stimulus_export.preparing import prepare_stimulus
from tests.core.exporting.export_bench import actuation, sidecar


def arrays_of(path):
    """Values of each array in a header, by name, and its constants."""
    text = path.read_text(encoding="ascii")
    arrays = {
        name: np.array([int(number) for number in re.findall(r"-?\d+", body)])
        for name, body in re.findall(r"(stim_\w+)\[STIM_N\][^{]*\{([^}]*)\}", text)
    }
    return arrays, dict(re.findall(r"#define (STIM_\w+) (\S+)", text))


def content_of(design, path):
    ss.export_stimulus(design, path)
    return json.loads(path.read_text())


@pytest.fixture
def tone():
    """One place: 175 Hz for 0.5 s at full strength, then 0.2 s at half of it."""
    loud = ss.Clip(waveform=ss.waveforms.Tone(frequency_hz=175.0, duration_s=0.5, window="none"))
    soft = ss.Clip(
        waveform=ss.waveforms.Tone(frequency_hz=175.0, duration_s=0.2, window="none"),
        onset_s=0.6,
        gain=0.5,
    )
    return ss.Design(limb="synthetic-1", inputs=(ss.Input(location=7, clips=(loud, soft)),))


@pytest.mark.parametrize("frequency_hz", [60.0, 175.0, 300.0])
def test_the_envelope_of_a_sine_is_its_amplitude_and_its_frequency(frequency_hz):
    time_s = np.arange(8000) / 8000.0
    envelope = envelope_of(0.7 * np.sin(2 * np.pi * frequency_hz * time_s), 8000.0, 0.01)
    middle = slice(20, 80)
    np.testing.assert_allclose(envelope.amplitude[middle], 0.7, rtol=0.02)
    np.testing.assert_allclose(envelope.frequency_hz[middle], frequency_hz, rtol=0.02)
    assert envelope.time_s[0] == 0.0
    assert envelope.time_s[-1] == 1.0


@pytest.mark.parametrize("updates", ["100", "200", "500"])
def test_drv2605l_gets_amplitudes_and_ends_off(tone, tmp_path, updates):
    path = tmp_path / "a.h"
    options = ss.StimulusOptions(choices={"updates": updates})
    ss.export_stimulus(tone, path, "drv2605l", 48_000, options=options)
    arrays, constants = arrays_of(path)
    values = arrays["stim_place_7"]
    hz = int(updates)
    assert constants["STIM_FS_HZ"] == f"{hz}UL"
    assert "LRA mode: bit 7" in path.read_text(encoding="ascii")
    assert values.size == round(0.8 * hz) + 1
    assert 0 <= values.min() <= values.max() <= 0x7F
    assert values[-1] == 0
    # Full in the loud part, half of it in the soft one, off between them.
    loud, soft = values[round(0.1 * hz) : round(0.4 * hz)], values[round(0.65 * hz) :][: hz // 20]
    ratio = soft.mean() / loud.mean()
    assert ratio == pytest.approx(0.5, abs=0.03)
    assert values[round(0.55 * hz)] < 8
    assert "frequency and phase are the chip's" in sidecar(path)["loses"]


def test_what_is_stronger_than_a_sine_at_full_scale_is_said_to_be_sent_as_one(tmp_path):
    path = tmp_path / "a.h"
    square = ss.waveforms.Square(frequency_hz=100.0)
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, square),))
    done = ss.export_stimulus(design, path, "drv2605l")
    (values,), about = arrays_of(path)[0].values(), sidecar(path)
    # A square wave of 1 is as strong as a sine of 1.41.
    assert values[20] / 127 * about["full_scale"] == pytest.approx(1.25, abs=0.01)
    assert "as strong as the drive, up to full scale: " in about["meaning"]
    assert "in 128 steps up to full scale;" in done.loses


def test_what_is_told_of_a_chip_is_what_it_is_sent(tone, tmp_path):
    path = tmp_path / "a.h"
    ready = prepare_stimulus(tone, format_named("drv2605l"), None, ss.StimulusOptions())
    done = ss.export_stimulus(tone, path, "drv2605l")
    (values,) = arrays_of(path)[0].values()
    sent = ready.files[0].sent
    assert ready.n_bytes == values.size == sidecar(path)["array_bytes"]
    np.testing.assert_array_equal(np.round(127 * sent.samples[0]), values)
    assert sent.sample_rate_hz == 200
    (overview,) = ready.channels
    assert overview.extremes.min() >= 0.0
    assert done.summary.startswith(
        "1 channel, 200 amplitudes a second, 805 ms, about 161 bytes of data"
    )


@pytest.mark.parametrize(("name", "most"), [("drv2605l", 127), ("bos1901", 2047)])
def test_a_sidecar_describes_the_values_of_the_header(tone, tmp_path, name, most):
    path = tmp_path / "a.h"
    ss.export_stimulus(tone, path, name)
    arrays, constants = arrays_of(path)
    about, hz, n = sidecar(path), *(int(constants[key][:-2]) for key in ("STIM_FS_HZ", "STIM_N"))
    assert (about["rate_hz"], about["n_times"], about["duration_s"]) == (hz, n, n / hz)
    # Read literally, the largest value is the largest drive.
    assert f" divided by {most} and times full_scale are " in about["meaning"]
    assert (arrays["stim_place_7"] % 2**11).max() == pytest.approx(most, rel=0.02)
    assert ("amplitudes" in about["meaning"]) == (about["errors"] == {}) == (name == "drv2605l")


@pytest.mark.parametrize(
    ("name", "actuator", "refused", "caution"),
    [
        ("drv2605l", "example-voice-coil", "sends only the amplitude", "drives a linear resonant"),
        ("drv2605l", "example-piezo", "sends only the amplitude", "drives a linear resonant"),
        ("drv2605l", "example-resonant", "sends only the amplitude", ""),
        ("haptic", "example-voice-coil", "sends only the amplitude", ""),
        ("bos1901", "example-voice-coil", "drives a piezo, not 'mine'", "a piezo, not 'mine'"),
        ("drv2665", "example-recoil", "drives a piezo, not 'mine'", "a piezo, not 'mine'"),
        ("bos1901", "example-piezo", "", ""),
        ("wav", "example-voice-coil", "", ""),
    ],
)
def test_a_chip_cautions_about_another_kind_of_actuator_and_takes_no_equaliser_for_it(
    tmp_path, name, actuator, refused, caution
):
    gabor = ss.waveforms.Gabor(frequency_hz=200.0)
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, gabor),))
    call = {"actuation": actuation(ss.actuators.load(actuator))}
    expected = pytest.raises(InvalidInputError, match=refused) if refused else nullcontext()
    with expected:
        ss.export_stimulus(design, tmp_path / "a", name, equaliser=RegularisedInverse(), **call)
    assert bool(refused) != any(tmp_path.iterdir())
    raw = ss.export_stimulus(design, tmp_path / "b", name, **call)
    assert caution in raw.loses
    assert ("Choose another actuator" in raw.loses) == bool(caution)


@pytest.mark.parametrize(("name", "device_v"), [("bos1901", 95.0), ("drv2665", 25.0)])
def test_a_header_in_volts_has_the_full_scale_of_the_file_beside_that_of_the_chip(
    tmp_path, name, device_v
):
    through = actuation(ss.actuators.load("example-piezo"), RegularisedInverse())
    gabor = ss.waveforms.Gabor(frequency_hz=200.0)
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, gabor),), actuation=through)
    path = tmp_path / "a.h"
    loses = ss.export_stimulus(design, path, name).loses
    here_v = sidecar(path)["full_scale"]
    for text in (path.read_text(), loses):
        assert f"is {here_v:.3g} V here, {device_v:g} V" in text
        assert f"({20 * np.log10(device_v / here_v):.1f} dB) too strong" in text
    options = ss.StimulusOptions(full_scale=device_v)
    faint = design.adding(ss.track(8, gabor, amplitude=1e-4))
    loses = ss.export_stimulus(faint, path, name, options=options).loses
    assert "steps. Raise" in loses
    silent = [name in loses for name in ("Channel 1", "Channel 2")]
    assert [not array.any() for array in arrays_of(path)[0].values()] == silent
    assert silent[1]
    assert f"is {device_v:g} V here, {device_v:g} V" in path.read_text()
    assert "too strong" not in path.read_text()
    options = ss.StimulusOptions(full_scale=1e3)
    loses = ss.export_stimulus(replace(faint, actuation=None), path, name, options=options).loses
    assert "steps. Choose a smaller full scale, or raise the amplitudes." in loses


def test_bos1901_gets_12_bits_that_begin_and_end_at_0_volts(design, tmp_path):
    path = tmp_path / "a.h"
    ss.export_stimulus(design, path, "bos1901", 48_000)
    arrays, constants = arrays_of(path)
    drive = ss.stimulus_of(design, 8000).samples
    expected_values = drive / np.abs(drive).max() * 2047
    for array, row in zip(arrays.values(), expected_values, strict=True):
        assert array[0] == array[-1] == 0
        assert 0 <= array.min() <= array.max() <= 0x0FFF
        values = np.where(array >= 0x800, array - 0x1000, array)
        assert np.abs(values[1:-1] - row).max() <= 0.5 + 1e-9
    # Whatever rate is asked for: the chip has its own.
    assert constants["STIM_FS_HZ"] == "8000UL"


def test_a_haptic_file_keeps_the_rules_of_its_format(tone, tmp_path):
    content = content_of(tone, tmp_path / "a.haptic")
    assert content["version"] == {"major": 1, "minor": 0, "patch": 0}
    envelopes = content["signals"]["continuous"]["envelopes"]
    amplitude, frequency = envelopes["amplitude"], envelopes["frequency"]
    times = [event["time"] for event in amplitude]
    assert times[0] >= 0.0
    assert times == sorted(times)
    assert times[-1] == pytest.approx(0.8)
    assert all(0.0 <= event["amplitude"] <= 1.0 for event in amplitude)
    assert all(0.0 <= event["frequency"] <= 1.0 for event in frequency)
    assert frequency[-1]["time"] <= times[-1]
    # 175 Hz between 55 and 200 Hz.
    assert frequency[20]["frequency"] == pytest.approx(120 / 145, abs=0.02)
    assert "55 Hz" in content["metadata"]["description"]


def test_an_ahap_file_keeps_the_rules_of_its_format(tone, tmp_path):
    content = content_of(tone, tmp_path / "a.ahap")
    assert content["Version"] == 1.0
    assert all(len(entry) == 1 for entry in content["Pattern"])
    kinds = [next(iter(entry)) for entry in content["Pattern"]]
    assert kinds == ["Event", "ParameterCurve", "ParameterCurve"]
    event = content["Pattern"][0]["Event"]
    assert event["EventType"] == "HapticContinuous"
    assert event["EventDuration"] == pytest.approx(0.8)
    intensity, sharpness = (entry["ParameterCurve"] for entry in content["Pattern"][1:])
    assert intensity["ParameterID"] == "HapticIntensityControl"
    points = intensity["ParameterCurveControlPoints"]
    assert all(0.0 <= point["ParameterValue"] <= 1.0 for point in points)
    # Felt strength is quadratic: half an amplitude is the root of it.
    assert sidecar(tmp_path / "a.ahap")["meaning"].startswith("squares of intensities times ")
    loud, soft = points[20]["ParameterValue"], points[68]["ParameterValue"]
    assert soft / loud == pytest.approx(np.sqrt(0.5), abs=0.02)
    values = [point["ParameterValue"] for point in sharpness["ParameterCurveControlPoints"]]
    assert values[20] == pytest.approx((175 - 65) / (300 - 65), abs=0.02)


def test_long_ahap_files_have_several_events_with_times_of_their_own(tmp_path):
    tones = tuple(
        ss.Clip(waveform=ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.1), onset_s=at)
        for at in (0.0, 40.0, 69.9)
    )
    long = ss.Design(limb="synthetic-1", inputs=(ss.Input(location=7, clips=tones),))
    pattern = content_of(long, tmp_path / "a.ahap")["Pattern"]
    events = [entry["Event"] for entry in pattern if "Event" in entry]
    assert [event["Time"] for event in events] == [0.0, 30.0, 60.0]
    assert all(event["EventDuration"] <= 30.0 for event in events)
    for curve in (entry["ParameterCurve"] for entry in pattern if "ParameterCurve" in entry):
        times = [point["Time"] for point in curve["ParameterCurveControlPoints"]]
        assert times[0] == pytest.approx(0.0, abs=1e-9)
        assert times[-1] <= 30.0 + 1e-9
    second = next(e["ParameterCurve"] for e in pattern[4:] if "ParameterCurve" in e)
    loud = max(second["ParameterCurveControlPoints"], key=lambda point: point["ParameterValue"])
    assert loud["Time"] == pytest.approx(10.05, abs=0.06)


def test_control_points_for_android_add_up_to_the_length(tone, tmp_path):
    points = content_of(tone, tmp_path / "a.pwle.json")["controlPoints"]
    assert sum(point["durationMillis"] for point in points) == 800
    assert all(point["durationMillis"] > 0 for point in points)
    assert all(0.0 <= point["amplitude"] <= 1.0 for point in points)
    assert points[10]["frequencyHz"] == pytest.approx(175.0, rel=0.02)
    # Each point is where its step ends: the last of 0.8 s, and the pause from 0.5 to 0.6 s.
    ends_ms = np.cumsum([point["durationMillis"] for point in points])
    at = dict(zip(ends_ms.tolist(), (point["amplitude"] for point in points), strict=True))
    assert max(at[540], at[560]) < 0.1
    assert at[520] < 0.5 < 0.9 < at[480]
