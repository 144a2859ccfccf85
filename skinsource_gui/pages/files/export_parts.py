"""Parts of the export dialog: what is asked before an export, and a preview of what is written."""

import importlib
import zipfile
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import Qt, Signal

from skinsource.base.errors import SkinSourceError, Stopped, sentence
from skinsource.base.extras import package_of_extra
from skinsource.base.job import Stop, silent
from skinsource.design.design import Design, View
from skinsource.export import plot, wiring
from skinsource.export.stimulus_export.preparing import size_text
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.pages.files.exports import FILM, MAPS_FILM, TRACES, WIRING, DrawerOf, ExportSpec
from skinsource_gui.pages.files.maps_film import maps_options, maps_picture, maps_remark
from skinsource_gui.pages.page import PictureView
from skinsource_gui.panels.skin.film import KINDS as FILM_KINDS
from skinsource_gui.panels.skin.film import (
    MOST_PX,
    FilmOptions,
    film_name,
    film_options,
    film_picture,
    film_remark,
)
from skinsource_gui.plots.pictures import (
    KIND,
    KINDS,
    PER_INCH,
    PictureForm,
    PictureOptions,
    caption_px,
    drawn_image,
    save_drawing,
)
from skinsource_gui.qt.buttons import page_label, scrolled, show_or_hide
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.theme import UNIT_PX, letter_scale
from skinsource_gui.state.worker import Worker, fault_text

#: Width of the fields beside a preview, px.
_FIELDS_PX = 300
# Larger files are not written for a preview, and no more of a table is shown.
_MOST_BYTES, _HEAD_BYTES = 32_000_000, 10_000
_PREVIEW_PER_INCH = 144
_PREVIEW = "preview"
# Among what is kept: the speed of a film that was chosen, not found.
_PACE = "animation pace"


class ExportPart(QtWidgets.QWidget):
    """Asks for the few choices of an entry of the dialog, and shows what will be written.

    Attributes
    ----------
    ready
        Whether it can be written.
    draws
        Whether it is drawn in the window's thread, not written as a job.
    """

    #: What it says has changed, or whether it can be written.
    changed = Signal()

    ready = False
    draws = False

    def __init__(self, name: str) -> None:
        super().__init__()
        self.setObjectName(f"{name}_part")
        self._worker = Worker(f"skinsource-{name}", self)
        self._summary = page_label(f"{name}_summary")
        self._problem = page_label(f"{name}_problem", tone="error")
        self._problem.hide()

    @property
    def name(self) -> str:
        """The entry of the table of exports that is shown."""
        raise NotImplementedError

    def suggestion(self) -> tuple[str, str]:
        """Return a name, and the kinds for the dialog that asks, the usual one first."""
        raise NotImplementedError

    def files(self, path: Path) -> Iterable[tuple[Path, ...]]:
        """Return the files that are written besides ``path``, each with what belongs to it."""
        return ()

    def writer(self, path: Path) -> Callable[..., Any]:
        """Return the function that writes what is shown to ``path``."""
        raise NotImplementedError

    def close_worker(self) -> None:
        """Stop computing."""
        self._worker.close()

    def _say(self, summary: str, problem: str = "") -> None:
        self._summary.setText(summary)
        show_or_hide(self._problem, problem)


def scrolled_fields(fields: QtWidgets.QWidget, name: str) -> QtWidgets.QScrollArea:
    """Return the column of fields beside a preview."""
    area = scrolled(fields, name)
    area.setFixedWidth(round(_FIELDS_PX * letter_scale(area.font())))
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    return area


