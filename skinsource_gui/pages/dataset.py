"""Help > Get the measured limbs: install them from a folder, or download them."""

from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import QStandardPaths, Qt
from PySide6.QtWidgets import (
    QFileDialog,
    QLabel,
    QProgressBar,
    QWidget,
)

from skinsource.base.errors import SkinSourceError
from skinsource.base.job import Job, time_left_text
from skinsource.limbs.dataset.download import fetch
from skinsource.limbs.dataset.install import install
from skinsource.limbs.dataset.published import published_files
from skinsource.limbs.dataset.store import StoreInfo
from skinsource_gui.pages.page import Page
from skinsource_gui.qt.buttons import page_button, page_label
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.job_runner import JobProgress, JobRunner
from skinsource_gui.state.preferences import INSTALLATIONS, InstalledLimbs

TITLE = "Get the measured limbs"


_ABOUT = """
<h3>The measured limbs</h3>
<p>The impulse responses of four measured limbs are published by their authors
(<a href="https://doi.org/10.5281/zenodo.10547601">doi&nbsp;10.5281/zenodo.10547601</a>).
They are not ours to pass on, so the studio starts on synthetic limbs until you install them.</p>
<p><b>Install from folder…</b> takes a folder that holds <i>impulseResponses.mat</i> and the
toolbox's folder <i>visualization</i>.<br>
<b>Download…</b> fetches {size} MB from their publishers, checks them and installs them.</p>
<p>All is checked before anything is changed, and you can go on working meanwhile. In a terminal,
<i>skinsource dataset</i> does the same.</p>
"""
_MEASURED = "measured"


class DatasetPage(Page):
    """Starts an installation, and shows its progress; closing the page lets it run on."""

    def __init__(self, runner: JobRunner, limbs: InstalledLimbs, parent: QWidget) -> None:
        super().__init__(parent, "dataset_page", TITLE, (560, 320))
        self._runner, self._limbs = runner, limbs
        size_mb = round(sum(file.size_bytes for file in published_files()) / 1e6)
        about = page_label("page_text", _ABOUT.format(size=size_mb))
        about.setOpenExternalLinks(True)
        self._message = page_label("dataset_words")
        self._bar = QProgressBar()
        self._bar.setObjectName("dataset_progress")
        self._bar.setAccessibleName("Progress of the installation")
        self._bar.setTextVisible(False)
        self._install = page_button("install_from_folder", "Install from folder…")
        self._fetch = page_button("download", "Download…")
        self._cancel = page_button("cancel_installing", "Cancel")
        self._close = page_button("close_page", "Close")
        self._lay_out(about)
        self._install.clicked.connect(self._ask_and_install)
        self._fetch.clicked.connect(self._download)
        self._cancel.clicked.connect(self._stop)
        self._close.clicked.connect(self.close)
        runner.changed.connect(self._show_state)
        runner.progressed.connect(self._show_progress)
        runner.done.connect(self._note_done)
        runner.cancelled.connect(self._note_cancelled)
        runner.failed.connect(self._note_failed)
        self._show_installed()
        self._show_state()

    def _lay_out(self, about: QLabel) -> None:
        buttons = in_row(self._install, self._fetch, None, self._cancel, self._close)
        in_column(about, None, self._message, self._bar, buttons, of=self, gap_px=UNIT_PX)

    def _ask_and_install(self) -> None:
        start = QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DownloadLocation)
        folder = QFileDialog.getExistingDirectory(self, "Folder with the download", start)
        if folder:
            self._runner.add(Job(INSTALLATIONS[0], partial(install, Path(folder))))

    def _download(self) -> None:
        self._runner.add(Job(INSTALLATIONS[1], fetch))

    def _stop(self) -> None:
        for job in self._runner.unfinished:
            if job.title in INSTALLATIONS:
                self._runner.cancel(job)

    def _show_state(self) -> None:
        runs = any(job.title in INSTALLATIONS for job in self._runner.unfinished)
        had_keyboard = self._cancel.hasFocus()
        self._bar.setVisible(runs)
        self._cancel.setVisible(runs)
        for button in (self._install, self._fetch):
            button.setEnabled(not runs)
        if had_keyboard and not runs:
            self._close.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_progress(self, job: Job[Any], progress: JobProgress) -> None:
        if job.title in INSTALLATIONS:
            self._bar.setRange(0, 1000 if progress.total else 0)
            self._bar.setValue(1000 * progress.done // max(progress.total, 1))
            left = time_left_text(progress.seconds_left)
            self._message.setText(f"{progress.text}, {left}" if left else f"{progress.text}…")

    def _show_installed(self) -> None:
        names = [name for name in self._limbs.names if name.startswith(_MEASURED)]
        count = len(names)
        self._message.setText(
            f"{count} measured limbs are installed; choose one at the left of the bar above the "
            "panels."
            if count
            else "No measured limb is installed yet."
        )

    def _note_done(self, job: Job[Any], result: object) -> None:
        if job.title in INSTALLATIONS:
            self._limbs.look()
            self._show_installed()
            if isinstance(result, StoreInfo) and result.note:
                self._message.setText(f"{self._message.text()}\nNote: {result.note}.")

    def _note_cancelled(self, job: Job[Any]) -> None:
        if job.title in INSTALLATIONS:
            self._message.setText("Cancelled. Nothing was changed.")

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        if job.title in INSTALLATIONS:
            mistake = f"The studio made a mistake: {type(error).__name__}: {error}"
            self._message.setText(str(error) if isinstance(error, SkinSourceError) else mistake)
