"""What becomes of exports that run as jobs."""

import logging
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import SkinSourceError
from skinsource.base.job import Job
from skinsource_gui.files.file_actions import FileActions
from skinsource_gui.state.job_runner import JobRunner

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class _Running:
    """Where to, which file is named, who answers for an error first, what is said besides."""

    path: Path
    written: Callable[[Any], Path]
    answered: Callable[[Exception], bool]
    note: str


class ExportJobs(QObject):
    """Has exports carried out, and tells how each ended.

    Parameters
    ----------
    runner, files
        Who carries them out; who tells of files that were written.
    parent
        As in Qt.
    """

    #: Why something was not exported.
    failed = Signal(str)

    def __init__(self, runner: JobRunner, files: FileActions, parent: QObject) -> None:
        super().__init__(parent)
        self._runner, self._files = runner, files
        self._running: dict[Job[Any], _Running] = {}
        runner.done.connect(self._note_written)
        runner.cancelled.connect(self._note_cancelled)
        runner.failed.connect(self._note_failed)

    def add(
        self,
        path: Path,
        work: Callable[..., Any],
        *,
        written: Callable[[Any], Path] | None = None,
        answered: Callable[[Exception], bool] = lambda error: False,
        note: str = "",
    ) -> None:
        """Export to ``path``.

        Parameters
        ----------
        path, work
            What is named while it runs; takes what a job's work takes.
        written
            Says of the result which file to name; ``path`` unless given.
        answered
            Is told of an error first; whether nothing more is to be said of it.
        note
            What is said beside the name of the file that was written.
        """
        job = Job(f"Exporting {path.name}", work)
        self._running[job] = _Running(path, written or (lambda result: path), answered, note)
        self._runner.add(job)

    def _note_written(self, job: Job[Any], result: Any) -> None:
        one = self._running.pop(job, None)
        if one is not None:
            self._files.note_written(one.written(result), one.note)

    def _note_cancelled(self, job: Job[Any]) -> None:
        one = self._running.pop(job, None)
        if one is not None:
            self._files.done.emit(f"Export of {one.path.name} cancelled; nothing was written")

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        one = self._running.pop(job, None)
        if one is None or one.answered(error):
            return
        if isinstance(error, SkinSourceError):
            self.failed.emit(str(error))
            return
        _log.error("an export failed", exc_info=error)
        self.failed.emit(
            f"{one.path.name} was not exported: the studio made a mistake "
            f"({type(error).__name__}: {error}). Please report this."
        )
