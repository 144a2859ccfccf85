"""The job of a page: started, followed, given up."""

from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.base.job import Job
from skinsource_gui.state.job_runner import JobProgress, JobRunner


class PageJob(QObject):
    """One job at a time.

    Parameters
    ----------
    runner
        Carries it out; of its other jobs nothing is told.
    """

    #: Its `JobProgress`.
    progressed = Signal(object)
    #: Its result.
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

    def start(self, job: Job[Any]) -> None:
        """Carry out ``job`` when those before it are done."""
        self._job = job
        self._runner.add(job)

    def give_up(self) -> None:
        """Stop it; nothing more is told."""
        job, self._job = self._job, None
        if job is not None:
            self._runner.cancel(job)

    def _follow(self, job: Job[Any], progress: JobProgress) -> None:
        if job is self._job:
            self.progressed.emit(progress)

    def _take(self, job: Job[Any], result: object) -> None:
        if job is self._job:
            self._job = None
            self.done.emit(result)

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        if job is self._job:
            self._job = None
            self.ended.emit(str(error))

    def _note_cancelled(self, job: Job[Any]) -> None:
        if job is self._job:
            self._job = None
            self.ended.emit("It was given up; nothing was changed")
