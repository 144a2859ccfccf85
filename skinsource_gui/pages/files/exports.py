"""Exports: the table of what can be exported, and the dialog and jobs that write it.

The dialog, and the entries of the palette that open it, are made from the table `EXPORTS`, whose
texts stand in ``resources/exports.toml``.
"""

import importlib
import logging
import math
import tomllib
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any

from PySide6 import QtGui
from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import SkinSourceError, TooInaccurateError
from skinsource.base.files import path_exists
from skinsource.base.job import Job
from skinsource.design.design import Design, View
from skinsource.design.edits.edit import Edit
from skinsource.export import packing
from skinsource.export.tables import (
    export_field,
    export_levels,
    export_map,
    export_traces,
    export_windows,
)
from skinsource_gui import pages
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.pages.files.maps_film import export_maps_film
from skinsource_gui.panels.skin.film import export_animation
from skinsource_gui.plots.pictures import Picture
from skinsource_gui.qt.buttons import show_or_hide
from skinsource_gui.qt.questions import ask_save, ask_to_replace, ask_yes
from skinsource_gui.qt.resources import read_text
from skinsource_gui.state.services import Services
from skinsource_gui.state.worker import fault_text

#: The exports that need more than design and view, or a selection.
STIMULUS, FILM, PACK, WIRING, TRACES = "stimulus", "animation", "pack", "wiring", "traces"
STIMULUS_SET, MAPS_FILM = "stimulus_set", "maps_animation"

