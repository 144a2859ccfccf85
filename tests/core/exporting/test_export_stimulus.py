"""`ss.export_stimulus`: defaults, options, refusals, sidecar."""

import hashlib
import json
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.export.formats import FORMATS
from tests.core.exporting.export_bench import exported, read, sidecar


def test_the_formats_are_listed_by_name():
    assert {"wav", "flac", "csv", "npz", "mat", "hdf5", "c-header", "bids"} <= set(
        ss.export_formats()
    )
    assert len({form.title for form in FORMATS}) == len(FORMATS)
    assert all(form.hint for form in FORMATS)


def test_the_largest_sample_of_all_channels_is_full_scale_and_the_ratio_is_kept(design, tmp_path):
    done = exported(design, tmp_path / "a.wav")
    samples = read(tmp_path / "a.wav")
    drive = ss.stimulus_of(design, 8000).samples
    assert np.abs(samples).max() == 1.0
    np.testing.assert_allclose(samples, drive * done.gain, rtol=0, atol=1e-7)


def test_the_sidecar_says_what_the_numbers_mean(design, tmp_path):
    path = tmp_path / "a.wav"
    done = exported(design, path)
    about = sidecar(path)
    drive = ss.stimulus_of(design, 8000)
    peak = np.abs(drive.samples).max()
    assert about["unit"] == "m/s²"
    assert about["full_scale"] == pytest.approx(peak, rel=1e-12)
    assert about["gain"] == done.gain == pytest.approx(1 / peak, rel=1e-12)
    assert about["rate_hz"] == 8000
    assert about["scaling"] == "probe"
    assert about["calibration"].startswith("uncalibrated")
    assert about["actuator"] is None
    assert about["equaliser"] is None
    assert about["clip_count"] == 0
    assert about["sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()
    assert about["bytes"] == path.stat().st_size
    assert [
        (channel["number"], channel["place"], channel["inputs"]) for channel in about["channels"]
    ] == [
        (1, 7, [1, 3]),
        (2, 12, [2]),
    ]
    assert [(track["number"], track["place"], track["amplitude"]) for track in about["inputs"]] == [
        (1, 7, 0.5),
        (2, 12, -1.7),
        (3, 7, 0.2),
    ]
    assert about["inputs"][0]["clips"][0]["gain"] == -0.7
    assert about["errors"]["band_hz"] == [25.0, 600.0]
    assert about["errors"]["resampling_at_most"]["aliases_db"] == -115.0
    assert about["versions"]["skinsource"] == ss.__version__
    assert about["n_times"] == drive.n_times


def test_the_digest_is_that_of_the_whole_design(design, tmp_path):
    def digest(exported):
        ss.export_stimulus(exported, tmp_path / "a.npz")
        return sidecar(tmp_path / "a.npz")["design_digest"]

    assert digest(design) == digest(replace(design))
    assert digest(design) != digest(design.with_input(0, amplitude=0.51))
    # Of what is not heard, too.
    assert digest(design) != digest(design.with_input(3, amplitude=0.51))


def test_drives_under_upstream_scaling_are_never_accelerations(design, tmp_path):
    ss.export_stimulus(replace(design, scaling="upstream"), tmp_path / "a.npz")
    about = sidecar(tmp_path / "a.npz")
    assert about["unit"] == "1"
    assert {channel["unit"] for channel in about["channels"]} == {"1"}
    assert "no unit" in about["note"]
    with np.load(tmp_path / "a.npz") as archive:
        assert json.loads(str(archive["about"]))["unit"] == "1"


def test_the_ending_tells_the_format(design, tmp_path):
    for ending, name in ((".wav", "wav"), (".mat", "mat"), ("_stim.tsv.gz", "bids")):
        path = tmp_path / f"a{ending}"
        ss.export_stimulus(design, path)
        assert sidecar(path)["format"] == name
    with pytest.raises(InvalidInputError, match="say which, one of wav"):
        ss.export_stimulus(design, tmp_path / "a.xyz")


def test_time_0_of_the_file_is_time_0_of_the_design(tmp_path):
    late = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Impulse(), onset_s=0.1),))
    exported(late, tmp_path / "a.wav")
    assert np.argmax(read(tmp_path / "a.wav")[0]) == 800


