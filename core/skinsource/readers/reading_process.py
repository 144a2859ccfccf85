"""A child process that reads foreign files, so that no file can crash this process.

Where the system cannot limit the memory of the child, this process measures it.
"""

import ctypes
import json
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from queue import Empty, Queue
from threading import Lock, Thread
from time import monotonic
from typing import IO, Any

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.assets import PACKAGE
from skinsource.base.child_process import child_command, child_environment
from skinsource.base.errors import RecordingError, StorageError
from skinsource.base.files import path_text
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.readers import limits
from skinsource.readers.reader import Block, Found, from_tree

_ASK_S = 2.0
_QUERY = 0x1000  # PROCESS_QUERY_LIMITED_INFORMATION

#: The command of the child.
COMMAND = child_command("skinsource.limbs.reading_child")
# A child that does not answer for this long is taken to hang.
_SILENCE_S = 10.0
# Time to start Python and to import the readers on a busy machine.
_START_S = 60.0
_BETWEEN_LOOKS_S = 0.05
_LONGEST_ANSWER = 2**24
_ADVICE = "The file may be damaged; record or export it again."
#: An answer and its bytes; None at the end.
_Answers = Queue[tuple[dict[str, Any], bytes] | None]


def resident_bytes(pid: int) -> int | None:
    """Return the memory that a process uses; None if the system does not tell."""
    try:
        if sys.platform.startswith("linux"):
            return _linux_bytes(pid)
        return _windows_bytes(pid) if sys.platform == "win32" else of_ps(pid)
    except (OSError, ValueError, AttributeError, IndexError, subprocess.SubprocessError):
        return None


def of_ps(pid: int) -> int:
    """Return the memory that the command ``ps`` prints, on macOS and the BSDs."""
    completed = subprocess.run(  # noqa: S603  a number
        ["/bin/ps", "-o", "rss=", "-p", str(int(pid))],
        capture_output=True,
        timeout=_ASK_S,
        check=True,
    )
    return int(completed.stdout) * 1024


