"""Help > Accuracy and speed: what is promised, what is measured now, and a benchmark to run."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent, QPixmap, QShowEvent
from PySide6.QtWidgets import QDialog, QHBoxLayout, QTabWidget, QVBoxLayout, QWidget

from skinsource.method_comparison.table import Row
from skinsource_gui.accuracy_page.accuracy_figures import AccuracyFigures
from skinsource_gui.accuracy_page.bench_bar import BenchBar
from skinsource_gui.accuracy_page.bench_job import Measured
from skinsource_gui.accuracy_page.bench_run import BenchRun
from skinsource_gui.accuracy_page.bench_table import BenchTable
from skinsource_gui.accuracy_page.bench_table_view import bench_table_view
from skinsource_gui.accuracy_page.picture_view import PictureView
from skinsource_gui.accuracy_page.report_saving import ask_and_save
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.status.status_line import StatusLine
from skinsource_gui.widgets.page_button import page_button

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
    preferences
        Know where files were last written.
    document
        Has the design, on whose limb can be measured.
    """

    def __init__(
        self,
        runner: JobRunner,
        status: StatusLine,
        preferences: Preferences,
        document: Document,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle("Accuracy and speed")
        self.setObjectName("accuracy_page")
        self.resize(*_SIZE_PX)
        self._status, self._preferences = status, preferences
        self.run = BenchRun(runner, self)
        self._figures = AccuracyFigures(status)
        self._model = BenchTable(self)
        self._table = bench_table_view(self._model)
        self._plot = PictureView()
        self._plot.setObjectName("bench_plot")
        self._plot.setAccessibleName("Plot of the benchmark")
        self._tabs = QTabWidget()
        self._tabs.setObjectName("accuracy_tabs")
        self._tabs.addTab(self._figures, "Promised and measured")
        self._tabs.addTab(self._table, "Benchmark: table")
        self._tabs.addTab(self._plot, "Benchmark: plot")
        self._bar = BenchBar(self.run, document)
        self._save = page_button(
            "save_report", "Save…", "Save the report, table and plot of the benchmark"
        )
        self._close = page_button("close_page", "Close", "Close this page (Esc)")
        self._lay_out()
        self._connect()
        self._show_rows([], _NOTHING_YET)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._refresh()

    def closeEvent(self, event: QCloseEvent) -> None:
        self.run.cancel()
        super().closeEvent(event)

    def reject(self) -> None:
        # What the Esc key does; no close event comes with it.
        self.run.cancel()
        super().reject()

    def end(self) -> None:
        """Close for good: nothing of the benchmark stays behind."""
        self.close()
        self.run.close()

    def _lay_out(self) -> None:
        last = QHBoxLayout()
        last.addStretch(1)
        last.addWidget(self._save)
        last.addWidget(self._close)
        column = QVBoxLayout(self)
        column.addWidget(self._tabs, 1)
        column.addWidget(self._bar)
        column.addLayout(last)

    def _connect(self) -> None:
        self._status.changed.connect(self._refresh)
        self._bar.began.connect(lambda: self._show_rows([], _NOTHING_YET))
        self.run.done.connect(self._show_results)
        self._save.clicked.connect(self._ask_and_save)
        self._close.clicked.connect(self.close)

    def _refresh(self) -> None:
        if self.isVisible():
            self._figures.refresh()

    def _show_results(self, measured: Measured) -> None:
        problem = measured.no_plot
        self._show_rows(list(measured.rows), f"{problem[:1].upper()}{problem[1:]}")
        self._tabs.setCurrentWidget(self._table)
        self._table.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_rows(self, rows: list[Row], no_plot: str) -> None:
        self._model.show_rows(rows)
        self._figures.show_rows(rows)
        self._save.setEnabled(bool(self.run.files))
        picture = QPixmap() if self.run.plot is None else QPixmap(str(self.run.plot))
        if picture.isNull():
            self._plot.say(no_plot)
        else:
            self._plot.show_picture(picture)

    def _ask_and_save(self) -> None:
        words = ask_and_save(self.run, self._preferences, self)
        if words:
            self._bar.say(words)
