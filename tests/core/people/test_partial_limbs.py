"""Partial limbs: some places of a person, and their files."""

from dataclasses import replace

import h5py
import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import FileFormatError, InvalidInputError, StorageError


@pytest.fixture
def own():
    cut = ss.people.partial("synthetic-2", [9, 21])
    return replace(
        cut,
        person="p07 · left of the lab",
        mounting="tape",
        posture="palm down",
        sensor="3 axes, 0.5 g",
        dates=("2026-03-02", "2026-03-03"),
    )


@pytest.fixture
def path(own, tmp_path):
    ss.people.save_partial(tmp_path / "p07.h5", own)
    return tmp_path / "p07.h5"


def test_it_has_the_responses_of_the_whole_limb_where_it_was_measured():
    whole, cut = ss.load_limb("synthetic-2"), ss.people.partial("synthetic-2", [9, 21])
    assert (cut.person, cut.outputs, cut.inputs) == ("synthetic-2", (9, 21), tuple(range(1, 21)))
    there = cut.limb.impulse_responses
    np.testing.assert_array_equal(there[:, [8, 20]], whole.impulse_responses[:, [8, 20]])
    assert not np.delete(there, [8, 20], axis=1).any()


@pytest.mark.parametrize("outputs", [[], [0], [9, 9], [73]])
def test_outputs_that_are_none_or_come_twice_are_refused(outputs):
    with pytest.raises(InvalidInputError, match=r"outputs are .* expected one or more of 1 to 72"):
        ss.people.partial("synthetic-1", outputs)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"inputs": (1, 2)}, r"responses have the shape .* with \(2, 2, 3\) first"),
        ({"responses": np.full((20, 2, 3, 9), np.nan)}, "responses is nan at index"),
        ({"dates": ("2026-03-02",)}, "there are 1 dates, expected 2"),
    ],
)
def test_what_does_not_fit_is_refused(own, changes, message):
    with pytest.raises(InvalidInputError, match=message):
        replace(own, **changes)


def test_a_file_gives_back_what_was_saved(own, path):
    read = ss.people.open_partial(path)
    for name in ("person", "like", "inputs", "outputs", "mounting", "posture", "sensor", "dates"):
        assert getattr(read, name) == getattr(own, name)
    np.testing.assert_array_equal(read.responses, own.responses)


def test_days_may_be_unknown(own, tmp_path):
    ss.people.save_partial(tmp_path / "a.h5", replace(own, dates=()))
    assert ss.people.open_partial(tmp_path / "a.h5").dates == ()


def changed(path, change):
    with h5py.File(path, "r+") as file:
        change(file)


def set_attribute(**values):
    return lambda file: file.attrs.update(values)


def delete(name):
    return lambda file: file.attrs.pop(name)


def scaled(file):
    file["responses"][3, 1] *= 1.001


def without_responses(file):
    del file["responses"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (scaled, "its checksum is another one"),
        (set_attribute(person="p08"), "its checksum is another one"),
        (set_attribute(outputs=[21, 9]), "its checksum is another one"),
        (set_attribute(outputs=[9.5, 21.0]), "outputs are"),
        (set_attribute(outputs="9 21"), "outputs are"),
        (set_attribute(format="skinsource limb"), "the attribute 'format'"),
        (set_attribute(format_version=2), "format_version is 2, expected 1"),
        (set_attribute(person=7), "the attribute 'person'"),
        (delete("sha256"), "it has no attribute 'sha256'"),
        (without_responses, "it has no dataset 'responses'"),
    ],
)
def test_damage_is_noticed(path, change, message):
    changed(path, change)
    with pytest.raises(FileFormatError, match=message):
        ss.people.open_partial(path)


def test_it_fits_the_limb_whose_places_it_has(own, path, monkeypatch):
    from skinsource.people import partial_file

    fast = type("Fast", (), {"axes": "xyz", "sample_rate_hz": 2000.0, "pre_trigger_delay_s": 0.052})
    fast.name = "fast"
    monkeypatch.setattr(partial_file, "limb_of", lambda name: fast)
    with pytest.raises(FileFormatError, match=r"sample_rate_hz is 1300.0, expected 2000.0 as of"):
        ss.people.open_partial(path)


def test_other_files_are_no_partial_limbs(tmp_path):
    (tmp_path / "a.h5").write_bytes(b"text")
    with pytest.raises(FileFormatError, match=r"a\.h5"):
        ss.people.open_partial(tmp_path / "a.h5")
    with pytest.raises(StorageError, match=r"none\.h5"):
        ss.people.open_partial(tmp_path / "none.h5")