class FilePart(ExportPart):
    """Pictures, films, tables, data and projects.

    Parameters
    ----------
    specs
        The exports that can be chosen in it.
    picture_options
        Options of the last pictures by the name of their export; new ones are added.
    wired
        Returns the channels of the stimulus, for the wiring page.
    """

    def __init__(
        self,
        specs: Sequence[ExportSpec],
        design: Design,
        view: View,
        drawer_of: DrawerOf,
        picture_options: dict[str, Any],
        wired: Callable[[], dict[str, Any]],
    ) -> None:
        super().__init__("file")
        self._specs = {spec.name: spec for spec in specs}
        self._spec = specs[0]
        self._design, self._view = design, view
        self._drawer_of, self._kept, self._wired = drawer_of, picture_options, wired
        options = tuple((spec.name, spec.title) for spec in specs)
        self._choice = named(ChoiceField(ChoiceSpec(label="What", options=options)), "export_what")
        self._choice.edited.connect(self.show_export)
        self._choice.setVisible(len(specs) > 1)
        self._page_kind = named(ChoiceField(KIND), "export_page_kind")
        self._page_kind.set_value(".pdf")
        self._hint = page_label("export_hint", tone="dim")
        self.form: PictureForm | None = None
        self._room = in_column(
            self._choice, self._hint, self._page_kind, None, margins=0, gap_px=UNIT_PX
        )
        fields = QtWidgets.QWidget()
        fields.setLayout(self._room)
        left = scrolled_fields(fields, "export_fields")
        self.image, self.text = PictureView(), QtWidgets.QPlainTextEdit()
        self.image.setAccessibleName("Preview")
        self.text.setReadOnly(True)
        self.text.setAccessibleName("Preview")
        self.text.setLineWrapMode(QtWidgets.QPlainTextEdit.LineWrapMode.NoWrap)
        columns = in_row(left, (self.image, 1), (self.text, 1), gap_px=2 * UNIT_PX)
        in_column((columns, 1), self._summary, self._problem, of=self, margins=0)

    @property
    def name(self) -> str:
        return self._spec.name

    @property
    def draws(self) -> bool:  # type: ignore[override]
        return self._spec.write is None

    def show_export(self, name: str) -> None:
        """Show one of the exports."""
        self._spec = spec = self._specs[name]
        self._choice.set_value(name)
        self._hint.setText(f"{spec.hint}.")
        if self.form is not None:
            self.form.deleteLater()
        self._picture = self._drawer_of(spec.panel) if spec.panel else None
        self.form = self._new_form()
        if self.form is not None:
            self._room.insertWidget(2, self.form)
            self.form.changed.connect(self._show_preview)
        drawn = self.form is not None or name == WIRING
        self._page_kind.setVisible(name == WIRING)
        self.image.setVisible(drawn)
        self.text.setVisible(not drawn)
        self._show_preview()

    def suggestion(self) -> tuple[str, str]:
        spec, name = self._spec, self._spec.file_name
        kinds: Sequence[tuple[str, str]] = KINDS
        if spec.name == WIRING:
            name = f"wiring{self._page_kind.value}"
        elif self.form is None:
            kinds = ((spec.group, Path(name).suffix),)
        elif isinstance(self.form.options, FilmOptions):
            kinds, name = FILM_KINDS, f"maps-side-by-side{self.form.options.kind}"
            if spec.name == FILM:
                name = film_name(self._design, self._view, self.form.options)
        else:
            title = self._picture.title if self._picture is not None else ""
            if spec.name == "panel_picture" and title:
                name = f"{title.lower().replace(' ', '-')}.png"
            name = str(Path(name).with_suffix(self.form.options.kind))
        ending = Path(name).suffix
        ordered = sorted(kinds, key=lambda kind: kind[1] != ending)
        text = ";;".join(f"{title} (*{suffix})" for title, suffix in ordered)
        return name, text

    def writer(self, path: Path) -> Callable[..., Any]:
        if self.draws and self._picture is not None and self.form is not None:
            options = self.form.options
            draw = partial(self._picture.draw, theme=options.theme)
            return partial(
                save_drawing, path, draw, options.width_px, options.height_px, dpi=options.dpi
            )
        return partial(self._write(), path, **self._more())

    def _write(self) -> Callable[..., Any]:
        if self._spec.write is None:
            raise TypeError(f"{self._spec.name} is no job")
        return partial(self._spec.write, design=self._design, view=self._view)

    def _more(self) -> dict[str, Any]:
        """Return what a film and a project are written with besides design and view."""
        if self._spec.group == "Film" and self.form and self._picture:
            return {"options": self.form.options, "seen": self._picture.visible}
        if self._spec.name == WIRING:
            return self._wired()
        return {}

    def _new_form(self) -> PictureForm | None:
        spec, picture = self._spec, self._picture
        shape = picture.size_px if picture is not None and picture.size_px else spec.size_px
        usual = self._kept.get(spec.name, PictureOptions(width_px=shape[0], height_px=shape[1]))
        if spec.name == MAPS_FILM and picture is not None:
            remark = partial(maps_remark, picture.visible)
            return PictureForm(maps_options(usual), shape=shape, most_px=MOST_PX, remark=remark)
        if spec.name == FILM:
            own = film_options(self._design, self._view, usual)
            self._usual_pace = own.pace
            own = replace(own, pace=self._kept.get(_PACE) or own.pace)
            remark = partial(film_remark, self._design, self._view)
            return PictureForm(own, shape=shape, most_px=MOST_PX, remark=remark)
        if picture is not None:
            return PictureForm(usual, shape=shape, below=partial(caption_px, picture.caption))
        return None

    def _show_preview(self) -> None:
        spec, form = self._spec, self.form
        self.ready, problem = True, ""
        if spec.name == TRACES and not self._view.outputs:
            problem = "No output is selected. Click one on the skin map."
        if spec.group == "Film":
            try:
                package_of_extra("imageio_ffmpeg", "video")
            except SkinSourceError as error:
                problem = sentence(str(error))
        summary = "Computing the preview…"
        if form is not None:
            self._kept[spec.name] = form.options
            if spec.name == FILM and isinstance(form.options, FilmOptions):
                pace = form.options.pace
                self._kept[_PACE] = pace if pace != self._usual_pace else ""
            remark = form.remark
            summary, problem = remark.text, problem or remark.text * remark.refuses
        if problem:
            self.ready = False
            self._say("", problem)
            self.image.show_image(QtGui.QImage())
            self.text.clear()
        elif self.draws and form is not None:
            self._say(f"{spec.title}, {form.options.kind[1:].upper()}, {summary}.")
            self.image.show_image(self._small(form.options))
        else:
            self._say(summary)
            work = partial(self._preview, form and form.options, self._more())
            self._worker.run_newest(_PREVIEW, work, self._receive)
        self.changed.emit()

    def _small(self, options: PictureOptions) -> QtGui.QImage:
        """Return the picture as it will be, in the pixels of the preview."""
        width, height = options.width_px, options.height_px
        draw = self._picture.draw  # type: ignore[union-attr]
        shown = self.image.size().expandedTo(self.image.sizeHint())
        scale = min(shown.width() / width, shown.height() / height, 1.0)
        dpi = max(round(PER_INCH * scale * self.devicePixelRatio()), 1)
        return drawn_image(partial(draw, theme=options.theme), width, height, dpi)

    def _preview(self, options: Any, more: dict[str, Any]) -> QtGui.QImage | tuple[str, int]:
        """Return the preview, in the thread of the worker."""
        stop = partial(self._worker.is_outdated, _PREVIEW)
        if self._spec.group == "Film":
            draw = film_picture if self._spec.name == FILM else maps_picture
            return draw(self._design, self._view, stop=stop, **more)
        if self._spec.name == WIRING:
            # As it is written it takes 70 MB.
            page = wiring.wiring_page(self._design, **more)
            return QtGui.QImage.fromData(plot.figure_content(page, "png", _PREVIEW_PER_INCH))
        return preview_of(partial(self._write(), **more), self._spec.file_name, stop)

    def _receive(self, result: Any, error: Exception | None) -> None:
        if isinstance(error, Stopped):
            self._say(f"{sentence(self._spec.hint)} Too large for a preview.")
        elif error is not None:
            self.ready = False
            self._say("", sentence(fault_text(error)))
        elif isinstance(result, QtGui.QImage):
            self.image.show_image(result)
            if self.form is None:
                self._say(sentence(self._spec.hint))
        else:
            text, n_bytes = result
            self.text.setPlainText(text)
            self._say(f"{self._spec.file_name}, {size_text(n_bytes)}.")
        self.changed.emit()


