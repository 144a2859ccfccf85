"""Folders that replace others of the same writer."""

import pytest

from skinsource.base.errors import StorageError
from skinsource.base.files import replacing_folder


@pytest.fixture
def folder(tmp_path):
    path = tmp_path / "out"
    path.mkdir()
    for name in ("mark.json", "old.bin", "log.csv", "log-2.csv"):
        (path / name).write_text(f"old {name}")
    (path / "log-3.csv").mkdir()
    return path


def content(folder):
    return {file.name: file.read_text() for file in folder.iterdir() if file.is_file()}


def test_what_others_wrote_goes_over_and_takes_the_place_of_nothing_new(folder):
    with replacing_folder(folder, "mark.json", kept="log*.csv") as new:
        for name in ("mark.json", "log-2.csv"):
            (new / name).write_text(f"new {name}")
    assert content(folder) == {
        "mark.json": "new mark.json",
        "log-2.csv": "new log-2.csv",
        "log.csv": "old log.csv",
    }
    assert {file.name for file in folder.iterdir()} == set(content(folder))
    assert list(folder.parent.iterdir()) == [folder]


def test_what_is_not_finished_or_not_ours_replaces_nothing(folder):
    before = content(folder)
    with pytest.raises(ZeroDivisionError), replacing_folder(folder, "mark.json") as new:
        (new / "mark.json").write_text(f"{1 / 0}")
    with (
        pytest.raises(StorageError, match="something else has this name"),
        replacing_folder(folder, "other.json"),
    ):
        pass
    assert content(folder) == before
    assert list(folder.parent.iterdir()) == [folder]
