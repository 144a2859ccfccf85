"""Small pictures of what presets play."""

from functools import lru_cache

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen, QPixmap

from skinsource.base.arrays import Floats
from skinsource.base.errors import SkinSourceError
from skinsource.design.presets.presets import Preset, mixed

SIZE_PX = QSize(44, 26)
#: Pixels of the screen for each of them, at most.
_SHARPEST = 3
_LINE_PX = 1.0
# What is so small looks the same at the rate of any limb.
_RATE_HZ = 2000.0


@lru_cache(maxsize=256)
def thumbnail(preset: Preset, colour: str, ratio: float) -> QPixmap:
    """What it plays, at full height; nothing where it cannot be played."""
    per_px = min(max(round(ratio), 1), _SHARPEST)
    picture = QPixmap(SIZE_PX * per_px)
    picture.setDevicePixelRatio(per_px)
    picture.fill(Qt.GlobalColor.transparent)
    try:
        samples = mixed(preset.fragment, _RATE_HZ)
    except SkinSourceError:
        return picture
    if not samples.size:
        return picture
    samples = samples / max(float(np.abs(samples).max()), np.finfo(np.float64).tiny)
    painter = QPainter(picture)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(QColor(colour), _LINE_PX))
    painter.drawPath(_curve(samples, SIZE_PX.width() * per_px))
    painter.end()
    return picture


def _curve(samples: Floats, columns: int) -> QPainterPath:
    """Every sample, or the highest and the lowest of each column."""
    if samples.size > 2 * columns:
        starts = np.arange(columns) * samples.size // columns
        high, low = np.maximum.reduceat(samples, starts), np.minimum.reduceat(samples, starts)
        samples = np.stack((high, low), axis=1).reshape(-1)
    middle, reach = SIZE_PX.height() / 2, SIZE_PX.height() / 2 - 1
    x = np.linspace(1, SIZE_PX.width() - 1, max(samples.size, 2))
    y = np.resize(middle - reach * samples, x.size)
    return arrayToQPath(x, y, finiteCheck=False)
