"""Every format, read back by readers that are not ours, and the predicted drive at every rate."""

import csv
import gzip
import json
import re
import struct
import subprocess

import h5py
import numpy as np
import pytest
import scipy
import soundfile

import skinsource as ss
from tests.core.exporting.export_bench import sidecar

RATES = (1300, 8000, 44_100, 48_000)


@pytest.mark.parametrize("rate_hz", RATES)
def test_float_wav_holds_the_nearest_single_precision_numbers(design, expected, path, rate_hz):
    ss.export_stimulus(design, path, format="wav", rate_hz=rate_hz)
    read, found_hz = soundfile.read(path, dtype="float32", always_2d=True)
    assert found_hz == rate_hz
    np.testing.assert_array_equal(read, expected(design, rate_hz).astype(np.float32))
    other_hz, other = scipy.io.wavfile.read(path)
    assert other_hz == rate_hz
    np.testing.assert_array_equal(other, read)


@pytest.mark.parametrize("container", ["plain", "extensible"])
@pytest.mark.parametrize(("kind", "full_scale"), [("pcm16", 32767), ("pcm24", 8388607)])
def test_whole_numbers_of_wav_are_rounded_to_half_a_step(
    design, expected, path, kind, full_scale, container
):
    options = ss.StimulusOptions(choices={"samples": kind, "container": container})
    ss.export_stimulus(design, path, rate_hz=48_000, options=options)
    read, _ = soundfile.read(path, dtype="int32", always_2d=True)
    bits = 16 if kind == "pcm16" else 24
    steps = read >> (32 - bits)
    expected_samples = expected(design, 48_000) * full_scale
    assert np.abs(steps - expected_samples).max() <= 0.5 + 1e-9
    assert np.abs(steps).max() == full_scale
    _, other = scipy.io.wavfile.read(path)
    np.testing.assert_array_equal(other.astype(np.int64) >> (0 if bits == 16 else 8), steps)
    about = soundfile.info(path)
    assert about.subtype == f"PCM_{bits}"
    assert about.format == ("WAV" if container == "plain" else "WAVEX")
    assert sidecar(path)["integer_full_scale"] == full_scale


@pytest.mark.parametrize("container", ["plain", "extensible"])
def test_sixteen_channels_are_sixteen_and_name_no_speaker(many, expected, tmp_path, container):
    path = tmp_path / "many.wav"
    options = ss.StimulusOptions(choices={"container": container})
    ss.export_stimulus(many, path, rate_hz=48_000, options=options)
    read, _ = soundfile.read(path, dtype="float32")
    np.testing.assert_array_equal(read, expected(many, 48_000).astype(np.float32))
    content = path.read_bytes()
    assert content[:4] + content[8:16] == b"RIFFWAVEfmt "
    assert struct.unpack("<I", content[4:8]) == (len(content) - 8,)
    (size, tag, channels) = struct.unpack("<IHH", content[16:24])
    assert channels == 16
    if container == "plain":
        assert (size, tag) == (16, 3)
    else:
        assert (size, tag) == (40, 0xFFFE)
        assert struct.unpack("<I", content[40:44]) == (0,)


def test_wav_tells_its_title_its_writer_and_its_design(design, path):
    ss.export_stimulus(design, path)
    with soundfile.SoundFile(path) as file:
        assert file.title == "Two places"
        assert ss.__version__ in file.software
        assert sidecar(path)["design_digest"] in file.comment


@pytest.mark.parametrize("rate_hz", RATES)
def test_flac_holds_24_bits(design, expected, tmp_path, rate_hz):
    path = tmp_path / "a.flac"
    ss.export_stimulus(design, path, format="flac", rate_hz=rate_hz)
    read, found_hz = soundfile.read(path, dtype="int32", always_2d=True)
    assert found_hz == rate_hz
    assert np.abs((read >> 8) - expected(design, rate_hz) * 8388607).max() <= 0.5 + 1e-9


def test_csv_reads_back_as_the_same_bits(design, tmp_path):
    path = tmp_path / "a.csv"
    ss.export_stimulus(design, path, format="csv", rate_hz=8000)
    with path.open(newline="") as file:
        head, *rows = csv.reader(file)
    assert head == ["time_s", "place_7_of_full_scale", "place_12_of_full_scale"]
    numbers = np.array(rows, float)
    np.testing.assert_array_equal(numbers[:, 0], np.arange(len(rows)) / 8000)
    drive = ss.stimulus_of(design, 8000).samples.T
    np.testing.assert_array_equal(numbers[:, 1:], drive * sidecar(path)["gain"])


def test_layouts_of_csv_are_those_that_generators_read(design, tmp_path):
    path = tmp_path / "a.csv"

    def lines(layout, **changes):
        options = ss.StimulusOptions(choices={"layout": layout}, **changes)
        ss.export_stimulus(design, path, rate_hz=8000, options=options)
        return path.read_text().splitlines()

    keysight = lines("keysight")
    assert keysight[:2] == ["SampleRate = 8000", "Y1,Y2"]
    assert len(keysight[2].split(",")) == 2
    assert lines("plain") == keysight[2:]
    times, values = np.loadtxt(lines("pwl", inputs=(2,)), delimiter=",").T
    assert np.all(np.diff(times) > 0)
    assert np.abs(values).max() == pytest.approx(1.0, abs=1e-15)
    with pytest.raises(ss.SkinSourceError, match="at most 1 channel, found 2"):
        lines("pwl")