#: Computes and writes a file, given path, design and view, and by name ``progress``, ``stop`` and
#: ``largest_error``.
Write = Callable[..., Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportSpec:
    """One thing that can be exported.

    It is written by a function, as a job, or is a picture of a panel; the stimulus is neither.

    Attributes
    ----------
    name
        Name of its entry in the palette, after ``export_``.
    group, hint, size_px, title, file_name, panel, keys, words
        As in the file of texts.
    write
        Computes and writes the file.
    """

    name: str
    group: str
    hint: str
    size_px: tuple[int, int]
    title: str = ""
    file_name: str = ""
    write: Write | None = None
    panel: str = ""
    keys: str = ""
    words: str = ""

    @property
    def text(self) -> str:
        """Its entry in the palette."""
        return f"Export {': '.join(filter(None, (self.group.lower(), self.title)))}…"


def _pack(path: Path, design: Design, view: View, *, largest_error: float, **job: Any) -> None:
    # Each table states its own.
    packing.pack(path, design, view, **job)


def _page(path: Path, design: Design, view: View, **job: Any) -> None:
    # As below.
    importlib.import_module("skinsource.export.web_page").export_web_page(path, design, view, **job)


def _wiring(path: Path, design: Design, view: View, **wired: Any) -> None:
    # Nothing is predicted.
    for name in ("progress", "stop", "largest_error"):
        del wired[name]
    # Imported when it is used: the start of the studio does not wait for formats.
    importlib.import_module("skinsource.export.wiring").export_wiring(design, path, **wired)


# The others are pictures of a panel, and stimuli.
_WRITES: dict[str, Write] = {
    FILM: export_animation,
    MAPS_FILM: export_maps_film,
    TRACES: export_traces,
    "levels": export_levels,
    "map": export_map,
    "windows": export_windows,
    "field": export_field,
    "page": _page,
    PACK: _pack,
    WIRING: _wiring,
}


def _specs() -> Iterator[ExportSpec]:
    for name, entry in tomllib.loads(read_text("exports.toml")).items():
        width_px, height_px = entry.pop("size_px", (1200, 1800))
        size_px = width_px, height_px
        yield ExportSpec(name=name, size_px=size_px, write=_WRITES.get(name), **entry)


EXPORTS = tuple(_specs())
_EXPORTING = "Exporting "

#: A visible error, relative to the largest sample.
VISIBLE = 1e-3
_log = logging.getLogger(__name__)


#: Returns the picture of a panel with the present results, given the name of the panel.
DrawerOf = Callable[[str], Picture]


class ExportActions(QObject):
    """Opens the dialog on the present design, and writes what is chosen there."""

    #: Why something was not exported.
    failed = Signal(str)

    def __init__(self, services: Services, files: FileActions, drawer_of: DrawerOf) -> None:
        super().__init__(services.window)
        self._document, self._preferences = services.document, services.preferences
        self._files, self._drawer_of, self._window = files, drawer_of, services.window
        self._runner = services.runner
        self._picture_options: dict[str, Any] = {}
        self._last = STIMULUS
        self._runner.changed.connect(self._show_running)
        #: The dialog, while it is open.
        self.page: Any = None

    def show(self, name: str = "") -> None:
        """Open the dialog on an entry of the table, at first that of the last export."""
        self.end()
        own = self._document.path
        # The design as the user sees it now.
        self.page = page = pages.ExportPage(
            self._document.design,
            self._document.view,
            self._window,
            drawer_of=self._drawer_of,
            picture_options=self._picture_options,
            last_stimulus=self._preferences.export_text,
            stem="stimulus" if own is None else own.stem,
        )
        page.show_export(name or self._last)
        page.chosen.connect(self._ask_and_write)
        page.cancel.clicked.connect(lambda: self._runner.cancel())
        page.edited.connect(self._edit)
        page.finished.connect(self._forget_page)
        self._files.done.connect(page.say)
        self.failed.connect(page.complain)
        self._show_running()
        page.open()

    def end(self) -> None:
        """Close the dialog."""
        if self.page is not None:
            self.page.reject()

    def copy_citation(self) -> None:
        """Put what to cite for the open design on the clipboard."""
        QtGui.QGuiApplication.clipboard().setText(packing.citation(self._document.design))
        self._files.done.emit("Citation copied")

    def _edit(self, edit: Edit, gesture: int | None) -> None:
        """Edit the design, as the panel Output does, and show the same choices on it."""
        said = f"{edit.label}: done in the design. Close keeps it, Undo takes it back"
        changes = edit.design != self._document.design
        self._document.apply(replace(edit, said=said if changes else ""), gesture)
        self.page.show_design(self._document.design)

    def _forget_page(self) -> None:
        self.page = None

    def _ask_and_write(self) -> None:
        """Ask for a file, and write what the dialog shows; it stays open, and says how it went."""
        page = self.page
        name, kinds = page.part.suggestion()
        start, numbers = self._preferences.folder / name, count(2)
        # The dialog would open inside a folder.
        while start.is_dir():
            start = start.with_name(f"{name}-{next(numbers)}")
        path = ask_save(self._window, page.windowTitle(), start, kinds)
        if path is None or not self._may_write(path, page.part.files(path)):
            return
        self._last, write = page.part.name, page.part.writer(path)
        self._preferences.export_text = page.settings
        if page.part.draws:
            self._draw(path, write)
            return
        # Tables and films hold the design without the gain that matches its level to another's.
        matched = self._document.view.match_gain(self._document.design) != 1.0
        note = "amplitudes are as stored, levels are not matched" if matched else ""
        quick = page.part.name not in (FILM, MAPS_FILM, STIMULUS_SET)
        work = partial(write, largest_error=VISIBLE)
        before = self._add(path, Job(f"{_EXPORTING}{path.name}", work, quick), note)
        does = f"waits for {_file_of(before)}" if before else "is being written"
        page.say(f"{path.name} {does}. Close lets it go on.")

    def _may_write(self, path: Path, written: Iterable[tuple[Path, ...]]) -> bool:
        """Return whether files other than ``path``, on which the dialog asked, may be replaced."""
        # A user who has a file replaced has its sidecar replaced too.
        agreed = path_exists(path)
        firsts = (
            next(filter(path_exists, files), None)
            for files in written
            if not (agreed and files[0] == path)
        )
        existing = [file for file in firsts if file is not None]
        return not existing or ask_to_replace(self._window, existing)

    def _draw(self, path: Path, write: Callable[[], object]) -> None:
        try:
            write()
        except SkinSourceError as error:
            self.failed.emit(str(error))
        else:
            self._files.note_written(path)

    def _show_running(self) -> None:
        """Offer to cancel the running job, as the status bar does behind the dialog."""
        job = self._runner.current
        if self.page is not None:
            text = f"Cancel {_file_of(job)}" if job else ""
            show_or_hide(self.page.cancel, text.replace("&", "&&"))

    def _add(self, path: Path, job: Job[Any], note: str) -> Job[Any] | None:
        """Return the job after which the file is written, if it waits for one."""

        def note_written(result: Any) -> None:
            self._files.note_written(result if isinstance(result, Path) else path, note)

        def note_cancelled() -> None:
            self._files.done.emit(f"Export of {path.name} cancelled; nothing was written")

        def note_failed(error: Exception) -> None:
            if isinstance(error, TooInaccurateError):
                question = f"{path.name}: {error} Export anyway?"
                if ask_yes(self._window, "Inaccurate numbers", question):
                    write: Any = job.work
                    anyway = partial(write, largest_error=math.inf)
                    self._add(path, replace(job, work=anyway), note)
            elif isinstance(error, SkinSourceError):
                self.failed.emit(str(error))
            else:
                _log.error("an export failed", exc_info=error)
                self.failed.emit(f"{path.name} was not exported. {fault_text(error)}")

        return self._runner.add(
            job, done=note_written, cancelled=note_cancelled, failed=note_failed
        )


def _file_of(job: Job[Any]) -> str:
    """Return the name of the file that a job writes, or what else it does."""
    return job.title.removeprefix(_EXPORTING)
