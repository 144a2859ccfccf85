"""The job of a page that checks: started, followed, given up."""

from collections.abc import Sequence
from functools import partial
from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.job import Job
from skinsource_gui.checking_page.checking import CHECKING, Row, check_rows
from skinsource_gui.state.job_runner import JobProgress, JobRunner


class CheckRun(QObject):
    """One check at a time.

    Parameters
    ----------
    runner
        Carries it out; of its other jobs nothing is told.
    """

    #: What is being done.
    progressed = Signal(str)
    #: What was found of each row, or why nothing was.
    done = Signal(object)
    #: Why it ended without a result.
    ended = Signal(str)

    def __init__(self, runner: JobRunner, parent: QObject) -> None:
        super().__init__(parent)
        self._runner = runner
        self._job: Job[Any] | None = None
        runner.progressed.connect(self._follow)
        runner.done.connect(self._take)
        runner.failed.connect(self._note_failed)
        runner.cancelled.connect(self._note_cancelled)

    @property
    def runs(self) -> bool:
        """Whether it is being carried out, or waits."""
        return self._job is not None

    def start(self, rows: Sequence[Row], axes: str, rate_hz: float) -> None:
        """Check; arguments as of `check_rows`."""
        self._job = Job(CHECKING, partial(check_rows, tuple(rows), axes, rate_hz))
        self._runner.add(self._job)

    def give_up(self) -> None:
        """Stop it; nothing more is told."""
        job, self._job = self._job, None
        if job is not None:
            self._runner.cancel(job)

    def _follow(self, job: Job[Any], progress: JobProgress) -> None:
        if job is self._job:
            self.progressed.emit(progress.text)

    def _take(self, job: Job[Any], results: object) -> None:
        if job is self._job:
            self._job = None
            self.done.emit(results)

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        if job is self._job:
            self._job = None
            self.ended.emit(str(error))

    def _note_cancelled(self, job: Job[Any]) -> None:
        if job is self._job:
            self._job = None
            self.ended.emit("It was given up; nothing was changed")
