"""The command that checks designs, alone and against recorded responses."""

import re
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource import View, save_design
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.base.errors import RecordingError
from skinsource.cli.command_line import main
from skinsource.design.labels import SCALINGS, label_of
from skinsource.studies import checking
from skinsource.studies.checking import Recorded, condition_of, html_of, quartiles, summary_lines


@pytest.fixture
def design_file(tmp_path):
    tone = ss.waveforms.Tone(frequency_hz=104.0, duration_s=0.1)
    design = ss.Design(
        limb="synthetic-1", inputs=(ss.track(8, tone), ss.track(13, tone, amplitude=0.5))
    )
    path = tmp_path / "two.skinsource"
    save_design(path, design, View())
    return path, design


def field_of(design, axes="xyz"):
    view = View(axes=axes, outputs=tuple(range(1, 73)))
    return ss.evaluate(design, "axis_traces", view=view)["axis_traces"]


def test_a_design_is_linear_and_its_inputs_add_up(design_file, capsys):
    path, _ = design_file
    assert main(["check", str(path)]) == 0
    printed = capsys.readouterr().out
    assert "104" in printed or "103" in printed or "105" in printed
    assert "adjusted R² 1" in printed
    assert "superposition: r 1" in printed
    assert "measured" not in printed


def test_which_recording_is_silent_is_said(design_file, tmp_path):
    _, design = design_file
    recording = tmp_path / "quiet lab.npz"
    np.savez(recording, field=np.zeros((300, 72, 3)), fs=1300.0)
    with pytest.raises(RecordingError, match=r"quiet lab\.npz.*silent throughout"):
        condition_of(design, "two", Recorded(path=recording))


def test_a_recording_is_held_against_the_prediction_and_reported(design_file, tmp_path, capsys):
    path, design = design_file
    field = field_of(design)
    # Noise of half of its RMS in each channel: r is 1 / sqrt(1 + 1/4).
    rms = np.sqrt(np.mean(field**2, axis=-1, keepdims=True))
    noisy = field + 0.5 * rms * np.random.default_rng(4).normal(size=field.shape)
    # As a lab records it: 67 samples earlier, and in another strength.
    table = 3.0 * noisy[..., 67:].reshape(216, -1).T
    recording, report = tmp_path / "lab.npz", tmp_path / "report.html"
    np.savez(recording, field=table, fs=1300.0)
    arguments = ["check", str(path), "--measured", str(recording), "--out", str(report)]
    assert main(arguments) == 0
    printed = capsys.readouterr().out
    assert "216 of 216 channels" in printed
    r = float(printed.split(", r ")[1].split()[0])
    assert r == pytest.approx(1.0 / np.sqrt(1.25), abs=0.02)
    page = report.read_text()
    ticks = re.findall(r"text-anchor='end'>([^<]*)<", page)
    assert len(ticks) >= 12
    assert all(len(tick.strip("-").replace(".", "").strip("0")) <= 2 for tick in ticks)
    assert page.count("<svg") == 3
    assert "Error: mean over time of |p/P - m/M|" in page
    assert "100 |RMS(p/P) - RMS(m/M)| / RMS(m/M)" in page
    assert "<td>67</td>" in page
    assert "two.skinsource" in page
    # What else could it be a report on?
    assert "recording: lab.npz" in page
    assert "limb: Synthetic 1" in page
    assert f"scaling: {label_of(SCALINGS, design.scaling).both}" in page
    assert "input at place 13: amplitude 0.5" in page
    assert re.search(r"written on \d{4}-\d\d-\d\d \d\d:\d\d UTC", page)


