"""The row that starts a benchmark, says how far it is, and ends it."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QWidget

from skinsource.job import left_in_words
from skinsource_gui.accuracy_page.bench_job import Measured
from skinsource_gui.accuracy_page.bench_limb import BenchLimb
from skinsource_gui.accuracy_page.bench_run import BenchRun
from skinsource_gui.accuracy_page.bench_table import verdict
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobProgress
from skinsource_gui.widgets.page_button import page_button

_INTRODUCTION = (
    "The benchmark compares this program and other ways of computing the same responses: how long "
    "they take, and how far they are from exact values. It takes about half a minute; other work "
    "would spoil the times."
)


class BenchBar(QWidget):
    """Words, progress, and the button that means something now.

    Parameters
    ----------
    run
        What is started here, and whose state is shown.
    document
        Has the design, on whose limb can be measured.
    """

    #: Another benchmark was asked for: what the last one has written is gone.
    began = Signal()

    def __init__(self, run: BenchRun, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._run = run
        self._words = QLabel(_INTRODUCTION)
        self._words.setObjectName("bench_words")
        self._words.setWordWrap(True)
        self._progress = QProgressBar()
        self._progress.setObjectName("bench_progress")
        self._progress.setAccessibleName("Progress of the benchmark")
        self._limb = BenchLimb(document)
        self._measure = page_button("measure", "Measure now", "Run skinsource bench --quick")
        self._cancel = page_button("cancel_measuring", "Cancel", "End the benchmark")
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self._words, 1)
        row.addWidget(self._progress, 1)
        row.addWidget(self._limb)
        row.addWidget(self._measure)
        row.addWidget(self._cancel)
        self._measure.clicked.connect(self._start)
        self._cancel.clicked.connect(run.cancel)
        run.progressed.connect(self._show_step)
        run.done.connect(self._show_verdict)
        run.cancelled.connect(self._show_cancelled)
        run.failed.connect(self._show_end)
        self._show_running(False)

    def say(self, words: str) -> None:
        """Say something in place of what was said before."""
        self._words.setText(words)

    def _start(self) -> None:
        if self._limb.missing:
            self.say(self._limb.missing)
            return
        self._progress.setRange(0, 0)
        self.say("Starting…")
        self._run.start(self._limb.limb)
        self.began.emit()
        if self._run.running:
            self._show_running(True)
            self._cancel.setFocus(Qt.FocusReason.OtherFocusReason)
        if self._run.waits_for:
            self.say(f"Waiting until this is done: {self._run.waits_for}.")

    def _show_step(self, step: JobProgress) -> None:
        self._progress.setRange(0, step.total)
        self._progress.setValue(step.done)
        left = left_in_words(step.seconds_left)
        words = f"Measuring {step.text}: {step.done} of {step.total} rows done"
        self.say(f"{words}, {left}." if left else f"{words}.")

    def _show_verdict(self, measured: Measured) -> None:
        self._show_end(verdict(list(measured.rows)))

    def _show_cancelled(self) -> None:
        self._show_end("Cancelled. Nothing was kept.")

    def _show_end(self, words: str) -> None:
        self.say(words)
        self._show_running(False)

    def _show_running(self, running: bool) -> None:
        had_keyboard = self._cancel.hasFocus()
        self._progress.setVisible(running)
        self._cancel.setVisible(running)
        self._measure.setVisible(not running)
        self._limb.setVisible(not running)
        if had_keyboard and not running:
            self._measure.setFocus(Qt.FocusReason.OtherFocusReason)
