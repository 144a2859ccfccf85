"""The bar of a running job."""

from PySide6.QtWidgets import QLabel, QProgressBar

from skinsource.base.job import Job
from skinsource_gui.shell.status import JobBar
from skinsource_gui.state.job_runner import JobProgress, JobRunner


def test_a_bar_is_shown_only_when_it_is_known_how_far_a_job_is(qtbot):
    runner = JobRunner()
    bar = JobBar(runner)
    qtbot.addWidget(bar)
    runner.current = Job("Exporting field.npz", None)
    runner.changed.emit()
    assert bar.findChild(QLabel, "job_percent").text() == "computing…"
    assert not bar.findChild(QProgressBar, "job_progress").isVisible()
    runner.progressed.emit(runner.current, JobProgress(1, 4, "Writing", 0.1))
    assert bar.findChild(QLabel, "job_percent").text() == "25 %"
    assert bar.findChild(QProgressBar, "job_progress").isVisible()
    runner.progressed.emit(runner.current, JobProgress(1, 4, "Writing", 5.0))
    assert bar.findChild(QLabel, "job_percent").text() == "25 % · about 15 s left"
