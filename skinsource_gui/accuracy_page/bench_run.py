"""The latest benchmark of one page: its job, and the folder with what it has written."""

from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.errors import SkinSourceError
from skinsource.files import make_folder, write_bytes
from skinsource.job import Job
from skinsource_gui.accuracy_page.bench_job import PLOT_NAME, Measured, measure
from skinsource_gui.state.job_runner import JobProgress, JobRunner

_TITLE = "Measuring accuracy and speed"


class BenchRun(QObject):
    """Has a benchmark measured, and keeps what came of it.

    Parameters
    ----------
    runner
        Carries it out, when what came before it is done: other work would spoil the times.
    """

    #: The `JobProgress`.
    progressed = Signal(object)
    #: What was `Measured`.
    done = Signal(object)
    #: It was cancelled; nothing is kept.
    cancelled = Signal()
    #: Why there are no results.
    failed = Signal(str)

    def __init__(self, runner: JobRunner, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._runner = runner
        self._folder: TemporaryDirectory[str] | None = None
        self._job: Job[Any] | None = None
        self._measured = False
        runner.progressed.connect(self._note_progress)
        runner.done.connect(self._note_done)
        runner.cancelled.connect(self._note_cancelled)
        runner.failed.connect(self._note_failed)

    @property
    def running(self) -> bool:
        """Whether it is measured, or waits for its turn."""
        return self._job is not None

    @property
    def waits_for(self) -> str:
        """Title of the job that comes before it, if any."""
        first = next(iter(self._runner.unfinished), None)
        return "" if first is None or first is self._job else first.title

    @property
    def files(self) -> tuple[Path, ...]:
        """What the latest run has written; nothing while one works."""
        if self._folder is None or not self._measured:
            return ()
        return tuple(sorted(path for path in Path(self._folder.name).iterdir() if path.is_file()))

    @property
    def plot(self) -> Path | None:
        """The plot of the latest run."""
        return next((path for path in self.files if path.name == PLOT_NAME), None)

    def start(self, limb: str) -> None:
        """Forget the latest run and begin another, on this limb; empty: on made-up responses."""
        self.close()
        try:
            # The job removes what is in there itself when it is stopped or fails.
            self._folder = TemporaryDirectory(
                prefix="skinsource-bench-", ignore_cleanup_errors=True
            )
        except OSError as error:
            self.failed.emit(
                f"No folder for the results can be made ({error.strerror}). Make room, and measure "
                "again."
            )
            return
        self._job = Job(_TITLE, partial(measure, Path(self._folder.name), limb))
        self._runner.add(self._job)

    def cancel(self) -> None:
        """Stop it; `cancelled` is told once nothing is written any more."""
        if self._job is not None:
            self._runner.cancel(self._job)

    def close(self) -> None:
        """Stop it, listen to it no more, and remove what was written."""
        job, self._job = self._job, None
        if job is not None:
            self._runner.cancel(job)
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

    def _note_progress(self, job: Job[Any], progress: JobProgress) -> None:
        if job is self._job:
            self.progressed.emit(progress)

    def _note_done(self, job: Job[Any], measured: Measured) -> None:
        if job is self._job:
            self._job, self._measured = None, True
            self.done.emit(measured)

    def _note_cancelled(self, job: Job[Any]) -> None:
        if job is self._job:
            self._job = None
            self._forget()
            self.cancelled.emit()

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        if job is self._job:
            self._job = None
            self._forget()
            mistake = f"The studio made a mistake: {type(error).__name__}: {error}"
            self.failed.emit(str(error) if isinstance(error, SkinSourceError) else mistake)

    def _forget(self) -> None:
        self._measured = False
        folder, self._folder = self._folder, None
        if folder is not None:
            folder.cleanup()
