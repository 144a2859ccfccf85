"""File > Own limbs: from a lab's files, and clicks on a photograph, to a limb."""

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import (
    QDialog,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QVBoxLayout,
    QWidget,
)

from skinsource.base.job import Job
from skinsource.base.quoting import sentence
from skinsource.limbs.limb import LimbFacts
from skinsource.limbs.limb_import import Points, import_limb
from skinsource.limbs.own_limbs import own_limb_names
from skinsource.specs.fields import ChoiceSpec
from skinsource_gui.limb_page.asking import may_replace
from skinsource_gui.limb_page.canvas import PlacesCanvas
from skinsource_gui.limb_page.draft import Draft
from skinsource_gui.limb_page.limb_form import LimbForm
from skinsource_gui.limb_page.own_list import OwnList
from skinsource_gui.limb_page.page_jobs import PageJobs
from skinsource_gui.limb_page.reader import LimbReader
from skinsource_gui.limb_page.title import IMPORTING, TITLE
from skinsource_gui.state.installed_limbs import InstalledLimbs
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.page_button import page_button

_CLICKS = ChoiceSpec(
    label="A click places",
    options=(
        ("inputs", "the next input"),
        ("outputs", "the next output"),
        ("outline", "a corner of the outline"),
        ("hand", "an end of the hand's length"),
    ),
    hint="What a click on the photograph means",
)
_KINDS = {
    "responses": "Responses (*.h5 *.hdf5 *.mat *.npy *.npz);;All files (*)",
    "outline": "Outlines (*.svg *.csv *.tsv *.txt);;All files (*)",
    "inputs": "Tables (*.csv *.tsv *.txt);;All files (*)",
    "outputs": "Tables (*.csv *.tsv *.txt);;All files (*)",
    "photograph": "Pictures (*.png *.jpg *.jpeg *.bmp *.webp);;All files (*)",
}


