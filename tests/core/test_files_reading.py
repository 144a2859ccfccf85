"""Reading ends, whatever the path leads to."""

import errno
import os
import threading
import time
from pathlib import Path

import psutil
import pytest

from skinsource.base.errors import FileFormatError, StorageError
from skinsource.base.files import make_folder, path_exists, read_bytes, temporary_path, write_bytes

ADVICE = {
    errno.ENOSPC: "Free some space",
    errno.EDQUOT: "Free some space",
    errno.EACCES: "Choose a folder you may write to",
    errno.EROFS: "Choose a folder you may write to",
    errno.ENOENT: "Choose a folder that exists",
    errno.ENAMETOOLONG: "Choose a shorter name",
    errno.EIO: "Check the disk",
}
posix = pytest.mark.skipif(os.name != "posix", reason="POSIX only")


def test_a_file_is_read_whole_up_to_the_limit(tmp_path):
    (tmp_path / "file").write_bytes(b"12345")
    assert read_bytes(tmp_path / "file", most=5) == b"12345"
    with pytest.raises(FileFormatError, match="file: 5 bytes are too large for it, expected at"):
        read_bytes(tmp_path / "file", most=4)


@posix
def test_a_folder_that_is_read_as_a_file_leaves_nothing_open(tmp_path):
    process = psutil.Process()
    before = process.num_fds()
    for _ in range(8):
        with pytest.raises(StorageError):
            read_bytes(tmp_path, most=100)
    assert process.num_fds() == before


@posix
def test_a_pipe_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    outcome = []

    def read():
        with pytest.raises(StorageError, match="it is not a regular file"):
            read_bytes(tmp_path / "pipe", most=100)
        outcome.append("refused")

    reader = threading.Thread(target=read, daemon=True)
    reader.start()
    reader.join(30)
    assert outcome == ["refused"]


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("nowhere", "It was moved or deleted"),
        (".", "Check that it is a file|permission to read"),
        ("a\0b", "cannot be read"),
        ("x" * 300, "cannot be read"),
        ("file/below", "cannot be read"),
    ],
)
def test_what_cannot_be_read_is_explained_in_one_printable_sentence(tmp_path, name, message):
    (tmp_path / "file").write_bytes(b"")
    with pytest.raises(StorageError, match=message) as caught:
        read_bytes(tmp_path / name, most=100)
    assert str(caught.value).isprintable()
    assert not path_exists(tmp_path / name) or name == "."


@pytest.mark.parametrize("code", ADVICE)
def test_what_to_do_depends_on_what_was_refused(tmp_path, monkeypatch, code):
    def failing(*_, **__):
        raise OSError(code, os.strerror(code))

    monkeypatch.setattr(os, "fsync", failing)
    with pytest.raises(StorageError, match=ADVICE[code]):
        write_bytes(tmp_path / "file", b"")


@pytest.mark.parametrize("name", ["a\0b", "x" * 300])
def test_names_that_no_file_can_have_are_explained(tmp_path, name):
    with pytest.raises(StorageError, match="cannot be written"):
        write_bytes(tmp_path / name, b"")
    with pytest.raises(StorageError, match="cannot be written"):
        make_folder(tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_commands_for_a_terminal_in_a_name_are_written_out(tmp_path):
    with pytest.raises(StorageError) as caught:
        write_bytes(tmp_path / "a\x1b[2J  b\n" / "file", b"")
    assert "a\\x1b[2J  b\\n" in str(caught.value)


def old(path: Path, days: float) -> Path:
    path.write_bytes(b"left behind")
    os.utime(path, times=(time.time() - days * 86_400,) * 2)
    return path


def left(path: Path, pid: int | str, computer: str = "") -> Path:
    """The name of what a process was writing to take the place of ``path``."""
    own = temporary_path(path).name.removeprefix(f".{path.name}.")
    number = pid if isinstance(pid, str) else f"{pid:08x}"
    return path.with_name(f".{path.name}.{computer or own[:4]}{number}{own[12:]}")


ENDED = 2**31  # no system has such a number


def test_what_ended_writers_left_is_deleted_at_the_next_writing(tmp_path):
    stale = [old(left(tmp_path / name, ENDED), 0.0) for name in ("x.csv", "ä ö", ".y")]
    # It had the number of a process that was started later.
    stale.append(old(left(tmp_path / "x.csv", os.getppid()), 0.9))
    os.utime(stale[-1], times=(psutil.Process(os.getppid()).create_time() - 60.0,) * 2)
    stale += [old(left(tmp_path / "x.csv", number), 1.1) for number in (os.getpid(), os.getppid())]
    stale.append(old(left(tmp_path / "x.csv", ENDED, "0123"), 1.1))
    unchanged = [
        old(left(tmp_path / "x.csv", os.getpid()), 0.9),
        old(left(tmp_path / "x.csv", os.getppid()), 0.0),
        old(left(tmp_path / "x.csv", ENDED, "0123"), 0.9),
        old(left(tmp_path / "x.csv", "0000123g"), 9),
        old(tmp_path / "x.csv.0123abcd.part", 9),
        old(tmp_path / ".x.csv.part", 9),
        old(tmp_path / "x.csv", 9),
    ]
    folder = left(tmp_path / "folder", ENDED)
    folder.mkdir()
    (folder / "inside").write_bytes(b"")
    write_bytes(tmp_path / "new", b"")
    assert not any(path.exists() for path in (*stale, folder))
    assert all(path.exists() for path in unchanged)


@posix
def test_a_link_that_looks_like_a_leftover_leads_nowhere(tmp_path):
    aim, link = old(tmp_path / "precious", 9), left(tmp_path / "x", ENDED)
    link.symlink_to(aim)
    os.utime(link, times=(0, 0), follow_symlinks=False)
    write_bytes(tmp_path / "new", b"")
    assert aim.exists()
    assert link.is_symlink()
