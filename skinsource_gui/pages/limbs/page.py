"""File > Own limbs: a limb is put together from a lab's files and clicks, and imported.

The page also lists the limbs that were imported; they can be mirrored, exported and removed there.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from PySide6 import QtGui, QtWidgets

from skinsource.base.errors import SkinSourceError
from skinsource.base.job import Job
from skinsource.base.run_limited import LimitedProcess
from skinsource.limbs.limb import LimbFacts
from skinsource.limbs.limb_import import Points, import_limb, read_description, read_points
from skinsource.limbs.limb_layout import POINT_FIELDS, export_limb
from skinsource.limbs.own_limbs import facts_of, mirror_limb, own_limb_names, remove_limb
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.pages.limbs import photograph
from skinsource_gui.pages.limbs.form import Draft, LimbForm, PlacesCanvas
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.questions import ask_open, ask_yes
from skinsource_gui.qt.resources import choice_of
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.job_runner import JobProgress, JobRunner, PageJobs
from skinsource_gui.state.preferences import InstalledLimbs
from skinsource_gui.state.worker import Worker

_NO = QtWidgets.QMessageBox.StandardButton.No
_LOST = "Its responses cannot be restored"


def ask_to_replace(parent: QtWidgets.QWidget, name: str) -> bool:
    """Return whether the user gives up the limb of this name for the one that is imported."""
    return ask_yes(
        parent,
        "Replace a limb",
        f"Replace {_limb_text(name)}? {_LOST}, and its designs open read-only unless the new one "
        "has the same numbers.",
        otherwise=_NO,
    )


def may_remove(parent: QtWidgets.QWidget, name: str) -> bool:
    """Return whether the user gives up the limb of this name."""
    return ask_yes(
        parent,
        "Remove a limb",
        f"Remove {_limb_text(name)}? {_LOST}, and its designs open read-only.",
        otherwise=_NO,
    )


def _limb_text(name: str) -> str:
    title = facts_of(name).title
    return f"“{name}”" if title == name else f"“{title}” ({name})"


_NONE = "No limb was imported yet."
_DAMAGED = "Damaged; import it again."


TITLE = "Own limbs"
IMPORTING = "Importing a limb"


_CLICKS = choice_of("photograph_click")
_KINDS = {
    "responses": "Responses (*.h5 *.hdf5 *.mat *.npy *.npz);;All files (*)",
    "outline": "Outlines (*.svg *.csv *.tsv *.txt);;All files (*)",
    "inputs": "Tables (*.csv *.tsv *.txt);;All files (*)",
    "outputs": "Tables (*.csv *.tsv *.txt);;All files (*)",
    "photograph": "Pictures (*.png *.jpg *.jpeg *.bmp *.webp);;All files (*)",
}


class LimbPage(ToolPage):
    """Puts a limb together and imports it; lists the limbs that were imported."""

    def __init__(self, runner: JobRunner, limbs: InstalledLimbs, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent, "limb_page", TITLE, (940, 640))
        self._limbs, self._jobs = limbs, PageJobs(runner, self, (IMPORTING,))
        self.draft = Draft()
        self._process, self.worker = LimitedProcess(), Worker("skinsource-limb", self)
        self.form, self.canvas = LimbForm(self), PlacesCanvas()
        self.list, self._about = QtWidgets.QListWidget(), page_label("own_limb_words")
        named(self.list, "own_limbs", "Imported limbs")
        self.list.setMaximumHeight(96)
        self._mirror = self.add_button(
            "mirror_limb", "Mirror", "Show a left hand as a right one", self._turn
        )
        self._export = self.add_button(
            "export_limb", "Export…", "Write it as docs/limbs.md says", self._ask_and_export
        )
        self._remove = self.add_button(
            "remove_limb", "Remove", "Delete it from this computer", self._delete
        )
        self.click = named(ChoiceField(_CLICKS), "click_places")
        self.click.set_value("inputs")
        self._back = self.add_button(
            "remove_last",
            "Remove last",
            "Remove the point clicked last",
            lambda: self._take(self.draft.without_last(self.click.value)),
        )
        self._import = self.add_button(
            "import_limb", "Import", "Check and store the limb", self._start
        )
        self._cancel = self.add_button(
            "cancel_import", "Cancel", "Stop the import; nothing is stored", self._jobs.cancel
        )
        self._close = self.add_button(
            "close_page", "Close", "Close; an import continues", self.close
        )
        self._lay_out()
        self._connect()
        self.show_limbs()
        self._show()

    def _lay_out(self) -> None:
        buttons = in_row(self._mirror, self._export, self._remove, None)
        own = in_column(self.list, self._about, buttons, margins=0, gap_px=UNIT_PX // 2)
        left = in_column(self.form.widget, None, own)
        clicks = in_row(QtWidgets.QLabel(_CLICKS.label), (self.click, 1), self._back)
        # Cancel is left of Import, so that a double click on Import does not cancel the import.
        ends = in_row(None, self._cancel, self._import, self._close)
        right = in_column(clicks, (self.canvas, 1), self.message, ends)
        in_row((left, 5), (right, 6), of=self, gap_px=2 * UNIT_PX)

    def _connect(self) -> None:
        self.form.changed.connect(self._show)
        self.form.file_requested.connect(self._ask)
        self.canvas.clicked.connect(
            lambda x, y: self._take(self.draft.with_point(self.click.value, (x, y)))
        )
        self.list.currentRowChanged.connect(self._show_chosen)
        self._jobs.changed.connect(self._show)
        self.follow_jobs(self._jobs, self._note_done, progressed=self._show_progress)
        self.finished.connect(self._stop_reading)

    @property
    def chosen(self) -> str:
        """Name of the chosen limb; empty: none."""
        names, row = own_limb_names(), self.list.currentRow()
        return names[row] if 0 <= row < len(names) else ""

    def show_limbs(self, name: str = "") -> None:
        """List the imported limbs again, and choose ``name``."""
        names = own_limb_names()
        self.list.clear()
        for limb in names:
            facts = facts_of(limb)
            self.list.addItem(f"{facts.title} ({limb})" if facts.title != limb else limb)
        self.list.setVisible(bool(names))
        if names:
            self.list.setCurrentRow(names.index(name) if name in names else 0)
        self._show_chosen()

    def open_file(self, path: Path, what: str) -> None:
        """Read a file for ``what``, in a thread and in a process with limits."""
        read: Callable[..., Any] = read_points
        take: Callable[..., None] = partial(self._take_points, path, what)
        if what == "photograph":
            read, take = photograph.read, partial(self._take_photograph, path)
        elif what == "responses":
            read, take = read_description, partial(self._take_responses, path)

        def tell(result: Any, error: Exception | None) -> None:
            if error is None:
                take(result)
            else:
                self.complain(str(error))

        if read is not read_points:
            self.say(f"Reading {path.name}…")
        self.worker.run(partial(read, path, self._process), tell)

    def _stop_reading(self) -> None:
        self._process.close()
        self.worker.close()

    def _turn(self) -> None:
        # A job, since mirroring writes the whole limb again.
        name = self.chosen
        turned = not facts_of(name).mirrored
        self._add_job(Job(f"Mirroring {name}", partial(mirror_limb, name, turned)))

    def _delete(self) -> None:
        name = self.chosen
        if not may_remove(self, name):
            return
        try:
            remove_limb(name)
        except SkinSourceError as error:
            self.complain(str(error))
        self._limbs.look()
        self.show_limbs()

    def _ask_and_export(self) -> None:
        name = self.chosen
        path = self.ask_save("Export limb", "HDF5 (*.h5)", Path(f"{name}.h5"))
        if path is not None:
            self._add_job(Job(f"Exporting {name}", partial(export_limb, name, path)))

    def _show_chosen(self) -> None:
        name = self.chosen
        facts = facts_of(name) if name else None
        self._about.setText(_NONE if facts is None else facts.sentence or _DAMAGED)
        for button in (self._mirror, self._export, self._remove):
            button.setEnabled(facts is not None and (facts.known or button is self._remove))
        mirrored = facts is not None and facts.mirrored
        self._mirror.setText("Do not mirror" if mirrored else "Mirror")

    def _ask(self, what: str) -> None:
        path = ask_open(self, f"Choose {what}", _KINDS[what])
        if path is not None:
            self.open_file(path, what)

    def _take_responses(self, path: Path, about: dict[str, Any]) -> None:
        header, in_layout = about["header"], about["header"] is not None
        if in_layout:
            shape = tuple(header["shape"])
            places: dict[str, Any] = {
                what: _points_of(header[field]) for what, field in POINT_FIELDS.items()
            }
            self.draft = replace(Draft(), responses=path, shape=shape, in_layout=True, **places)
            self.form.show_header(header)
        else:
            self.draft = self.draft.with_array(path)
        largest = max(about["arrays"], key=lambda array: np.prod(array["shape"]), default=None)
        if largest is not None:
            self._array_shape = tuple(largest["shape"])
        dimensions = " × ".join(map(str, shape if in_layout else self._array_shape))
        self.form.show_file("responses", f"{path.name} ({dimensions})")
        self.form.show_plain(in_layout, path)
        self._show()

    def _take_points(self, path: Path, what: str, points: Points) -> None:
        self.form.show_file(what, path.name)
        names: dict[str, Any] = {}
        if points.names and what != "outline":
            names[f"{what[:-1]}_names"] = points.names
        draft = self.draft.with_file(what, points.points, y_down=points.y_down)
        self.draft = replace(draft, **names)
        self._show()

    def _take_photograph(self, path: Path, image: QtGui.QImage) -> None:
        self.form.show_file("photograph", path.name)
        # Points are pixels of the photograph from now on; points in other units are removed.
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
            self.say(missing or "Ready to import.")

    def _add_job(self, job: Job[Any]) -> None:
        self._jobs.add(job)
        self.say(f"{job.title}…")

    def _show_progress(self, job: Job[Any], progress: JobProgress) -> None:
        if progress.total:
            self.say(f"{job.title}: {100 * progress.done // progress.total} %")

    def _start(self) -> None:
        name = self.draft.values["name"]
        exists = name in own_limb_names()
        if not exists or ask_to_replace(self, name):
            work = partial(import_limb, self.draft.source(), replace=exists)
            self._add_job(Job(IMPORTING, work))

    def _note_done(self, job: Job[Any], result: object) -> None:
        self._limbs.look()
        self.show_limbs(result.name if isinstance(result, LimbFacts) else self.chosen)
        if isinstance(result, LimbFacts):
            self.say(f"Imported as {result.name}. Choose it at the right of the bar.")
        else:
            self.say(f"{job.title}: done.")


def _points_of(rows: list[Any]) -> np.ndarray:
    points = [(np.nan, np.nan) if row is None else row for row in rows]
    return np.array(points, float).reshape(-1, 2)


def _shape(shape: tuple[int, ...], order: str) -> tuple[int, ...] | None:
    """Return inputs, outputs, axes and taps of an array; None where the order does not fit."""
    order = order or {3: "iot", 4: "ioat"}[len(shape)]
    if len(order) != len(shape) or not set("iot") <= set(order):
        return None
    size = dict(zip(order, shape, strict=True))
    return size["i"], size["o"], size.get("a", 1), size["t"]
