"""A film of maps side by side: their loop, as the stage or the Compare panel shows it."""

from copy import copy
from dataclasses import dataclass, replace
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6 import QtGui
from PySide6.QtCore import QRectF

from skinsource.base.job import Progress, Stop
from skinsource.design.design import Design, View
from skinsource.export.video import frames_per_s, video_file
from skinsource_gui.panels.compare.content import CompareContent
from skinsource_gui.panels.compare.motion import MovingMaps
from skinsource_gui.panels.compare.view import paint_page
from skinsource_gui.panels.skin.film import FilmOptions, frame_size, painted_frame
from skinsource_gui.plots.pictures import PictureOptions, Remark, letters_px
from skinsource_gui.qt.theme import Theme, on_paper, tabular

# A loop is repeated until it has been seen for so long.
_LEAST_S = 4.0
_NOTHING = "No maps move side by side. Show a comparison in motion, on the stage or in Compare."
_TOO_FAST = "At this speed a film would show false waves. Choose Play > Automatic speed."


class MapsFilmOptions(FilmOptions):
    """Size, colours and format: all else is as the panel shows it."""

    @property
    def unused(self) -> frozenset[str]:
        return super().unused | {"quantity", "rms_window_s", "part", "pace"}


@dataclass(frozen=True, kw_only=True, eq=False)
class MapsFilm:
    """Maps in motion as a panel showed them, and the caption below them."""

    moving: MovingMaps
    content: CompareContent
    caption: str

    def turns(self, per_s: int) -> tuple[int, int]:
        """Return how often the loop is shown, and in how many frames."""
        turn_s = self.moving.longest_s * self.moving.slow_motion
        common, _ = self.moving.common_turns
        turns = common * ceil(_LEAST_S / (common * turn_s))
        return turns, round(turns * turn_s * per_s)

    def frame(self, image: QtGui.QImage, options: FilmOptions, turns: float) -> NDArray[np.uint8]:
        """Draw the maps after so many turns, and return the pixels, (rows, columns, 3)."""
        # The film may be drawn while its preview is.
        moving = copy(self.moving)
        moving.turns = turns
        content = replace(self.content, cells=moving.cells(), about=moving.clock_text)

        def draw(painter: QtGui.QPainter, width: int, height: int, theme: Theme) -> None:
            room, font = QRectF(0, 0, width, height), tabular(painter.font())
            # Those of the caption are no larger.
            font.setPixelSize(letters_px(options.width_px, options.height_px))
            painter.setFont(font)
            painter.fillRect(room, QtGui.QColor(theme.base))
            with on_paper():
                paint_page(painter, content, room, theme)

        return painted_frame(image, options, draw, self.caption)


def maps_options(last: PictureOptions) -> MapsFilmOptions:
    """Return the options of the last such film, or usual ones in the given size."""
    if isinstance(last, MapsFilmOptions):
        return last
    return MapsFilmOptions(width_px=last.width_px, height_px=last.height_px)


def maps_remark(maps: MapsFilm | None, options: FilmOptions) -> Remark:
    """Return how long the film will be, or why there is none."""
    if maps is None:
        return Remark(_NOTHING, refuses=True)
    fastest_hz = max(loop.fastest_hz for loop, _ in filter(None, maps.moving.loops))
    if 2.0 * fastest_hz > options.frames_per_s * maps.moving.slow_motion:
        return Remark(_TOO_FAST, refuses=True)
    _, count = maps.turns(options.frames_per_s)
    _, closes = maps.moving.common_turns
    ends = "which begins again without a seam" if closes else "which jumps where it begins again"
    return Remark(f"{count / options.frames_per_s:.3g} s of film, {ends}: {count} frames.")


def export_maps_film(
    path: Path,
    design: Design,
    view: View,
    *,
    options: FilmOptions,
    seen: MapsFilm,
    progress: Progress,
    stop: Stop,
    largest_error: float,
) -> None:
    """Write maps side by side in motion until all begin again, or nearly so.

    Raises
    ------
    MissingExtraError, InvalidInputError, StorageError, Stopped
        As `skinsource.export.video`.
    """
    turns, count = seen.turns(frames_per_s(path))
    image = QtGui.QImage(*frame_size(options), QtGui.QImage.Format.Format_RGB888)
    about = f"SkinSource studio, 1/{seen.moving.slow_motion:g} of real time"
    with video_file(path, frame_size(options), about, stop) as add:
        for number in range(count):
            add(seen.frame(image, options, turns * number / count))
            progress(number + 1, count, "Drawing frames")


def maps_picture(*_: Any, options: FilmOptions, seen: MapsFilm, stop: Stop) -> QtGui.QImage:
    """Return a frame of the film."""
    image = QtGui.QImage(*frame_size(options), QtGui.QImage.Format.Format_RGB888)
    seen.frame(image, options, 0.25)
    return image
