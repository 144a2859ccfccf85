"""What ended studios left is found, without opening any of it, and what a studio keeps."""

import os
import sys
import time
from dataclasses import replace

import pytest

from skinsource.base.files import temporary_path
from skinsource.base.lock import Lock, to_bytes
from skinsource.design import recovery
from skinsource.design.design_file import open_design
from skinsource.design.recovery import MOST_COPIES, OWNER, Session, mark_opening


def test_the_newest_copy_comes_first_with_its_picture_name_and_file(
    tmp_path, left_by_a_killed_studio
):
    file = tmp_path / "tap.skinsource"
    left_by_a_killed_studio(3, file)
    (left_over,) = recovery.find(tmp_path).left
    numbers = [open_design(copy).design.inputs[0].amplitude for copy in left_over.copies]
    assert numbers == [3.0, 2.0, 1.0]
    assert left_over.picture() == b"picture 3"
    assert (left_over.name, left_over.file) == ("tap", file)
    assert left_over.clock() == time.strftime("%T", time.localtime(left_over.saved_s))
    older = replace(left_over, saved_s=left_over.saved_s - 200_000.0)
    assert older.clock().endswith(f" {time.strftime('%T', time.localtime(older.saved_s))}")


def test_work_of_a_studio_that_runs_or_is_elsewhere_is_not_offered(
    tmp_path, work, left_by_a_killed_studio, elsewhere
):
    assert recovery.find(tmp_path / "none") == recovery.Found()
    session = Session(tmp_path)
    session.keep(work(1))
    (left_by_a_killed_studio() / OWNER).write_bytes(to_bytes(elsewhere))
    assert recovery.find(tmp_path).left == ()
    assert len(list(session.folder.iterdir())) == 3


def test_several_are_found_the_newest_first(tmp_path, left_by_a_killed_studio):
    for k in range(3):
        folder = left_by_a_killed_studio(1, tmp_path / f"{'abc'[k]}.skinsource")
        (copy,) = folder.glob("*.skinsource")
        os.utime(copy, (1000.0 * k, 1000.0 * k))
    (folder / "file").unlink()  # a file that cannot be told is none
    left = recovery.find(tmp_path).left
    assert [left_over.name for left_over in left] == ["c", "b", "a"]
    assert [left_over.file is None for left_over in left] == [True, False, False]


def test_a_copy_whose_opening_never_ended_is_set_aside_and_the_one_before_is_offered(
    tmp_path, left_by_a_killed_studio, ended
):
    left_by_a_killed_studio(2)
    newest, before = recovery.find(tmp_path).left[0].copies
    content = newest.read_bytes()
    recovery.mark_opening(newest)
    mark = newest.with_name(f"{newest.name}.opening")
    assert recovery.find(tmp_path).left[0].copies == (before,)  # it is being opened now
    assert newest.exists()
    mark.write_bytes(to_bytes(ended))
    recovered = recovery.find(tmp_path)
    assert [left_over.copies for left_over in recovered.left] == [(before,)]
    assert [path.read_bytes() for path in recovered.set_aside] == [content]
    assert not mark.exists()
    assert recovery.find(tmp_path).set_aside == ()
    # A mark that is damaged counts as one.
    before.with_name(f"{before.name}.opening").write_bytes(b"")
    recovered = recovery.find(tmp_path)
    assert (recovered.left, len(recovered.set_aside)) == ((), 1)


def test_what_was_opened_well_is_offered_as_before(tmp_path, left_by_a_killed_studio):
    left_by_a_killed_studio(1)
    before = recovery.find(tmp_path)
    recovery.mark_opening(before.left[0].copies[0])
    recovery.mark_opened(before.left[0].copies[0])
    assert recovery.find(tmp_path) == before


def test_copies_of_one_name_are_set_aside_beside_each_other(tmp_path, left_by_a_killed_studio):
    moved = []
    for _ in range(3):
        left_by_a_killed_studio(1)
        moved.append(recovery.set_aside(recovery.find(tmp_path).left[0].copies[0]))
    assert len({path.name for path in moved}) == 3
    assert all(path.is_file() for path in moved)


def half_written(path):
    """What a process that has ended was writing."""
    partial = temporary_path(path)
    name = partial.name.replace(f"{os.getpid():08x}", "80000000")
    partial.with_name(name).write_bytes(b"half")


def test_what_killed_writers_left_anywhere_is_cleared_away(tmp_path, left_by_a_killed_studio):
    folder = left_by_a_killed_studio(1)
    half_written(folder / "tap.2.skinsource")
    half_written(tmp_path / "settings.json")
    empty = folder.with_name("20260101-000000-999999999-abcdef")
    empty.mkdir()
    half_written(empty / "owner")
    begun = folder.with_name(f"20260101-000000-{os.getpid()}-abcdef")
    begun.mkdir()
    recovery.find(tmp_path)
    assert list(tmp_path.rglob("*.part")) == []
    assert not empty.exists()
    assert begun.exists()  # its studio runs, and is about to write


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
