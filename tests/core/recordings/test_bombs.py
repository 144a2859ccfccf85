"""Files that declare what they do not hold, or lead elsewhere, and mutants: refused in time."""

import struct
import zipfile

import h5py
import numpy as np
import pytest
import scipy.io

from skinsource.base.errors import RecordingError
from tests.core.recordings.mutants import FORMATS, try_mutants


def npy_header(shape, dtype="<f8", more=b""):
    text = f"{{'descr': '{dtype}', 'fortran_order': False, 'shape': {shape}, }}".encode()
    text = text.ljust(117) + b"\n"
    return b"\x93NUMPY\x01\0" + struct.pack("<H", len(text)) + text + more


def npy_of_terabytes(path, _):
    path.write_bytes(npy_header((100_000_000_000,), more=bytes(800)))


def npy_deep_header(path, _):
    text = b"[" * 9000
    path.write_bytes(b"\x93NUMPY\x01\0" + struct.pack("<H", len(text)) + text)


def npz_of_zeros(path, _):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.npy", npy_header((2**24,), more=bytes(2**27)))


def npz_that_lies(path, _):
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("a.npy", npy_header((10**9,), more=bytes(80)))


def wav_of_gigabytes(path, _):
    fmt = struct.pack("<HHIIHH", 1, 1, 48_000, 96_000, 2, 16)
    head = b"WAVEfmt " + struct.pack("<I", 16) + fmt + b"data" + struct.pack("<I", 0xFFFFFFF0)
    path.write_bytes(b"RIFF" + struct.pack("<I", 0xFFFFFFF8) + head)


def mat_that_lies(path, _):
    element = struct.pack("<II", 14, 2**31) + bytes(100)
    path.write_bytes(b"MATLAB 5.0 MAT-file".ljust(124) + b"\0\x01IM" + element)


def mat_of_zeros(path, _):
    scipy.io.savemat(path, {"a": np.zeros(2**23 + 1)}, do_compression=True, appendmat=False)


def hdf5_unallocated(path, _):
    with h5py.File(path, "w") as file:
        file.create_dataset("a", (10**11,), "f8", chunks=(1000,))


def hdf5_of_zeros(path, _):
    with h5py.File(path, "w") as file:
        made = file.create_dataset("a", (20_000_000,), "f8", chunks=(10**6,), compression=9)
        for k in range(0, 20_000_000, 10**6):
            made[k : k + 10**6] = 0.0


def hdf5_large_chunks(path, _):
    with h5py.File(path, "w") as file:
        made = file.create_dataset("a", (2**24,), "f8", chunks=(2**24,), compression=1)
        made[:10] = 1.0


def hdf5_external_link(path, other):
    with h5py.File(path, "w") as file:
        file["a"] = h5py.ExternalLink(str(other), "secret")


def hdf5_external_storage(path, other):
    with h5py.File(path, "w") as file:
        file.create_dataset("a", (100,), "f8", external=[(str(other), 0, 800)])


def hdf5_virtual(path, other):
    layout = h5py.VirtualLayout((100,), "f8")
    layout[:] = h5py.VirtualSource(str(other), "secret", (100,))
    with h5py.File(path, "w") as file:
        file.create_virtual_dataset("a", layout)


def hdf5_cycle(path, _):
    with h5py.File(path, "w") as file:
        group = file.create_group("a")
        group["again"] = group
        group["root"] = file["/"]


def hdf5_deep(path, _):
    with h5py.File(path, "w") as file:
        group = file
        for _ in range(40):
            group = group.create_group("g")
        group["x"] = np.arange(9.0)


def csv_too_large(path, _):
    with path.open("wb") as file:
        file.write(b"1,2\n" * 100)
        file.truncate(300_000_000)


BOMBS = {
    name: make
    for name, make in list(globals().items())
    if name.startswith(("npy_of", "npy_deep", "npz", "wav", "mat", "hdf5"))
    or name.startswith("csv")
}


#: What of a bomb is said, where something else would refuse it too.
WORDS = {
    "npz_that_lies": "unpack to 8000000000 bytes",
    "npz_of_zeros": "too much",
    "mat_of_zeros": "unpack to 67108872 bytes",
    "hdf5_unallocated": "declares 800000000000 bytes",
    "hdf5_of_zeros": "declares 160000000 bytes",
    "hdf5_large_chunks": "chunks are larger",
    "hdf5_external_link": "a link that leads elsewhere",
    "hdf5_external_storage": "it lies in another file",
    "hdf5_virtual": "it lies in another file",
    "hdf5_deep": "groups deep",
}


@pytest.mark.parametrize("name", BOMBS)
def test_bombs_are_refused_and_the_process_lives_on(name, tmp_path, process):
    other = tmp_path / "other.h5"
    with h5py.File(other, "w") as file:
        file["secret"] = np.arange(100.0)
    path = tmp_path / "bomb"
    BOMBS[name](path, other)
    before = other.stat().st_atime_ns
    pid = process.pid
    with pytest.raises(RecordingError, match=r"^bomb: .*expected") as error:
        process.look(path)
    assert WORDS.get(name, "") in str(error.value)
    assert other.stat().st_atime_ns == before
    assert pid is None or process.pid == pid
    assert _peak_bytes(process.pid) < 400 * 2**20


def _peak_bytes(pid):
    try:
        with open(f"/proc/{pid}/status") as file:
            line = next(line for line in file if line.startswith("VmHWM"))
    except OSError:
        return 0
    return int(line.split()[1]) * 1024


def test_what_lies_beside_a_link_can_be_taken(tmp_path, process):
    path = tmp_path / "a.h5"
    with h5py.File(path, "w") as file:
        file["good"] = np.arange(9.0)
        file["bad"] = h5py.ExternalLink("/etc/hostname", "x")
    recording = process.look(path)
    assert [series.key for series in recording.series] == ["good"]
    assert "'bad'" in recording.notes[0]
    with pytest.raises(RecordingError, match="no signal"):
        process.read(path, ["bad"], 0, 5)


#: Of each format; together 2030.
COUNT = 290
SEED = 20261122


@pytest.mark.parametrize("file_format", FORMATS)
def test_no_mutant_takes_the_studio_down_or_is_misread(file_format, tmp_path, process):
    tally = try_mutants(file_format, COUNT, SEED, tmp_path, process)
    assert tally.wrong == []
    assert sum(tally.outcomes.values()) == COUNT
    # Of some the damage is in numbers, of some it is where it counts.
    assert tally.outcomes["read"] > 5
    assert tally.outcomes["refused"] > 20
    assert tally.outcomes["process lost"] < 20
