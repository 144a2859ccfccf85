"""Exports of numbers and pictures: their table, their jobs, and the actions that start them.

Menus, shortcuts and the palette are made from the table `EXPORTS`.
"""

import logging
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from PySide6 import QtGui
from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import MissingExtraError, SkinSourceError, TooInaccurateError
from skinsource.base.extras import package_of_extra
from skinsource.base.job import Job, Progress, Stop
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.export import packing
from skinsource.export.map_files import export_map
from skinsource.export.tables import export_field, export_levels, export_traces, export_windows
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.panels.skin.film import (
    KINDS,
    MOST_PX,
    SIZE_PX,
    export_animation,
    film_name,
    film_options,
    film_remark,
)
from skinsource_gui.plots.pictures import (
    ALL_VISIBLE,
    PANEL_IN_USE,
    Picture,
    PictureOptions,
    ask_picture_options,
    caption_px,
    save_drawing,
)
from skinsource_gui.qt.error_label import VISIBLE
from skinsource_gui.qt.questions import ask_yes
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.services import Services

#: The exports that are written with more than design and view.
_FILM = "animation"
_PICTURES = (("PNG", ".png"), ("SVG", ".svg"), ("PDF", ".pdf"))

#: Computes and writes a file, given path, design and view, and by name ``progress``, ``stop`` and
#: ``largest_error``.
Write = Callable[..., Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportSpec:
    """One thing that can be exported.

    It is either written by a function, as a job, or a picture of a panel.

    Attributes
    ----------
    name
        Name of the action, after ``export_``.
    title
        Text in the menu, after "Export".
    file_name
        Suggested name of the file.
    kinds
        Kinds of files, as title and ending, first that of the suggested name.
    hint
        What is written, as a sentence.
    write
        Computes and writes the file.
    panel, size_px
        Panel whose picture is saved, or one of its views as ``"panel/view"``; width and height.
    enabled
        Whether there is anything to export; None: always.
    keys, keywords
        As those of an action.
    """

    name: str
    title: str
    file_name: str
    hint: str
    kinds: tuple[tuple[str, str], ...] = _PICTURES
    write: Write | None = None
    panel: str = ""
    size_px: tuple[int, int] = (1200, 1800)
    enabled: Callable[[Design, View], bool] | None = None
    keys: tuple[str, ...] = ()
    keywords: str = ""

    def filter_for(self, ending: str) -> str:
        """Return the filter with one of the endings first, which the dialog starts with."""
        kinds = sorted(self.kinds, key=lambda kind: kind[1] != ending)
        return ";;".join(f"{title} (*{ending})" for title, ending in kinds)

    @property
    def window_title(self) -> str:
        """The title of the dialogs that ask for options and a file."""
        return f"Export {self.title.removesuffix('…')}"

    @property
    def kinds_text(self) -> str:
        """The kinds of files within a sentence: "PNG, SVG or PDF"."""
        *others, last = (title for title, _ in self.kinds)
        return f"{', '.join(others)} or {last}" if others else last

    @property
    def endings(self) -> tuple[str, ...]:
        """The endings that the file may have."""
        return tuple(ending for _, ending in self.kinds)


def _has_outputs(design: Design, view: View) -> bool:
    return bool(view.outputs)


def _pack(
    path: Path,
    design: Design,
    view: View,
    *,
    progress: Progress,
    stop: Stop,
    largest_error: float,
) -> None:
    del largest_error  # each table states its own
    packing.pack(path, design, view, progress=progress, stop=stop)


EXPORTS: tuple[ExportSpec, ...] = (
    ExportSpec(
        name="picture",
        title="picture of the skin map…",
        file_name="skin-map.png",
        hint="Save the skin map as PNG, SVG or PDF, with its colour bar",
        panel="skin",
        keys=("Ctrl+Shift+E",),
        keywords="image figure screenshot heatmap vector pdf svg png",
    ),
    ExportSpec(
        name="panel_picture",
        title="picture of the panel in use…",
        file_name="panel.png",
        hint="Save the panel that has the keyboard as PNG, SVG or PDF, for a paper or a slide",
        panel=PANEL_IN_USE,
        keywords="image figure screenshot vector pdf svg png plot paper",
    ),
    ExportSpec(
        name="window_picture",
        title="picture of all panels…",
        file_name="studio.png",
        hint="Save all panels that are in sight, arranged as they are, as PNG, SVG or PDF",
        panel=ALL_VISIBLE,
        keywords="image figure screenshot vector pdf svg png arrangement window slide",
    ),
    ExportSpec(
        name=_FILM,
        title="animation of the skin map…",
        file_name="skin-map.mp4",
        kinds=KINDS,
        hint="Save the skin map in time, in slow motion, as MP4, WebM or GIF",
        write=export_animation,
        size_px=SIZE_PX,
        keywords="video film movie wave gif mp4 webm slow motion time",
    ),
    ExportSpec(
        name="traces",
        title="traces as CSV…",
        file_name="traces.csv",
        kinds=(("CSV", ".csv"),),
        hint="Save the traces of the selected outputs, with times and units",
        write=export_traces,
        enabled=_has_outputs,
        keys=("Ctrl+E",),
        keywords="table excel matlab waveform acceleration",
    ),
    ExportSpec(
        name="levels",
        title="RMS levels as CSV…",
        file_name="rms-levels.csv",
        kinds=(("CSV", ".csv"),),
        hint="Save the RMS of all outputs, in m/s² and dB",
        write=export_levels,
        keywords="table excel matlab decibels",
    ),
    ExportSpec(
        name="map",
        title="map of levels as CSV…",
        file_name="map.csv",
        kinds=(("CSV", ".csv"),),
        hint="Save the map as numbers, in dB: a row for each y, a column for each x, in mm",
        write=export_map,
        keywords="table excel matlab decibels skin heatmap surface",
    ),
    ExportSpec(
        name="windows",
        title="windows as CSV…",
        file_name="windows.csv",
        kinds=(("CSV", ".csv"),),
        hint="Save the RMS of all outputs in consecutive windows, and how far each window reaches",
        write=export_windows,
        keywords="table excel matlab windowed rms extent distance strip contraction",
    ),
    ExportSpec(
        name="windows_picture",
        title="picture of the windows…",
        file_name="windows.png",
        hint="Save the strip of windows as PNG, SVG or PDF, with its colour scale and the extent",
        panel="analysis/windowed",
        size_px=(1600, 1100),
        keywords="image figure screenshot vector pdf svg png windowed rms strip",
    ),
    ExportSpec(
        name="field",
        title="whole field as NPZ…",
        file_name="field.npz",
        kinds=(("NumPy archive", ".npz"),),
        hint="Save the acceleration of all outputs on three axes, for NumPy",
        write=export_field,
        keywords="python numpy matlab data array",
    ),
    ExportSpec(
        name="pack",
        title="all of it as ZIP…",
        file_name="design.zip",
        kinds=(("ZIP", ".zip"),),
        hint="Save design, stimulus, rig, figure, tables, versions and what to cite as one file",
        write=_pack,
        keywords="zip archive pack share publish supplement reproduce citation",
    ),
)


_log = logging.getLogger(__name__)


class ExportJobs(QObject):
    """Runs exports as jobs, and reports how each ended."""

    #: Why something was not exported.
    failed = Signal(str)

    def __init__(self, runner: JobRunner, files: FileActions, parent: QObject) -> None:
        super().__init__(parent)
        self._runner, self._files = runner, files
        self._running: dict[Job[Any], tuple[Path, Callable[[Exception], bool], str]] = {}
        runner.done.connect(self._note_written)
        runner.cancelled.connect(self._note_cancelled)
        runner.failed.connect(self._note_failed)

    def add(
        self,
        path: Path,
        work: Callable[..., Any],
        *,
        handled: Callable[[Exception], bool] = lambda error: False,
        note: str = "",
    ) -> None:
        """Export to ``path``.

        Parameters
        ----------
        path
            File or folder, which names the job.
        work
            Work of the job; where it returns a path, that is reported instead.
        handled
            Returns whether it has handled an error, which is then not reported.
        note
            Text that follows the name of the written file.
        """
        job = Job(f"Exporting {path.name}", work)
        self._running[job] = path, handled, note
        self._runner.add(job)

    def _note_written(self, job: Job[Any], result: Any) -> None:
        if job in self._running:
            path, _, note = self._running.pop(job)
            self._files.note_written(result if isinstance(result, Path) else path, note)

    def _note_cancelled(self, job: Job[Any]) -> None:
        if job in self._running:
            path, *_ = self._running.pop(job)
            self._files.done.emit(f"Export of {path.name} cancelled; nothing was written")

    def _note_failed(self, job: Job[Any], error: Exception) -> None:
        if job not in self._running:
            return
        path, handled, _ = self._running.pop(job)
        if handled(error):
            return
        if isinstance(error, SkinSourceError):
            self.failed.emit(str(error))
            return
        _log.error("an export failed", exc_info=error)
        self.failed.emit(
            f"{path.name} was not exported: the studio made a mistake "
            f"({type(error).__name__}: {error}). Please report this."
        )


#: Returns the picture of a panel with the present results, given the name of the panel.
DrawerOf = Callable[[str], Picture]


class ExportActions(QObject):
    """Exports the present design, and reports how that ended."""

    #: Why something was not exported.
    failed = Signal(str)

    def __init__(
        self,
        services: Services,
        files: FileActions,
        drawer_of: DrawerOf,
    ) -> None:
        super().__init__(services.window)
        self._document, self._preferences = services.document, services.preferences
        self._files, self._drawer_of, self._window = files, drawer_of, services.window
        self._jobs = ExportJobs(services.runner, files, self)
        self._jobs.failed.connect(self.failed)
        self._picture_options: dict[str, PictureOptions] = {}

    def export(self, name: str) -> None:
        """Ask for a file, and write the export ``name`` of the table to it."""
        spec = next(spec for spec in EXPORTS if spec.name == name)
        # The design as the user sees it now, even if it changes while the dialog is open.
        design, view = self._document.design, self._document.view
        write = spec.write
        if write is None:
            self._export_picture(spec)
            return
        arguments: dict[str, Any] = {}
        if name == _FILM:
            options = self._ask_film(spec, design, view)
            if options is None:
                return
            spec = replace(spec, file_name=film_name(design, view, options))
            arguments = {"options": options, "seen": self._drawer_of("skin").visible}
        path = self._ask_where(spec)
        if path is not None:
            # Tables and films hold the design without the gain that matches its level to another's.
            matched = view.match_gain(design) != 1.0
            note = "amplitudes are as stored, levels are not matched" if matched else ""
            self._add(path, partial(write, path, design, view, **arguments), note)

    def copy_citation(self) -> None:
        """Put what to cite for the open design on the clipboard."""
        QtGui.QGuiApplication.clipboard().setText(packing.citation(self._document.design))
        self._files.done.emit("Copied what to cite")

    def _ask_film(self, spec: ExportSpec, design: Design, view: View) -> Any:
        """Ask for the options of a film; None where there is none to be written."""
        try:
            package_of_extra("imageio_ffmpeg", "video")
        except MissingExtraError as error:
            self.failed.emit(str(error))
            return None
        remark = partial(film_remark, design, view)
        usual = film_options(design, view, self._usual_options(spec, spec.size_px))
        about = {"kinds": "", "most_px": MOST_PX, "remark": remark}
        return self._ask_options(spec, usual, spec.size_px, **about)

    def _ask_where(self, spec: ExportSpec) -> Path | None:
        start = self._preferences.folder / spec.file_name
        kinds = spec.filter_for(start.suffix)
        return self._files.ask_where(spec.window_title, start, kinds, spec.endings)

    def _export_picture(self, spec: ExportSpec) -> None:
        picture = self._drawer_of(spec.panel)
        if spec.panel == PANEL_IN_USE:
            # The dialogs cover the window, so their title names the panel.
            name = picture.title.lower().replace(" ", "-")
            spec = replace(
                spec, title=f"picture of the panel {picture.title}…", file_name=f"{name}.png"
            )
        size = picture.size_px or spec.size_px
        below = partial(caption_px, picture.caption)
        usual = self._usual_options(spec, size)
        options = self._ask_options(spec, usual, size, kinds=spec.kinds_text, below=below)
        path = None if options is None else self._ask_where(spec)
        if options is None or path is None:
            return
        draw = partial(picture.draw, theme=options.theme)
        try:
            save_drawing(path, draw, options.width_px, options.height_px, dpi=options.dpi)
        except SkinSourceError as error:
            self.failed.emit(str(error))
        else:
            self._files.note_written(path)

    def _usual_options(self, spec: ExportSpec, size_px: tuple[int, int]) -> PictureOptions:
        usual = PictureOptions(width_px=size_px[0], height_px=size_px[1])
        return self._picture_options.get(spec.name, usual)

    def _ask_options(
        self, spec: ExportSpec, usual: PictureOptions, shape: tuple[int, int], **about: Any
    ) -> PictureOptions | None:
        """Ask for size and colours, which are offered the next time too."""
        about |= {"title": spec.window_title, "shape": shape}
        options = ask_picture_options(self._window, usual, **about)
        if options is not None:
            self._picture_options[spec.name] = options
        return options

    def _add(
        self, path: Path, write: Callable[..., Any], note: str, largest_error: float = VISIBLE
    ) -> None:
        def ask(error: Exception) -> bool:
            if not isinstance(error, TooInaccurateError):
                return False
            question = f"{path.name}: {error} Export it all the same?"
            if ask_yes(self._window, "Inaccurate numbers", question):
                self._add(path, write, note, math.inf)
            return True

        self._jobs.add(path, partial(write, largest_error=largest_error), handled=ask, note=note)
