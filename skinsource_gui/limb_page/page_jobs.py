"""The jobs of the page, which stands in front of the bar where others are cancelled."""

from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.base.job import Job
from skinsource_gui.limb_page.title import IMPORTING
from skinsource_gui.state.job_runner import JobProgress, JobRunner


class PageJobs(QObject):
    """Hands jobs to the runner, and tells what becomes of them.

    An import that an earlier page began belongs to it too.

    Parameters
    ----------
    runner
        Who carries them out.
    """

    #: How far the present one is, in words.
    told = Signal(str)
    #: There is one more of them, or one fewer.
    changed = Signal()
    #: The job, and its result.
    done = Signal(object, object)
    #: A sentence: it failed.
    failed = Signal(str)
    cancelled = Signal()

    def __init__(self, runner: JobRunner, parent: QObject) -> None:
        super().__init__(parent)
        self._runner = runner
        self._own = [job for job in runner.unfinished if job.title == IMPORTING]
        runner.progressed.connect(self._note_progress)
        runner.done.connect(self._note_done)
        runner.failed.connect(self._note_failed)
        runner.cancelled.connect(self._note_cancelled)

    @property
    def busy(self) -> bool:
        """Whether one of them is not finished."""
        return bool(self._own)

    def add(self, job: Job[Any]) -> None:
        """Have a job carried out."""
        self._own.append(job)
        self.told.emit(f"{job.title}…")
        self.changed.emit()
        self._runner.add(job)

    def cancel(self) -> None:
        """Stop all of them."""
        for job in tuple(self._own):
            self._runner.cancel(job)

    def _note_progress(self, job: Job[Any], progress: JobProgress) -> None:
        if job in self._own and progress.total:
            share = 100 * progress.done // progress.total
            self.told.emit(f"{job.title}: {share} %")

    def _note_done(self, job: Job[Any], result: object) -> None:
        if self._ended(job):
            self.done.emit(job, result)

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        if self._ended(job):
            self.failed.emit(str(error))

    def _note_cancelled(self, job: Job[Any]) -> None:
        if self._ended(job):
            self.cancelled.emit()

    def _ended(self, job: Job[Any]) -> bool:
        if job not in self._own:
            return False
        self._own.remove(job)
        self.changed.emit()
        return True
