"""Exports: where to, and what came of it."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QWidget

from skinsource.base.errors import MissingExtraError, SkinSourceError, TooInaccurateError
from skinsource.base.extras import package_of_extra
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.export import packing
from skinsource_gui.files.export_jobs import ExportJobs
from skinsource_gui.files.exports import EXPORTS, SEEN, SIZED, WIRED, ExportSpec
from skinsource_gui.files.file_actions import FileActions
from skinsource_gui.panels.skin.time.film import MOST_PX
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.status.error_label import VISIBLE
from skinsource_gui.widgets.asking import agreed
from skinsource_gui.widgets.pictures.caption import caption_px
from skinsource_gui.widgets.pictures.letters import letters_remark
from skinsource_gui.widgets.pictures.picture_file import save_drawing
from skinsource_gui.widgets.pictures.picture_options import PictureOptions, ask_picture_options
from skinsource_gui.widgets.pictures.whole_picture import IN_USE, WholePicture

#: Asked for the name of a panel: its picture, with the present results.
DrawerOf = Callable[[str], WholePicture]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Order:
    """What is to be exported, as it was when the user asked for it."""

    spec: ExportSpec
    path: Path
    design: Design
    view: View
    largest_error: float = VISIBLE
    besides: Mapping[str, Any] = field(default_factory=dict)

    @property
    def work(self) -> Callable[..., Any]:
        """Writes it."""
        what = self.path, self.design, self.view
        if self.spec.write is None:
            raise TypeError(f"{self.spec.name} is a picture of a panel: nothing writes it")
        return partial(self.spec.write, *what, largest_error=self.largest_error, **self.besides)


class ExportActions(QObject):
    """Exports the present design, and tells what becomes of it.

    Parameters
    ----------
    document, preferences, files
        What is exported; where files were last written; who asks where to.
    runner
        Carries the exports out.
    drawer_of
        Knows who draws pictures.
    window
        In front of which questions are asked; also the parent.
    """

    #: Why something was not exported.
    failed = Signal(str)

    def __init__(
        self,
        document: Document,
        preferences: Preferences,
        files: FileActions,
        runner: JobRunner,
        drawer_of: DrawerOf,
        window: QWidget,
    ) -> None:
        super().__init__(window)
        self._document, self._preferences, self._files = document, preferences, files
        self._drawer_of, self._window = drawer_of, window
        self._jobs = ExportJobs(runner, files, self)
        self._jobs.failed.connect(self.failed)
        self._picture_options: dict[str, PictureOptions] = {}

    def export(self, name: str) -> None:
        """Ask for a file, and export to it what the table calls ``name``."""
        spec = next(one for one in EXPORTS if one.name == name)
        # What the user sees now, whatever happens while the dialog is open.
        design, view = self._document.design, self._document.view
        if spec.package is not None:
            try:
                package_of_extra(*spec.package)
            except MissingExtraError as error:
                self.failed.emit(str(error))
                return
        if spec.panel:
            self._export_picture(spec)
            return
        besides: dict[str, Any] = {}
        options: PictureOptions | None = None
        if SIZED in spec.wants:
            remark = None if spec.remark is None else partial(spec.remark, design, view)
            options = self._ask_options(spec, spec.size_px, most_px=MOST_PX, remark=remark)
            if options is None:
                return
            besides[SIZED] = options
        if SEEN in spec.wants:
            besides[SEEN] = self._drawer_of("skin").seen
        if WIRED in spec.wants:
            rig = self._preferences.rig_path
            besides[WIRED] = Path(rig) if rig else None
        path = self._ask_where(spec, options)
        if path is not None:
            order = _Order(spec=spec, path=path, design=design, view=view, besides=besides)
            self._add(order)

    def copy_citation(self) -> None:
        """Put what to cite for the open design on the clipboard."""
        QGuiApplication.clipboard().setText(packing.citation(self._document.design))
        self._files.done.emit("Copied what to cite")

    def _ask_where(self, spec: ExportSpec, options: PictureOptions | None = None) -> Path | None:
        document, name = self._document, spec.file_name
        if spec.named is not None:
            name = spec.named(document.design, document.view, options)
        start = self._preferences.folder / name
        kinds = spec.filter_for(start.suffix)
        return self._files.ask_where(spec.window_title, start, kinds, spec.endings)

    def _export_picture(self, spec: ExportSpec) -> None:
        picture = self._drawer_of(spec.panel)
        if spec.panel == IN_USE:
            # Which one that is, is not seen any more behind the windows that ask.
            name = picture.title.lower().replace(" ", "-")
            spec = replace(
                spec, title=f"picture of the panel {picture.title}…", file_name=f"{name}.png"
            )
        size, remark = picture.size_px or spec.size_px, letters_remark(picture)
        below = partial(caption_px, picture.caption)
        options = self._ask_options(spec, size, remark=remark, below=below)
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

    def _ask_options(
        self, spec: ExportSpec, size_px: tuple[int, int], **about: Any
    ) -> PictureOptions | None:
        """Ask how large, and in which colours; the next time it begins with these."""
        usual = PictureOptions(width_px=size_px[0], height_px=size_px[1])
        known = self._picture_options.get(spec.name, usual)
        kinds = spec.kind_words
        if spec.begun is not None:
            known, kinds = spec.begun(self._document.design, self._document.view, known), ""
        about |= {"title": spec.window_title, "kinds": kinds, "shape": size_px}
        options = ask_picture_options(self._window, known, **about)
        if options is not None:
            self._picture_options[spec.name] = options
        return options

    def _add(self, order: _Order) -> None:
        # Tables and films hold the design, not what makes it as loud as another one.
        matched = order.view.match_gain(order.design) != 1.0
        note = "amplitudes are as stored, levels are not matched" if matched else ""
        answered = partial(self._accepted, order)
        self._jobs.add(order.path, order.work, answered=answered, note=note)

    def _accepted(self, order: _Order, error: Exception) -> bool:
        if not isinstance(error, TooInaccurateError):
            return False
        question = f"{order.path.name}: {error} Export it all the same?"
        if agreed(self._window, "Inaccurate numbers", question):
            self._add(replace(order, largest_error=math.inf))
        return True
