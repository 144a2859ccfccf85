"""Help > Get the measured limbs: install them from a folder, or download them."""

from functools import partial
from pathlib import Path
from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import QStandardPaths, Qt

from skinsource.base.job import Job, time_left_text
from skinsource.limbs.dataset.install import fetch, install
from skinsource.limbs.dataset.published import published_files
from skinsource.limbs.dataset.store import StoreInfo
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.qt.buttons import page_label, progress_bar
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.resources import read_text
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.job_runner import JobProgress, JobRunner, PageJobs
from skinsource_gui.state.preferences import INSTALLATIONS, InstalledLimbs

TITLE = "Get the measured limbs"
_MEASURED = "measured"


class DatasetPage(ToolPage):
    """Starts an installation, and shows its progress; closing the page lets it run on."""

    def __init__(self, runner: JobRunner, limbs: InstalledLimbs, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent, "dataset_page", TITLE, (560, 320))
        self._limbs, self._jobs = limbs, PageJobs(runner, self, INSTALLATIONS)
        size_mb = round(sum(file.size_bytes for file in published_files()) / 1e6)
        about = page_label("page_text", read_text("dataset.html").format(size=size_mb))
        about.setTextFormat(Qt.TextFormat.RichText)
        about.setOpenExternalLinks(True)
        self._bar = progress_bar("dataset_progress", "Progress of the installation")
        self._install = self.add_button(
            "install_from_folder", "Install from folder…", "", self._ask_and_install
        )
        download = partial(self._jobs.add, Job(INSTALLATIONS[1], fetch))
        self._fetch = self.add_button("download", "Download…", "", download)
        self._cancel = self.add_button("cancel_installing", "Cancel", "", self._jobs.cancel)
        self._close = self.add_button("close_page", "Close", "", self.close)
        buttons = in_row(self._install, self._fetch, None, self._cancel, self._close)
        in_column(about, None, self.message, self._bar, buttons, of=self, gap_px=UNIT_PX)
        self._jobs.changed.connect(self._show_state)
        self.follow_jobs(self._jobs, self._note_done, progressed=self._show_progress)
        self._show_installed()
        self._show_state()

    def _ask_and_install(self) -> None:
        start = QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DownloadLocation)
        folder = QtWidgets.QFileDialog.getExistingDirectory(self, "Folder with the download", start)
        if folder:
            self._jobs.add(Job(INSTALLATIONS[0], partial(install, Path(folder))))

    def _show_state(self) -> None:
        runs = self._jobs.busy
        had_keyboard = self._cancel.hasFocus()
        self._bar.setVisible(runs)
        self._cancel.setVisible(runs)
        for button in (self._install, self._fetch):
            button.setEnabled(not runs)
        if had_keyboard and not runs:
            self._close.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_progress(self, _job: Job[Any], progress: JobProgress) -> None:
        self._bar.setRange(0, 1000 if progress.total else 0)
        self._bar.setValue(1000 * progress.done // max(progress.total, 1))
        left = time_left_text(progress.seconds_left)
        self.say(f"{progress.text}, {left}" if left else f"{progress.text}…")

    def _show_installed(self, note: str = "") -> None:
        count = sum(name.startswith(_MEASURED) for name in self._limbs.names)
        self.say(
            f"{count} measured limbs are installed; choose one at the right of the bar above the "
            f"panels.{note}"
            if count
            else "No measured limb is installed yet."
        )

    def _note_done(self, _job: Job[Any], result: object) -> None:
        self._limbs.look()
        note = result.note if isinstance(result, StoreInfo) else ""
        self._show_installed(f"\nNote: {note}." if note else "")
