"""How far a long job is, and the way to stop it."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QWidget,
)

from skinsource.base.job import left_in_words
from skinsource_gui.state.job_runner import JobProgress, JobRunner
from skinsource_gui.theme import UNIT_PX, tabular

_BAR_PX, _NAME_PX = 96, 200
_STEPS = 1000


class JobBar(QWidget):
    """What is being done, a bar, the time left, and Cancel; hidden while nothing is done."""

    def __init__(self, runner: JobRunner, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("job")
        self._runner = runner
        self._name = QLabel()
        self._name.setObjectName("job_name")
        self._name.setAccessibleName("What is being done")
        self._percent = QLabel()
        self._percent.setObjectName("job_percent")
        self._percent.setFont(tabular(self.font()))
        self._percent.setMinimumWidth(self._percent.fontMetrics().horizontalAdvance("100 %"))
        self._percent.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._bar = QProgressBar()
        self._bar.setObjectName("job_progress")
        self._bar.setAccessibleName("Progress")
        self._bar.setTextVisible(False)
        self._bar.setFixedSize(_BAR_PX, UNIT_PX)
        self._cancel = QPushButton("Cancel")
        self._cancel.setObjectName("cancel_running_job")
        self._cancel.setToolTip("Stop this; nothing half done is left")
        self._cancel.setAccessibleName("Cancel what is being done")
        self._cancel.setAutoDefault(False)
        self._cancel.clicked.connect(self._stop)
        # Where the bar it stands in has room to spare, it is not for this.
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row = QHBoxLayout(self)
        row.setContentsMargins(UNIT_PX, 0, 0, 0)
        row.setSpacing(UNIT_PX)
        for widget in (self._name, self._bar, self._percent, self._cancel):
            row.addWidget(widget)
        self._shown: object = None
        runner.changed.connect(self._show_job)
        runner.progressed.connect(self._show_progress)
        self.hide()

    def _stop(self) -> None:
        self._runner.cancel()

    def _show_job(self) -> None:
        job, waiting = self._runner.current, max(len(self._runner.unfinished) - 1, 0)
        if job is not self._shown:
            self._show_progress(job, JobProgress(text="Computing"))
        self._shown = job
        title = "" if job is None else job.title
        elided = self._name.fontMetrics().elidedText(title, Qt.TextElideMode.ElideMiddle, _NAME_PX)
        self._name.setText(f"{elided} (+{waiting})" if waiting else elided)
        self._name.setToolTip(f"{title}\n{waiting} more to come" if waiting else title)
        # The keyboard goes back to where work is done.
        if job is None and self._cancel.hasFocus():
            self.window().setFocus()
        self.setVisible(job is not None)

    def _show_progress(self, _job: object, progress: JobProgress) -> None:
        total = progress.total
        self._bar.setRange(0, _STEPS if total else 0)
        self._bar.setValue(_STEPS * progress.done // total if total else 0)
        # A bar that only moves looks full.
        self._bar.setVisible(bool(total))
        left = left_in_words(progress.seconds_left)
        percent = f"{100 * progress.done // total} %" if total else f"{progress.text.lower()}…"
        self._percent.setText(f"{percent} · {left}" if left else percent)
        self._bar.setToolTip(progress.text)