@pytest.mark.parametrize("strength", [0.002, 3.0])
def test_channels_count_that_are_above_twice_the_noise_of_their_recording(
    design_file, tmp_path, strength
):
    _, design = design_file
    field = field_of(design)
    noise_rms = np.median(np.sqrt(np.mean(field**2, axis=-1)))
    # A tenth of a second before the stimulus, in a unit of the lab's own.
    field = np.pad(field, ((0, 0), (0, 0), (130, 0)))
    noise = noise_rms * np.random.default_rng(9).normal(size=field.shape)
    path = tmp_path / "lab.npz"
    np.savez(path, field=strength * np.moveaxis(field + noise, -1, 0), fs=1300.0)
    condition = condition_of(design, "lab", Recorded(path=path))
    assert (condition.shift_samples, condition.noise_of) == (-130, "recording")
    rms = np.sqrt(np.mean((field + noise)[..., 130:] ** 2, axis=-1))
    share = condition.agreement.counted.mean()
    assert 0.1 < share < 0.5
    assert share == pytest.approx(np.mean(rms >= 2.0 * noise_rms), abs=0.03)


def test_a_recording_from_time_0_is_aligned_where_an_equaliser_moves_before(design_file, tmp_path):
    coil = ss.ActuatorAt(model=ss.actuators.load("example-voice-coil"))
    actuation = ss.Actuation(actuators=(coil,), equaliser=RegularisedInverse())
    design = replace(design_file[1], actuation=actuation)
    begins_s = ss.evaluate(design, "response_time_s")["response_time_s"][0]
    assert begins_s < -0.4
    path = tmp_path / "lab.npz"
    field = np.moveaxis(field_of(design), -1, 0)[round(-1300.0 * begins_s) :]
    np.savez(path, field=field, fs=1300.0)
    condition = condition_of(design, "lab", Recorded(path=path))
    assert condition.shift_samples == 0
    assert condition.agreement.correlation.min() > 0.99


@pytest.mark.parametrize("axes", ["xyz", "z", "xz"])
def test_a_recording_without_quiet_is_held_against_the_noise_of_the_limb(measured, tmp_path, axes):
    tone = ss.waveforms.Tone(frequency_hz=104.0, duration_s=0.1)
    design = ss.Design(limb="measured-1", inputs=(ss.track(8, tone),), scaling="probe")
    field = field_of(design, axes)[..., 60:]
    path = tmp_path / "lab.npz"
    np.savez(path, field=np.moveaxis(field, -1, 0), fs=1300.0)
    condition = condition_of(design, "lab", Recorded(path=path), axes=axes)
    assert (condition.shift_samples, condition.noise_of) == (60, "limb")
    chosen = ["xyz".index(axis) for axis in axes]
    before = ss.load_limb("measured-1").response_to(8)[:, chosen, :39]
    sensors = np.sqrt(np.mean(before**2, axis=-1))
    aligned = np.sqrt(np.sum(field**2, axis=-1) / (field.shape[-1] + 60))
    np.testing.assert_array_equal(condition.agreement.counted, aligned >= 2.0 * sensors)
    assert "noise of the sensors of the limb" in summary_lines([condition])[0]
    assert "noise of the sensors of the limb" in html_of([condition], ["synthetic-1"])


def test_recordings_that_do_not_fit_are_refused_and_nothing_is_written(
    design_file, tmp_path, capsys
):
    path, _ = design_file
    recording, report = tmp_path / "lab.npz", tmp_path / "report.html"
    np.savez(recording, field=np.ones((50, 12)), fs=1300.0)
    arguments = ["check", str(path), "--measured", str(recording), "--out", str(report)]
    assert main(arguments) == 1
    assert "12 signals, expected 216" in capsys.readouterr().err
    assert not report.exists()
    assert main(["check", str(path), str(path), "--measured", str(recording)]) == 1
    assert "expected one for each" in capsys.readouterr().err


def test_whiskers_end_at_data_within_one_and_a_half_boxes():
    values = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 100.0])
    assert quartiles(values) == (0.0, 1.25, 2.5, 3.75, 4.0)
    # What is not drawn is said: not the one at the end of a whisker.
    drawn = checking._box_plot([("100 Hz", values), ("200 Hz", values[:5])])
    assert "1 of 11 channels lie beyond the whiskers" in drawn
    assert "all lie from 0 to 100" in drawn
    assert "beyond" not in checking._box_plot([("200 Hz", values[:5])])
