"""Exporting stimuli: opens the page, asks where to, and tells what came of it."""

import importlib
import logging
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from skinsource.design import Design
from skinsource.errors import SkinSourceError
from skinsource.job import Job
from skinsource_gui.files.file_actions import FileActions
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.theme import Theme

_log = logging.getLogger(__name__)


class StimulusActions(QObject):
    """Exports the stimulus of the open design.

    Parameters
    ----------
    document, preferences, files
        What is exported; where files were last written; who asks where to.
    runner
        Carries the exports out.
    theme
        Gives the colours in use.
    window
        In front of which the page opens; also the parent.
    """

    #: Why something was not exported.
    failed = Signal(str)

    def __init__(
        self,
        document: Document,
        preferences: Preferences,
        files: FileActions,
        runner: JobRunner,
        theme: Callable[[], Theme],
        window: QWidget,
    ) -> None:
        super().__init__(window)
        self._document, self._preferences, self._files = document, preferences, files
        self._runner, self._theme, self._window = runner, theme, window
        self._paths: dict[Job[Any], Path] = {}
        #: The page, while it is open.
        self.page: Any = None
        runner.done.connect(self._note_written)
        runner.cancelled.connect(self._note_cancelled)
        runner.failed.connect(self._note_failed)

    def show(self) -> None:
        """Open the page on the design as it is now."""
        # Few export anything; the start of the studio shall not wait for it.
        page_module = importlib.import_module("skinsource_gui.stimulus_page.page")
        design, view = self._document.design, self._document.view
        kept = self._preferences.export_text
        page = page_module.StimulusPage(design, view, self._theme, self._window, kept)
        page.chosen.connect(partial(self._export, design))
        page.finished.connect(self._forget_page)
        self.page = page
        page.open()

    def end(self) -> None:
        """Close the page."""
        if self.page is not None:
            self.page.reject()

    def _forget_page(self) -> None:
        self.page = None

    def _export(self, design: Design, order: Any, confirmed: bool, kept: str) -> None:
        # What was right for this one mostly is for the next.
        self._preferences.export_text = kept
        kind = order.format
        own = self._document.path
        name = "stimulus" if own is None else own.stem
        start = self._preferences.folder / f"{name}{kind.suffix}"
        words = "Folder" if kind.folder else kind.title
        offered = f"{words} (*{kind.suffix})" if kind.suffix else "All files (*)"
        path = self._files.ask_where("Export stimulus", start, offered, ending=kind.suffix)
        if path is None:
            return
        export = importlib.import_module("skinsource.stimulus_export").export_stimulus
        work = partial(
            export,
            design,
            path,
            kind.name,
            order.rate_hz,
            options=order.options,
            rig=order.rig,
            equaliser=order.equaliser,
            confirmed=confirmed,
        )
        job = Job(f"Exporting {path.name}", work)
        self._paths[job] = path
        self._runner.add(job)

    def _note_written(self, job: Job[Any], result: Any) -> None:
        if self._paths.pop(job, None) is not None:
            self._files.note_written(result.files[0])

    def _note_cancelled(self, job: Job[Any]) -> None:
        path = self._paths.pop(job, None)
        if path is not None:
            self._files.done.emit(f"Export of {path.name} cancelled; nothing was written")

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        path = self._paths.pop(job, None)
        if path is None:
            return
        if isinstance(error, SkinSourceError):
            self.failed.emit(str(error))
            return
        _log.error("an export failed", exc_info=error)
        self.failed.emit(
            f"{path.name} was not exported: the studio made a mistake "
            f"({type(error).__name__}: {error}). Please report this."
        )