def test_mat_holds_the_drive_at_its_top(design, expected, tmp_path):
    path = tmp_path / "a.mat"
    ss.export_stimulus(design, path, format="mat", rate_hz=8000)
    read = scipy.io.loadmat(path)
    assert read["drive"].shape == (2000, 2)
    np.testing.assert_allclose(read["drive"], expected(design, 8000), rtol=0, atol=2e-16)
    assert read["sample_rate_hz"].item() == 8000
    assert read["places"].tolist() == [[7, 12]]
    assert path.read_bytes()[:19] == b"MATLAB 5.0 MAT-file"


def test_hdf5_holds_the_drive_and_what_the_skin_answers(design, expected, tmp_path):
    path = tmp_path / "a.h5"
    ss.export_stimulus(design, path, format="hdf5")
    view = ss.View(outputs=(30,), axes="z")
    trace = ss.evaluate(design, "selected_traces", view=view)["selected_traces"][0]
    with h5py.File(path) as file:
        np.testing.assert_allclose(file["drive"][:], expected(design), rtol=0, atol=2e-16)
        assert file["drive"].attrs["places"].tolist() == [7, 12]
        assert file["response"].attrs["unit"] == "m/s²"
        np.testing.assert_allclose(file["response"][29, 2], trace, rtol=0, atol=1e-12)


def test_bids_is_a_packed_table_beside_its_description(design, expected, tmp_path):
    path = tmp_path / "sub-01_task-touch_stim.tsv.gz"
    ss.export_stimulus(design, path, format="bids", rate_hz=2000)
    with gzip.open(path, "rt") as file:
        rows = [line.split("\t") for line in file]
    np.testing.assert_allclose(np.array(rows, float), expected(design, 2000), rtol=0, atol=2e-16)
    about = json.loads((tmp_path / "sub-01_task-touch_stim.json").read_text())
    assert about["SamplingFrequency"] == 2000
    assert about["StartTime"] == 0.0
    assert about["Columns"] == ["place_7", "place_12"]
    assert about["place_7"]["Units"] == "parts of full scale"
    assert sidecar(path)["Columns"] == about["Columns"]


@pytest.mark.parametrize(
    ("kind", "full_scale", "zero"), [("int16", 32767, 0), ("int8", 127, 0), ("uint8", 127, 128)]
)
def test_a_c_header_compiles_clean_and_holds_the_samples(
    design, expected, tmp_path, kind, full_scale, zero
):
    path = tmp_path / "a.h"
    options = ss.StimulusOptions(choices={"samples": kind})
    ss.export_stimulus(design, path, format="c-header", rate_hz=8000, options=options)
    assert (f" minus {zero}, divided by " in sidecar(path)["meaning"]) == (kind == "uint8")
    flags = ["-Wall", "-Wextra", "-Werror", "-pedantic"]
    for language, standard in (("c", "c99"), ("c++", "c++11")):
        subprocess.run(
            ["cc", f"-std={standard}", *flags, "-x", language, "-fsyntax-only", str(path)],
            check=True,
        )
    (tmp_path / "main.c").write_text(
        '#include <stdio.h>\n#include "a.h"\nint main(void) {\n'
        "  unsigned long k;\n"
        '  printf("%lu %lu %d ", STIM_FS_HZ, STIM_N, STIM_CH);\n'
        '  printf("%d %d\\n", STIM_FULL_SCALE, STIM_ZERO);\n'
        "  for (k = 0; k < STIM_N; k++)\n"
        '    printf("%d %d\\n", (int)stim_place_7[k], (int)stim_place_12[k]);\n'
        "  return 0;\n}\n"
    )
    program = tmp_path / "main"
    subprocess.run(
        ["cc", "-std=c99", *flags, str(tmp_path / "main.c"), "-o", str(program)], check=True
    )
    printed = subprocess.run([str(program)], check=True, capture_output=True, text=True).stdout
    head, *rows = printed.splitlines()
    assert head.split() == ["8000", "2000", "2", str(full_scale), str(zero)]
    values = np.array([row.split() for row in rows], int) - zero
    assert np.abs(values - expected(design, 8000) * full_scale).max() <= 0.5 + 1e-9
    n_bytes = 2 * 2000 * (2 if kind == "int16" else 1)
    assert re.match(rf"/\* {n_bytes} bytes", path.read_text())
    assert sidecar(path)["array_bytes"] == n_bytes


@pytest.mark.parametrize("rate_hz", [2000, 8000, 44_100, 48_000, 96_000, 192_000])
def test_what_is_written_is_the_predicted_drive_at_another_rate(design, rate_hz):
    resampled = ss.resample(ss.stimulus_of(design).samples, 1300, rate_hz)
    np.testing.assert_array_equal(ss.stimulus_of(design, rate_hz).samples, resampled)