def preview_of(write: Callable[..., Any], name: str, stop: Stop) -> tuple[str, int]:
    """Return the begin of a file or what it holds, and its bytes; it is not kept."""
    with TemporaryDirectory(prefix="skinsource-") as folder:
        path = Path(folder) / name

        def too_large() -> bool:
            parts = Path(folder).rglob("*")
            return stop() or sum(part.stat().st_size for part in parts) > _MOST_BYTES

        write(path, progress=silent, stop=too_large, largest_error=np.inf)
        n_bytes = path.stat().st_size
        if path.suffix == ".npz":
            with np.load(path, allow_pickle=False) as arrays:
                lines = [f"{key}: {array.dtype}, {array.shape}" for key, array in arrays.items()]
        elif path.suffix == ".zip":
            with zipfile.ZipFile(path) as archive:
                lines = [
                    f"{entry.filename}, {size_text(entry.file_size)}" for entry in archive.filelist
                ]
        elif path.suffix == ".html":
            # Imported when it is used: the start of the studio does not wait for it.
            pages = importlib.import_module("skinsource.export.web_page")
            lines = pages.content_of(path.read_text("utf-8"))["details"]
        else:
            with path.open("rb") as file:
                head = file.read(_HEAD_BYTES + 1)
            lines = head[:_HEAD_BYTES].decode(errors="ignore").splitlines()
            lines += ["…"] * (len(head) > _HEAD_BYTES)
    return "\n".join(lines), n_bytes
