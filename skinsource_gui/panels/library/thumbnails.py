"""Small pictures of what presets play."""

from functools import lru_cache

import numpy as np
from PySide6.QtCore import QLineF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from skinsource.errors import SkinSourceError
from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.presets import Preset, mixed

SIZE_PX = QSize(44, 26)
#: Pixels of the screen for each of them, at most.
_SHARPEST = 3


@lru_cache(maxsize=256)
def thumbnail(preset: Preset, colour: str, ratio: float) -> QPixmap:
    """Highest and lowest sample of each column; nothing where it cannot be played."""
    per_px = min(max(round(ratio), 1), _SHARPEST)
    picture = QPixmap(SIZE_PX * per_px)
    picture.setDevicePixelRatio(per_px)
    picture.fill(Qt.GlobalColor.transparent)
    try:
        samples = mixed(preset.fragment, SAMPLE_RATE_HZ)
    except SkinSourceError:
        return picture
    if not samples.size:
        return picture
    columns = min(SIZE_PX.width() * per_px, samples.size)
    starts = np.arange(columns) * samples.size // columns
    largest = max(float(np.abs(samples).max()), np.finfo(np.float64).tiny)
    high = np.maximum.reduceat(samples, starts) / largest
    low = np.minimum.reduceat(samples, starts) / largest
    painter = QPainter(picture)
    painter.setPen(QPen(QColor(colour), 0))
    middle, reach = SIZE_PX.height() / 2, SIZE_PX.height() / 2 - 1
    # Each stroke reaches the one before it, so that a slow curve is a line.
    before = np.concatenate((starts[:0], [0.0], (high + low)[:-1] / 2))
    top, bottom = np.maximum(high, before), np.minimum(low, before)
    x = (np.arange(columns) + 0.5) * SIZE_PX.width() / columns
    painter.drawLines(
        [
            QLineF(across, middle - reach * upper, across, middle - reach * lower + 0.5)
            for across, upper, lower in zip(x, top, bottom, strict=True)
        ]
    )
    painter.end()
    return picture
