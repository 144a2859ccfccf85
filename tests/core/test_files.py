import errno
import os
import stat
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from skinsource.base.errors import StorageError
from skinsource.base.files import replacing, write_bytes

OLD, NEW = b"what stood there", b"what is to stand there" * 1000
posix_rights = pytest.mark.skipif(
    os.name != "posix", reason="rights of this kind exist on POSIX only"
)
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


@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize(
    ("place", "name", "call"),
    [
        (os, "open", 1),
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


@pytest.fixture
def mask_027():
    before = os.umask(0o027)
    yield
    os.umask(before)


def mode_of(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


@posix_rights
@pytest.mark.usefixtures("mask_027")
def test_a_new_file_has_the_usual_rights(tmp_path, monkeypatch):
    def refuse(_mask):
        raise AssertionError("the mask belongs to the whole process")

    with monkeypatch.context() as patched:
        patched.setattr(os, "umask", refuse)
        write_bytes(tmp_path / "file", NEW)
    assert mode_of(tmp_path / "file") == 0o640


@posix_rights
@pytest.mark.usefixtures("mask_027")
@pytest.mark.parametrize("mode", [0o600, 0o644, 0o666, 0o755, 0o444])
def test_a_file_that_is_replaced_hands_down_its_rights(target, mode):
    target.chmod(mode)
    write_bytes(target, NEW)
    assert target.read_bytes() == NEW
    assert mode_of(target) == mode


@posix_rights
@pytest.mark.parametrize("mode", [0o600, 0o444])
def test_until_the_end_nobody_else_can_read_what_replaces_a_file(target, mode):
    target.chmod(mode)
    with replacing(target) as temporary:
        assert mode_of(temporary) == 0o600
        temporary.write_bytes(NEW)


def test_a_link_stays_and_what_it_leads_to_is_replaced(target):
    place = target.parent / "links" / "link.skinsource"
    place.parent.mkdir()
    try:
        place.symlink_to(Path("..") / target.name)
    except OSError as error:
        pytest.skip(f"links cannot be made here: {error}")
    second = place.with_name("link to the link")
    second.symlink_to(place)
    with replacing(second) as temporary:
        assert temporary.parent.samefile(target.parent)
        temporary.write_bytes(NEW)
        assert target.read_bytes() == OLD
    assert target.read_bytes() == NEW
    assert place.is_symlink()
    assert second.is_symlink()
    assert {path.name for path in place.parent.iterdir()} == {place.name, second.name}
    assert {path.name for path in target.parent.iterdir()} == {target.name, "links"}


def test_two_threads_may_write_the_same_file_at_once(target):
    contents = [bytes([k]) * 100_000 for k in range(8)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda content: write_bytes(target, content), contents))
    assert target.read_bytes() in contents
    assert list(target.parent.iterdir()) == [target]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names here")
def test_what_is_no_file_is_not_replaced_by_one(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(StorageError, match="it is a device or a pipe"):
        write_bytes(pipe, b"1")
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert [entry.name for entry in tmp_path.iterdir()] == ["pipe"]
