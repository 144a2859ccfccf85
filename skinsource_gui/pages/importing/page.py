"""The page on which a recording is examined and chosen before it is placed in the design.

A worker reads the file; the page shows what the file holds and what would be imported.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import monotonic

from PySide6 import QtWidgets
from PySide6.QtCore import QObject, Signal

from skinsource.base.arrays import Floats
from skinsource.base.errors import SkinSourceError, Stopped, counted
from skinsource.base.files import path_text
from skinsource.base.job import Job, Progress, Stop, stop_if
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.recordings import (
    ImportChoice,
    RawPart,
    Taken,
    at_common_peak,
    read_for,
    read_part,
)
from skinsource.design.waveforms.samples import Recording
from skinsource.limbs.limb import LimbFacts
from skinsource.readers.limits import MOST_PART_S
from skinsource.readers.reader import Found, Series
from skinsource.readers.reading_process import ReadingProcess
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.pages.importing.form import (
    ASSUMED_RATE_HZ,
    ChoiceForm,
    ImportPreview,
    OverviewStrip,
)
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.qt.buttons import Answer, answers, page_label, progress_bar
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.worker import Worker, fault_text

# Reading that takes longer is given up for a newer request.
_PATIENCE_S = 0.5
# Columns of the picture of the whole recording.
_COLUMNS = 600


_PART, _OVERVIEW = "part", "overview"
#: What is imported of each signal.
Choices = tuple[ImportChoice, ...]


class ReadingWorker(Worker):
    """Inspects a file and imports parts of it; samples in memory are not read again.

    Parameters
    ----------
    path
        The file.
    to_hz
        Sample rate of the imported parts.
    """

    #: The choices that failed, None for the inspection of the file, and a sentence on why.
    failed = Signal(object, str)
    #: `Found`.
    inspected = Signal(object)
    #: `RawPart` that was read for the present choice.
    read = Signal(object)
    #: Each `ImportChoice`, and its `Taken`.
    converted = Signal(object, object)
    #: Key of a series, and the least and largest of each stretch of it, (2, columns).
    surveyed = Signal(str, object)
    #: Samples read, and of how many.
    progressed = Signal(int, int)

    def __init__(self, path: Path, to_hz: float, parent: QObject | None = None) -> None:
        super().__init__("skinsource-import", parent)
        self._path, self._to_hz = path, to_hz
        self._process = ReadingProcess()
        self._found: Found | None = None
        self._raw: dict[object, RawPart] = {}

    def look(self) -> None:
        """Find out what the file holds."""
        self.run_newest(_PART, self._look, partial(self._receive, None))

    def take(self, choices: Choices) -> None:
        """Import signals in place of those before."""
        work = partial(self._import, choices)
        self.run_newest(_PART, work, partial(self._receive, choices))

    def survey(self, series: Series) -> None:
        """Compute the picture of a whole series once nothing else is to be done."""
        self.run_newest(_OVERVIEW, partial(self._read_overview, series), again=True)

    def end(self) -> None:
        """Stop reading, and the process that reads."""
        self.close()
        self._process.close()

    def _receive(self, choices: Choices | None, _: None, error: Exception | None) -> None:
        if error is not None and not isinstance(error, Stopped):
            self.failed.emit(choices, fault_text(error))

    def _look(self) -> None:
        self._found = self._process.look(self._path, stop=lambda: self.closed)
        self.tell(self.inspected.emit, self._found)

    def _import(self, choices: Choices) -> None:
        job = Job(f"Importing {self._path.name}", partial(self._take, choices))
        self.tell(self.converted.emit, choices, job.run(self._tell_progress, self._stop()))

    def _read_overview(self, series: Series) -> None:
        try:
            extremes = self._process.overview(
                self._path, series.key, series.n_samples, _COLUMNS, stop=self._should_wait
            )
        except SkinSourceError as error:
            if isinstance(error, Stopped):
                raise  # it is tried again later, unless the page is closed
            return  # the import of the part reports the error
        self.tell(self.surveyed.emit, series.key, extremes)

    def _should_wait(self) -> bool:
        return self.is_outdated(_PART) or self.is_outdated(_OVERVIEW)

    def _take(self, choices: Choices, *, progress: Progress, stop: Stop) -> tuple[Taken, ...]:
        if self._found is None:
            raise Stopped  # the file was not inspected yet
        wanted = {read_for(choice) for choice in choices}
        self._raw = {key: raw for key, raw in self._raw.items() if key in wanted}
        for choice in choices:
            if read_for(choice) not in self._raw:
                self._raw[read_for(choice)] = read_part(
                    self._path,
                    self._found,
                    choice,
                    process=self._process,
                    progress=progress,
                    stop=stop,
                )
        raw = [self._raw[read_for(choice)] for choice in choices]
        self.tell(self.read.emit, raw[0])
        stop_if(stop)
        together = len(choices) > 1 and choices[0].scale == "peak"
        if together:
            # Each by its own peak would lose how strong they are beside each other.
            choices = tuple(replace(choice, scale="keep") for choice in choices)
        parts = tuple(
            part.converted(choice, self._to_hz) for part, choice in zip(raw, choices, strict=True)
        )
        return at_common_peak(parts) if together else parts

    def _stop(self) -> Stop:
        until_s = monotonic() + _PATIENCE_S

        def stop() -> bool:
            return self.closed or (self.is_outdated(_PART) and monotonic() > until_s)

        return stop

    def _tell_progress(self, done: int, total: int, _: str) -> None:
        self.tell(self.progressed.emit, done, total)


_LEFT_PX = 300
_READING = "Reading…"
_ASSUMED = f"The file does not state its sample rate; {ASSUMED_RATE_HZ:g} Hz is assumed."


class ImportPage(ToolPage):
    """Shows what a file holds, asks what it leaves open, and shows what will be imported.

    Parameters
    ----------
    path
        The file.
    limb
        Limb of the design, with its rate and band.
    places
        Name and text of each place that the recording can go to, the likeliest one first.
    put_at
        Makes the edit that puts recordings at one of them, which says where that is.
    """

    #: A `skinsource.design.waveforms.samples.Recording` for each signal; the name of the place.
    chosen = Signal(object, str)

    def __init__(
        self,
        path: Path,
        limb: LimbFacts,
        places: tuple[tuple[str, str], ...],
        put_at: Callable[[tuple[Recording, ...], str], Edit | Refusal],
        parent: QtWidgets.QWidget | None = None,
    ) -> None:
        super().__init__(parent, "import_page", f"Import {path_text(Path(path.name))}", (820, 520))
        self._band_hz = limb.band_hz
        self.form: ChoiceForm | None = None
        self._recordings: tuple[Recording, ...] = ()
        self._surveyed = ""
        self._about = page_label("import_about", _READING)
        self._warning = page_label("import_warning", _ASSUMED, tone="warning")
        self._place = ChoiceField(ChoiceSpec(label="Destination", options=places))
        self._put_at, self._where = put_at, page_label("import_where", tone="dim")
        self.preview, self._strip = ImportPreview(), OverviewStrip(MOST_PART_S)
        self._strip.hide()
        self._bar = progress_bar("import_progress", "Progress of reading", keeps_room=True)
        self._bar.setRange(0, 0)
        self._buttons = answers(self)
        self._import_button = self._buttons.button(Answer.Ok)
        self._import_button.setText("Import")
        self._import_button.setEnabled(False)
        self._place.setObjectName("import_place")
        self._warning.hide()
        left = QtWidgets.QWidget()
        left.setFixedWidth(_LEFT_PX)
        place = QtWidgets.QLabel("Destination"), self._place, self._where
        parts = self._about, self._warning, None, *place
        self._left = in_column(*parts, of=left, margins=0, gap_px=UNIT_PX)
        right = in_column(self._strip, (self.preview, 1), gap_px=UNIT_PX)
        columns = in_row(left, (right, 1), gap_px=2 * UNIT_PX)
        in_column((columns, 1), self._bar, self._buttons, of=self)
        self.preview.show_message(_READING)
        self._worker = ReadingWorker(path, limb.sample_rate_hz, self)
        worker = self._worker
        worker.inspected.connect(self._show_contents)
        worker.read.connect(self._show_read)
        worker.converted.connect(self._show_taken)
        worker.surveyed.connect(self._show_overview)
        worker.failed.connect(self._show_failed)
        worker.progressed.connect(self._show_progress)
        self._place.edited.connect(self._show_where)
        self._worker.look()

    @property
    def busy(self) -> bool:
        """Whether the latest choice is not shown yet."""
        return self._bar.isVisible()

    @property
    def ready(self) -> bool:
        """Whether the latest choice is shown and can be imported."""
        return self._import_button.isEnabled()

    def done(self, result: int) -> None:
        """Close the page, with or without a recording."""
        recordings, place = self._recordings, self._place.value
        self._worker.end()
        super().done(result)
        if result == QtWidgets.QDialog.DialogCode.Accepted and recordings:
            self.chosen.emit(recordings, place)

    def _show_contents(self, contents: Found) -> None:
        self._about.setText(about(contents))
        self.form = ChoiceForm(contents, self)
        self.form.changed.connect(self._import)
        self._left.insertWidget(2, self.form)
        self._strip.part_chosen.connect(self.form.take_part)
        self._import(self.form.choice)

    def _import(self, choice: ImportChoice) -> None:
        self._recordings = ()
        self._import_button.setEnabled(False)
        self._warning.setVisible(self.form is not None and self.form.assumes_rate)
        self.preview.set_pale(True)
        self._bar.show()
        self._bar.setRange(0, 0)
        self._worker.take((choice,) if self.form is None else self.form.choices)
        self._show_part(choice)

    def _show_part(self, choice: ImportChoice) -> None:
        form = self.form
        lasts_s = form.lasts_s if form is not None else None
        self._strip.setVisible(lasts_s is not None)
        if form is None or lasts_s is None:
            return
        self._strip.show_part(lasts_s, choice.start_s, choice.duration_s)
        if self._surveyed != choice.series:
            self._surveyed = choice.series
            self._strip.show_extremes(None)
            self._worker.survey(form.series)

    def _show_overview(self, key: str, extremes: Floats) -> None:
        if self.form is not None and key == self.form.choice.series:
            self._strip.show_extremes(extremes)

    def _show_read(self, raw: RawPart) -> None:
        if self.form is not None:
            self.form.show_missing(raw.n_missing)
            self._strip.show_landmarks(raw.landmarks_s)
            self.form.show_length(raw.lasts_s)
            self._show_part(self.form.choice)

    def _show_taken(self, choices: Choices, taken: tuple[Taken, ...]) -> None:
        if self.form is None or choices != self.form.choices:
            return
        self._recordings = tuple(part.waveform for part in taken)
        self._bar.hide()
        self.preview.show_part(taken, choices[0], self._band_hz)
        self._import_button.setEnabled(True)
        self._import_button.setDefault(True)
        self._show_where()

    def _show_where(self, *_: object) -> None:
        """Say where the recordings will be; while they are read it is not known."""
        if self._recordings:
            edit = self._put_at(self._recordings, self._place.value)
            self._where.setText(edit.said if isinstance(edit, Edit) else edit.sentence)

    def _show_failed(self, choices: Choices | None, reason: str) -> None:
        if choices is None:
            self._about.setText("This file cannot be imported.")
        elif self.form is None or choices != self.form.choices:
            return
        self._bar.hide()
        self.preview.show_message(reason)

    def _show_progress(self, done: int, total: int) -> None:
        self._bar.setRange(0, 1000)
        self._bar.setValue(1000 * done // max(total, 1))


def about(contents: Found) -> str:
    """Return a few lines on the content of a file."""
    signals = contents.signals()
    signal = signals[0]
    rate_hz = contents.rate_of(signal)
    many = f"{len(signals)} signals" if len(signals) > 1 else "one signal"
    facts = [f"{contents.format}, {many} of {counted(signal.n_samples, 'sample')}"]
    if rate_hz is not None:
        facts.append(f"{rate_hz:g} Hz, {signal.n_samples / rate_hz:.4g} s")
    if signal.unit:
        facts.append(f"in {signal.unit}")
    # Numbers stay with their units.
    text = ", ".join(fact.replace(" Hz", "\u00a0Hz").replace(" s", "\u00a0s") for fact in facts)
    return text + "." + "".join(f"\n{note}" for note in contents.notes[:3])
