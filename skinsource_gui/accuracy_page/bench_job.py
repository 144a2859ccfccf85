"""The work of measuring: the short benchmark in a process of its own, which a stop kills."""

import os
import re
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from queue import Empty, Queue
from shutil import rmtree
from tempfile import TemporaryFile
from threading import Thread
from typing import IO

from skinsource.errors import SkinSourceError
from skinsource.job import Progress, Stop, stop_if
from skinsource.method_comparison.table import Row, read_table

#: The child process; where it shall write is added.
COMMAND = (sys.executable, "-m", "skinsource", "bench", "--quick", "--progress", "lines", "--out")
TABLE_NAME, PLOT_NAME = "work_precision.csv", "work_precision.png"
_STEP = re.compile(r"(\d+)/(\d+) (.*)")
_SPEAKER = "skinsource: "
_IN_A_TERMINAL = "In a terminal, 'skinsource bench --quick' may say more."
# How long a stop may wait for its effect.
_BETWEEN_LOOKS_S = 0.05


class MeasurementError(SkinSourceError):
    """The benchmark gave no results."""

    def __init__(self, reason: str) -> None:
        super().__init__(f"The measurement gave no results: {reason.rstrip('.')}. {_IN_A_TERMINAL}")


@dataclass(frozen=True, slots=True)
class Measured:
    """What was measured: the rows of the table; why there is no plot, or nothing."""

    rows: tuple[Row, ...]
    no_plot: str


def measure(folder: Path, limb: str, *, progress: Progress, stop: Stop) -> Measured:
    """Measure, and write report, table and plot into ``folder``.

    Parameters
    ----------
    folder
        Where to write; there already.
    limb
        Name of the limb that is measured on; empty: made-up responses.
    progress, stop
        As of each job.

    Raises
    ------
    MeasurementError
        There are no results; the folder is gone, as after a stop.
    Stopped
        ``stop`` said so: the process has ended.
    """
    try:
        return _measured(folder, limb, progress, stop)
    except BaseException:
        rmtree(folder, ignore_errors=True)
        raise


def _measured(folder: Path, limb: str, progress: Progress, stop: Stop) -> Measured:
    with TemporaryFile() as complaints:
        words = [str(folder), *(("--limb", limb) if limb else ())]
        code = _run(words, complaints, progress, stop)
        complaints.seek(0)
        said = complaints.read().decode(errors="replace").strip()
    reason = said.splitlines()[-1].removeprefix(_SPEAKER) if said else ""
    table = folder / TABLE_NAME
    # A negative code is a signal that ended it.
    if code < 0 or not table.is_file():
        raise MeasurementError(reason or f"it ended with code {code}")
    try:
        rows = tuple(read_table(table))
    except SkinSourceError as error:
        raise MeasurementError(str(error)) from error
    return Measured(rows, "" if (folder / PLOT_NAME).is_file() else reason)


def _run(words: Sequence[str], complaints: IO[bytes], progress: Progress, stop: Stop) -> int:
    try:
        process = subprocess.Popen(  # noqa: S603  ourselves
            [*COMMAND, *words],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=complaints,
            env={**os.environ, "PYTHONIOENCODING": "utf-8"},
        )
    except OSError as error:
        raise MeasurementError(f"{COMMAND[0]}: {error.strerror}") from error
    with process:
        try:
            _follow(process, progress, stop)
        except BaseException:
            process.kill()
            raise
    return process.returncode


def _follow(process: subprocess.Popen[bytes], progress: Progress, stop: Stop) -> None:
    """Tell how far ``process`` is until it has ended."""
    lines: Queue[bytes] = Queue()
    # A pipe cannot be asked on every system whether there is something in it.
    listener = Thread(target=_listen, args=(process.stdout, lines), daemon=True)
    listener.start()
    while listener.is_alive() or not lines.empty():
        stop_if(stop)
        try:
            line = lines.get(timeout=_BETWEEN_LOOKS_S)
        except Empty:
            continue
        step = _STEP.match(line.decode(errors="replace"))
        if step:
            progress(int(step[1]), int(step[2]), step[3].strip())


def _listen(output: IO[bytes], lines: "Queue[bytes]") -> None:
    for line in output:
        lines.put(line)
