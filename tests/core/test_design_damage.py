"""Damaged design files of version 1: whatever happens to them, no other design is ever opened.

The attempts run in a process of their own, because a damaged file can end HDF5 or keep it busy.
There the reader of version 1 is called as it is, not in one more process for each attempt.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from skinsource.design_file import open_design
from skinsource.errors import DesignFileError

FOLDER = Path(__file__).parents[1] / "references" / "designs-v1"
SEED = 20261
ATTEMPTS = """
import collections
import json
import sys
from pathlib import Path

import numpy as np

from skinsource.design_file import version_1_process, open_design, version_1_child
from skinsource.errors import DesignFileError, FileFormatError, InvalidInputError


def here(image):
    said = version_1_child.answer(bytes(image))
    word, _, content = said.partition(b"\\n")
    if word == b"found":
        return content
    raise (FileFormatError if word == b"damaged" else InvalidInputError)(content.decode())


version_1_process.as_today = here
path, way, seed, count = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
expected, image = open_design(path), path.read_bytes()
random = np.random.default_rng(seed)
texts = (b"synthetic-", b"skinsource design", b"Tone", b"Noise", b"sensors_shown")
watched = [image.index(text) + k for text in texts for k in range(len(text))]
outcome = collections.Counter()
for attempt in watched if way == "watch" else range(count):
    damaged = bytearray(image)
    place = int(random.integers(len(image)))
    if way == "watch":
        place = attempt
        damaged[place] ^= 2
    elif way == "flip":
        damaged[place] ^= 1 << int(random.integers(8))
    elif way == "cut":
        del damaged[place:]
    elif way == "hole":
        damaged[place : place + 64] = bytes(len(damaged[place : place + 64]))
    elif way == "shift":
        damaged.insert(place, int(random.integers(256)))
    path.write_bytes(damaged)
    try:
        found = open_design(path)
    except DesignFileError:
        outcome["refused"] += 1
    else:
        outcome["the same" if found == expected else f"another, attempt {attempt}"] += 1
print(json.dumps(outcome))
"""


def attempts(path: Path, way: str, count: int) -> dict[str, int]:
    command = [sys.executable, "-c", ATTEMPTS, str(path), way, str(SEED), str(count)]
    result = subprocess.run(command, check=False, capture_output=True, text=True, timeout=60)
    assert result.returncode == 0, f"{SEED=}: {result.stderr[-2000:]}"
    return json.loads(result.stdout)


@pytest.fixture(params=["every-kind", "muted-and-solo"])
def saved(request, tmp_path) -> Path:
    path = tmp_path / "design.skinsource"
    path.write_bytes((FOLDER / f"{request.param}.skinsource").read_bytes())
    return path


@pytest.mark.parametrize(("way", "count"), [("flip", 250), ("hole", 60), ("shift", 40)])
def test_damaged_bytes_are_refused_or_make_no_difference(saved, way, count):
    outcome = attempts(saved, way, count)
    assert set(outcome) <= {"refused", "the same"}, f"{SEED=}"
    assert outcome["refused"] > count // 3


def test_a_file_cut_off_anywhere_is_refused(saved):
    assert attempts(saved, "cut", 60) == {"refused": 60}


def test_every_bit_of_every_text_is_watched_over(saved):
    outcome = attempts(saved, "watch", 0)
    assert set(outcome) == {"refused"}
    assert outcome["refused"] == 49


def test_a_damaged_file_is_refused_by_the_process_that_reads_it_in_the_studio_too(saved):
    image = bytearray(saved.read_bytes())
    image[image.index(b"Tone")] ^= 2
    saved.write_bytes(image)
    with pytest.raises(DesignFileError):
        open_design(saved)
