"""What clips play, as pictures that are kept."""

from collections import OrderedDict
from dataclasses import dataclass

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QPainter, QPixmap

from skinsource.base.arrays import Floats
from skinsource_gui.widgets.kept_picture import KeptPicture
from skinsource_gui.widgets.paper import is_on_paper, thin_pen
from skinsource_gui.widgets.plot.curve_points import course_of
from skinsource_gui.widgets.plot.decimation import KeptColumns
from skinsource_gui.widgets.plot.wave import wave_of

_BUDGET_BYTES = 48 * 2**20
_BYTES_PER_PIXEL = 4
# Strokes of this mean length, of 2, make a block, whose edge needs no smoothing.
_BLOCK = 0.8


@dataclass(frozen=True, slots=True, eq=False)
class Played:
    """What a clip plays.

    Attributes
    ----------
    samples : (n_times,)
    sample_rate_hz
    """

    samples: Floats
    sample_rate_hz: float


@dataclass(frozen=True, slots=True)
class Look:
    """How it is drawn.

    Attributes
    ----------
    colour
        Of the curve, as a number.
    reach
        Height of a sample of 1, as a share of half the picture; negative: upside down.
    part
        Which part of the whole is shown, from 0 to 1.
    ratio
        Dots in a px.
    """

    colour: int
    reach: float
    part: tuple[float, float] = (0.0, 1.0)
    ratio: float = 1.0


@dataclass(frozen=True, slots=True)
class _Key:
    # The samples stand beside the picture, so that their number is not given to others.
    samples: int
    rate_hz: float
    width: float
    height: float
    look: Look


class ClipPictures:
    """Curves of clips, painted once for each size and look; the oldest go first.

    Attributes
    ----------
    mark
        The frame of the one clip that is shown elsewhere.
    columns
        Where the samples of the clip that was painted last fall.
    painted, waves
        How many pictures were painted, and how many of them show the wave between samples: an edit
        that changes no clip paints none.
    """

    def __init__(self, budget_bytes: int = _BUDGET_BYTES) -> None:
        self._kept: OrderedDict[_Key, tuple[Floats, QPixmap]] = OrderedDict()
        self._budget, self._bytes = budget_bytes, 0
        self.painted = self.waves = 0
        self.mark, self.columns = KeptPicture(), KeptColumns()

    def paint(self, painter: QPainter, played: Played, area: QRectF, look: Look) -> None:
        """Paint what a clip plays; on paper as lines."""
        if is_on_paper():
            painter.save()
            painter.translate(area.topLeft())
            self._draw(painter, played, area.size(), look)
            painter.restore()
            return
        painter.drawPixmap(area.topLeft(), self.picture(played, area.size(), look))

    def picture(self, played: Played, size: QSizeF, look: Look) -> QPixmap:
        """Picture of what a clip plays, so large, px."""
        samples = played.samples
        key = _Key(id(samples), played.sample_rate_hz, size.width(), size.height(), look)
        found = self._kept.get(key)
        if found is not None and found[0] is samples:
            self._kept.move_to_end(key)
            return found[1]
        made = QPixmap((size * look.ratio).toSize().expandedTo(QSizeF(1, 1).toSize()))
        made.setDevicePixelRatio(look.ratio)
        made.fill(Qt.GlobalColor.transparent)
        on_picture = QPainter(made)
        self._draw(on_picture, played, size, look)
        on_picture.end()
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

    def _draw(self, painter: QPainter, played: Played, size: QSizeF, look: Look) -> None:
        samples, width, height = played.samples, size.width(), size.height()
        if not samples.size:
            return
        time_s = np.arange(samples.size) / played.sample_rate_hz
        first_s, end_s = (share * samples.size / played.sample_rate_hz for share in look.part)
        across = max(round(width * look.ratio), 1)
        wave = wave_of(time_s, samples[np.newaxis])
        found = self.columns.of(time_s, (first_s, end_s), across)
        seen = course_of(found, samples[np.newaxis], wave, width, look.ratio)
        heights = look.reach * seen.line.y[0]
        if seen.wave:
            self.waves += 1
            # Between samples it may be higher than the lane is for them.
            heights = heights / max(float(np.abs(heights).max()), 1.0)
        strokes = np.abs(heights[1::2] - heights[::2]) if seen.line.strokes else 0.0
        block = not is_on_paper() and np.mean(strokes) > _BLOCK * abs(look.reach)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, not block)
        painter.setPen(thin_pen(QColor.fromRgba(look.colour)))
        x = (seen.line.x - first_s) / (end_s - first_s) * width
        y = height / 2 - np.clip(heights, -1, 1) * (height / 2 - 1)
        if x.size == 1:
            painter.drawLine(QPointF(x[0], height / 2), QPointF(x[0], y[0]))
        else:
            painter.drawPath(arrayToQPath(x, y, finiteCheck=False))


def _size(picture: QPixmap) -> int:
    return picture.width() * picture.height() * _BYTES_PER_PIXEL
