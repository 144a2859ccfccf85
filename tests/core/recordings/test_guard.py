"""The process that reads: it may crash, hang or lie, and nothing else happens."""

import os
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from skinsource.base.errors import RecordingError, Stopped, StorageError
from skinsource.readers import limits, reading_process
from skinsource.readers.reading_process import ReadingProcess
from tests.core.recordings.conftest import talker

FILE = Path("some") / "tap.wav"
ANSWER = "import sys; sys.stdin.readline(); "

MISBEHAVING = {
    "crash": (ANSWER + "import os; os.abort()", "crashed"),
    "exit": (ANSWER + "sys.exit(0)", "crashed"),
    "hang": (ANSWER + "import time; time.sleep(60)", "too long"),
    "nonsense": (ANSWER + "print('not json'); sys.stdout.flush(); sys.stdin.read()", "crashed"),
    "lie": (ANSWER + "print('{\"found\": 3}', flush=True); sys.stdin.read()", "no sense"),
    "cut off": (ANSWER + 'print(\'{"block": [1, 9, "f8"]}\', flush=True)', "crashed"),
    "bomb": (
        ANSWER + 'print(\'{"block": [1, 99999999999, "f8"]}\', flush=True); sys.stdin.read()',
        "crashed",
    ),
}


@pytest.mark.parametrize("name", MISBEHAVING)
def test_a_process_that_misbehaves_is_ended_with_one_sentence(name):
    script, message = MISBEHAVING[name]
    with ReadingProcess(silence_s=0.5, command=talker(script)) as process:
        with pytest.raises(RecordingError, match=f"tap.wav: .*{message}.*expected") as error:
            process.look(FILE)
        assert "some" not in str(error.value)


@pytest.mark.parametrize("shape", ["[1, 4]", "[2, 9]", "[1, 11]"])
def test_blocks_of_another_shape_than_was_asked_for_are_not_taken(shape):
    rows, width = (int(part) for part in shape.strip("[]").split(","))
    script = ANSWER + (
        f'sys.stdout.buffer.write(b\'{{"block": [{rows}, {width}, "f8"]}}\\n\' '
        f"+ bytes({rows * width * 8}) + b'{{\"end\": true}}\\n'); sys.stdout.flush(); "
        "sys.stdin.read()"
    )
    with (
        ReadingProcess(silence_s=5.0, command=talker(script)) as process,
        pytest.raises(RecordingError, match=r"no sense|samples were found, expected 10"),
    ):
        process.read(FILE, ["0"], 0, 10)


def test_the_next_file_is_read_by_a_new_process(files):
    with ReadingProcess() as process:
        first = process.look(files["WAV"])
        process._process.kill()
        process._process.wait()
        assert process.look(files["WAV"]) == first


def test_a_process_that_cannot_be_started_is_an_error_of_the_system():
    with (
        ReadingProcess(command=["/nowhere/python"]) as process,
        pytest.raises(StorageError, match="no other process"),
    ):
        process.look(FILE)


def test_a_stop_ends_the_process_at_once():
    script = ANSWER + "import time; time.sleep(60)"
    asked = threading.Event()

    def stop():
        asked.set()
        return True

    with ReadingProcess(command=talker(script)) as process:
        with pytest.raises(Stopped):
            process.look(FILE, stop=stop)
        assert asked.is_set()
        assert process._process is None


def test_closing_ends_the_process(files):
    process = ReadingProcess()
    process.look(files["NPY"])
    own = process._process
    process.close()
    assert own.poll() is not None
    process.close()


def test_one_process_reads_all(files):
    with ReadingProcess() as process:
        process.look(files["WAV"])
        pid = process._process.pid
        for path in files.values():
            process.look(path)
        with pytest.raises(RecordingError):
            process.look(Path(__file__))
        assert process._process.pid == pid


def test_more_than_half_a_gigabyte_is_not_asked_for():
    with (
        ReadingProcess(command=["/nowhere"]) as process,
        pytest.raises(RecordingError, match="too many"),
    ):
        process.read(FILE, ["0"], 0, 2**27)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only Linux limits all of it")
def test_the_process_limits_its_own_memory(tmp_path, process):
    process.look(_array_file(tmp_path))
    text = Path(f"/proc/{process._process.pid}/limits").read_text()
    (line,) = [line for line in text.splitlines() if line.startswith("Max address space")]
    assert line.split()[3] == str(limits.MEMORY_BYTES)


def test_what_takes_too_much_memory_is_ended_where_the_system_does_not_limit(tmp_path, monkeypatch):
    monkeypatch.setattr(ReadingProcess, "_is_too_large", lambda self: self._process is not None)
    script = ANSWER + "import time; time.sleep(60)"
    with (
        ReadingProcess(command=talker(script)) as process,
        pytest.raises(RecordingError, match="memory"),
    ):
        process.look(FILE)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no ps")
def test_the_memory_of_a_process_is_known():
    own = reading_process.resident_bytes(os.getpid())
    assert own > 10 * 2**20
    if Path("/bin/ps").exists():
        assert reading_process.of_ps(os.getpid()) == pytest.approx(own, rel=0.2)
    assert reading_process.resident_bytes(2**22 + 5) is None


def test_libraries_that_print_do_not_disturb_the_answers(tmp_path):
    script = (
        "import os, sys\n"
        "from skinsource.limbs import reading_child as child\n"
        "from skinsource.readers import readers\n"
        "plain = readers.look\n"
        "def loud(path):\n"
        "    os.write(1, b'hello from a library\\n'); print('and another'); return plain(path)\n"
        "readers.look = loud\n"
        "child.main()\n"
    )
    with ReadingProcess(command=(sys.executable, "-c", script)) as process:
        assert process.look(_array_file(tmp_path)).format == "NPY"


def test_the_folder_in_which_one_stands_gives_no_code(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "numpy.py").write_text("raise SystemExit('sprung')")
    with ReadingProcess() as process:
        assert process.look(_array_file(tmp_path)).format == "NPY"


def _array_file(folder):
    np.save(folder / "x.npy", np.arange(9.0))
    return folder / "x.npy"
