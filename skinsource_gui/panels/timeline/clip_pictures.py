"""What clips play, as pictures that are kept."""

from collections import OrderedDict
from dataclasses import dataclass

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from skinsource.arrays import Floats
from skinsource_gui.widgets.kept_picture import KeptPicture
from skinsource_gui.widgets.plot.decimation import KeptColumns

_BUDGET_BYTES = 48 * 2**20
_BYTES_PER_PIXEL = 4
# Strokes of this mean length, of 2, make a block, whose edge needs no smoothing.
_BLOCK = 0.8


@dataclass(frozen=True, slots=True)
class _Key:
    # The samples stand beside the picture, so that their number is not given to others.
    samples: int
    width: int
    height: int
    first: float
    last: float
    reach: float
    colour: int
    ratio: float


class ClipPictures:
    """Curves of clips, painted once for each size and colour; the oldest go first.

    Attributes
    ----------
    mark
        The frame of the one clip that is shown elsewhere.
    columns
        Where the samples of the clip that was painted last fall.
    """

    def __init__(self, budget_bytes: int = _BUDGET_BYTES) -> None:
        self._kept: OrderedDict[_Key, tuple[Floats, QPixmap]] = OrderedDict()
        self._budget, self._bytes = budget_bytes, 0
        #: How many pictures were painted: an edit that changes no clip paints none.
        self.painted = 0
        self.mark, self.columns = KeptPicture(), KeptColumns()

    def picture(
        self,
        samples: Floats,
        width: int,
        height: int,
        colour: QColor,
        *,
        reach: float,
        part: tuple[float, float] = (0.0, 1.0),
        ratio: float = 1.0,
    ) -> QPixmap:
        """Picture of ``samples``, (n_times,).

        Parameters
        ----------
        width, height
            Size, px.
        reach
            Height of a sample of 1, as a share of half the picture; negative: upside down.
        part
            Which part of the whole is shown, from 0 to 1.
        ratio
            Pixels of the screen for each px.
        """
        key = _Key(id(samples), width, height, *part, reach, colour.rgba(), ratio)
        found = self._kept.get(key)
        if found is not None and found[0] is samples:
            self._kept.move_to_end(key)
            return found[1]
        made = _painted(samples, width, height, colour, reach, part, ratio, self.columns)
        self.painted += 1
        self._keep(key, samples, made)
        return made

    def forget(self) -> None:
        """Keep nothing."""
        self._kept.clear()
        self._bytes = 0

    def _keep(self, key: _Key, samples: Floats, made: QPixmap) -> None:
        old = self._kept.pop(key, None)
        self._bytes += _size(made) - (0 if old is None else _size(old[1]))
        self._kept[key] = (samples, made)
        while self._bytes > self._budget and len(self._kept) > 1:
            _, (_, gone) = self._kept.popitem(last=False)
            self._bytes -= _size(gone)


def _size(picture: QPixmap) -> int:
    return picture.width() * picture.height() * _BYTES_PER_PIXEL


def _painted(
    samples: Floats,
    width: int,
    height: int,
    colour: QColor,
    reach: float,
    part: tuple[float, float],
    ratio: float,
    columns: KeptColumns,
) -> QPixmap:
    picture = QPixmap(max(round(width * ratio), 1), max(round(height * ratio), 1))
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    if not samples.size:
        return picture
    painter = QPainter(picture)
    share = np.arange(samples.size) / samples.size
    across = max(round(width * ratio), 1)
    points = columns.of(share, part, across).points(samples[np.newaxis])
    heights = points.y[0]
    block = points.strokes and np.mean(np.abs(heights[1::2] - heights[::2])) > _BLOCK
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, not block)
    painter.setPen(QPen(colour, 0))
    x = (points.x - part[0]) / (part[1] - part[0]) * width
    y = height / 2 - np.clip(reach * heights, -1, 1) * (height / 2 - 1)
    if x.size == 1:
        x, y = np.repeat(x, 2), np.array([height / 2, y[0]])
    painter.drawPath(arrayToQPath(x, y, finiteCheck=False))
    painter.end()
    return picture