class LimbPage(QDialog):
    """Puts a limb together and imports it; lists those that were imported.

    Parameters
    ----------
    runner, limbs
        Who imports, and who knows which limbs there are.
    """

    def __init__(
        self,
        runner: JobRunner,
        limbs: InstalledLimbs,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName("limb_page")
        self.setWindowTitle(TITLE)
        self.resize(940, 640)
        self._limbs, self._jobs = limbs, PageJobs(runner, self)
        self.draft = Draft()
        self.reader = LimbReader(self)
        self.form, self.canvas, self.own = LimbForm(self), PlacesCanvas(), OwnList()
        self.click = ChoiceField(_CLICKS)
        self.click.setObjectName("click_places")
        self.click.set_value("inputs")
        self._back = page_button("remove_last", "Take back", "Remove the point clicked last")
        self._words = QLabel()
        self._words.setObjectName("limb_words")
        self._words.setWordWrap(True)
        self._import = page_button("import_limb", "Import", "Check all of it, and keep it")
        self._cancel = page_button("cancel_import", "Cancel", "Stop it; nothing is kept of it")
        self._close = page_button("close_page", "Close", "Close; an import goes on")
        self._lay_out()
        self._connect()
        self._show()

    def _lay_out(self) -> None:
        left = QVBoxLayout()
        left.addWidget(self.form.widget)
        left.addStretch(1)
        left.addWidget(self.own)
        clicks = QHBoxLayout()
        clicks.addWidget(QLabel(_CLICKS.label))
        clicks.addWidget(self.click, 1)
        clicks.addWidget(self._back)
        ends = QHBoxLayout()
        ends.addStretch(1)
        # Left of it, so that a double click on Import does not cancel it.
        ends.addWidget(self._cancel)
        ends.addWidget(self._import)
        ends.addWidget(self._close)
        right = QVBoxLayout()
        right.addLayout(clicks)
        right.addWidget(self.canvas, 1)
        right.addWidget(self._words)
        right.addLayout(ends)
        columns = QHBoxLayout(self)
        columns.setSpacing(2 * UNIT_PX)
        columns.addLayout(left, 5)
        columns.addLayout(right, 6)

    def _connect(self) -> None:
        self.form.changed.connect(self._show)
        self.form.file_wanted.connect(self._ask)
        self.reader.looked.connect(self._take_responses)
        self.reader.read.connect(self._take_points)
        self.reader.pictured.connect(self._take_photograph)
        self.reader.failed.connect(self._complain)
        self.canvas.clicked.connect(
            lambda x, y: self._take(self.draft.with_point(self.click.value, (x, y)))
        )
        self._back.clicked.connect(lambda: self._take(self.draft.without_last(self.click.value)))
        self._import.clicked.connect(self._start)
        self._close.clicked.connect(self.close)
        self.own.changed.connect(self._limbs.look)
        self.own.failed.connect(self._complain)
        self.own.job_wanted.connect(self._jobs.add)
        self._cancel.clicked.connect(self._jobs.cancel)
        self._jobs.changed.connect(self._show)
        self._jobs.told.connect(self._say)
        self._jobs.done.connect(self._note_done)
        self._jobs.failed.connect(self._complain)
        self._jobs.cancelled.connect(lambda: self._say("Cancelled. Nothing was changed."))
        self.finished.connect(lambda _: self.reader.end())

    def open_file(self, path: Path, what: str) -> None:
        """Take a file for ``what``."""
        if what == "photograph":
            self._words.setText(f"Reading {path.name}…")
            self.reader.read_photograph(path)
        elif what == "responses":
            self._words.setText(f"Reading {path.name}…")
            self.reader.look(path)
        else:
            self.reader.read_points(path, what)

    def _ask(self, what: str) -> None:
        name, _ = QFileDialog.getOpenFileName(self, f"Choose {what}", "", _KINDS[what])
        if name:
            self.open_file(Path(name), what)

    def _take_responses(self, path: Path, about: dict[str, Any]) -> None:
        header, in_layout = about["header"], about["header"] is not None
        if in_layout:
            shape = tuple(header["shape"])
            places: dict[str, Any] = {
                what: _points_of(header[field])
                for what, field in (
                    ("outline", "outline"),
                    ("inputs", "input_positions"),
                    ("outputs", "output_positions"),
                )
            }
            self.draft = replace(Draft(), responses=path, shape=shape, in_layout=True, **places)
            self.form.show_header(header)
        else:
            self.draft = self.draft.with_array(path)
        largest = max(about["arrays"], key=lambda one: np.prod(one["shape"]), default=None)
        if largest is not None:
            self._array_shape = tuple(largest["shape"])
        dimensions = " × ".join(map(str, shape if in_layout else self._array_shape))
        self.form.show_file("responses", f"{path.name} ({dimensions})")
        self.form.show_plain(in_layout, path)
        self._show()

    def _take_points(self, path: Path, what: str, points: Points) -> None:
        self.form.show_file(what, path.name)
        found: dict[str, Any] = {}
        if points.names and what != "outline":
            found[f"{what[:-1]}_names"] = points.names
        draft = self.draft.with_file(what, points.points, y_down=points.y_down)
        self.draft = replace(draft, **found)
        self._show()

    def _take_photograph(self, path: Path, image: QImage) -> None:
        self.form.show_file("photograph", path.name)
        # Points are pixels of it from now on; others would not lie where they should.
        nothing = Draft()
        if not self.draft.y_down:
            self.draft = replace(
                self.draft,
                y_down=True,
                tables=nothing.tables,
                turned=nothing.turned,
                outline=nothing.outline,
                inputs=nothing.inputs,
                outputs=nothing.outputs,
            )
        self.canvas.show_photograph(image)
        self._show()

    def _take(self, draft: Draft) -> None:
        self.draft = draft
        self._show()

    def _show(self) -> None:
        draft = replace(self.draft, values=self.form.values(), order=self.form.order.text().strip())
        if not draft.in_layout and draft.responses is not None:
            draft = replace(draft, shape=_shape(self._array_shape, draft.order))
        self.draft = draft
        self.canvas.show_draft(draft)
        missing = draft.missing()
        self._back.setEnabled(len(getattr(draft, self.click.value)) > 0)
        self._import.setEnabled(not missing and not self._jobs.busy)
        self._cancel.setVisible(self._jobs.busy)
        if not self._jobs.busy:
            self._say(missing or "Ready to import.")

    def _say(self, words: str, tone: str = "") -> None:
        set_tone(self._words, tone)
        self._words.setText(words)

    def _complain(self, reason: str) -> None:
        self._say(sentence(reason), "error")

    def _start(self) -> None:
        name = self.draft.values["name"]
        taken = name in own_limb_names()
        if not taken or may_replace(self, name):
            work = partial(import_limb, self.draft.source(), replace=taken)
            self._jobs.add(Job(IMPORTING, work))

    def _note_done(self, job: Job[Any], result: object) -> None:
        self._limbs.look()
        self.own.show_limbs(result.name if isinstance(result, LimbFacts) else self.own.chosen)
        if isinstance(result, LimbFacts):
            self._say(f"Imported as {result.name}. Choose it at the left of the bar.")
        else:
            self._say(f"{job.title}: done.")


def _points_of(rows: list[Any]) -> np.ndarray:
    found = [(np.nan, np.nan) if row is None else row for row in rows]
    return np.array(found, float).reshape(-1, 2)


def _shape(shape: tuple[int, ...], order: str) -> tuple[int, ...] | None:
    """Inputs, outputs, axes and taps of an array; None where the order does not fit it."""
    order = order or {3: "iot", 4: "ioat"}[len(shape)]
    if len(order) != len(shape) or not set("iot") <= set(order):
        return None
    size = dict(zip(order, shape, strict=True))
    return size["i"], size["o"], size.get("a", 1), size["t"]
