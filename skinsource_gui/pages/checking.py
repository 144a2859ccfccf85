"""The page on which predictions of designs are checked, alone and against recordings.

It holds a table of designs, a job that checks them, and box plots of what was found by frequency.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, cast

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QLineF, QPointF, QRectF

from skinsource.base.conventions import Axes as PublishedAxes
from skinsource.base.conventions import Floats
from skinsource.base.errors import SkinSourceError, Stopped, printable, sentence
from skinsource.base.job import Job, Progress, Stop
from skinsource.design.design import Design
from skinsource.design.design_file import open_design
from skinsource.limbs.own_limbs import facts_of
from skinsource.readers.reading_process import ReadingProcess
from skinsource.studies.checking import (
    FIGURES,
    Condition,
    Recorded,
    by_frequency,
    condition_of,
    quartiles,
    write_report,
)
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.units import minus
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.plots.figure import Axes, Axis, Figure, fitted_axes
from skinsource_gui.plots.ranges import Tick
from skinsource_gui.qt.fitting import fit_to_letters
from skinsource_gui.qt.labels import RowTable
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.questions import ask_open
from skinsource_gui.qt.resources import choice_of, columns_of, number_named
from skinsource_gui.qt.theme import UNIT_PX, current_theme
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobRunner, PageJobs
from skinsource_gui.state.preferences import Preferences

_WIDEST_PX = 40.0
_NOTHING = "Channels above twice the noise appear here"


@dataclass(frozen=True, slots=True, kw_only=True)
class _GroupAxis(Axis):
    """An axis with a label in the middle of each group."""

    labels: tuple[str, ...]

    def ticks(self, length_px: float, each_px: float) -> tuple[Tick, ...]:
        return tuple(Tick(value=rank + 0.5, label=label) for rank, label in enumerate(self.labels))


class BoxFigure(Figure):
    """Draws whiskers, box and median of each group.

    Parameters
    ----------
    name
        Object name.
    title
        Title of the y axis, with its unit.
    """

    def __init__(self, name: str, title: str) -> None:
        super().__init__(name, title)
        self._title = title
        self.groups: Sequence[tuple[str, Floats]] = ()
        self.say(_NOTHING)

    def show_groups(self, groups: Sequence[tuple[str, Floats]]) -> None:
        """Show groups, each a label and its values."""
        self.groups = [(label, values) for label, values in groups if values.size]
        self.say("" if self.groups else _NOTHING)

    def draw(self, painter: QtGui.QPainter, room: QRectF) -> None:
        boxes = [quartiles(values) for _, values in self.groups]
        low = min(0.0, *(box[0] for box in boxes))
        high = max(1e-9, *(box[4] for box in boxes))
        edge = 0.05 * (high - low)
        labels = tuple(label for label, _ in self.groups)
        x = _GroupAxis(shown=(0.0, float(len(boxes))), title="Peak frequency (Hz)", labels=labels)
        y = Axis(shown=(low - (edge if low < 0.0 else 0.0), high + edge), title=self._title)
        self.axes = axes = fitted_axes(room, x, y, QtGui.QFontMetricsF(painter.font()))
        axes.paint(painter, current_theme(), grid=False)
        for rank, box in enumerate(boxes):
            self._paint_box(painter, axes, rank, box)

    def read(self, at: QPointF) -> str:
        position = None if self.axes is None else self.axes.value_at(at)
        if position is None or not self.groups:
            return ""
        rank = min(max(int(position[0]), 0), len(self.groups) - 1)
        label, values = self.groups[rank]
        first, low, middle, high, last = (minus(f"{value:.3g}") for value in quartiles(values))
        return (
            f"{label} Hz: median {middle}, quartiles {low} to {high}, whiskers {first} to {last}, "
            f"{values.size} channels"
        )

    def _paint_box(
        self, painter: QtGui.QPainter, axes: Axes, rank: int, levels: tuple[float, ...]
    ) -> None:
        theme = current_theme()
        points = axes.to_screen(np.full(5, rank + 0.5), np.array(levels))
        x = float(points[0, 0])
        first, bottom, middle, top, last = (float(y) for y in points[:, 1])
        wide = min(0.5 * axes.frame.width() / len(self.groups), _WIDEST_PX)
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.dim), 1.5))
        painter.drawLine(QLineF(x, first, x, last))
        for end in (first, last):
            painter.drawLine(QLineF(x - wide / 4, end, x + wide / 4, end))
        fill = QtGui.QColor(theme.accent)
        painter.setPen(QtGui.QPen(fill, 1.5))
        painter.setBrush(QtGui.QColor(theme.base))
        box = QRectF(x - wide / 2, top, wide, max(bottom - top, 0.5))
        painter.drawRect(box)
        fill.setAlphaF(0.25)
        painter.setBrush(fill)
        painter.drawRect(box)
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.text), 2.0))
        painter.drawLine(QLineF(x - wide / 2, middle, x + wide / 2, middle))


TITLE = "Check against a recording"
CHECKING = "Checking against recordings"
# Steps of one design: predicted, checked, read.
_STEPS = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A design, and the recording that it is checked against.

    Attributes
    ----------
    name
        Name of the design in the report.
    design
        The design as it was when the row was added.
    recording
        File of measured responses; None: none was chosen.
    result
        The condition, or why it could not be checked; None: not checked yet.
    """

    name: str
    design: Design
    recording: Path | None = None
    result: Condition | str | None = None


