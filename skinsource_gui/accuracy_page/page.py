"""Help > Accuracy and speed: what is promised, what is measured now, and a benchmark to run."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QCloseEvent, QPixmap, QShowEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDialog,
    QFileDialog,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QMessageBox,
    QProgressBar,
    QPushButton,
    QTableView,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from skinsource.errors import SkinSourceError
from skinsource.method_comparison.table import Row
from skinsource_gui.accuracy_page.accuracy_figures import AccuracyFigures
from skinsource_gui.accuracy_page.bench_run import BenchRun
from skinsource_gui.accuracy_page.bench_table import BenchTable, verdict
from skinsource_gui.accuracy_page.picture_view import PictureView
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
_ROW_PX = 24
_NO_ANSWER = QMessageBox.StandardButton.Cancel


class AccuracyPage(QDialog):
    """Stands beside the window; closing it ends a benchmark that runs.

    Parameters
    ----------
    status
        Knows the present figures.
    theme
        Gives the colours in use.
    preferences
        Know where files were last written.
    """

    def __init__(
        self,
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
        self.run = BenchRun(self)
        self._figures = AccuracyFigures(status)
        self._model = BenchTable(self)
        self._table = self._make_table()
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
        self._measure = self._button("measure", "Measure now", "Run skinsource bench --quick")
        self._cancel = self._button("cancel_measuring", "Cancel", "End the benchmark")
        self._save = self._button(
            "save_report", "Save…", "Save the report, table and plot of the benchmark"
        )
        self._close = self._button("close_page", "Close", "Close this page (Esc)")
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

    def _button(self, name: str, text: str, hint: str) -> QPushButton:
        button = QPushButton(text)
        button.setObjectName(name)
        button.setToolTip(hint)
        button.setAccessibleDescription(hint)
        button.setAutoDefault(False)
        return button

    def _make_table(self) -> QTableView:
        table = QTableView()
        table.setObjectName("bench_table")
        table.setAccessibleName("Table of the benchmark")
        table.setModel(self._model)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        table.setTabKeyNavigation(False)
        table.setWordWrap(False)
        table.setShowGrid(False)
        table.verticalHeader().hide()
        table.verticalHeader().setMinimumSectionSize(_ROW_PX)
        table.verticalHeader().setDefaultSectionSize(_ROW_PX)
        header = table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setStretchLastSection(True)
        header.setHighlightSections(False)
        header.setSortIndicatorShown(True)
        header.setSectionsClickable(True)
        header.setSortIndicator(-1, Qt.SortOrder.AscendingOrder)
        header.sortIndicatorChanged.connect(self._model.sort)
        return table

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
        self._show_running(True)
        self._cancel.setFocus(Qt.FocusReason.OtherFocusReason)
        self.run.start()

    def _stop(self) -> None:
        if self.run.running:
            self.run.cancel()
            self._words.setText("Cancelled. Nothing was kept.")
            self._show_running(False)

    def _show_step(self, done: int, total: int, name: str) -> None:
        self._progress.setRange(0, total)
        self._progress.setValue(done)
        self._words.setText(f"Measuring {name}: {done} of {total} rows done.")

    def _show_results(self, rows: list[Row], problem: str) -> None:
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
        chosen = QFileDialog.getExistingDirectory(
            self, "Save the benchmark in a folder", str(self._preferences.folder)
        )
        if not chosen:
            return
        folder = Path(chosen)
        there = [path.name for path in self.run.files if (folder / path.name).exists()]
        if there and not self._may_replace(there):
            return
        try:
            self.run.save(folder)
        except SkinSourceError as error:
            self._words.setText(str(error))
        else:
            self._preferences.folder = folder
            names = ", ".join(path.name for path in self.run.files)
            self._words.setText(f"Saved in {folder}: {names}.")

    def _may_replace(self, names: list[str]) -> bool:
        answer = QMessageBox.question(
            self,
            "Replace the files?",
            f"{', '.join(names)}: in that folder already. Replace?",
            QMessageBox.StandardButton.Yes | _NO_ANSWER,
            _NO_ANSWER,
        )
        return answer == QMessageBox.StandardButton.Yes
