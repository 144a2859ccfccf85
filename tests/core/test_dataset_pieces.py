"""Downloads whose arrays are not all there, or not where they should be, are refused."""

import shutil
import struct

import h5py
import numpy as np
import pytest

from skinsource.base.errors import DatasetError
from skinsource.limbs.dataset.install import check_contiguous, install

#: A node of an index, and that it is one of pieces, not of names.
NODE = b"TREE\x01"


def test_a_misplaced_piece_is_refused_by_the_installation(synthetic_download, tmp_path):
    folder = tmp_path / "download"
    shutil.copytree(synthetic_download, folder)
    path = folder / "visualization" / "adjacencyMatrix.mat"
    matio = pytest.importorskip("matio")
    values = matio.load_from_mat(str(path))["adjacencyMatrix"]
    matio.save_to_mat(str(path), {"adjacencyMatrix": values}, version="v7.3")
    with h5py.File(path, "r+", libver="earliest") as file:
        attributes = dict(file["adjacencyMatrix"].attrs)
        del file["adjacencyMatrix"]
        pieces = file.create_dataset(
            "adjacencyMatrix", data=values.T, chunks=(8, 500), compression="gzip"
        )
        pieces.attrs.update(attributes)
    install(folder, unpublished=True)

    content = bytearray(path.read_bytes())
    place = content.index(NODE) + 24 + 8 + 7  # the highest byte of the first piece's row
    content[place] ^= 2
    path.write_bytes(content)
    with h5py.File(path) as file:
        assert (file["adjacencyMatrix"][:8, :500] == 0).all()  # not a word from HDF5
    with pytest.raises(DatasetError, match=r"adjacencyMatrix\.mat: is damaged: .* piece"):
        install(folder, unpublished=True)


def test_two_arrays_in_one_place_are_refused(tmp_path):
    path = tmp_path / "twice.mat"
    with h5py.File(path, "w", libver="earliest") as file:
        for name in ("one", "other"):
            file[name] = np.arange(1000.0)
        places = [file[name].id.get_offset() for name in ("one", "other")]
    check_contiguous(path)
    first, second = (struct.pack("<Q", place) for place in places)
    content = path.read_bytes()
    assert content.count(second) == 1
    path.write_bytes(content.replace(second, first))
    with h5py.File(path) as file:
        assert file["other"].id.get_offset() == places[0]
    with pytest.raises(DatasetError, match="/one and /other lie in the same place"):
        check_contiguous(path)


def written_in_part(file):
    file.create_dataset("mask", (4, 4), "<f8", chunks=(2, 4))[:2] = 1.0


def of_an_odd_kind(file):
    odd = h5py.h5t.IEEE_F64LE.copy()
    odd.set_ebias(1022)
    space = h5py.h5s.create_simple((4,))
    h5py.h5d.create(file.id, b"mask", odd, space).write(h5py.h5s.ALL, h5py.h5s.ALL, np.ones(4))


ODD = {
    "mask is not there": lambda file: file.create_dataset("mask", (3, 4), "<f8"),
    "mask has 1 pieces, expected 2": written_in_part,
    "mask lies in other files": lambda file: file.create_dataset(
        "mask", (3, 4), "<f8", external=[("raw", 0, 96)]
    ),
    "mask holds numbers of an unknown kind": of_an_odd_kind,
}


@pytest.mark.parametrize("message", ODD)
def test_an_array_that_is_not_all_there_or_of_another_kind_is_refused(tmp_path, message):
    path = tmp_path / "odd.mat"
    with h5py.File(path, "w", libver="earliest") as file:
        ODD[message](file)
    with pytest.raises(DatasetError, match=message):
        check_contiguous(path)
