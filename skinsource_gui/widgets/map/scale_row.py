"""What the colours of small maps mean, in a row below them."""

from dataclasses import dataclass, replace

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

from skinsource.base.arrays import Floats
from skinsource.base.decibels import FLOOR_DB
from skinsource.signals.map_range import MAP_RANGE_DB, map_range_db
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.map.colour_maps import VIRIDIS, colour_table
from skinsource_gui.widgets.map.level_look import FIXED_MARK, LevelLook
from skinsource_gui.widgets.map.scale_ticks import tick_text
from skinsource_gui.widgets.map.small_map import Range

#: What stands in the place of a level that there is not.
SILENT = "silent"
_LEVELS = "dB re 1 m/s²"
_OF_OWN = (-MAP_RANGE_DB, 0.0)
_RAMP_PX, _ABOVE_PX = 9.0, 2.0
_CENTRE = Qt.AlignmentFlag.AlignCenter
# Of the levels that a map spans, of differences with zero in their middle, and of narrow scales.
_TICKS, _SIGNED_TICKS, _FEW_TICKS = 6, 5, 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Scale:
    """Colours, and what they mean.

    Attributes
    ----------
    range_db
        Values of the lowest and the highest colour.
    words
        Unit, and what the values are.
    colours
        Name of the colour map.
    signed
        Whether values are told with their sign.
    reached_db
        The smallest and the largest value; those beyond the range have the colour of its end.
        None: all lie within.
    """

    range_db: Range
    words: str
    colours: str = VIRIDIS
    signed: bool = False
    reached_db: Range | None = None

    def text(self, value_db: float) -> str:
        """``"−12.3 dB"``; with a sign where it is one of a difference, which silence has not."""
        if not self.signed and value_db <= FLOOR_DB:
            return SILENT
        return minus(f"{value_db:+z.1f} dB" if self.signed else f"{value_db:z.1f} dB")


def scale_of_levels(levels_db: Floats, look: LevelLook) -> Scale:
    """The scale of RMS levels as they shall look; it says so where its range was fixed by hand."""
    fixed = look.map_range_db is not None
    return Scale(
        range_db=look.map_range_db or map_range_db(levels_db),
        words=f"{_LEVELS} · {FIXED_MARK}" if fixed else _LEVELS,
        colours=look.colours,
    )


def scale_of_own(look: LevelLook) -> Scale:
    """The scale of RMS levels that are each relative to the loudest output of their map."""
    return Scale(range_db=_OF_OWN, words="dB re each map's maximum", colours=look.colours)


def with_matched(scale: Scale, matched: str) -> Scale:
    """The same scale, which says by how much values are louder or softer than stored, if at all."""
    return replace(scale, words=f"{scale.words}, {matched}") if matched else scale


def scale_row_px(line_px: float) -> float:
    """Height of `paint_scale_row`, whose words have lines of this height."""
    return _ABOVE_PX + _RAMP_PX + 2.0 * line_px


def paint_scale_row(painter: QPainter, area: QRectF, scale: Scale, theme: Theme) -> None:
    """Draw the colours in the middle of ``area``, with numbers and words below them."""
    line = painter.fontMetrics().height()
    width = max(min(area.width() - 4.0 * line, 20.0 * line), 4.0 * line)
    ramp = QRectF(area.center().x() - width / 2.0, area.top() + _ABOVE_PX, width, _RAMP_PX)
    row = np.ascontiguousarray(colour_table(scale.colours))
    image = QImage(row.data, len(row), 1, 4 * len(row), QImage.Format.Format_RGB32)
    painter.drawImage(ramp, image)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.border), 1))
    painter.drawRect(ramp)
    low, high = scale.range_db
    painter.setPen(QColor(theme.text))
    n_ticks = _SIGNED_TICKS if scale.signed else _TICKS
    if ramp.width() < 3.0 * line * n_ticks:
        n_ticks = _FEW_TICKS
    for value in np.linspace(low, high, n_ticks):
        x = ramp.left() + (value - low) / (high - low) * ramp.width()
        words = QRectF(x - 3.0 * line, ramp.bottom(), 6.0 * line, line)
        number = tick_text(value, scale.range_db, scale.reached_db, signed=scale.signed)
        painter.drawText(words, _CENTRE, number)
    painter.setPen(QColor(theme.dim))
    below = QRectF(area.left(), ramp.bottom() + line, area.width(), line)
    painter.drawText(below, _CENTRE, scale.words)
