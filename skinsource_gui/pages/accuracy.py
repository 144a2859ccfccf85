"""Help > Accuracy and speed: error against run time of this program and of others.

The page measures in a job, and shows the rows as a table and as a plot.
"""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPointF, QRectF, Qt, SignalInstance

from skinsource.base.files import write_bytes
from skinsource.base.job import Job, Progress, Stop, time_left_text
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.own_limbs import facts_of
from skinsource.studies.accuracy.cases import cases_of
from skinsource.studies.accuracy.measuring import (
    COLUMNS,
    MEANING,
    QUICK_REPEATS,
    Row,
    cells_of,
    measure,
    table_csv,
)
from skinsource_gui.fields.choice_field import DropDown
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.plots.figure import Axes, Axis, Figure, fitted_axes
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.labels import RowTable
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.theme import current_theme
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobProgress, JobRunner, PageJobs
from skinsource_gui.state.preferences import Preferences

_NOTHING = "Nothing is measured yet"
_LEAST_POWER, _MOST_POWER = -17.0, 1.0
_RADIUS_PX, _OTHER_RADIUS_PX, _REACH_PX = 5.0, 2.5, 12.0
#: Names rise, so that those of neighbours do not lie on each other.
_SLOPE_DEGREES = -55.0


class AccuracyPlot(Figure):
    """Plots a point for each row, with names beside those of one case; lower left is better."""

    def __init__(self) -> None:
        super().__init__("accuracy_plot", "Error against run time")
        self._rows: Sequence[Row] = ()
        self._case = ""
        self.say(_NOTHING)

    def show_rows(self, rows: Sequence[Row]) -> None:
        """Plot ``rows``."""
        self._rows = rows
        self.say("" if rows else _NOTHING)

    def show_case(self, case: str) -> None:
        """Write names beside the rows of this case."""
        self._case = case
        self.update()

    def draw(self, painter: QtGui.QPainter, room: QRectF) -> None:
        metrics = QtGui.QFontMetricsF(painter.font())
        times_ms = [1e3 * row.time_s for row in self._rows]
        x = Axis(
            shown=(0.5 * min(times_ms), 20.0 * max(times_ms)), title="Fastest run (ms)", log=True
        )
        y = Axis(shown=(_LEAST_POWER, _MOST_POWER), title="Error (power of ten)")
        self.axes = fitted_axes(room, x, y, metrics)
        self.axes.paint(painter, current_theme())
        points = list(zip(self._rows, self._points(self.axes), strict=True))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QtGui.QColor(current_theme().dim))
        for _, point in points:
            painter.drawEllipse(point, _OTHER_RADIUS_PX, _OTHER_RADIUS_PX)
        for row, point in points:
            if row.case == self._case:
                self._paint_named(painter, row.way, point)

    def read(self, at: QPointF) -> str:
        points = [] if self.axes is None else self._points(self.axes)
        away = [(point - at).manhattanLength() for point in points]
        if not away or min(away) > _REACH_PX:
            return ""
        row = self._rows[int(np.argmin(away))]
        case, way, error, time_ms = cells_of(row)
        return f"{case}, {way}: error {error} in {time_ms} ms"

    def _points(self, axes: Axes) -> list[QPointF]:
        errors = np.array([row.error for row in self._rows])
        powers = np.log10(np.clip(errors, 10.0**_LEAST_POWER, 10.0**_MOST_POWER))
        times_ms = np.array([1e3 * row.time_s for row in self._rows])
        return [QPointF(*place) for place in axes.to_screen(times_ms, powers)]

    def _paint_named(self, painter: QtGui.QPainter, name: str, point: QPointF) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QtGui.QColor(current_theme().accent))
        painter.drawEllipse(point, _RADIUS_PX, _RADIUS_PX)
        painter.setPen(QtGui.QColor(current_theme().text))
        painter.save()
        painter.translate(point)
        painter.rotate(_SLOPE_DEGREES)
        painter.drawText(QPointF(2.0 * _RADIUS_PX, _RADIUS_PX), name)
        painter.restore()


_TITLE = "Measuring accuracy and speed"
_BEGIN = "Measuring takes about half a minute; other work would distort the times."
_CANCELLED = "Cancelled. Nothing was stored."
_SIZE_PX = (1180, 640)


def measured(limb: str, digest: str, *, progress: Progress, stop: Stop) -> tuple[Row, ...]:
    """Return the rows of a short run on a limb; on synthetic responses where none is named."""
    on = load_limb(limb, digest) if limb else None
    cases = cases_of(on, quick=True, progress=progress, stop=stop)
    return tuple(measure(cases, repeats=QUICK_REPEATS, progress=progress, stop=stop))


class Status(Protocol):
    """Reports how fast and how exact the studio is now."""

    changed: SignalInstance

    def times_and_error(self) -> str:
        """Return the times of the latest edits and the error of the traces, as sentences."""
        ...


