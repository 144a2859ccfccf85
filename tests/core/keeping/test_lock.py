"""One file, several studios."""

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import pytest

from skinsource.base.errors import StorageError
from skinsource.base.lock import Lock, read_owner, still_runs, this_process, to_bytes

OTHER_STUDIO = """
import sys
from pathlib import Path
from skinsource.base.lock import Lock
print(Lock(Path(sys.argv[1])).take(), flush=True)
sys.stdin.readline()
"""


@pytest.fixture
def lock(tmp_path):
    return Lock(tmp_path / "tap.skinsource")


def test_a_free_file_is_ours_as_often_as_we_take_it_and_free_again_after(lock):
    assert lock.take() is None
    assert lock.take() is None
    assert read_owner(lock.path) == this_process()
    lock.release()
    assert not lock.path.exists()
    assert os.listdir(lock.path.parent) == []


def test_a_file_that_another_studio_has_is_told_until_that_ends(lock):
    command = [sys.executable, "-c", OTHER_STUDIO, str(lock.file)]
    other = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert other.stdout.readline() == "None\n"
    assert lock.take().pid == other.pid
    lock.release()  # not ours
    assert lock.path.exists()
    other.kill()
    other.communicate()
    assert lock.take() is None


def test_a_number_of_a_process_that_is_used_again_is_another_process(lock, ended):
    lock.path.write_bytes(to_bytes(ended))
    assert still_runs(ended) is False
    assert still_runs(this_process()) is True
    assert lock.take() is None


def test_a_process_elsewhere_cannot_be_asked_and_keeps_its_file(lock, elsewhere):
    lock.path.write_bytes(to_bytes(elsewhere))
    assert lock.take() == elsewhere
    assert "ana on lab-3, since" in elsewhere.description
    assert lock.take(from_other=True) is None
    assert read_owner(lock.path) == this_process()


def test_a_file_is_held_for_a_moment_and_not_while_another_process_has_it(lock, elsewhere):
    with lock.hold():
        assert read_owner(lock.path) == this_process()
    assert not lock.path.exists()
    lock.path.write_bytes(to_bytes(elsewhere))
    with pytest.raises(StorageError, match=r"tap\.skinsource: .*ana on lab-3"), lock.hold(0.0):
        pass
    assert read_owner(lock.path) == elsewhere


@pytest.mark.parametrize(
    "text",
    [b"", b"{}", b"[1]", b"\xff", json.dumps({"host": "a", "user": "b", "pid": -1}).encode()],
)
def test_a_lock_that_names_nobody_holds_only_while_it_may_be_being_written(lock, text):
    lock.path.write_bytes(text)
    assert "an unknown computer" in lock.take().description
    os.utime(lock.path, (1000.0, 1000.0))
    assert lock.take() is None


def test_a_link_and_what_it_leads_to_are_one_file(lock):
    lock.file.write_bytes(b"")
    other = lock.file.with_name("link.skinsource")
    other.symlink_to(lock.file)
    assert Lock(other).path == lock.path


def test_of_two_that_find_the_same_stale_lock_one_gets_the_file(lock, ended, elsewhere):
    lock.path.write_bytes(to_bytes(elsewhere))
    lock._remove(ended)  # it judged the lock of one that has ended, and another was quicker
    assert read_owner(lock.path) == elsewhere
    lock._remove(elsewhere)
    assert os.listdir(lock.path.parent) == []
    with ThreadPoolExecutor(8) as pool:
        assert set(pool.map(lambda _: lock.take(), range(32))) == {None}
