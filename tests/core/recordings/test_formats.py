"""Every format: what is in a file, and its numbers."""

import h5py
import numpy as np
import pytest
import scipy.io
import soundfile

from skinsource.base.errors import RecordingError
from skinsource.design.recordings import suggested
from tests.core.recordings.conftest import RATE_HZ, WRITERS


@pytest.mark.parametrize("file_format", WRITERS)
def test_a_file_says_what_it_is_and_gives_its_numbers(file_format, files, signal, process):
    recording = process.look(files[file_format])
    assert recording.format == file_format
    (series,) = recording.signals()
    assert series.n_samples == signal.size
    rate_hz = recording.rate_of(series)
    assert rate_hz == (None if file_format in ("NPY", "text") else RATE_HZ)
    values = process.read(files[file_format], [series.key], 0, signal.size)
    np.testing.assert_array_equal(values[0], signal)
    part = process.read(files[file_format], [series.key], 1000, 1007)
    np.testing.assert_array_equal(part[0], signal[1000:1007])


def test_a_compressed_sound_has_the_length_it_says(tmp_path, process):
    path = tmp_path / "a.ogg"
    soundfile.write(path, np.sin(np.arange(20_000) * 0.1), 8000)
    (series,) = process.look(path).series
    assert series.n_samples == 20_000
    values = process.read(path, [series.key], 5000, 15_000)[0]
    assert np.corrcoef(values, np.sin(np.arange(5000, 15_000) * 0.1))[0, 1] > 0.999


def test_a_sound_that_is_cut_off_says_so(files, signal, tmp_path, process):
    path = tmp_path / "cut.wav"
    path.write_bytes(files["WAV"].read_bytes()[:-1000])
    recording = process.look(path)
    assert recording.series[0].n_samples == signal.size - 500
    assert "cut off" in recording.notes[0]
    assert process.look(files["WAV"]).notes == ()


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("shape", [(500, 3), (3, 500)])
def test_columns_of_an_array_lie_along_its_short_side(order, shape, tmp_path, process):
    values = np.asarray(np.random.default_rng(0).standard_normal(shape), order=order)
    lanes = values if shape[0] == 3 else values.T
    np.save(tmp_path / "a.npy", values)
    np.savez(tmp_path / "a.npz", values)
    scipy.io.savemat(tmp_path / "a.mat", {"a": values})
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file.create_dataset("a", data=values, chunks=True, compression="gzip")
    for name in ("a.npy", "a.npz", "a.mat", "a.h5"):
        recording = process.look(tmp_path / name)
        assert [series.n_samples for series in recording.series] == [500] * 3
        keys = [series.key for series in recording.series]
        np.testing.assert_array_equal(process.read(tmp_path / name, keys, 0, 500), lanes)


def test_structures_groups_units_and_rates_are_found(tmp_path, process):
    inner = {"acc": np.arange(30.0), "time": np.arange(30.0) / 8000.0, "fs": 8000.0}
    scipy.io.savemat(tmp_path / "a.mat", {"trial": {"one": inner}, "note": "hello"})
    recording = process.look(tmp_path / "a.mat")
    assert [signal.key for signal in recording.signals()] == ["trial/one/acc"]
    assert (recording.rate_hz, recording.rate_from) == (8000.0, "'trial/one/fs'")
    choice = suggested(recording)
    assert choice.time == "trial/one/time"

    with h5py.File(tmp_path / "a.h5", "w") as file:
        for group, rate in (("a", 1000.0), ("b", 4000.0)):
            file[f"{group}/acc"] = np.arange(30.0)
            file[f"{group}/acc"].attrs["unit"] = "g"
            file[f"{group}/acc"].attrs["sampling_rate"] = rate
            file[f"{group}/time"] = np.arange(30.0) / rate
    recording = process.look(tmp_path / "a.h5")
    second = recording.one("b/acc")
    assert (second.unit, recording.rate_of(second)) == ("g", 4000.0)
    assert recording.time_of(second).key == "b/time"


def test_what_is_no_signal_is_left_out_and_named(tmp_path, process):
    np.savez(
        tmp_path / "a.npz",
        good=np.arange(10.0),
        text=np.array(["a", "b"]),
        cube=np.zeros((3, 4, 5)),
        wide=np.zeros((300, 400)),
        turning=np.ones(10, complex),
    )
    recording = process.look(tmp_path / "a.npz")
    assert [series.key for series in recording.series] == ["good"]
    for name in ("text", "cube", "wide", "turning"):
        assert any(f"'{name}'" in note for note in recording.notes), name


def test_objects_are_never_unpickled(tmp_path, process):
    class Trap:
        def __reduce__(self):
            return (open, (str(tmp_path / "sprung"), "w"))

    np.save(tmp_path / "a.npy", np.array([Trap(), Trap()]), allow_pickle=True)
    np.savez(tmp_path / "a.npz", a=np.array([Trap()]), b=np.arange(5.0))
    with pytest.raises(RecordingError, match="Python objects"):
        process.look(tmp_path / "a.npy")
    assert [series.key for series in process.look(tmp_path / "a.npz").series] == ["b"]
    assert not (tmp_path / "sprung").exists()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "no rows of numbers"),
        (b"\0\1\2" * 50, "not text"),
        (b"RIFF\x24\0\0\0WAVEfmt ", "cannot be read"),
        (b"\x93NUMPY\x01\0", "cannot be read"),
        (b"PK\x03\x04nonsense", "cannot be read"),
        (b"MATLAB 5.0 MAT-file", "cannot be read"),
        (b"\x89HDF\r\n\x1a\n" + bytes(50), "cannot be read"),
        (b"<html>nothing here</html>", "no rows of numbers"),
    ],
)
def test_what_is_no_recording_is_one_clear_error(content, message, tmp_path, process):
    path = tmp_path / "strange.bin"
    path.write_bytes(content)
    with pytest.raises(RecordingError, match=message):
        process.look(path)
