"""Damaged and hostile files of limbs: one clear error each, nothing kept, nothing lost."""

import re

import h5py
import numpy as np
import pytest

from skinsource.base.errors import FileFormatError, SkinSourceError
from skinsource.limbs.limb_import import LimbSource, import_limb
from skinsource.limbs.own_limbs import LimbFile, own_limb_path
from tests.core.own_limbs.mutants import read_layout, try_layout, whole_file

N_MUTANTS = 300


def test_hundreds_of_mutants_give_a_limb_or_one_clear_error(user_data, tmp_path, process):
    whole = whole_file(tmp_path / "whole.h5")
    tally = try_layout(whole, N_MUTANTS, 3, tmp_path, process)
    assert tally.wrong == []
    assert tally.outcomes["refused"] > N_MUTANTS // 4
    assert tally.outcomes["read"] > N_MUTANTS // 20
    assert tally.outcomes["process lost"] == 0
    read_layout(whole, process)


def test_a_kept_limb_with_another_byte_or_more_or_fewer_of_them_is_refused(user_data, tmp_path):
    import_limb(LimbSource(responses=whole_file(tmp_path / "whole.h5")))
    path = own_limb_path("ours")
    content = path.read_bytes()
    # Zeros fill up blocks.
    used = np.flatnonzero(np.frombuffer(content, np.uint8))
    for at in used[np.linspace(0, used.size - 1, N_MUTANTS).astype(int)]:
        flipped = bytes([content[at] ^ 1])
        changed = content[:at] + flipped + content[at + 1 :]
        for damaged in (content[:at], changed, content + flipped):
            path.write_bytes(damaged)
            with pytest.raises(FileFormatError, match=r"^\S*ours[^\n]{,500}$"):
                [LimbFile(path).response(place) for place in (1, 2)]


def hostile(change):
    def make(path):
        with h5py.File(whole_file(path), "r+") as file:
            change(file)
        return path

    return make


def put(name, value):
    def change(file):
        del file[name]
        file[name] = value

    return change


def linked_elsewhere(file):
    del file["responses"]
    file["responses"] = h5py.ExternalLink("other.h5", "responses")


def huge(file):
    del file["responses"]
    file.create_dataset("responses", (256, 512, 3, 100_000), "f8", chunks=(1, 1, 1, 1000))


def huge_names(file):
    del file["names/inputs"]
    file["names/inputs"] = ["a" * 100_000, "b"]


@pytest.mark.parametrize(
    ("change", "part"),
    [
        (lambda file: file.attrs.__setitem__("format_version", 2), "format_version is 2"),
        (lambda file: file.attrs.__delitem__("axes"), "no attribute 'axes'"),
        (lambda file: file.attrs.__setitem__("axes", 5), "'axes' is 5, expected a short text"),
        (lambda file: file.attrs.__setitem__("sample_rate_hz", "fast"), "expected one number"),
        (lambda file: file.attrs.__setitem__("sample_rate_hz", [1.0, 2.0]), "expected one number"),
        (lambda file: file.attrs.__setitem__("answers", "what"), "expected drive or pulse"),
        (lambda file: file.attrs.__setitem__("note", "a" * 20_000), "expected a short text"),
        (lambda file: file.__delitem__("map"), "no group 'map'"),
        (lambda file: file.__delitem__("responses"), "no dataset 'responses'"),
        (put("responses", np.zeros((2, 4, 8))), "'responses' has shape (2, 4, 8)"),
        (put("responses", np.zeros((3, 4, 2, 8))), "the responses have 3"),
        (put("map/outputs", np.array([b"a", b"b"])), "not real numbers"),
        (linked_elsewhere, "no dataset 'responses'"),
        (huge, "it declares"),
        (huge_names, "one line"),
    ],
)
def test_a_file_that_is_not_what_it_should_be_is_refused_by_name(tmp_path, process, change, part):
    path = hostile(change)(tmp_path / "bad.h5")
    with pytest.raises(SkinSourceError, match=re.escape(part)) as refused:
        read_layout(path, process)
    assert "bad.h5" in str(refused.value)