def test_options_come_in_the_order_of_time(design, tmp_path):
    path = tmp_path / "a.wav"
    exported(
        design, path, from_s=0.1, to_s=0.2, fade_in_s=0.01, fade_out_s=0.01, lead_in_s=0.05,
        sync=True, channel_map=(3, 0, 2, 1),
    )  # fmt: skip
    samples = read(path)
    assert samples.shape == (4, 400 + 800)
    sync, silent, noise, other = samples
    assert np.flatnonzero(sync).tolist() == list(range(400, 480))
    assert not silent.any()
    drive = ss.stimulus_of(design, 8000).samples
    part = drive[:, 800:1600] / np.abs(drive[:, 800:1600]).max()
    inside = slice(80, 720)
    gain = sidecar(path)["gain"]
    np.testing.assert_allclose(noise[400:][inside], drive[1, 800:1600][inside] * gain, atol=1e-7)
    np.testing.assert_allclose(other[400:][inside], drive[0, 800:1600][inside] * gain, atol=1e-7)
    assert part.shape[1] == 800
    assert noise[400] == 0.0
    assert noise[-1] == 0.0
    about = sidecar(path)
    assert about["start_s"] == pytest.approx(0.05)
    assert [channel["place"] for channel in about["channels"]] == [None, None, 12, 7]


def test_each_input_can_have_a_file_of_its_own_with_one_full_scale_for_all(design, tmp_path):
    done = exported(design, tmp_path / "a.wav", one_file_per_input=True)
    assert [file.name for file in done.files] == [
        "a_input-1.wav",
        "a_input-2.wav",
        "a_input-3.wav",
    ]
    peaks = [np.abs(read(file)).max() for file in done.files]
    assert max(peaks) == 1.0
    alone = ss.stimulus_of(design, 8000, per="input").samples
    np.testing.assert_allclose(peaks, np.abs(alone).max(axis=1) * done.gain, atol=1e-7)
    about = sidecar(done.files[2])
    assert [track["number"] for track in about["inputs"]] == [3]
    assert not (tmp_path / "a.wav").exists()


def test_a_selection_is_exported_alone(design, tmp_path):
    exported(design, tmp_path / "a.wav", inputs=(2,))
    assert sidecar(tmp_path / "a.wav")["places"] == [12]


def test_a_full_scale_of_ones_own_is_kept_for_a_whole_set(design, tmp_path):
    done = ss.export_stimulus(design, tmp_path / "a.wav", rate_hz=8000, full_scale=4.0)
    assert done.gain == 0.25
    drive = ss.stimulus_of(design, 8000).samples
    np.testing.assert_allclose(read(tmp_path / "a.wav"), drive / 4.0, rtol=0, atol=1e-7)
    assert sidecar(tmp_path / "a.wav")["full_scale"] == 4.0


def test_an_equaliser_works_at_the_rate_of_the_device_before_full_scale(design, tmp_path):
    def halved_second(drive):
        assert drive.sample_rate_hz == 8000.0
        return drive.with_samples(drive.samples * [[1.0], [0.5]])

    done = ss.export_stimulus(design, tmp_path / "a.wav", "wav", 8000, stages=(halved_second,))
    drive = ss.stimulus_of(design, 8000).samples * [[1.0], [0.5]]
    np.testing.assert_allclose(read(tmp_path / "a.wav"), drive * done.gain, atol=1e-7)
    assert np.abs(read(tmp_path / "a.wav")).max() == 1.0


def test_dither_is_that_of_its_seed_and_clips_nothing(design, tmp_path):
    options = ss.StimulusOptions(dither_seed=5, choices={"samples": "pcm16"})
    ss.export_stimulus(design, tmp_path / "a.wav", options=options)
    about = sidecar(tmp_path / "a.wav")
    assert about["dither_seed"] == 5
    assert about["integer_full_scale"] == 32766
    assert about["clip_count"] == 0
    steps = read(tmp_path / "a.wav") * 32768
    integers = ss.stimulus_of(design, 48_000).samples * about["gain"] * 32766
    assert 0.6 < np.abs(steps - integers).max() <= 1.5


def test_lossy_formats_say_what_they_lose(design, tmp_path):
    options = ss.StimulusOptions(choices={"samples": "pcm16"})
    ss.export_stimulus(design, tmp_path / "a.wav", options=options)
    assert "98 dB" in sidecar(tmp_path / "a.wav")["loses"]
    assert sidecar(tmp_path / "a.wav")["errors"]["rounding_db"] < -96
    ss.export_stimulus(design, tmp_path / "b.wav")
    assert sidecar(tmp_path / "b.wav")["loses"] == ""
