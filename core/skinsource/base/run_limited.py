"""Functions that read foreign files run in a process of their own, under limits.

A parser that crashes, hangs or fills the memory ends that process, and nothing else.  It is
``python -P -m skinsource.base.run_limited``, so that it runs neither the script of the user again
nor modules of the current folder.

A request is a line of JSON: the name of a function, "module:function", a path and other arguments.
Each answer is a line of JSON too, ``{"array": ["<f8", rows, ...]}`` is followed by the bytes of the
array; the last one is ``{"end": true}`` or ``{"error": sentence, "kind": name of its class}``.
"""

import importlib
import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import nullcontext, suppress
from math import prod
from pathlib import Path
from queue import Empty, Queue
from threading import Thread
from time import monotonic
from typing import IO, Any, Self

import numpy as np
import psutil

from skinsource.base import errors
from skinsource.base.errors import RecordingError, SkinSourceError, Stopped, StorageError, printable
from skinsource.base.files import path_text
from skinsource.base.job import Stop, never

#: Most memory of the process, and most bytes of all results of a function.
MEMORY_BYTES, RESULT_BYTES = 2**30, 2**30
# A process that does not answer for this long is taken to hang.
_SILENCE_S = 10.0
# Time to start Python and to import the function on a busy machine.
_START_S = 60.0
# The process ends itself then, if the one that would have ended it is gone.
_LONGEST_STEP_S = 120
_BETWEEN_LOOKS_S = 0.05
_LONGEST_ANSWER = 2**24
_ARRAYS = ("<f4", "<f8", "<u4")
_ADVICE = "The file may be damaged; record or export it again."
_ERRORS = {kind.__name__: kind for kind in vars(errors).values() if isinstance(kind, type)}


def run_limited(
    function: str,
    path: Path,
    *,
    expected: str,
    process: "LimitedProcess | None" = None,
    most_bytes: int = RESULT_BYTES,
    stop: Stop = never,
    **arguments: object,
) -> Iterator[Any]:
    """Run a function on a foreign file in a process of its own, and give its results.

    Parameters
    ----------
    function
        Its module and name, ``"skinsource.readers.readers:blocks"``.  It takes a path, and other
        arguments that JSON can hold by name; it returns what JSON can hold, or an array of
        float32, float64 or uint32, or is a generator of these.
    path
        The file.
    expected
        What the file should be, for the message where the function fails.
    process
        Runs the function, and stays for the next one; without it a new one.
    most_bytes
        Of all arrays together.
    stop
        Asked whether to give up.

    Yields
    ------
    Each result of a generator, or the only result.

    Raises
    ------
    SkinSourceError
        That of the function.
    RecordingError
        The function failed in another way, crashed, took too long or too much memory.
    StorageError
        No process can be started.
    Stopped
        ``stop`` returned True; the process has ended.

    Examples
    --------
    >>> from skinsource.base.run_limited import run_limited
    >>> list(run_limited("skinsource.base.files:is_file", Path("none"), expected="a file"))
    [False]
    """
    name = path_text(Path(path.name))
    request = {"function": function, "path": str(path.absolute()), "arguments": arguments}
    with nullcontext(process) if process is not None else LimitedProcess() as child:
        try:
            child.send(request, stop)
            n_bytes = 0
            while "end" not in (answer := child.receive(stop)):
                if "error" in answer:
                    raise _error_of(answer, name, expected)
                result = answer["result"]
                if isinstance(result, np.ndarray):
                    n_bytes += result.nbytes
                if n_bytes > most_bytes:
                    child.close()
                    raise _LostError(f"it gives more than {most_bytes} bytes")
                yield result
        except _LostError as error:
            raise RecordingError(
                f"{name}: {error}, so reading stopped; expected a file that can be read in "
                f"{child.silence_s:g} s. {_ADVICE}"
            ) from error
        except OSError as error:
            raise StorageError(
                f"{name}: cannot be read: no other process can be started "
                f"({error.strerror or error}). Close other programs, then try again."
            ) from error


def _error_of(answer: dict[str, Any], name: str, expected: str) -> SkinSourceError:
    """Return the error of the function, or one that says in which way else it failed."""
    kind = _ERRORS.get(str(answer.get("kind")))
    if kind is not None and issubclass(kind, SkinSourceError):
        return kind(str(answer["error"]))
    return RecordingError(
        f"{name}: cannot be read ({str(answer['error']).rstrip('.')}), expected {expected}. It "
        "may be damaged; record or export it again."
    )


class _LostError(Exception):
    """The process ended before it had answered, or was ended."""


