"""Damaged stores: whatever happens to the bytes, no other data are ever given.

The attempts run in a process of their own, because a damaged file can end HDF5 or keep it busy.
"""

import json
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

from skinsource.base.errors import DatasetError
from skinsource.limbs.dataset import published, store
from skinsource.limbs.dataset import store as upkeep

SEED = 20262
ATTEMPTS = """
import collections
import json
import sys
from pathlib import Path

import numpy as np

from skinsource.limbs.dataset.store import describe, load_mask, load_measured_limb
from skinsource.base.errors import DatasetError

way, seed, count, gaps = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), json.loads(sys.argv[4])
random = np.random.default_rng(seed)
places = np.concatenate([np.arange(first, last) for first, last in gaps])


def everything():
    limb = load_measured_limb(1)
    arrays = (
        limb.map.outline,
        limb.map.output_positions,
        limb.map.input_positions,
        limb.map.visibility,
        limb.response_to(1),
        limb.response_to(20),
        load_mask(1),
    )
    return describe(), [array.tobytes() for array in arrays]


def damaged(old):
    if way == "flip":
        return bytes([old[0] ^ 1 << int(random.integers(8))]) + old[1:]
    if way == "hole":
        return bytes(len(old))
    return random.bytes(len(old))


expected, path = everything(), describe().path
outcome = collections.Counter()
with path.open("r+b", buffering=0) as opened:
    for attempt in range(count):
        place = int(random.choice(places))
        opened.seek(place)
        old = opened.read(32)
        opened.seek(place)
        opened.write(damaged(old))
        try:
            content = everything()
        except DatasetError as error:
            assert "Install it again" in str(error), error
            outcome["refused"] += 1
        else:
            outcome["the same" if content == expected else f"another, attempt {attempt}"] += 1
        opened.seek(place)
        opened.write(old)
print(json.dumps(outcome))
"""


def used_gaps(path: Path) -> list[tuple[int, int]]:
    """Give what is no array: first and last + 1 of each run of bytes that is not all zero."""
    arrays = []
    with h5py.File(path) as opened:
        for name in published.WHOLE_SHAPES:
            dataset_id = opened[name].id
            arrays.append((dataset_id.get_offset(), dataset_id.get_storage_size()))
        for limb in published.LIMBS:
            dataset_id = opened[published.responses_name(limb)].id
            chunks = [dataset_id.get_chunk_info(k) for k in range(dataset_id.get_num_chunks())]
            arrays += [(chunk.byte_offset, chunk.size) for chunk in chunks]
    is_free = np.ones(path.stat().st_size, bool)
    for start, size in arrays:
        is_free[start : start + size] = False
    is_free &= np.fromfile(path, np.uint8) != 0
    edges = np.flatnonzero(np.diff(is_free, prepend=False, append=False))
    return edges.reshape(-1, 2).tolist()


@pytest.mark.parametrize(("way", "count"), [("flip", 250), ("hole", 60), ("noise", 60)])
def test_damage_outside_the_arrays_is_refused_or_makes_no_difference(
    synthetic_installed, way, count
):
    gaps = json.dumps(used_gaps(synthetic_installed))
    command = [sys.executable, "-c", ATTEMPTS, way, str(SEED), str(count), gaps]
    result = subprocess.run(command, check=False, capture_output=True, text=True, timeout=90)
    assert result.returncode == 0, f"{SEED=}: {result.stderr[-2000:]}"
    outcome = json.loads(result.stdout)
    assert set(outcome) <= {"refused", "the same"}, f"{SEED=}: {outcome}"
    assert outcome["refused"] > count // 6, f"{SEED=}: {outcome}"


def test_a_store_cut_off_anywhere_is_refused(synthetic_installed):
    random = np.random.default_rng(SEED)
    size = synthetic_installed.stat().st_size
    cuts = [size - 1, *sorted(random.integers(0, size, 30).tolist(), reverse=True), 100, 47, 8, 1]
    for cut in cuts:
        with synthetic_installed.open("r+b") as opened:
            opened.truncate(cut)
        for call in (store.describe, lambda: store.load_measured_limb(1), upkeep.verify):
            with pytest.raises(DatasetError, match="Install it again"):
                call()
            assert synthetic_installed.stat().st_size == cut, f"{SEED=}"


def test_every_letter_of_every_text_is_watched_over(synthetic_installed):
    info = store.describe()
    texts = [published.FORMAT, info.installed_at, info.source_name, info.source_sha256]
    with h5py.File(synthetic_installed) as opened:
        texts.append(opened["map/outline"].attrs["sha256"].decode())
        texts += [digest.decode() for digest in opened["responses/limb-1"].attrs["sha256"][[0, 19]]]
    gaps = used_gaps(synthetic_installed)
    with synthetic_installed.open("r+b", buffering=0) as opened:
        for text in texts:
            start = next(start for gap in gaps if (start := find(opened, gap, text)) is not None)
            for place in range(start, start + len(text)):
                opened.seek(place)
                old = opened.read(1)
                opened.seek(place)
                opened.write(bytes([old[0] ^ 2]))
                with pytest.raises(DatasetError):
                    store.load_measured_limb(1)
                opened.seek(place)
                opened.write(old)
    assert store.describe() == info


def find(opened, gap: tuple[int, int], text: str) -> int | None:
    opened.seek(gap[0])
    place = opened.read(gap[1] - gap[0]).find(text.encode())
    return None if place < 0 else gap[0] + place


def test_no_text_of_the_store_lies_outside_the_checksums(synthetic_installed):
    assert b"GCOL" not in synthetic_installed.read_bytes()
    with h5py.File(synthetic_installed) as opened:
        parts = [opened]
        opened.visititems(lambda _, part: parts.append(part))
        assert len(parts) == 16
        for part in parts:
            for name in part.attrs:
                assert part.attrs.get_id(name).dtype.kind in "iS"
