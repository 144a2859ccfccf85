"""Exporting stimuli: opens the page, asks where to, and tells what came of it."""

import importlib
from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from skinsource.base.files import is_there
from skinsource.design.design import Design
from skinsource_gui.files.export_jobs import ExportJobs
from skinsource_gui.files.file_actions import FileActions
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.widgets.asking import may_replace


class StimulusActions(QObject):
    """Exports the stimulus of the open design.

    Parameters
    ----------
    document, preferences, files
        What is exported; where files were last written; who asks where to.
    runner
        Carries the exports out.
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
        window: QWidget,
    ) -> None:
        super().__init__(window)
        self._document, self._preferences, self._files = document, preferences, files
        self._window = window
        self._jobs = ExportJobs(runner, files, self)
        self._jobs.failed.connect(self.failed)
        #: The page, while it is open.
        self.page: Any = None

    def show(self) -> None:
        """Open the page on the design as it is now."""
        # Few export anything; the start of the studio shall not wait for it.
        page_module = importlib.import_module("skinsource_gui.stimulus_page.page")
        design, view = self._document.design, self._document.view
        kept = self._preferences.export_text
        rig = self._preferences.rig_path
        page = page_module.StimulusPage(design, view, self._window, kept, rig)
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

    def _export(
        self, design: Design, order: Any, overview: Any, confirmed: bool, kept: str
    ) -> None:
        # What was right for this one mostly is for the next.
        self._preferences.export_text = kept
        kind = order.format
        own = self._document.path
        name = "stimulus" if own is None else own.stem
        start = self._preferences.folder / f"{name}{kind.suffix}"
        words = "Folder" if kind.folder else kind.title
        offered = f"{words} (*{kind.suffix})" if kind.suffix else "All files (*)"
        path = self._files.ask_where("Export stimulus", start, offered, ending=kind.suffix)
        # It was loaded with the page.
        stimulus_export = importlib.import_module("skinsource.export.stimulus_export")
        if path is None or not self._may_write(
            path, stimulus_export.written_files(path, kind, overview.marks)
        ):
            return
        work = partial(
            stimulus_export.export_stimulus,
            design,
            path,
            kind.name,
            order.rate_hz,
            options=replace(order.options, accept_loss=confirmed),
            actuation=order.actuation,
            rig=order.rig,
            equaliser=order.equaliser,
            confirmed=confirmed,
        )
        self._jobs.add(path, work, written=lambda result: result.files[0])

    def _may_write(self, path: Path, written: Iterable[tuple[Path, ...]]) -> bool:
        """Whether nothing is lost beside ``path``, which the dialog asked about, or may be."""
        # Who lets a file go lets its sidecar go.
        agreed = is_there(path)
        firsts = (
            next(filter(is_there, files), None)
            for files in written
            if not (agreed and files[0] == path)
        )
        there = [one for one in firsts if one is not None]
        return not there or may_replace(self._window, there)