class LimitedProcess:
    """A process for `run_limited`; it is started when needed, and again after a crash.

    Parameters
    ----------
    silence_s
        It is killed after it has not answered for this long.
    memory_bytes
        It is killed when it uses more memory.
    """

    def __init__(self, silence_s: float = _SILENCE_S, memory_bytes: int = MEMORY_BYTES) -> None:
        self.silence_s, self.memory_bytes = silence_s, memory_bytes
        self._process: subprocess.Popen[bytes] | None = None
        self._answers: Queue[dict[str, Any] | None] = Queue()
        self._listener: Thread | None = None
        self._busy = False

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def pid(self) -> int | None:
        """Number of the process; None where it does not run."""
        process = self._process
        return None if process is None or process.poll() is not None else process.pid

    def close(self) -> None:
        """Kill the process, if it runs; the function that it runs fails."""
        process, self._process = self._process, None
        self._busy = False
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

    def send(self, request: Mapping[str, object], stop: Stop) -> None:
        """Have a request begun; start the process, or a new one if earlier results remain."""
        if self._busy or self.pid is None:
            self.close()
            self._start()
        self._busy = True
        pipe = self._process.stdin if self._process else None
        try:
            if pipe is not None:
                pipe.write(json.dumps(request).encode("ascii") + b"\n")
                pipe.flush()
        except OSError as error:
            self.close()
            raise _LostError("reading it crashed") from error
        self.receive(stop, _START_S)

    def receive(self, stop: Stop, silence_s: float | None = None) -> dict[str, Any]:
        """Wait for the next answer."""
        until_s = monotonic() + (silence_s or self.silence_s)
        reason, answer = "", None
        while not reason:
            if stop():
                self.close()
                raise Stopped("Stopped.")
            try:
                answer = self._answers.get(timeout=_BETWEEN_LOOKS_S)
            except Empty:
                if monotonic() > until_s:
                    reason = "reading it takes too long"
                elif (resident_bytes(self.pid) or 0) > self.memory_bytes:
                    reason = "reading it takes too much memory"
            else:
                if answer is not None:
                    self._busy = not ("end" in answer or "error" in answer)
                    return answer
                reason = "reading it crashed"
            if self._process is None:
                reason = "its reader was closed"  # by another thread
        self.close()
        raise _LostError(reason)

    def _start(self) -> None:
        self._process = subprocess.Popen(  # noqa: S603  ourselves
            (sys.executable, "-P", "-m", __name__),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={
                **os.environ,
                # All that this process can import, except what lies in the current folder.
                "PYTHONPATH": os.pathsep.join(folder for folder in sys.path if folder),
                "OPENBLAS_NUM_THREADS": "1",
                # HDF5 loads no plug-ins.
                "HDF5_PLUGIN_PRELOAD": "::",
            },
        )
        self._answers = Queue(maxsize=8)
        self._listener = Thread(
            target=_listen, args=(self._process.stdout, self._answers), daemon=True
        )
        self._listener.start()


def resident_bytes(pid: int | None) -> int | None:
    """Return the memory that a process uses; None if there is no such process."""
    try:
        return None if pid is None else int(psutil.Process(pid).memory_info().rss)
    except psutil.Error:
        return None


def _listen(pipe: IO[bytes], answers: "Queue[dict[str, Any] | None]") -> None:
    """Put the answers of the process into the queue, until it ends or sends nonsense."""
    with suppress(OSError, ValueError, TypeError, KeyError):
        while line := pipe.readline(_LONGEST_ANSWER):
            answer = json.loads(line)
            if "array" in answer:
                kind, *shape = answer["array"]
                size = prod(shape) * np.dtype(kind).itemsize
                if kind not in _ARRAYS or not 0 <= size <= RESULT_BYTES:
                    break
                content = pipe.read(size)
                answer = {"result": np.frombuffer(content, kind).reshape(shape)}
            elif not {"begun", "result", "end", "error"} & set(answer):
                break
            answers.put(answer)
    answers.put(None)


def _serve() -> None:
    """Answer requests until there are no more."""
    # What libraries print does not get among the answers.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    for line in sys.stdin.buffer:
        _answer(answers, json.loads(line))
        _end_after(0)


def _answer(answers: IO[bytes], request: dict[str, Any]) -> None:
    try:
        module, name = request["function"].split(":")
        function = vars(importlib.import_module(module))[name]
        _send(answers, {"begun": True})
        results = function(Path(request["path"]), **request["arguments"])
        for result in results if isinstance(results, Iterator) else (results,):
            if isinstance(result, np.ndarray):
                kind = result.dtype.newbyteorder("<").str
                array = np.ascontiguousarray(result, kind)
                _send(answers, {"array": [kind, *result.shape]}, array)
            else:
                _send(answers, {"result": result})
        _send(answers, {"end": True})
    except SkinSourceError as error:
        _send(answers, {"error": str(error), "kind": type(error).__name__})
    except Exception as error:  # noqa: BLE001  on a damaged file a parser may fail in any way
        _send(answers, {"error": printable(error) or type(error).__name__})


def _send(answers: IO[bytes], answer: dict[str, Any], content: Any = b"") -> None:
    answers.write(json.dumps(answer).encode("ascii") + b"\n")
    answers.write(content)
    answers.flush()
    _end_after(_LONGEST_STEP_S)


def _end_after(seconds: int) -> None:
    """Have the system end this process after a time; 0: not any more."""
    if sys.platform != "win32":
        signal.alarm(seconds)


if __name__ == "__main__":
    _serve()
