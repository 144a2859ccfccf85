"""The page on which designs are checked, alone and against recordings."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QFileDialog, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from skinsource.base.errors import SkinSourceError
from skinsource.base.job import Job
from skinsource.base.quoting import sentence
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.fields import ChoiceSpec, NumberSpec
from skinsource.studies.checking import FIGURES, Condition, by_frequency, write_report
from skinsource_gui.checking_page.boxes import BoxFigure
from skinsource_gui.checking_page.check_list import CheckList
from skinsource_gui.checking_page.checking import CHECKING, TITLE, Row, check_rows
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.page_job import PageJob
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.page_button import page_button
from skinsource_gui.widgets.room.letter_width import LetterWidth

_ALL = "all"
_AXES = ChoiceSpec(
    label="Axes",
    options=((_ALL, "All of the limb"), ("x", "x"), ("y", "y"), ("z", "z")),
    hint="Along which axes was recorded",
)
_RATE = NumberSpec(
    label="Rate",
    unit="Hz",
    minimum=1.0,
    maximum=768_000.0,
    hint="Of recordings that say none themselves; other rates than that of the limb are resampled",
)
_BEGIN = (
    "Choose a recording of the design: an array of times × outputs × axes, or a column for each "
    "output and axis. Without one it is checked whether the prediction is linear."
)
_AGAIN = "Now press Check."
_REPORTED = "The paper reports errors {0}, differences in amplitude {1} and r {2}."
_SIZE_PX = (1080, 620)


class CheckingPage(QDialog):
    """Holds predictions against measurements, as the paper's Fig. 4 does, and writes a report.

    Parameters
    ----------
    runner, document, preferences
        Who checks, whose design, and where files were taken from last.
    """

    def __init__(
        self,
        runner: JobRunner,
        document: Document,
        preferences: Preferences,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName("checking_page")
        self.setWindowTitle(TITLE)
        self.resize(*_SIZE_PX)
        self._preferences = preferences
        self.run = PageJob(runner, self)
        row = Row(name=_name_of(document), design=document.design)
        self.list = CheckList((row,), preferences)
        self.axes, self.rate = ChoiceField(_AXES), NumberField(_RATE)
        self.axes.set_value(_ALL)
        self.rate.set_value(facts_of(document.design.limb).sample_rate_hz)
        self.boxes = tuple(
            BoxFigure(f"check_boxes_{k}", f"{title} ({unit})" if unit else title)
            for k, (title, unit, _) in enumerate(FIGURES)
        )
        self.words = QLabel(_BEGIN)
        self.words.setObjectName("check_words")
        self.words.setWordWrap(True)
        self._check = page_button("check_designs", "Check", "Check all designs in the table")
        self._save = page_button("save_report", "Save report…", "Save what was found as HTML")
        self._close = page_button("close_page", "Close", "Close; what is being checked is given up")
        self._lay_out()
        self._connect()
        self._show()

    def check(self) -> None:
        """Check all of them."""
        axes = "" if self.axes.value == _ALL else self.axes.value
        work = partial(check_rows, tuple(self.list.rows), axes, self.rate.value_si)
        self.run.start(Job(CHECKING, work))
        self._show()

    def save(self, path: Path) -> None:
        """Write the report, as the command ``check`` does."""
        rows = self.list.rows
        limbs = (row.design.limb for row in rows if isinstance(row.result, Condition))
        try:
            write_report(path, self.list.conditions, limbs)
        except SkinSourceError as error:
            self._complain(str(error))
            return
        self._preferences.folder = path.parent
        self._say(f"Saved {path.name}.")

    def _lay_out(self) -> None:
        for field, spec, width_px in ((self.axes, _AXES, 150), (self.rate, _RATE, 110)):
            label = QLabel(spec.label)
            label.setBuddy(field)
            LetterWidth(field, width_px)
            self.list.bar.addWidget(label)
            self.list.bar.addWidget(field)
        plots = QHBoxLayout()
        for box in self.boxes:
            plots.addWidget(box, 1)
        below = QHBoxLayout()
        below.addWidget(self.words, 1)
        for button in (self._check, self._save, self._close):
            below.addWidget(button)
        column = QVBoxLayout(self)
        column.setSpacing(UNIT_PX)
        column.addWidget(self.list, 2)
        column.addLayout(plots, 3)
        column.addLayout(below)

    def _connect(self) -> None:
        self._check.clicked.connect(self.check)
        self._save.clicked.connect(self._ask_and_save)
        self._close.clicked.connect(self.close)
        self.list.changed.connect(self._show)
        self.list.failed.connect(self._complain)
        self.list.took.connect(self._say)
        # What was found was found along other axes, or at another rate.
        self.axes.chosen.connect(self._begin_anew)
        self.rate.edited.connect(self._begin_anew)
        for box in self.boxes:
            box.reading.connect(self._read)
        self.run.progressed.connect(lambda progress: self._say(f"{progress.text}…"))
        self.run.done.connect(self._take)
        self.run.ended.connect(self._note_ended)
        self.finished.connect(self.run.give_up)

    def _begin_anew(self) -> None:
        """What was said is of something else, and what was found."""
        self.list.forget_results()
        taken = any(row.recording is not None for row in self.list.rows)
        self._say(_AGAIN if taken else _BEGIN)

    def _ask_and_save(self) -> None:
        start = str(self._preferences.folder / "check.html")
        name, _ = QFileDialog.getSaveFileName(self, "Save the report", start, "HTML (*.html)")
        if name:
            self.save(Path(name))

    def _show(self) -> None:
        """Show what is known, and offer what can be done now."""
        runs, conditions = self.run.runs, self.list.conditions
        for k, box in enumerate(self.boxes):
            box.show_groups(by_frequency(conditions, k))
        self.list.show_running(runs)
        self._check.setEnabled(bool(self.list.rows) and not runs)
        self._save.setEnabled(bool(conditions) and not runs)

    def _take(self, results: Sequence[Condition | str]) -> None:
        self.list.take_results(results)
        problems = [one for one in results if isinstance(one, str)]
        if problems:
            self._complain(problems[0])
        elif any(one.agreement is not None for one in self.list.conditions):
            self._say(_REPORTED.format(*(reported for _, _, reported in FIGURES)))
        else:
            self._say("Checked. Choose a recording to hold it against.")

    def _note_ended(self, reason: str) -> None:
        self._show()
        self._complain(reason)

    def _read(self, words: str) -> None:
        if words:
            self._say(words)

    def _say(self, words: str) -> None:
        set_tone(self.words, "")
        self.words.setText(words)

    def _complain(self, reason: str) -> None:
        set_tone(self.words, "error")
        self.words.setText(sentence(reason))


def _name_of(document: Document) -> str:
    """What a report calls the open design: a file is not what was checked once it was edited."""
    if document.path is None:
        return document.design.title or "This design"
    edited = ", with unsaved edits" if document.modified else ""
    return f"{document.path.name}{edited}"
