"""`ss.export_stimulus`: defaults, options, refusals, what is told before and in the sidecar."""

import hashlib
import json
from dataclasses import replace

import numpy as np
import pytest
import soundfile

import skinsource as ss
from skinsource.base.errors import (
    DatasetMissingError,
    InvalidInputError,
    NotConfirmedError,
    Stopped,
    StorageError,
)
from skinsource.cli.command_line import main
from skinsource.export.formats import arrays, format_named
from skinsource.export.stimulus_export.export import written_files
from skinsource.export.stimulus_export.preparing import prepare_stimulus
from tests.core.exporting.export_bench import actuation, exported, read, sidecar


def test_the_sidecar_says_what_the_numbers_mean(design, path):
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
    channels = [tuple(map(each.get, ("number", "place", "inputs"))) for each in about["channels"]]
    assert channels == [(1, 7, [1, 3]), (2, 12, [2])]
    inputs = [tuple(map(each.get, ("number", "place", "amplitude"))) for each in about["inputs"]]
    assert inputs == [(1, 7, 0.5), (2, 12, -1.7), (3, 7, 0.2)]
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
    with pytest.raises(InvalidInputError, match="choose one of wav"):
        ss.export_stimulus(design, tmp_path / "a.xyz")


def test_a_channel_whose_clips_lie_outside_the_part_is_silent_behind_an_equaliser_too():
    model = ss.actuators.load("kastor-2023-air")
    through = actuation(model, ss.equalising.RegularisedInverse())
    gabor = ss.waveforms.Gabor(200.0)
    tracks = ss.track(7, gabor, onset_s=0.5), ss.track(12, gabor, onset_s=1.0)
    design = ss.Design(limb="synthetic-1", inputs=tracks, actuation=through)
    for inputs, peaks in ((None, [1.0, 0.0]), ((2,), [0.0])):
        options = ss.StimulusOptions(from_s=0.5, to_s=0.7, inputs=inputs)
        ready = prepare_stimulus(design, format_named("wav"), 48_000, options)
        assert [channel.peak for channel in ready.channels] == peaks
        assert ready.edges == ""
    # What is merely soft is written.
    quiet = replace(design, inputs=(tracks[0], ss.track(12, gabor, onset_s=0.5, amplitude=1e-4)))
    ready = prepare_stimulus(quiet, ready.format, 48_000, replace(options, inputs=None))
    assert 1e-5 < ready.channels[1].peak < 1e-3


def test_options_come_in_the_order_of_time(design, path):
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
    inside = slice(80, 720)
    gain = sidecar(path)["gain"]
    np.testing.assert_allclose(noise[400:][inside], drive[1, 800:1600][inside] * gain, atol=1e-7)
    np.testing.assert_allclose(other[400:][inside], drive[0, 800:1600][inside] * gain, atol=1e-7)
    assert noise[400] == 0.0
    assert noise[-1] == 0.0
    about = sidecar(path)
    assert about["start_s"] == pytest.approx(0.05)
    assert [channel["place"] for channel in about["channels"]] == [None, None, 12, 7]


def test_each_input_can_have_a_file_of_its_own_with_one_full_scale_for_all(design, tmp_path):
    done = exported(design, tmp_path / "a.wav", one_file_per_input=True)
    assert [file.name for file in done.files] == [f"a_input-{k}.wav" for k in (1, 2, 3)]
    peaks = [np.abs(read(file)).max() for file in done.files]
    assert max(peaks) == 1.0
    alone = ss.stimulus_of(design, 8000, per="input").samples
    np.testing.assert_allclose(peaks, np.abs(alone).max(axis=1) * done.gain, atol=1e-7)
    about = sidecar(done.files[2])
    assert [track["number"] for track in about["inputs"]] == [3]
    assert not (tmp_path / "a.wav").exists()


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


PULSE = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Impulse()),))
LATE = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Impulse(), onset_s=0.1),))


def caution_of(tmp_path, design, **options):
    exported(design, tmp_path / "a.wav", **options)
    return sidecar(tmp_path / "a.wav")["edges"]


def test_a_pulse_at_time_0_is_said_to_be_cut_and_a_lead_in_keeps_all_of_it(tmp_path):
    message = caution_of(tmp_path, PULSE)
    assert message.startswith(
        "Channel 1 begins at 100 % of its peak: what lies before time 0 is cut off. A lead-in of "
        "0.1 s keeps it."
    )
    (cut,) = read(tmp_path / "a.wav")
    assert "begins" not in caution_of(tmp_path, PULSE, lead_in_s=0.1)
    assert sidecar(tmp_path / "a.wav")["start_s"] == -0.1
    (samples,) = read(tmp_path / "a.wav")
    # At 8 kHz time 0 is sample 800, and a pulse there is as whole as one that comes later.
    np.testing.assert_array_equal(samples[800:], cut)
    exported(LATE, tmp_path / "late.wav")
    np.testing.assert_allclose(samples, read(tmp_path / "late.wav")[0], atol=1e-6)
    assert np.abs(samples[:800]).max() > 0.5
    assert "A longer lead-in keeps it." in caution_of(tmp_path, PULSE, lead_in_s=0.0003)


