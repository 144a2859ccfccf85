"""Help > Accuracy and speed: what is promised, what is measured now, and a benchmark to run."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QCloseEvent, QPixmap, QShowEvent
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from skinsource.job import left_in_words
from skinsource.method_comparison.table import Row
from skinsource_gui.accuracy_page.accuracy_figures import AccuracyFigures
from skinsource_gui.accuracy_page.bench_job import Measured
from skinsource_gui.accuracy_page.bench_run import BenchRun
from skinsource_gui.accuracy_page.bench_table import BenchTable, verdict
from skinsource_gui.accuracy_page.bench_table_view import bench_table_view
from skinsource_gui.accuracy_page.picture_view import PictureView
from skinsource_gui.accuracy_page.report_saving import ask_and_save
from skinsource_gui.state.job_runner import JobProgress, JobRunner
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.status.status_line import StatusLine
from skinsource_gui.theme import Theme

_INTRODUCTION = (
    "The benchmark compares this program and other ways of computing the same responses: how long "
    "they take, and how far they are from exact values. It takes about half a minute; other work "
    "would spoil the times."
)
_NOTHING_YET = "Nothing is measured yet. “Measure now” runs the benchmark."
_SIZE_PX = (1240, 640)


class AccuracyPage(QDialog):
    """Stands beside the window; closing it ends a benchmark that runs.

    Parameters
    ----------
    runner
        Carries the benchmark out.
    status
        Knows the present figures.
    theme
        Gives the colours in use.
    preferences
        Know where files were last written.
    """

    def __init__(
        self,
        runner: JobRunner,
        status: StatusLine,
        theme: Callable[[], Theme],
        preferences: Preferences,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle("Accuracy and speed")
        self.setObjectName("accuracy_page")
        self.resize(*_SIZE_PX)
        self._status, self._theme, self._preferences = status, theme, preferences
        self.run = BenchRun(runner, self)
        self._figures = AccuracyFigures(status)
        self._model = BenchTable(self)
        self._table = bench_table_view(self._model)
        self._plot = PictureView()
        self._plot.setObjectName("bench_plot")
        self._plot.setAccessibleName("Plot of the benchmark")
        self._plot.say(_NOTHING_YET)
        self._tabs = QTabWidget()
        self._tabs.setObjectName("accuracy_tabs")
        self._tabs.addTab(self._figures, "Promised and measured")
        self._tabs.addTab(self._table, "Benchmark: table")
        self._tabs.addTab(self._plot, "Benchmark: plot")
        self._words = QLabel(_INTRODUCTION)
        self._words.setObjectName("bench_words")
        self._words.setWordWrap(True)
        self._progress = QProgressBar()
        self._progress.setObjectName("bench_progress")
        self._progress.setAccessibleName("Progress of the benchmark")
        self._measure = _button("measure", "Measure now", "Run skinsource bench --quick")
        self._cancel = _button("cancel_measuring", "Cancel", "End the benchmark")
        self._save = _button(
            "save_report", "Save…", "Save the report, table and plot of the benchmark"
        )
        self._close = _button("close_page", "Close", "Close this page (Esc)")
        self._lay_out()
        self._connect()
        self._show_running(False)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._refresh()
        self._take_colours()

    def closeEvent(self, event: QCloseEvent) -> None:
        self._stop()
        super().closeEvent(event)

    def reject(self) -> None:
        # What the Esc key does; no close event comes with it.
        self._stop()
        super().reject()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._take_colours()

    def end(self) -> None:
        """Close for good: nothing of the benchmark stays behind."""
        self.close()
        self.run.close()

    def _lay_out(self) -> None:
        running = QHBoxLayout()
        running.addWidget(self._words, 1)
        running.addWidget(self._progress, 1)
        running.addWidget(self._measure)
        running.addWidget(self._cancel)
        last = QHBoxLayout()
        last.addStretch(1)
        last.addWidget(self._save)
        last.addWidget(self._close)
        column = QVBoxLayout(self)
        column.addWidget(self._tabs, 1)
        column.addLayout(running)
        column.addLayout(last)

    def _connect(self) -> None:
        self._status.changed.connect(self._refresh)
        self._measure.clicked.connect(self._start)
        self._cancel.clicked.connect(self._stop)
        self._save.clicked.connect(self._ask_and_save)
        self._close.clicked.connect(self.close)
        self.run.progressed.connect(self._show_step)
        self.run.done.connect(self._show_results)
        self.run.cancelled.connect(self._show_cancelled)
        self.run.failed.connect(self._show_failure)

    def _refresh(self) -> None:
        if self.isVisible():
            self._figures.refresh()
            self._figures.show_theme(self._theme())

    def _take_colours(self) -> None:
        self._model.show_theme(self._theme())
        self._figures.show_theme(self._theme())

    def _start(self) -> None:
        self._show_rows([], _NOTHING_YET)
        self._progress.setRange(0, 0)
        self._words.setText("Starting…")
        self.run.start()
        if self.run.running:
            self._show_running(True)
            self._cancel.setFocus(Qt.FocusReason.OtherFocusReason)
        if self.run.waits_for:
            self._words.setText(f"Waiting until this is done: {self.run.waits_for}.")

    def _stop(self) -> None:
        self.run.cancel()

    def _show_cancelled(self) -> None:
        self._words.setText("Cancelled. Nothing was kept.")
        self._show_running(False)

    def _show_step(self, step: JobProgress) -> None:
        self._progress.setRange(0, step.total)
        self._progress.setValue(step.done)
        left = left_in_words(step.seconds_left)
        words = f"Measuring {step.text}: {step.done} of {step.total} rows done"
        self._words.setText(f"{words}, {left}." if left else f"{words}.")

    def _show_results(self, measured: Measured) -> None:
        rows, problem = list(measured.rows), measured.no_plot
        self._words.setText(verdict(rows))
        self._show_rows(rows, f"{problem[:1].upper()}{problem[1:]}")
        self._show_running(False)
        self._tabs.setCurrentWidget(self._table)
        self._table.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_failure(self, reason: str) -> None:
        self._words.setText(reason)
        self._show_running(False)

    def _show_rows(self, rows: list[Row], no_plot: str) -> None:
        self._model.show_rows(rows)
        self._figures.show_rows(rows)
        picture = QPixmap() if self.run.plot is None else QPixmap(str(self.run.plot))
        if picture.isNull():
            self._plot.say(no_plot)
        else:
            self._plot.show_picture(picture)

    def _show_running(self, running: bool) -> None:
        had_keyboard = self._cancel.hasFocus()
        self._progress.setVisible(running)
        self._cancel.setVisible(running)
        self._measure.setVisible(not running)
        self._save.setEnabled(bool(self.run.files))
        if had_keyboard and not running:
            self._measure.setFocus(Qt.FocusReason.OtherFocusReason)

    def _ask_and_save(self) -> None:
        self._words.setText(ask_and_save(self.run, self._preferences, self) or self._words.text())


def _button(name: str, text: str, hint: str) -> QPushButton:
    button = QPushButton(text)
    button.setObjectName(name)
    button.setToolTip(hint)
    button.setAccessibleDescription(hint)
    button.setAutoDefault(False)
    return button
