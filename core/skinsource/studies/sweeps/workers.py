"""Measurement of stimuli in several processes, so that all cores are used.

A process that ends by itself is started anew; a stimulus that ended two processes gets an error.
"""

import json
import os
import subprocess
import sys
from collections import Counter, deque
from collections.abc import Iterable, Iterator
from contextlib import suppress
from queue import Empty, SimpleQueue
from threading import Lock, Thread
from typing import IO

from skinsource.base.assets import PACKAGE
from skinsource.base.errors import StorageError
from skinsource.base.job import Stop, never, stop_if
from skinsource.studies.sweeps.metrics import Metrics
from skinsource.studies.sweeps.plan import Plan, chunks

#: Command of the process; it imports no module from the current folder.
COMMAND = (sys.executable, "-P", "-m", "skinsource.studies.sweeps.worker")
_POLL_S = 0.05
_MOST_LOST = 2

#: Number of a stimulus, and its metrics or the reason why it has none.
Row = tuple[int, Metrics | str]


def measured(
    plan: Plan, numbers: Iterable[int], processes: int, stop: Stop = never
) -> Iterator[Row]:
    """Yield the metrics, or errors, of some stimuli of ``plan``, in any order.

    Raises
    ------
    Stopped
        ``stop`` said so; the processes have ended.
    StorageError
        No process can be started.
    """
    tasks = _Tasks(numbers)
    rows: SimpleQueue[Row | BaseException | None] = SimpleQueue()
    servers = [_Server(plan, tasks, rows) for _ in range(max(1, processes))]
    try:
        for server in servers:
            server.start()
        running = len(servers)
        while running:
            stop_if(stop)
            try:
                row = rows.get(timeout=_POLL_S)
            except Empty:
                continue
            if row is None:
                running -= 1
            elif isinstance(row, BaseException):
                raise row
            else:
                yield row
    finally:
        for server in servers:
            server.end()


class _Tasks:
    """The remaining stimuli; threads take chunks of them."""

    def __init__(self, numbers: Iterable[int]) -> None:
        self._waiting = deque(chunks(numbers))
        self._lost: Counter[int] = Counter()
        self._lock = Lock()

    def next(self) -> tuple[int, ...] | None:
        with self._lock:
            return self._waiting.popleft() if self._waiting else None

    def give_back(self, numbers: tuple[int, ...]) -> tuple[int, ...]:
        """Put back the rest of a chunk, whose first stimulus ended its process.

        Returns the stimuli that are given up.
        """
        if not numbers:
            return ()
        with self._lock:
            self._lost[numbers[0]] += 1
            given_up = numbers[:1] if self._lost[numbers[0]] >= _MOST_LOST else ()
            rest = numbers[len(given_up) :]
            if rest:
                self._waiting.appendleft(rest)
            return given_up


class _Server(Thread):
    """One process, and the thread that feeds it."""

    def __init__(
        self, plan: Plan, tasks: _Tasks, rows: "SimpleQueue[Row | BaseException | None]"
    ) -> None:
        super().__init__(daemon=True)
        self._plan, self._tasks, self._rows = plan, tasks, rows
        self._process: subprocess.Popen[bytes] | None = None
        self._given_up = False

    def run(self) -> None:
        """Work until nothing is left, or `end`."""
        try:
            while not self._given_up and (chunk := self._tasks.next()) is not None:
                self._measure(chunk)
        except BaseException as error:  # noqa: BLE001  raised by whoever takes the rows
            self._rows.put(error)
        finally:
            self._close()
            self._rows.put(None)

    def end(self) -> None:
        """End the process, in the middle of a stimulus if need be."""
        self._given_up = True
        process = self._process
        if process is not None:
            with suppress(OSError):
                process.kill()
        self.join()

    def _measure(self, chunk: tuple[int, ...]) -> None:
        remaining = deque(chunk)
        try:
            pipe = self._pipe()
            pipe.write(json.dumps({"measure": chunk}).encode() + b"\n")
            pipe.flush()
            while remaining:
                number, outcome = self._answer()
                self._rows.put((number, outcome))
                remaining.remove(number)
        except (_ProcessLost, OSError):
            self._close()
            if self._given_up:
                return
            for number in self._tasks.give_back(tuple(remaining)):
                self._rows.put((number, "the process that measured it ended, twice"))

    def _answer(self) -> Row:
        out = self._process.stdout if self._process else None
        line = out.readline() if out else b""
        if not line.endswith(b"\n"):
            raise _ProcessLost
        tree = json.loads(line)
        if "error" in tree:
            return int(tree["stimulus"]), str(tree["error"])
        metrics = {name: float(value) for name, value in tree["metrics"].items()}
        return int(tree["stimulus"]), metrics

    def _pipe(self) -> IO[bytes]:
        if self._process is None:
            self._process = _new_process()
            pipe = self._process.stdin
            if pipe is not None:
                pipe.write(json.dumps({"plan": self._plan.text}).encode() + b"\n")
                pipe.flush()
        pipe = self._process.stdin
        if pipe is None:
            raise _ProcessLost
        return pipe

    def _close(self) -> None:
        process, self._process = self._process, None
        if process is None:
            return
        process.kill()
        process.wait()
        for pipe in (process.stdin, process.stdout):
            if pipe is not None:
                with suppress(OSError):
                    pipe.close()


class _ProcessLost(Exception):
    """The process ended before it had answered."""


def _new_process() -> "subprocess.Popen[bytes]":
    inherited = os.environ.get("PYTHONPATH")
    paths = [str(PACKAGE.parent), *([inherited] if inherited else [])]
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(paths),
        # Every core has a process already.
        "OPENBLAS_NUM_THREADS": "1",
    }
    try:
        return subprocess.Popen(  # noqa: S603  ourselves
            COMMAND,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment,
        )
    except OSError as error:
        raise StorageError(
            f"the sweep cannot start another process ({error.strerror or error}). Close other "
            "programs, or run it with one process."
        ) from error
