"""Downloads with flipped bits: refused, or read as they were.

The attempts run in a process of their own, because a damaged file can end HDF5 or keep it busy.
"""

import json
import shutil
import struct
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

from skinsource.base.errors import DatasetError
from skinsource.limbs.dataset.install import check_contiguous, install

SEED = 20263
#: More of an array than a node of the index holds: there are nodes of nodes.
N_PIECES = 72
#: A node of an index, and that it is one of pieces, not of names.
NODE = b"TREE\x01"
ATTEMPTS = """
import collections
import hashlib
import json
import sys
from pathlib import Path

import h5py

from skinsource.limbs.dataset.install import check_contiguous

path, flips = Path(sys.argv[1]), json.loads(sys.stdin.read())


def everything():
    check_contiguous(path)
    with h5py.File(path) as file:
        arrays = [file[cell] for cell in file["cells"][()]]
        digests = [hashlib.sha256(array[()].tobytes()).hexdigest() for array in arrays]
        assert len(set(digests)) == len(digests)
        return [(array.shape, str(array.dtype)) for array in arrays], digests


expected = everything()
outcome = collections.Counter()
with path.open("r+b", buffering=0) as opened:
    for place, bit in flips:
        opened.seek(place)
        old = opened.read(1)
        opened.seek(place)
        opened.write(bytes([old[0] ^ 1 << bit]))
        try:
            content = everything()
        except Exception:  # HDF5 has many, and the installation explains each
            outcome["refused"] += 1
        else:
            # The installation knows shapes and kinds of numbers.
            known = content[0] == expected[0]
            read = "the same" if content == expected else f"another: {place}, {bit}"
            outcome[read if known else "refused"] += 1
        opened.seek(place)
        opened.write(old)
print(json.dumps(outcome))
"""


def outcome_of(path: Path, flips: list[tuple[int, int]]) -> dict[str, int]:
    result = subprocess.run(
        [sys.executable, "-c", ATTEMPTS, str(path)],
        input=json.dumps(flips),
        check=False,
        capture_output=True,
        text=True,
        timeout=110,
    )
    assert result.returncode == 0, f"{SEED=}: {result.stderr[-2000:]}"
    return json.loads(result.stdout)


def places_of_nodes(content: bytes, length: int) -> list[int]:
    """Bytes of all index nodes, ``length`` from the beginning of each."""
    places: list[int] = []
    place = content.find(NODE)
    while place >= 0:
        places += range(place, min(place + length, len(content)))
        place = content.find(NODE, place + 1)
    return places


def test_flips_anywhere_but_in_values_are_refused_or_make_no_difference(tmp_path):
    # Write a small file as MATLAB does: cells of packed arrays, in the oldest format of HDF5.
    path = tmp_path / "packed.mat"
    random = np.random.default_rng(SEED)
    with h5py.File(path, "w", libver="earliest", userblock_size=512) as file:
        group = file.create_group("#refs#")
        for k in range(3):
            values = random.standard_normal((3, 12, 30))
            group.create_dataset(f"c{k}", data=values, chunks=(1, 2, 8), compression="gzip")
        cells = np.array([dataset.ref for dataset in group.values()], dtype=h5py.ref_dtype)
        file.create_dataset("cells", data=cells, dtype=h5py.ref_dtype)
    with h5py.File(path) as file:
        ranges = [
            file["#refs#"][name].id.get_chunk_info(k)
            for name in file["#refs#"]
            for k in range(N_PIECES)
        ]
    free = np.ones(path.stat().st_size, bool)
    free[:512] = False
    for piece in ranges:
        free[512 + piece.byte_offset : 512 + piece.byte_offset + piece.size] = False
    content = np.fromfile(path, np.uint8)
    anywhere = np.flatnonzero(free & (content != 0))
    # Of a node: its head, then size, mask and four offsets of each piece, and where it lies.
    in_index = places_of_nodes(path.read_bytes(), 24 + N_PIECES // 2 * 48)
    random = np.random.default_rng(SEED)
    places = [*random.choice(anywhere, 200), *random.choice(in_index, 300)]
    outcome = outcome_of(path, [(int(place), int(random.integers(8))) for place in places])
    assert set(outcome) <= {"refused", "the same"}, outcome
    assert outcome["refused"] > 200


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