def _linux_bytes(pid: int) -> int:
    for line in Path(f"/proc/{pid}/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) * 1024
    raise ValueError("a process that has ended takes none")


def _windows_bytes(pid: int) -> int:
    kernel: Any = ctypes.WinDLL("kernel32")  # type: ignore[attr-defined,unused-ignore]
    handle = kernel.OpenProcess(_QUERY, False, pid)
    # cb, PageFaultCount, then sizes: PeakWorkingSetSize, WorkingSetSize, ...
    counters = (ctypes.c_size_t * 10)()
    ctypes.cast(counters, ctypes.POINTER(ctypes.c_uint32))[0] = ctypes.sizeof(counters)
    answered = kernel.K32GetProcessMemoryInfo(
        ctypes.c_void_p(handle), ctypes.byref(counters), ctypes.sizeof(counters)
    )
    kernel.CloseHandle(ctypes.c_void_p(handle))
    if not answered:
        raise OSError("no answer")
    return int(counters[2])


class ReadingProcess:
    """A child process that reads files; it is started when needed, and again after a crash.

    Parameters
    ----------
    silence_s
        The child is killed after it has not answered for this long.
    command
        The command of the child.
    folder
        A further folder of modules for the child.
    """

    def __init__(
        self,
        silence_s: float = _SILENCE_S,
        command: Sequence[str] = COMMAND,
        folder: Path = PACKAGE.parent,
    ) -> None:
        self._silence_s, self._command, self._folder = silence_s, tuple(command), folder
        self._process: subprocess.Popen[bytes] | None = None
        self._answers: _Answers = Queue()
        self._listener: Thread | None = None
        # Requests wait for each other.
        self._lock = Lock()

    def __enter__(self) -> "ReadingProcess":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Kill the process, if it runs; a request that it is answering fails."""
        self._end()

    def look(self, path: Path, *, stop: Stop = never) -> Found:
        """Return what a file holds.

        Raises
        ------
        RecordingError
            The file holds nothing usable, or reading it crashed or took too long.
        StorageError
            The file cannot be read.
        Stopped
            ``stop`` returned True.
        """
        with self._lock:
            self._ask(path, {"do": "look"}, stop)
            answer, _ = self._next(path, stop)
            try:
                return from_tree(answer["found"])
            except (KeyError, TypeError, ValueError) as error:
                raise self._lost(path, "what was read makes no sense") from error

    def read(
        self,
        path: Path,
        keys: Sequence[str],
        start: int,
        end: int,
        *,
        progress: Progress = silent,
        stop: Stop = never,
    ) -> Block:
        """Return samples ``start`` to ``end`` of some series, (n_series, n).

        Raises what `look` does.
        """
        n = end - start
        if n < 0 or n * len(keys) * 8 > limits.MOST_BYTES:
            raise RecordingError(
                f"{_name(path)}: {n} samples are too many, expected at most "
                f"{limits.MOST_BYTES // 8}. Take a shorter part."
            )
        with self._lock:
            request = {"do": "read", "keys": list(keys), "start": start, "stop": end}
            self._ask(path, request, stop)
            return self._gathered(path, len(keys), n, progress, stop)

    def overview(
        self, path: Path, key: str, n_samples: int, columns: int, *, stop: Stop = never
    ) -> Floats:
        """Return the smallest and largest value of each of ``columns`` stretches, (2, columns).

        Stretches without a number are NaN.  Raises what `look` does.
        """
        request = {"do": "overview", "key": key, "samples": n_samples, "columns": columns}
        with self._lock:
            self._ask(path, request, stop)
            extremes = np.empty((2, 0))
            while True:
                answer, content = self._next(path, stop)
                if "end" in answer:
                    return extremes
                if "block" in answer:
                    extremes = np.frombuffer(content, "<f8").reshape(2, -1)

    def ask(self, path: Path, request: dict[str, Any], *, stop: Stop = never) -> dict[str, Any]:
        """Return the only answer to a request of another kind; raises what `look` does."""
        with self._lock:
            self._ask(path, request, stop)
            return self._next(path, stop)[0]

    def stream(
        self, path: Path, request: dict[str, Any], *, stop: Stop = never
    ) -> Iterator[Floats]:
        """Give the blocks that answer a request one by one; raises what `look` does."""
        with self._lock:
            self._ask(path, request, stop)
            ended = False
            try:
                while not (ended := "end" in (answer := self._next(path, stop))[0]):
                    height, width, kind = answer[0]["block"]
                    flat = np.frombuffer(answer[1], {"f4": "<f4", "f8": "<f8"}[kind])
                    yield flat.reshape(height, width).astype(np.float64, copy=False)
            finally:
                if not ended:  # later answers do not belong to the next request
                    self._end()

    def _gathered(self, path: Path, rows: int, n: int, progress: Progress, stop: Stop) -> Block:
        samples: Block = np.empty((rows, 0), np.float32)
        done = 0
        while True:
            answer, content = self._next(path, stop)
            if "end" in answer:
                break
            try:
                height, width, kind = answer["block"]
                flat = np.frombuffer(content, {"f4": "<f4", "f8": "<f8"}[kind])
                part = flat.reshape(height, width)
                if not width:
                    continue
                if not samples.size:
                    samples = np.empty((rows, n), part.dtype)
                samples[:, done : done + width] = part
            except (KeyError, TypeError, ValueError) as error:
                raise self._lost(path, "what was read makes no sense") from error
            done += width
            progress(done, n, f"Reading {path.name}")
        if done != n:
            raise RecordingError(
                f"{_name(path)}: {done} samples were found, expected {n}. {_ADVICE}"
            )
        return samples

    def _ask(self, path: Path, request: dict[str, Any], stop: Stop) -> None:
        text = json.dumps({**request, "path": str(path.absolute())}).encode("ascii") + b"\n"
        if self._process is None or self._process.poll() is not None:
            self._end()
            self._start(path, stop)
        pipe = self._process.stdin if self._process else None
        try:
            if pipe is not None:
                pipe.write(text)
                pipe.flush()
        except OSError as error:
            raise self._lost(path, "reading it crashed") from error

    def _start(self, path: Path, stop: Stop) -> None:
        try:
            self._process = subprocess.Popen(  # noqa: S603  ourselves
                self._command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env=child_environment(os.pathsep.join({str(PACKAGE.parent), str(self._folder)})),
            )
        except OSError as error:
            raise StorageError(
                f"{_name(path)}: cannot be read: no other process can be started "
                f"({error.strerror or error}). Close other programs, then try again."
            ) from error
        self._answers = Queue(maxsize=8)
        self._listener = Thread(
            target=_listen, args=(self._process.stdout, self._answers), daemon=True
        )
        self._listener.start()
        self._next(path, stop, _START_S)

    def _next(
        self, path: Path, stop: Stop, silence_s: float | None = None
    ) -> tuple[dict[str, Any], bytes]:
        """Wait for the next answer; raise the error that it may be."""
        last_s = monotonic()
        while True:
            try:
                answer = self._answers.get(timeout=_BETWEEN_LOOKS_S)
                break
            except Empty:
                self._stop_if(stop)
                if monotonic() - last_s > (silence_s or self._silence_s):
                    raise self._lost(path, "reading it takes too long") from None
                if self._is_too_large():
                    raise self._lost(path, "reading it takes too much memory") from None
        self._stop_if(stop)
        if answer is None:
            raise self._lost(path, "reading it crashed")
        if "error" in answer[0]:
            kind = StorageError if answer[0].get("kind") == "storage" else RecordingError
            raise kind(str(answer[0]["error"]))
        return answer

    def _stop_if(self, stop: Stop) -> None:
        if stop():
            self._end()
            stop_if(stop)

    def _is_too_large(self) -> bool:
        # On Linux the child limits itself.
        if sys.platform.startswith("linux") or self._process is None:
            return False
        return (resident_bytes(self._process.pid) or 0) > limits.MEMORY_BYTES

    def _lost(self, path: Path, reason: str) -> RecordingError:
        self._end()
        return RecordingError(
            f"{_name(path)}: {reason}, so it was given up; expected a file that can be read "
            f"in {self._silence_s:g} s. {_ADVICE}"
        )

    def _end(self) -> None:
        process, self._process = self._process, None
        if process is None:
            return
        process.kill()
        process.wait()
        # The listener may wait for room in the queue.
        while self._listener is not None and self._listener.is_alive():
            with suppress(Empty):
                self._answers.get(timeout=_BETWEEN_LOOKS_S)
        for pipe in (process.stdin, process.stdout):
            if pipe is not None:
                with suppress(OSError):
                    pipe.close()


def _listen(pipe: IO[bytes], answers: _Answers) -> None:
    """Put the answers of the child into the queue, until it ends or sends nonsense."""
    with suppress(OSError, ValueError, TypeError, KeyError):
        while line := pipe.readline(_LONGEST_ANSWER):
            answer = json.loads(line)
            size = 0
            if "block" in answer:
                rows, width, kind = answer["block"]
                size = int(rows) * int(width) * (4 if kind == "f4" else 8)
                if not 0 <= size <= limits.MOST_BYTES:
                    break
            content = pipe.read(size) if size else b""
            if len(content) < size:
                break
            answers.put((answer, content))
    answers.put(None)


def _name(path: Path) -> str:
    return path_text(Path(path.name))
