"""Draws a colour scale with its ticks."""

from math import floor, log10

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetrics, QImage, QPainter, QPen

from skinsource_gui.panels.skin.map_quantity import MapQuantity
from skinsource_gui.panels.skin.scale.level_range import Range, tick_levels
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.fields.level_text import minus

# So many lines beside the colours are numbers: farther than handles reach.
_WORDS_LINES = 0.8


def level_y(level_db: float, axis_db: Range, ramp: QRectF) -> float:
    """Screen height of a level on a scale whose ``ramp`` spans ``axis_db``."""
    low, high = axis_db
    return ramp.bottom() - (level_db - low) / (high - low) * ramp.height()


def paint_colour_scale(
    painter: QPainter,
    ramp: QRectF,
    axis_db: Range,
    range_db: Range,
    table: NDArray[np.uint32],
    theme: Theme,
    quantity: MapQuantity,
) -> None:
    """Draw the colours in ``ramp``, ticks and title to its right, in the painter's font.

    Parameters
    ----------
    painter
        Its font is that of the ticks.
    ramp
        Area of the colours.
    axis_db
        Levels of its lower and upper edge; values, where ``quantity`` is no level.
    range_db
        Levels of the lowest and the highest colour.
    table, theme
        Colours.
    quantity
        What the values are.
    """
    line = painter.fontMetrics().height()
    top, bottom = (level_y(level, axis_db, ramp) for level in reversed(range_db))
    painter.fillRect(ramp, QColor(int(table[0])))
    painter.fillRect(
        QRectF(ramp.left(), ramp.top(), ramp.width(), top - ramp.top()), QColor(int(table[-1]))
    )
    column = np.ascontiguousarray(table[::-1])
    image = QImage(column.data, 1, len(column), 4, QImage.Format.Format_RGB32)
    painter.drawImage(QRectF(ramp.left(), top, ramp.width(), bottom - top), image)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.border), 1))
    painter.drawRect(ramp)
    widest = 0
    for level in _ticks(axis_db, ramp.height(), 2.8 * line, quantity):
        y = level_y(level, axis_db, ramp)
        words = minus(f"{level:g}")
        widest = max(widest, painter.fontMetrics().horizontalAdvance(words))
        painter.setPen(QPen(QColor(theme.dim), 1))
        painter.drawLine(QPointF(ramp.right(), y), QPointF(ramp.right() + 0.3 * line, y))
        painter.setPen(QColor(theme.text))
        beside = QRectF(ramp.right() + _WORDS_LINES * line, y - line / 2, 4 * line, line)
        painter.drawText(beside, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, words)
    _paint_title(
        painter, ramp, ramp.right() + (_WORDS_LINES + 0.4) * line + widest, theme, quantity
    )


def fitting_title(quantity: MapQuantity, metrics: QFontMetrics, room_px: int) -> str:
    """The longest title that has room; of the shortest as much as has, with three dots."""
    titles = quantity.titles
    fitting = (title for title in titles if metrics.horizontalAdvance(title) <= room_px)
    shortest = metrics.elidedText(titles[-1], Qt.TextElideMode.ElideRight, room_px)
    return next(fitting, shortest)


def _paint_title(
    painter: QPainter, ramp: QRectF, left: float, theme: Theme, quantity: MapQuantity
) -> None:
    line = painter.fontMetrics().height()
    painter.save()
    painter.setPen(QColor(theme.dim))
    painter.translate(left + line / 2, ramp.center().y())
    painter.rotate(-90)
    words = fitting_title(quantity, painter.fontMetrics(), int(ramp.height()))
    along = QRectF(-ramp.height() / 2, -line / 2, ramp.height(), line)
    painter.drawText(along, Qt.AlignmentFlag.AlignCenter, words)
    painter.restore()


def _ticks(axis: Range, room_px: float, spacing_px: float, quantity: MapQuantity) -> list[float]:
    if not quantity.signed:
        return tick_levels(*axis, room_px, spacing_px)
    # Steps of levels are whole decibels; here any power of ten can be meant.
    scale = 10.0 ** (floor(log10(axis[1] - axis[0])) - 1)
    found = tick_levels(axis[0] / scale, axis[1] / scale, room_px, spacing_px)
    return [tick * scale for tick in found]
