"""Copies rotate, and go when the work is saved."""

import sys

import pytest

from skinsource.base.lock import Lock
from skinsource.design.design_file import open_design
from skinsource.design.recovery import MOST_COPIES, Session, mark_opening


def amplitudes(session):
    copies = sorted(session.folder.glob("*.skinsource"), key=lambda path: path.stat().st_mtime_ns)
    return [open_design(path).design.inputs[0].amplitude for path in copies]


def test_the_last_five_copies_are_kept_with_their_pictures(tmp_path, work):
    session = Session(tmp_path)
    for number in range(1, 9):
        path = session.keep(work(number), tmp_path / "tap.skinsource", b"%d" % number)
        assert open_design(path) == work(number)
        assert path.with_suffix(".png").read_bytes() == b"%d" % number
    assert amplitudes(session) == [4.0, 5.0, 6.0, 7.0, 8.0]
    assert len(list(session.folder.glob("*.png"))) == MOST_COPIES


def test_what_is_kept_already_is_not_written_again(tmp_path, work):
    session = Session(tmp_path)
    first = session.keep(work(1))
    first.write_bytes(b"looked at")
    assert session.keep(work(1)) == first
    assert first.read_bytes() == b"looked at"
    other = session.keep(work(2), tmp_path / f"{'a' * 240}.skinsource")
    assert other.name == f"{'a' * 60}.2.skinsource"


def test_saved_work_leaves_no_copy_and_later_work_is_kept_again(tmp_path, work):
    session = Session(tmp_path)
    session.keep(work(1))
    session.forget()
    assert list((tmp_path / "unsaved").iterdir()) == []
    session.keep(work(1))
    assert amplitudes(session) == [1.0]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has other rights")
def test_nobody_else_may_read_copies_and_locks(tmp_path, work):
    session = Session(tmp_path)
    copy = session.keep(work(1), tmp_path / "tap.skinsource", b"picture")
    mark_opening(copy)
    lock = Lock(tmp_path / "tap.skinsource")
    lock.take()
    files = [lock.path, *(path for path in tmp_path.rglob("*") if path.is_file())]
    assert len(files) >= 6
    assert {path.stat().st_mode & 0o777 for path in files} == {0o600}
