"""What an export of a stimulus refuses, and what it then leaves behind."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError, NotConfirmedError, Stopped, StorageError
from tests.core.exporting.export_bench import read, sidecar


@pytest.mark.parametrize("kind", ["float32", "pcm16"])
def test_what_clips_is_refused_until_it_is_confirmed(design, tmp_path, kind):
    path = tmp_path / "a.wav"
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


def test_a_limit_that_is_passed_must_be_confirmed(design, tmp_path):
    listings = []

    def limit(drives):
        listings.append((drives.unit, np.abs(drives.samples).max()))
        return ["Channel 1 reaches 45 mm/s, more than 40 mm/s."]

    path = tmp_path / "a.wav"
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
        ({"rate_hz": 44_100.5}, "sample_rate_hz is 44100.5"),
        ({"rate_hz": 0}, "sample_rate_hz is 0"),
        ({"options": ss.StimulusOptions(choices={"samples": "pcm8"})}, "one of float32, pcm24"),
        ({"options": ss.StimulusOptions(choices={"layout": "table"})}, "offers samples"),
        ({"options": ss.StimulusOptions(from_s=0.2, to_s=0.1)}, "to_s is 0.1"),
        ({"options": ss.StimulusOptions(inputs=(4,))}, "Nothing is heard"),
        ({"options": ss.StimulusOptions(channel_map=(1,))}, "Channel map"),
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