def test_a_lead_in_of_any_length_leaves_time_0_where_it_is():
    whole = ss.stimulus_of(LATE, 44_100).samples
    for lead_in_s, n in ((0.01, 441), (0.0333, 1469), (1 / 44_100, 1)):
        early = ss.stimulus_of(PULSE, 44_100, lead_in_s=lead_in_s)
        assert early.start_s == -n / 44_100
        np.testing.assert_allclose(early.samples, whole[:, 4410 - n :], rtol=0, atol=1e-12)
    own = ss.stimulus_of(PULSE, lead_in_s=0.01).samples
    assert np.flatnonzero(own).tolist() == [13]


def test_soft_ends_say_nothing_and_hard_ones_of_a_part_say_what_helps(tmp_path):
    gabor = ss.waveforms.Gabor(frequency_hz=200.0)
    soft = ss.Design(limb="synthetic-1", inputs=(ss.track(7, gabor, onset_s=0.1),))
    assert caution_of(tmp_path, soft) == ""
    tone = ss.waveforms.Tone(frequency_hz=100.0, phase_rad=1.5, window="none")
    hard = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone), ss.track(12, tone)))
    part = caution_of(tmp_path, hard, from_s=0.1, to_s=0.15)
    assert part.startswith("2 channels begin at up to ")
    assert "before that part is cut off. A fade-in softens it." in part
    assert part.endswith("A fade-out softens it.")
    assert caution_of(tmp_path, hard, from_s=0.1, to_s=0.15, fade_in_s=0.01, fade_out_s=0.01) == ""


TONE = ss.waveforms.Tone(frequency_hz=101.0, duration_s=0.4)
PAIR = ss.Design(limb="synthetic-1", inputs=(ss.track(8, TONE), ss.track(13, TONE)))
SINGLE = replace(PAIR, inputs=PAIR.inputs[:1])


@pytest.mark.parametrize("layout", ["table", "plain", "keysight", "pwl"])
@pytest.mark.parametrize("rate_hz", [1300, 8000])
def test_a_table_is_about_as_large_as_told_in_each_layout(tmp_path, layout, rate_hz):
    options = ss.StimulusOptions(choices={"layout": layout})
    path = tmp_path / "drive.csv"
    told_bytes = prepare_stimulus(SINGLE, format_named("csv"), rate_hz, options).n_bytes
    ss.export_stimulus(SINGLE, path, "csv", rate_hz, options=options)
    assert told_bytes == pytest.approx(path.stat().st_size, rel=0.15)


def test_what_is_predicted_counts_unless_it_is_too_much_to_be_written(tmp_path, monkeypatch):
    path, sizes = tmp_path / "drive.h5", []
    for _ in range(2):
        told_bytes = prepare_stimulus(
            SINGLE, format_named("hdf5"), None, ss.StimulusOptions()
        ).n_bytes
        ss.export_stimulus(SINGLE, path)
        sizes.append((told_bytes, path.stat().st_size))
        monkeypatch.setattr(arrays, "_MOST_RESPONSE_BYTES", 1e5)
    assert sizes[0][0] == pytest.approx(sizes[0][1], rel=0.05)
    assert max(sizes[1]) < 20_000


@pytest.mark.parametrize("several", [False, True])
@pytest.mark.parametrize("name", ss.export_formats())
def test_the_files_that_are_told_are_those_that_are_written(tmp_path, name, several):
    kind, options = format_named(name), ss.StimulusOptions(one_file_per_input=several)
    path = tmp_path / f"a.b{kind.suffix}"
    prepared = prepare_stimulus(PAIR, kind, None, options)
    ss.export_stimulus(PAIR, path, name, options=options, confirmed=True)
    promised = [file for files in written_files(prepared, path) for file in files]
    assert sorted(promised) == sorted(tmp_path.iterdir())


@pytest.mark.parametrize("kind", ["float32", "pcm16"])
def test_what_clips_is_refused_until_it_is_confirmed(design, tmp_path, path, kind):
    options = ss.StimulusOptions(full_scale=0.5, choices={"samples": kind})
    drive = ss.stimulus_of(design, 48_000).samples / 0.5
    counts = np.count_nonzero(np.abs(drive) > 1.0, axis=1)
    with pytest.raises(NotConfirmedError, match=rf"channel 2 \(Digit II, base\) {counts[1]}"):
        ss.export_stimulus(design, path, options=options)
    assert list(tmp_path.iterdir()) == []
    done = ss.export_stimulus(design, path, options=options, confirmed=True)
    assert done.clip_count == counts.sum()
    about = sidecar(path)
    assert about["clip_count"] == counts.sum()
    assert [channel["clip_count"] for channel in about["channels"]] == counts.tolist()
    assert "cuts them off" in about["confirmed"][0]
    if kind == "pcm16":
        limited = np.clip(drive, -1.0, 1.0)
        np.testing.assert_allclose(read(path) * 32768 / 32767, limited, rtol=0, atol=2e-5)


