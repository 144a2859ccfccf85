"""What becomes of an installation of limbs: the page that started it may be closed by then."""

from typing import Any

from PySide6.QtCore import QObject

from skinsource.base.errors import SkinSourceError
from skinsource.base.job import Job
from skinsource.design.labels import LIMBS
from skinsource.limbs.dataset.store import StoreInfo
from skinsource_gui.shell.reports import Reports
from skinsource_gui.state.installed_limbs import INSTALLATIONS, InstalledLimbs
from skinsource_gui.state.job_runner import JobRunner


class Installations(QObject):
    """Has the limbs looked for once they are installed, and says how it went.

    Parameters
    ----------
    runner
        Carries installations out; also the parent.
    limbs, reports
        Who looks, and who says it.
    """

    def __init__(self, runner: JobRunner, limbs: InstalledLimbs, reports: Reports) -> None:
        super().__init__(runner)
        self._limbs, self._reports = limbs, reports
        self._known = limbs.names
        limbs.changed.connect(self._note_changed)
        runner.done.connect(self._note_done)
        runner.failed.connect(self._note_failed)

    def _note_changed(self) -> None:
        """Say which limbs came or went, whoever installed or removed them."""
        before, self._known = self._known, self._limbs.names
        come = [_title(one) for one in self._known if one not in before]
        gone = [_title(one) for one in before if one not in self._known]
        words = []
        if come:
            words.append(f"{', '.join(come)}: installed, choose it under Limb above the panels")
        if gone:
            words.append(f"{', '.join(gone)}: no longer installed")
        self._reports.report(". ".join(words))

    def _note_done(self, job: Job[Any], result: object) -> None:
        if job.title in INSTALLATIONS:
            self._limbs.look()
            note = f" Note: {result.note}." if isinstance(result, StoreInfo) and result.note else ""
            self._reports.report(f"The measured limbs are installed.{note}")

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        if job.title in INSTALLATIONS:
            mistake = f"The studio made a mistake: {type(error).__name__}: {error}"
            self._reports.complain(str(error) if isinstance(error, SkinSourceError) else mistake)


def _title(limb: str) -> str:
    """What the window calls a limb."""
    return next((word.title for word in LIMBS if word.name == limb), limb)
