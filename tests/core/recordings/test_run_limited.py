"""The process that reads: it may crash, hang or fill the memory, and nothing else happens."""

import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from skinsource.base.errors import RecordingError, Stopped, StorageError
from skinsource.base.run_limited import LimitedProcess, run_limited
from skinsource.readers.reading_process import ReadingProcess

FILE = Path("some") / "tap.wav"


def run(name, process, **options):
    function = f"tests.core.recordings.misbehaving:{name}"
    return run_limited(function, FILE, expected="a sound", process=process, **options)


@pytest.fixture(scope="module")
def limited():
    with LimitedProcess(silence_s=1.0) as process:
        yield process


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("crash", "reading it crashed"),
        ("end", "reading it crashed"),
        ("hang", "takes too long"),
        ("give_without_end", "more than 1000000 bytes"),
        ("answer_with_nonsense", "crashed"),
    ],
)
def test_a_process_that_misbehaves_is_ended_with_one_sentence_and_the_next_file_is_read(
    name, message, limited
):
    with pytest.raises(RecordingError, match=f"^tap.wav: .*{message}.*expected") as error:
        list(run(name, limited, most_bytes=1_000_000))
    assert "some" not in str(error.value)
    assert limited.pid is None
    assert list(run("print_much", limited, times=3)) == [["tap.wav", 3]]


def test_a_process_that_fills_the_memory_is_ended():
    with (
        LimitedProcess(memory_bytes=200 * 2**20) as process,
        pytest.raises(RecordingError, match=r"too much memory.*expected"),
    ):
        list(run("fill_the_memory", process))


def test_errors_of_readers_come_back_as_they_are_and_others_as_one_sentence(limited):
    list(run("give_arrays", limited))
    pid = limited.pid
    with pytest.raises(StorageError, match=r"^tap.wav: is away, expected it here\.$"):
        list(run("fail_clearly", limited))
    with pytest.raises(
        RecordingError, match=r"^tap.wav: cannot be read \(no such thing\), expected a sound\."
    ):
        list(run("fail", limited))
    assert limited.pid == pid


def test_arrays_and_trees_arrive_as_they_were_given(limited):
    first, tree, strided, empty, whole = run("give_arrays", limited)
    assert first.tolist() == [[0, 1, 2], [3, 4, 5]]
    assert first.dtype == np.float32
    assert tree == {"a": [1.5, None]}
    assert strided.tolist() == [0, 2, 4]
    assert empty.shape == (2, 0)
    assert whole.tolist() == [2**32 - 1]


def test_a_process_that_cannot_be_started_is_an_error_of_the_system(monkeypatch):
    monkeypatch.setattr(sys, "executable", "/nowhere/python")
    with pytest.raises(StorageError, match="no other process"):
        list(run("hang", None))


def test_a_stop_ends_the_process_at_once():
    asked = threading.Event()

    def stop():
        asked.set()
        return True

    with LimitedProcess() as process:
        with pytest.raises(Stopped):
            list(run("hang", process, stop=stop))
        assert asked.is_set()
        assert process.pid is None


def test_closing_in_another_thread_ends_what_waits():
    with ThreadPoolExecutor(1) as pool:
        waiting = pool.submit(list, run("hang", process := LimitedProcess(silence_s=60.0)))
        while process.pid is None:
            assert not waiting.done()
        process.close()
        with pytest.raises(RecordingError, match="its reader was closed"):
            waiting.result()


def test_the_folder_in_which_one_stands_gives_no_code(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "numpy.py").write_text("raise SystemExit('sprung')")
    np.save(tmp_path / "x.npy", np.arange(9.0))
    with ReadingProcess() as process:
        assert process.look(tmp_path / "x.npy").format == "NPY"
