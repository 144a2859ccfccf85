"""``skinsource export``."""

import json

import pytest
import soundfile

import skinsource as ss
from skinsource.cli.command_line import main


@pytest.fixture
def saved(design, tmp_path):
    path = tmp_path / "scene.skinsource"
    ss.save_design(path, design)
    return path


def test_it_writes_the_file_and_its_sidecar_and_says_where_and_that_it_is_uncalibrated(
    saved, tmp_path, capsys
):
    out = tmp_path / "drive.wav"
    call = ["export", str(saved), "--format", "wav", "--rate", "44100", "--out", str(out)]
    assert main(call) == 0
    printed = capsys.readouterr()
    path, summary, calibration = printed.out.splitlines()
    assert path == str(out)
    assert summary.startswith("  2 channels, 44.1 kHz, ")
    assert summary.endswith(", not equalised (raw accelerations).")
    assert calibration.startswith("  Uncalibrated: no rig says how many volts")
    assert printed.err == ""
    about = soundfile.info(out)
    assert (about.samplerate, about.channels, about.subtype) == (44_100, 2, "FLOAT")
    assert json.loads((tmp_path / "drive.wav.json").read_text())["rate_hz"] == 44_100


def test_options_reach_the_file(saved, tmp_path, capsys):
    out = tmp_path / "drive.wav"
    call = ["export", str(saved), "--out", str(out), "--samples", "pcm16", "--sync"]
    assert main([*call, "--lead-in", "0.1", "--inputs", "2", "--dither", "3"]) == 0
    about = json.loads((tmp_path / "drive.wav.json").read_text())
    assert about["samples"] == "int16"
    assert about["dither_seed"] == 3
    assert about["start_s"] == -0.1
    assert [channel["title"] for channel in about["channels"]] == ["Digit II, base", "Sync"]
    capsys.readouterr()


def test_it_never_asks_and_says_in_one_line_what_is_wrong(saved, tmp_path, capsys):
    out = tmp_path / "drive.wav"
    call = ["export", str(saved), "--out", str(out), "--full-scale", "0.1"]
    assert main(call) == 1
    error_output = capsys.readouterr().err
    assert error_output.startswith("skinsource: drive.wav: samples lie beyond full scale")
    assert error_output.count("\n") == 1
    assert not out.exists()
    assert main([*call, "--confirm"]) == 0
    assert "confirmed: drive.wav" in capsys.readouterr().err
    assert out.exists()
