import errno
import os
import stat
import tempfile
from pathlib import Path

import pytest

from skinsource.errors import StorageError
from skinsource.files import make_folder, replacing, write_bytes

OLD, NEW = b"what stood there", b"what is to stand there" * 1000
CODES = [errno.ENOSPC, errno.EIO, errno.EACCES, errno.EROFS, errno.EDQUOT]


@pytest.fixture
def target(tmp_path) -> Path:
    path = tmp_path / "design.skinsource"
    path.write_bytes(OLD)
    return path


@pytest.fixture
def fail(monkeypatch):
    """Make a function of a module fail from its n-th call on."""

    def arrange(place: object, name: str, code: int, call: int = 1) -> list[int]:
        original, calls = getattr(place, name), []

        def failing(*args, **kwargs):
            calls.append(len(calls) + 1)
            if len(calls) >= call:
                raise OSError(code, os.strerror(code))
            return original(*args, **kwargs)

        monkeypatch.setattr(place, name, failing)
        return calls

    return arrange


def assert_untouched(target: Path) -> None:
    assert target.read_bytes() == OLD
    assert [path.name for path in target.parent.iterdir()] == [target.name]


def test_the_new_content_replaces_the_old_one_and_nothing_else_is_left(target):
    write_bytes(target, NEW)
    assert target.read_bytes() == NEW
    assert list(target.parent.iterdir()) == [target]


def test_a_file_is_made_where_there_was_none(tmp_path):
    write_bytes(tmp_path / "new", NEW)
    assert (tmp_path / "new").read_bytes() == NEW


def test_until_the_end_the_old_content_stands_there(target):
    with replacing(target) as temporary:
        assert temporary.parent == target.parent
        temporary.write_bytes(NEW)
        assert target.read_bytes() == OLD
    assert target.read_bytes() == NEW
    assert not temporary.exists()


@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize(
    ("place", "name", "call"),
    [
        (tempfile, "mkstemp", 1),
        (Path, "write_bytes", 1),
        (os, "open", 2),
        (os, "fsync", 1),
        (os, "chmod", 1),
        (os, "replace", 1),
    ],
)
def test_a_failure_at_any_step_leaves_the_old_file_and_no_other(
    target, fail, place, name, call, code
):
    calls = fail(place, name, code, call)
    with pytest.raises(StorageError) as caught:
        write_bytes(target, NEW)
    assert len(calls) >= call
    assert_untouched(target)
    assert str(target) in str(caught.value)
    assert os.strerror(code) in str(caught.value)
    assert "try again" in str(caught.value)
    assert caught.value.__cause__.errno == code


def test_a_disk_that_is_full_half_way_leaves_the_old_file(target):
    resource = pytest.importorskip("resource", reason="limits exist on POSIX only")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (len(NEW) // 2, hard))
    try:
        with pytest.raises(StorageError, match="cannot be written"):
            write_bytes(target, NEW)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert_untouched(target)


def test_a_folder_that_cannot_be_flushed_does_not_matter_for_the_move_is_made(target, fail):
    calls = fail(os, "fsync", errno.EINVAL, 2)
    write_bytes(target, NEW)
    assert len(calls) == 2
    assert target.read_bytes() == NEW


def test_the_file_is_flushed_before_it_is_moved_and_the_folder_after(target, monkeypatch):
    steps = []
    flush, move = os.fsync, os.replace

    def fsync(handle):
        steps.append("folder" if stat.S_ISDIR(os.fstat(handle).st_mode) else "file")
        flush(handle)

    def replace(source, aim):
        steps.append("move")
        assert Path(source).read_bytes() == NEW
        move(source, aim)

    monkeypatch.setattr(os, "fsync", fsync)
    monkeypatch.setattr(os, "replace", replace)
    write_bytes(target, NEW)
    assert steps == ["file", "move", "folder"]


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt, MemoryError])
def test_any_other_failure_passes_through_and_leaves_the_old_file(target, error):
    def interrupted():
        with replacing(target) as temporary:
            temporary.write_bytes(NEW[:100])
            raise error

    with pytest.raises(error):
        interrupted()
    assert_untouched(target)


def test_a_missing_folder_is_explained(tmp_path):
    with pytest.raises(StorageError, match="choose a folder"):
        write_bytes(tmp_path / "nowhere" / "file", NEW)


def test_a_folder_is_not_replaced_by_a_file(tmp_path):
    folder = tmp_path / "folder"
    (folder / "inner").mkdir(parents=True)
    with pytest.raises(StorageError, match="cannot be written"):
        write_bytes(folder, NEW)
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]


@pytest.mark.skipif(os.name != "posix", reason="rights of this kind exist on POSIX only")
def test_the_file_has_the_usual_rights(tmp_path):
    mask = os.umask(0o027)
    try:
        write_bytes(tmp_path / "file", NEW)
        assert os.umask(0o027) == 0o027
    finally:
        os.umask(mask)
    assert stat.S_IMODE((tmp_path / "file").stat().st_mode) == 0o640


@pytest.mark.parametrize("name", ["ä ö ü.skinsource", "触覚 🖐.csv", "-rf", "a" * 200])
def test_names_of_all_kinds_will_do(tmp_path, name):
    write_bytes(tmp_path / name, NEW)
    assert (tmp_path / name).read_bytes() == NEW


def test_a_name_too_long_is_explained(tmp_path):
    with pytest.raises(StorageError, match="cannot be written"):
        write_bytes(tmp_path / ("a" * 300), NEW)
    assert not list(tmp_path.iterdir())


def test_folders_are_made_with_their_parents(tmp_path):
    make_folder(tmp_path / "one" / "two")
    make_folder(tmp_path / "one" / "two")
    assert (tmp_path / "one" / "two").is_dir()


def test_a_folder_that_cannot_be_made_is_explained(target):
    with pytest.raises(StorageError, match="cannot be written"):
        make_folder(target / "below a file")