class AccuracyPage(ToolPage):
    """Measures accuracy and speed beside the window; closing it cancels the measurement.

    Parameters
    ----------
    runner
        Runs the measurement.
    status
        Knows the times of the latest edits, and the error of the traces.
    preferences
        Know the folder of the last file.
    document
        Holds the design, on whose limb can be measured.
    """

    def __init__(
        self,
        runner: JobRunner,
        status: Status,
        preferences: Preferences,
        document: Document,
        parent: QtWidgets.QWidget,
    ) -> None:
        super().__init__(parent, "accuracy_page", "Accuracy and speed", _SIZE_PX)
        # It holds what was measured while it is closed.
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose, on=False)
        self._status = status
        self._preferences, self._document = preferences, document
        self.run = PageJobs(runner, self)
        self.rows: tuple[Row, ...] = ()
        self.table = RowTable(
            "accuracy_table", "Errors and run times", dict.fromkeys(COLUMNS, ""), wide=(1,)
        )
        self.plot = AccuracyPlot()
        self.now = page_label("accuracy_now")
        self.say(_BEGIN)
        self._limb = named(DropDown(), "accuracy_limb", "Limb to measure on")
        self._limb.setMinimumContentsLength(19)
        self._limb.addItems(["Synthetic responses", ""])
        self._measure = self.add_button(
            "measure", "Measure now", "Run skinsource bench --quick", self._start_or_cancel
        )
        self._save = self.add_button(
            "save_table", "Save table…", "Save the table as CSV", self._ask_and_save
        )
        self._close = self.add_button("close_page", "Close", "Close this page (Esc)", self.close)
        self._lay_out()
        self._status.changed.connect(self._refresh)
        self._document.changed.connect(self._name_limb)
        self.table.currentCellChanged.connect(self._choose)
        self.plot.reading.connect(self.say_reading)
        self.run.changed.connect(self._show_running)
        self.follow_jobs(self.run, self._take, progressed=self._follow, cancelled=_CANCELLED)
        self.finished.connect(self._give_up)
        self._name_limb()
        self._show_rows(())

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        super().showEvent(event)
        self._refresh()

    def save(self, path: Path) -> None:
        """Write the table."""
        write = partial(write_bytes, path, table_csv(self.rows).encode())
        self.save_as(path, write, self._preferences)

    def _lay_out(self) -> None:
        meaning = page_label("accuracy_meaning", MEANING)
        split = QtWidgets.QSplitter()
        split.addWidget(self.table)
        split.addWidget(self.plot)
        split.setSizes([_SIZE_PX[0] // 2, _SIZE_PX[0] // 2])
        limb = QtWidgets.QLabel("Limb")
        limb.setBuddy(self._limb)
        below = in_row((self.message, 1), limb, self._limb, self._measure, self._save, self._close)
        in_column(meaning, self.now, (split, 1), below, of=self)

    def _refresh(self) -> None:
        if self.isVisible():
            self.now.setText(self._status.times_and_error())

    def _name_limb(self) -> None:
        self._limb.setItemText(1, facts_of(self._document.design.limb).title)

    def _start_or_cancel(self) -> None:
        if self.run.busy:
            self._give_up()
            return
        design, chosen = self._document.design, bool(self._limb.currentIndex())
        limb = (design.limb, design.limb_digest) if chosen else ("", "")
        self._show_rows(())
        self.say("Waiting for other work…")
        self.run.add(Job(_TITLE, partial(measured, *limb)))

    def _give_up(self) -> None:
        if self.run.busy:
            self.run.give_up()
            self.say(_CANCELLED)

    def _follow(self, _job: Job[Any], step: JobProgress) -> None:
        left = time_left_text(step.seconds_left)
        self.say(f"{step.done} of {step.total}: {step.text}{f', {left}' if left else ''}")

    def _take(self, _job: Job[Any], rows: tuple[Row, ...]) -> None:
        self._show_rows(rows)
        self.say("Choose a row: the plot names its case.")
        self.table.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_running(self) -> None:
        self._measure.setText("Cancel" if self.run.busy else "Measure now")
        self._limb.setEnabled(not self.run.busy)

    def _show_rows(self, rows: tuple[Row, ...]) -> None:
        self.rows = rows
        self._save.setEnabled(bool(rows))
        self.plot.show_rows(rows)
        self.table.fill([[(text, "") for text in cells_of(row)] for row in rows])

    def _choose(self, line: int, *_: int) -> None:
        if 0 <= line < len(self.rows):
            self.plot.show_case(self.rows[line].case)

    def _ask_and_save(self) -> None:
        start = self._preferences.folder / "accuracy.csv"
        path = self.ask_save("Save the table", "CSV (*.csv)", start)
        if path is not None:
            self.save(path)
