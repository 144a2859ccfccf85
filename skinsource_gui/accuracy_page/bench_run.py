"""The short benchmark, in a process of its own."""

import re
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from PySide6.QtCore import QObject, QProcess, QProcessEnvironment, Signal

from skinsource.errors import SkinSourceError
from skinsource.files import make_folder, write_bytes
from skinsource.method_comparison.table import Row, read_table

#: The child process; where it shall write is added.
COMMAND = (sys.executable, "-m", "skinsource", "bench", "--quick", "--progress", "lines", "--out")
TABLE_NAME, PLOT_NAME = "work_precision.csv", "work_precision.png"
_STEP = re.compile(r"(\d+)/(\d+) (.*)")
_SPEAKER = "skinsource: "
_LONGEST_GOODBYE_MS = 3000
_IN_A_TERMINAL = "In a terminal, 'skinsource bench --quick' may say more."


class BenchRun(QObject):
    """Starts ``skinsource bench --quick``, listens to it, and keeps what it has written."""

    #: Steps done, steps in all, name of the step.
    progressed = Signal(int, int, str)
    #: The rows of the table; why there is no plot, or nothing.
    done = Signal(list, str)
    #: Why there are no results.
    failed = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._folder: TemporaryDirectory[str] | None = None
        self._process: QProcess | None = None
        self._heard = b""
        self._rows: list[Row] = []

    @property
    def running(self) -> bool:
        """Whether the process works."""
        return self._process is not None

    @property
    def files(self) -> tuple[Path, ...]:
        """What the latest run has written; nothing while one works."""
        if self._folder is None or self.running or not self._rows:
            return ()
        return tuple(sorted(path for path in Path(self._folder.name).iterdir() if path.is_file()))

    @property
    def plot(self) -> Path | None:
        """The plot of the latest run."""
        return next((path for path in self.files if path.name == PLOT_NAME), None)

    def start(self) -> None:
        """Forget the latest run and begin another."""
        self.cancel()
        self._forget()
        try:
            self._folder = TemporaryDirectory(prefix="skinsource-bench-")
        except OSError as error:
            self.failed.emit(
                f"No folder for the results can be made ({error.strerror}). Make room, and measure "
                "again."
            )
            return
        self._process = process = QProcess(self)
        environment = QProcessEnvironment.systemEnvironment()
        environment.insert("PYTHONIOENCODING", "utf-8")
        process.setProcessEnvironment(environment)
        process.readyReadStandardOutput.connect(self._listen)
        process.finished.connect(self._finish)
        process.errorOccurred.connect(self._note_fault)
        program, *words = COMMAND
        process.start(program, [*words, self._folder.name])

    def cancel(self) -> None:
        """End the process if there is one; nothing is said, nothing is left of it."""
        process = self._release()
        if process is not None:
            process.kill()
            process.waitForFinished(_LONGEST_GOODBYE_MS)
            process.deleteLater()
            self._forget()

    def close(self) -> None:
        """End the process and remove what it has written."""
        self.cancel()
        self._forget()

    def save(self, folder: Path) -> None:
        """Copy all files of the latest run into ``folder``.

        Raises
        ------
        StorageError
            The folder cannot be written, or the disk is full.
        """
        make_folder(folder)
        for path in self.files:
            write_bytes(folder / path.name, path.read_bytes())

    def _listen(self) -> None:
        if self._process is None:
            return
        self._heard += self._process.readAllStandardOutput().data()
        *lines, self._heard = self._heard.split(b"\n")
        for line in lines:
            step = _STEP.match(line.decode(errors="replace"))
            if step:
                self.progressed.emit(int(step[1]), int(step[2]), step[3].strip())

    def _finish(self, code: int, how: QProcess.ExitStatus) -> None:
        process = self._release()
        if process is None or self._folder is None:
            return
        said = process.readAllStandardError().data().decode(errors="replace").strip()
        process.deleteLater()
        reason = said.splitlines()[-1].removeprefix(_SPEAKER) if said else ""
        table = Path(self._folder.name) / TABLE_NAME
        if how == QProcess.ExitStatus.CrashExit or not table.is_file():
            self._fail(reason or f"it ended with code {code}")
            return
        try:
            self._rows = read_table(table)
        except SkinSourceError as error:
            self._fail(str(error))
            return
        self.done.emit(list(self._rows), "" if self.plot else reason)

    def _note_fault(self, fault: QProcess.ProcessError) -> None:
        # All other faults are told by `finished` too.
        if fault == QProcess.ProcessError.FailedToStart:
            process = self._release()
            if process is not None:
                process.deleteLater()
                self._fail(process.errorString())

    def _fail(self, reason: str) -> None:
        self._forget()
        self.failed.emit(f"The measurement gave no results: {reason.rstrip('.')}. {_IN_A_TERMINAL}")

    def _release(self) -> QProcess | None:
        """Take the process out, and listen to it no more."""
        process, self._process = self._process, None
        if process is not None:
            process.readyReadStandardOutput.disconnect(self._listen)
            process.finished.disconnect(self._finish)
            process.errorOccurred.disconnect(self._note_fault)
        self._heard = b""
        return process

    def _forget(self) -> None:
        self._rows = []
        folder, self._folder = self._folder, None
        if folder is not None:
            folder.cleanup()