def check_rows(
    rows: Sequence[Row],
    axes: str,
    rate_hz: float,
    *,
    progress: Progress,
    stop: Stop,
) -> tuple[Condition | str, ...]:
    """Check each row; return its condition, or why it could not be checked.

    Parameters
    ----------
    rows
        The designs and their recordings.
    axes
        Axes that were recorded; empty: all of the limb.
    rate_hz
        Sample rate of recordings whose files do not state one.
    progress, stop
        As for all long work.
    """
    results: list[Condition | str] = []
    with ReadingProcess() as process:
        for number, row in enumerate(rows):

            def tell(done: int, total: int, text: str, before: int = number) -> None:
                progress(before * _STEPS + done, len(rows) * _STEPS, text)

            recorded = (
                None if row.recording is None else Recorded(path=row.recording, rate_hz=rate_hz)
            )
            try:
                results.append(
                    condition_of(
                        row.design,
                        row.name,
                        recorded,
                        axes=cast(PublishedAxes, axes),
                        process=process,
                        progress=tell,
                        stop=stop,
                    )
                )
            except Stopped:
                raise
            except SkinSourceError as error:
                results.append(str(error))
    return tuple(results)


_CHANNELS = "Channels"
_COLUMNS = columns_of("checking")


def _cells(row: Row) -> list[tuple[str, str]]:
    """Return text and tooltip of each cell."""
    result, hints = row.result, dict.fromkeys(_COLUMNS, "")
    if isinstance(result, str):
        hints = dict.fromkeys(_COLUMNS, sentence(result))
    elif result is not None and result.agreement is not None:
        hints[_CHANNELS] = f"{result.noise_text[0].upper()}{result.noise_text[1:]}"
    texts = zip(_texts(row), hints.values(), strict=True)
    return [(text, hint or text) for text, hint in texts]


def _texts(row: Row) -> list[str]:
    recording = "–" if row.recording is None else row.recording.name
    result = row.result
    if not isinstance(result, Condition):
        return [row.name, recording, *([""] * (len(_COLUMNS) - 2))]
    texts = [_text(result.frequency_hz, "silent"), _text(result.linear), _text(result.superposed)]
    if result.agreement is None:
        texts += ["–"] * 5
    else:
        counted = result.agreement.counted
        texts += [f"{int(counted.sum())} of {counted.size}"]
        texts += [_text(value) for value in result.agreement.medians]
        texts += [str(result.shift_samples)]
    return [row.name, recording, *(minus(text) for text in texts)]


def _text(value: float, otherwise: str = "–") -> str:
    return f"{value:.3g}" if np.isfinite(value) else otherwise


_RECORDINGS = "Recordings (*.csv *.tsv *.txt *.npy *.npz *.mat *.h5 *.hdf5);;All files (*)"
_DESIGNS = "Designs (*.skinsource);;All files (*)"


_ALL = "all"
_AXES = choice_of("recording_axes")
_RATE = number_named("rate_of_checked")
_BEGIN = (
    "Choose a recording of the design: an array of times × outputs × axes, or a column for each "
    "output and axis. Without one, the check is whether the prediction is linear."
)
_AGAIN = "Now press Check."
_REPORTED = "The paper reports errors {0}, differences in amplitude {1} and r {2}."
_SIZE_PX = (1080, 620)


