"""Damaged design files, and what never was one: nothing of them is ever opened."""

import io
import os
from hashlib import sha256
from pathlib import Path

import h5py
import numpy as np
import pytest

from skinsource.base.errors import DesignFileError, StorageError
from skinsource.design.design import Design, track
from skinsource.design.design_file import open_design, save_design
from skinsource.design.waveforms import KINDS


def test_every_flipped_bit_is_refused(tmp_path):
    save_design(tmp_path / "small", Design(limb="synthetic-1", inputs=(track(location=1),)))
    stored = (tmp_path / "small").read_bytes()
    for bit in range(8 * len(stored)):
        damaged = bytearray(stored)
        damaged[bit // 8] ^= 1 << bit % 8
        (tmp_path / "small").write_bytes(damaged)
        with pytest.raises(DesignFileError):
            open_design(tmp_path / "small")


def test_any_other_damage_to_a_larger_file_is_refused(tmp_path):
    random = np.random.default_rng(4)
    inputs = tuple(track(location=1 + k % 20, waveform=KINDS[k % 4]()) for k in range(100))
    path = tmp_path / "large"
    save_design(path, Design(limb="synthetic-1", inputs=inputs), layout=random.bytes(5000))
    stored = path.read_bytes()
    for attempt in range(400):
        place, length = int(random.integers(len(stored))), int(random.integers(1, 64))
        other = random.bytes(length) if attempt % 2 else bytes(length)
        damaged = [
            stored[:place] + other + stored[place + length :],
            stored[:place] + other + stored[place:],
            stored[:place] + stored[place + length :],
            stored[:place],
        ][attempt % 4]
        path.write_bytes(damaged)
        if damaged != stored:
            with pytest.raises(DesignFileError):
                open_design(path)


@pytest.mark.parametrize(
    "stored", [b"", b"\x89HDF\r\n\x1a\n", b"design", bytes(10_000), b"PK\x03\x04" * 500]
)
def test_what_is_no_design_file_is_refused(tmp_path, stored):
    (tmp_path / "any").write_bytes(stored)
    with pytest.raises(DesignFileError, match=r"not a SkinSource design, or damaged"):
        open_design(tmp_path / "any")


def test_a_file_far_too_large_is_refused_unread(tmp_path):
    with (tmp_path / "film.mp4").open("wb") as file:
        file.truncate(2**33)
    with pytest.raises(DesignFileError, match=r"^film\.mp4: 8589934592 bytes are too large"):
        open_design(tmp_path / "film.mp4")


@pytest.mark.parametrize("name", ["nowhere", ".", "a\0b", "x" * 300])
def test_a_file_that_cannot_be_read_is_explained(tmp_path, name):
    with pytest.raises(StorageError, match="cannot be read"):
        open_design(tmp_path / name)


@pytest.mark.skipif(os.name != "posix", reason="POSIX only")
def test_a_pipe_and_an_endless_device_are_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", Path("/dev/zero")):
        with pytest.raises(StorageError, match="no regular file"):
            open_design(path)


def test_a_hostile_file_with_a_right_checksum_costs_nothing(saved):
    memory = io.BytesIO()
    with h5py.File(memory, "w", userblock_size=512, libver=("v110", "v110")) as file:
        file.create_dataset(
            "content", (2**34,), np.uint8, chunks=(1,), compression="gzip", fletcher32=True
        )
        file.create_group("samples")
    stored = memory.getvalue()[512:]
    header = f"SkinSource design, version 3\nSHA-256 {sha256(stored).hexdigest()}\n"
    saved.write_bytes(header.encode().ljust(512, b"\n") + stored)
    with pytest.raises(DesignFileError, match="not larger than the file"):
        open_design(saved)
