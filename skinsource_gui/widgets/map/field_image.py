"""The interpolated map as a picture that a vector outline can clip."""

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage

from skinsource.base.arrays import Floats
from skinsource.limbs.limb import Limb
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource_gui.widgets.map.colour_maps import colour_indices

# The picture goes on this many pixels outside the mask, in the colours of the rim, so that
# smooth scaling never meets an empty pixel inside the outline.
_COLLAR = 2
# Neighbours that share an edge come before those that share a corner.
_NEIGHBOURS = ((0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1))


class FieldImage:
    """Pixels of one surface operator, coloured anew for each set of levels.

    Parameters
    ----------
    mask : (rows, columns) of bool
        Pixels inside the outline; rows increase with y.
    x_mm, y_mm : (columns,) and (rows,)
        Centres of the pixels.
    px_per_mm
        Outline pixels in a millimetre.

    Attributes
    ----------
    rect
        What the picture covers, in outline pixels; its top is the lowest y.
    """

    def __init__(
        self, mask: NDArray[np.bool_], x_mm: Floats, y_mm: Floats, px_per_mm: float
    ) -> None:
        self._shape = mask.shape
        self._step_mm = float(x_mm[1] - x_mm[0]), float(y_mm[1] - y_mm[0])
        self._origin_mm = float(x_mm[0]), float(y_mm[0])
        self._px_per_mm = px_per_mm
        source = _inside_pixels(mask)[::-1]
        self._targets = np.flatnonzero(source >= 0)
        self._sources = source.ravel()[self._targets]
        self._pixels = np.zeros(source.shape, np.uint32)
        rows, columns = self._size = source.shape
        self._image = self._of_pixels()
        self._drawn: tuple[Floats, tuple[float, float], NDArray[np.uint32]] | None = None
        (dx, dy), (x0, y0) = self._step_mm, self._origin_mm
        self.rect = QRectF(
            (x0 - (_COLLAR + 0.5) * dx) * px_per_mm,
            (y0 - (_COLLAR + 0.5) * dy) * px_per_mm,
            columns * dx * px_per_mm,
            rows * dy * px_per_mm,
        )

    def image(
        self, levels_db: Floats, range_db: tuple[float, float], table: NDArray[np.uint32]
    ) -> QImage:
        """Picture of levels, (rows, columns); its first line is the highest y.

        Its pixels are this object's own and change with the next call.
        """
        drawn = self._drawn
        if (
            drawn is None
            or drawn[0] is not levels_db
            or drawn[1] != range_db
            or drawn[2] is not table
        ):
            codes = colour_indices(levels_db.ravel().take(self._sources), range_db)
            self._pixels.ravel()[self._targets] = table.take(codes)
            self._drawn = levels_db, range_db, table
            self._image = self._of_pixels()
        return self._image

    def _of_pixels(self) -> QImage:
        """A picture with a key of its own: a PDF holds those of one key for the same picture."""
        rows, columns = self._size
        depth = QImage.Format.Format_ARGB32_Premultiplied
        return QImage(self._pixels.data, columns, rows, 4 * columns, depth)

    def level_at(self, levels_db: Floats, x_px: float, y_px: float) -> float | None:
        """Level of the pixel at a place of the outline, dB; None outside."""
        column = round((x_px / self._px_per_mm - self._origin_mm[0]) / self._step_mm[0])
        row = round((y_px / self._px_per_mm - self._origin_mm[1]) / self._step_mm[1])
        rows, columns = self._shape
        if not (0 <= row < rows and 0 <= column < columns):
            return None
        level = float(levels_db[row, column])
        return level if np.isfinite(level) else None


def field_image(surface: SurfaceOperator, limb: Limb) -> FieldImage:
    """Pixels of the surface of ``limb``."""
    px_per_mm = limb.map.hand_length_px / limb.hand_length_mm
    return FieldImage(surface.mask, surface.x_mm, surface.y_mm, px_per_mm)


def _inside_pixels(mask: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Index of the inside pixel whose colour each pixel takes, -1 for none, with the collar."""
    own = np.where(mask, np.arange(mask.size).reshape(mask.shape), -1)
    source = np.pad(own, _COLLAR, constant_values=-1)
    for _ in range(_COLLAR):
        grown = source.copy()
        for step in _NEIGHBOURS:
            neighbour = np.roll(source, step, axis=(0, 1))
            taken = (grown < 0) & (neighbour >= 0)
            grown[taken] = neighbour[taken]
        source = grown
    return source