def test_numbers_that_no_device_plays_do_not_clip(design, tmp_path):
    options = ss.StimulusOptions(full_scale=0.5)
    done = ss.export_stimulus(design, tmp_path / "a.npz", options=options)
    assert done.clip_count == 0
    with np.load(tmp_path / "a.npz") as archive:
        np.testing.assert_allclose(
            archive["drive"] * 0.5, ss.stimulus_of(design).samples.T, rtol=1e-15
        )


def test_a_limit_that_is_passed_must_be_confirmed(design, path):
    listings = []

    def limit(drives):
        listings.append((drives.unit, np.abs(drives.samples).max()))
        return ["Channel 1 reaches 45 mm/s, more than 40 mm/s."]

    with pytest.raises(NotConfirmedError, match="more than 40 mm/s"):
        ss.export_stimulus(design, path, limits=(limit,))
    assert not path.exists()
    # Limits see drives in their own unit, not parts of full scale.
    peak = np.abs(ss.stimulus_of(design, 48_000).samples).max()
    assert listings == [("m/s²", peak)]
    ss.export_stimulus(design, path, limits=(limit,), confirmed=True)
    assert sidecar(path)["confirmed"] == ["Channel 1 reaches 45 mm/s, more than 40 mm/s."]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"format": "mp3"}, "choose from wav"),
        ({"rate_hz": 0}, "sample_rate_hz is 0"),
        ({"options": ss.StimulusOptions(choices={"samples": "pcm8"})}, "one of float32, pcm24"),
        ({"options": ss.StimulusOptions(choices={"layout": "table"})}, "choose one of samples"),
        ({"options": ss.StimulusOptions(inputs=(4,))}, "No input is active"),
    ],
)
def test_what_cannot_be_had_is_refused_and_nothing_is_written(design, tmp_path, changes, message):
    call = {"format": "wav", "rate_hz": 48_000, **changes}
    with pytest.raises(InvalidInputError, match=message):
        ss.export_stimulus(design, tmp_path / "a.wav", **call)
    assert list(tmp_path.iterdir()) == []


def test_more_channels_than_a_format_holds_are_refused(many, tmp_path):
    with pytest.raises(InvalidInputError, match="at most 8 channels, found 16"):
        ss.export_stimulus(many, tmp_path / "a.flac")
    eight = ss.StimulusOptions(inputs=tuple(range(1, 9)))
    ss.export_stimulus(many, tmp_path / "a.flac", options=eight)


@pytest.mark.parametrize("name", ss.export_formats())
def test_where_nothing_can_be_written_one_sentence_says_so(design, tmp_path, name):
    with pytest.raises(StorageError, match="Choose a folder that exists"):
        ss.export_stimulus(design, tmp_path / "missing" / "a", format=name)


def test_a_folder_of_that_name_is_left_alone(design, tmp_path):
    (tmp_path / "a.wav").mkdir()
    with pytest.raises(StorageError, match="Choose another name"):
        ss.export_stimulus(design, tmp_path / "a.wav")
    assert [file.name for file in tmp_path.iterdir()] == ["a.wav"]


@pytest.mark.parametrize("name", ss.export_formats())
def test_an_export_that_is_stopped_leaves_what_was_there(design, tmp_path, name):
    asked: list[int] = []

    def count():
        asked.append(1)
        return False

    path = tmp_path / "a"
    ss.export_stimulus(design, path, format=name, stop=count)
    before = sorted((file.name, file.stat().st_mtime_ns) for file in tmp_path.iterdir())
    times = len(asked)
    # As late as it is asked at all.
    late = iter([*[False] * (times - 1), True])
    with pytest.raises(Stopped):
        ss.export_stimulus(design, path, format=name, stop=lambda: next(late))
    assert sorted((file.name, file.stat().st_mtime_ns) for file in tmp_path.iterdir()) == before


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
    assert calibration.startswith("  Uncalibrated: no rig says whether")
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


def test_the_range_between_people_is_that_of_what_the_file_holds(saved, tmp_path):
    out = tmp_path / "drive.wav"
    call = ["export", str(saved), "--out", str(out), "--people", "--inputs", "2"]
    assert main(call) == 0
    about = json.loads((tmp_path / "drive.wav.json").read_text(encoding="utf-8"))
    written, design = about["range_between_people"], ss.open_design(saved).design
    alone = replace(design, inputs=design.inputs[1:2])
    found = ss.people.levels(alone, limbs=written["people"])
    for name in ("mean_db", "low_db", "high_db"):
        np.testing.assert_allclose(written[name], getattr(found, name), atol=1e-9)
    assert written["levels"] == "RMS over the whole record, x, y, z, principal axis"


def test_without_the_people_nothing_is_written(tmp_path):
    design = ss.Design(limb="measured-1", inputs=(ss.track(7),))
    options = ss.StimulusOptions(people=True)
    with pytest.raises(DatasetMissingError):
        ss.export_stimulus(design, tmp_path / "drive.wav", options=options)
    assert not list(tmp_path.iterdir())


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
