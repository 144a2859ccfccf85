"""The skin map in time as a file: MP4, WebM or GIF."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QSizeF
from PySide6.QtGui import QGuiApplication, QImage, QPainter

from skinsource.base.job import Progress, Stop, never, silent
from skinsource.design.design import Design
from skinsource.design.labels import limb_word
from skinsource.design.panel_settings import settings_of
from skinsource.design.view import View
from skinsource.engine.time_rules import block_of
from skinsource.export.exported_design import ExportedDesign
from skinsource.export.video import frames_per_s, video_file
from skinsource.limbs.own_limbs import facts_of
from skinsource.perception.validity import Findings, Judged, in_short
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.map_picture import Heading, heading_of, paint_picture
from skinsource_gui.panels.skin.settings import SKIN, SkinSettings
from skinsource_gui.panels.skin.stage.map_layout import ALL, SeenPart
from skinsource_gui.panels.skin.time.film import Film, film_of, frame_size
from skinsource_gui.panels.skin.time.film_options import FilmOptions, film_options
from skinsource_gui.panels.skin.time.frames import NEEDS, Frames
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.map.colour_maps import DIVERGING
from skinsource_gui.widgets.map.field_image import field_image
from skinsource_gui.widgets.pictures.caption import caption_of, with_caption
from skinsource_gui.widgets.pictures.picture_options import PictureOptions

#: Width and height of a frame unless another size is asked for, px.
SIZE_PX = (900, 1200)


def export_animation(
    path: Path,
    design: Design,
    view: View,
    *,
    options: FilmOptions | None = None,
    seen: SeenPart = ALL,
    progress: Progress = silent,
    stop: Stop = never,
    largest_error: float = np.inf,
) -> None:
    """Write the skin map in time, each frame computed at its instant, the stimulus below it.

    ``options`` say what is shown and how slowly, how large and on which ground; what the skin panel
    shows unless given.  The piece is that of the time axes, the colours are those of the panel, and
    ``seen`` is the part of the map that is in sight.

    Raises
    ------
    MissingExtraError
        The extra ``video`` is not installed.
    InvalidInputError
        It would be too long or too large, or the ending of the name is that of no animation.
    StorageError, Stopped
        As `skinsource.export.video`.
    """
    # Frames are no numbers that anyone computes with.
    del largest_error
    options = options or film_options(design, view, _usual_size())
    view = options.view_of(view)
    settings = settings_of(view, SKIN, SkinSettings)
    per_s = frames_per_s(path)
    exported = ExportedDesign(design, view, progress, stop)
    camera = _Camera(exported, settings, options, options.part_of(seen))
    film = film_of(view, settings, camera.end_s, per_s, facts_of(design.limb))
    about = f"SkinSource studio, {camera.words(film)}"
    with video_file(path, camera.size, about, stop) as add:
        for number in range(film.count):
            add(camera.frame(film, number))
            progress(number + 1, film.count, "Drawing frames")


def _usual_size() -> PictureOptions:
    return PictureOptions(width_px=SIZE_PX[0], height_px=SIZE_PX[1])


class _Camera:
    """Draws one frame after another."""

    def __init__(
        self,
        exported: ExportedDesign,
        settings: SkinSettings,
        options: PictureOptions | None = None,
        seen: SeenPart = ALL,
    ) -> None:
        self._seen = seen
        self._exported, self._settings = exported, settings
        self._options = options or _usual_size()
        self.size = frame_size(self._options)
        findings: Findings = exported.value("validity")
        self._caption = _caption_of(exported, findings)
        self._frames = Frames()
        self._family = QGuiApplication.font().family()
        interpolated = settings.map_style == "interpolated"
        found = exported.values({"limb_map", *({"surface"} if interpolated else ())})
        self._surface = found.get("surface")
        limb = exported.limb
        self._content = MapContent(
            limb_map=found["limb_map"],
            field=None if self._surface is None else field_image(self._surface, limb),
            outputs=exported.view.outputs,
            sensors_shown=settings.sensors_shown,
            px_per_mm=limb.map.hand_length_px / limb.hand_length_mm,
            noisy=next((one.outputs for one in findings if one.name == "noise"), ()),
            synthetic=limb.synthetic,
        )
        self._image = QImage(*self.size, QImage.Format.Format_RGB888)
        self._look(exported.view)

    @property
    def end_s(self) -> float:
        """When the response ends, on the time axis."""
        return self._frames.end_s(self._exported.view)

    def words(self, film: Film) -> str:
        """How fast time runs, and of whom this is."""
        limb = limb_word(self._exported.design.limb).title
        return f"{limb} · 1/{film.slow_motion:g} of real time"

    def frame(self, film: Film, number: int) -> NDArray[np.uint8]:
        """One frame, (rows, columns, 3)."""
        view = replace(self._exported.view, playhead_s=film.time_s(number))
        if self._frames.runs_out(view) or not self._frames.has(view):
            self._look(view)
        shown = self._frames.frame(view, self._settings)
        signed = shown.quantity.signed
        content = replace(
            self._content,
            values=shown.values,
            field_values=None if self._surface is None else self._surface.interpolate(shown.values),
            quantity=shown.quantity,
            value_range=self._frames.value_range(self._settings),
            colours=DIVERGING if signed else self._settings.colours,
        )
        heading = heading_of(self._exported.design, view, shown.quantity)
        pace = f"1/{film.slow_motion:g} of real time"
        heading = replace(heading, details=f"{heading.details} · {pace}")
        self._draw(content, heading)
        rows, columns = self._image.height(), self._image.width()
        lines = np.frombuffer(self._image.constBits(), np.uint8)
        return lines.reshape(rows, self._image.bytesPerLine())[:, : 3 * columns].reshape(
            rows, columns, 3
        )

    def _draw(self, content: MapContent, heading: Heading) -> None:
        options = self._options

        def draw(painter: QPainter, width: int, height: int, theme: Theme) -> None:
            size = QSizeF(width, height)
            paint_picture(painter, size, content, heading, theme, self._family, self._seen)

        painter = QPainter(self._image)
        width, height = self.size
        painter.scale(width / options.width_px, height / options.height_px)
        font = painter.font()
        font.setFamily(self._family)
        painter.setFont(font)
        with_caption(draw, self._caption)(
            painter, options.width_px, options.height_px, options.theme
        )
        painter.end()

    def _look(self, view: View) -> None:
        name = self._settings.quantity
        block = block_of(view.playhead_s)
        found = self._exported.values({NEEDS[name]}, moving_block=block)
        self._frames.take(found, name, view)


def _caption_of(exported: ExportedDesign, findings: Findings) -> str:
    """Stimulus, limb, and conditions of the measurement that are not kept."""
    design, note = exported.design, exported.limb.note
    judged = Judged(label=limb_word(design.limb).title, note=note, findings=findings)
    return caption_of(design, notes=in_short([judged]))