class CheckingPage(ToolPage):
    """Compares predictions with measurements, as the paper's Fig. 4 does, and writes a report."""

    def __init__(
        self,
        runner: JobRunner,
        document: Document,
        preferences: Preferences,
        parent: QtWidgets.QWidget,
    ) -> None:
        super().__init__(parent, "checking_page", TITLE, _SIZE_PX)
        self._preferences = preferences
        self.run = PageJobs(runner, self)
        self.rows: tuple[Row, ...] = (Row(name=_name_of(document), design=document.design),)
        self.table = RowTable("check_table", "Designs that are checked", _COLUMNS, wide=(0, 1))
        self.axes, self.rate = ChoiceField(_AXES), NumberField(_RATE)
        self.axes.set_value(_ALL)
        self.rate.set_value(facts_of(document.design.limb).sample_rate_hz)
        self.boxes = tuple(
            BoxFigure(f"check_boxes_{k}", f"{title} ({unit})" if unit else title)
            for k, (title, unit, _) in enumerate(FIGURES)
        )
        self.say(_BEGIN)
        self._check = self.add_button(
            "check_designs", "Check", "Check all designs in the table", self.check
        )
        self._save = self.add_button(
            "save_report", "Save report…", "Save the results as HTML", self._ask_and_save
        )
        self._close = self.add_button(
            "close_page", "Close", "Close, and stop the check", self.close
        )
        self._lay_out()
        # Results hold for the axes and the rate that they were computed with.
        self.axes.edited.connect(self._begin_anew)
        self.rate.edited.connect(self._begin_anew)
        for box in self.boxes:
            box.reading.connect(self.say_reading)
        self.run.changed.connect(self._show)
        self.follow_jobs(self.run, self._take)
        self.finished.connect(self.run.give_up)
        self._show()

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """The results of the rows that could be checked."""
        return tuple(row.result for row in self.rows if isinstance(row.result, Condition))

    def add_design(self, path: Path) -> None:
        """Add the design of a file."""
        try:
            design = open_design(path).design
        except SkinSourceError as error:
            self.complain(str(error))
            return
        self._set_rows((*self.rows, Row(name=path.name, design=design)))
        self.table.setCurrentCell(len(self.rows) - 1, 0)

    def take_recording(self, path: Path) -> None:
        """Choose the recording of the selected design."""
        rows, chosen = list(self.rows), self.table.currentRow()
        if 0 <= chosen < len(rows):
            rows[chosen] = replace(rows[chosen], recording=path, result=None)
            self._set_rows(tuple(rows))
            self.say(f"{printable(path.name)} is chosen for {rows[chosen].name}. {_AGAIN}")

    def check(self) -> None:
        """Check all rows."""
        axes = "" if self.axes.value == _ALL else self.axes.value
        work = partial(check_rows, self.rows, axes, self.rate.value_si)
        self.run.add(Job(CHECKING, work))

    def save(self, path: Path) -> None:
        """Write the report, as the command ``check`` does."""
        limbs = (row.design.limb for row in self.rows if isinstance(row.result, Condition))
        write = partial(write_report, path, self.conditions, limbs)
        self.save_as(path, write, self._preferences)

    def _lay_out(self) -> None:
        recording = self.add_button(
            "choose_recording",
            "Recording…",
            "Choose the recording of the selected design",
            partial(self._ask, "Choose a recording", _RECORDINGS, self.take_recording),
        )
        self._add = self.add_button(
            "add_design",
            "Add design…",
            "Check another design as well",
            partial(self._ask, "Add a design", _DESIGNS, self.add_design),
        )
        remove = self.add_button(
            "remove_design", "Remove", "Remove the selected design from the list", self._remove
        )
        self._row_buttons = recording, remove
        bar = in_row(recording, self._add, remove, None)
        for field, spec, width_px in ((self.axes, _AXES, 150), (self.rate, _RATE, 110)):
            label = QtWidgets.QLabel(spec.label)
            label.setBuddy(field)
            fit_to_letters(field, width_px)
            bar.addWidget(label)
            bar.addWidget(field)
        plots = in_row(*((box, 1) for box in self.boxes))
        below = in_row((self.message, 1), self._check, self._save, self._close)
        top = in_column(bar, (self.table, 1), gap_px=UNIT_PX)
        in_column((top, 2), (plots, 3), below, of=self, gap_px=UNIT_PX)

    def _begin_anew(self) -> None:
        """Clear the results and the message about them."""
        self._set_rows(tuple(replace(row, result=None) for row in self.rows))
        has_recording = any(row.recording is not None for row in self.rows)
        self.say(_AGAIN if has_recording else _BEGIN)

    def _ask(self, title: str, kinds: str, take: Callable[[Path], None]) -> None:
        path = ask_open(self, title, kinds, self._preferences.folder)
        if path is not None:
            take(path)

    def _remove(self) -> None:
        chosen = self.table.currentRow()
        self._set_rows(tuple(row for k, row in enumerate(self.rows) if k != chosen))

    def _set_rows(self, rows: tuple[Row, ...]) -> None:
        self.rows = rows
        self._show()

    def _ask_and_save(self) -> None:
        start = self._preferences.folder / "check.html"
        path = self.ask_save("Save the report", "HTML (*.html)", start)
        if path is not None:
            self.save(path)

    def _show(self) -> None:
        """Show the results, and enable what can be done now."""
        runs, conditions = self.run.busy, self.conditions
        for k, box in enumerate(self.boxes):
            box.show_groups(by_frequency(conditions, k))
        self._add.setEnabled(not runs)
        for button in (*self._row_buttons, self._check):
            button.setEnabled(bool(self.rows) and not runs)
        self.table.fill([_cells(row) for row in self.rows], max(self.table.currentRow(), 0))
        self._save.setEnabled(bool(conditions) and not runs)

    def _take(self, _job: Job[Any], results: Sequence[Condition | str]) -> None:
        pairs = zip(self.rows, results, strict=True)
        self._set_rows(tuple(replace(row, result=result) for row, result in pairs))
        problems = [result for result in results if isinstance(result, str)]
        if problems:
            self.complain(problems[0])
        elif any(condition.agreement is not None for condition in self.conditions):
            self.say(_REPORTED.format(*(reported for _, _, reported in FIGURES)))
        else:
            self.say("Checked. Choose a recording to compare with.")


def _name_of(document: Document) -> str:
    """Return the name of the open design in a report, which says where it is not the file's."""
    if document.path is None:
        return document.design.title or "This design"
    edited = ", with unsaved edits" if document.modified else ""
    return f"{document.path.name}{edited}"
