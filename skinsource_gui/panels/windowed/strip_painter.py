"""Draws the strip of windows: maps in one scale, the scale, and the extent over the windows."""

from collections.abc import Callable
from math import ceil

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from skinsource_gui.panels.windowed.content import WindowedContent
from skinsource_gui.panels.windowed.strip_layout import StripLayout
from skinsource_gui.panels.windowed.window_titles import window_titles
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.map.colour_maps import colour_table
from skinsource_gui.widgets.map.length_bar import paint_small_bar
from skinsource_gui.widgets.map.scale_row import paint_scale_row
from skinsource_gui.widgets.map.small_map import paint_small_map

_DOT_PX = 2.5
# Marks of inputs at fingertips stand beyond the map.
_RING_PX = 4.0
_CENTRE = Qt.AlignmentFlag.AlignCenter
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
#: Names of the curves of the extent, the longest first, and which colour of outputs each has.
CURVES = (
    (("mean distance", "mean", "mean"), 0),
    (("90 % of the energy within", "90 % within", "90 %"), 1),
)
_BELOW = ("mm from {}, window by window", "mm from {}", "mm")


def paint_strip(
    painter: QPainter,
    content: WindowedContent,
    layout: StripLayout,
    theme: Theme,
    chosen: int | None = None,
) -> None:
    """Draw ``content``; the painter's font is that of all words.

    Parameters
    ----------
    painter, layout, theme
        On what, where, in which colours.
    content
        What is shown.
    chosen
        The window that is framed; None: none is.
    """
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    line = float(painter.fontMetrics().height())
    scale = content.scale
    table = colour_table(scale.colours)
    width_of = painter.fontMetrics().horizontalAdvance
    titles = window_titles(content.bounds_s, layout.cells, width_of).words
    for window, (cell, words) in enumerate(zip(layout.cells, titles, strict=True)):
        painter.setPen(QColor(theme.text))
        # One that is named for some may be wider than its map.
        middle = QRectF(cell.left(), cell.top(), cell.width(), line)
        painter.drawText(middle, _CENTRE | Qt.TextFlag.TextDontClip, words)
        area = cell.adjusted(2.0, line + _RING_PX, -2.0, -2.0)
        paint_small_map(
            painter, area, content.map_of(window), content.design, theme, scale.range_db, table
        )
        if window == len(titles) - 1:  # one for all: they are alike
            limb = content.design.limb
            paint_small_bar(painter, area, content.map_of(window), limb, theme)
        if window == chosen:
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(theme.accent), 1.5))
            painter.drawRoundedRect(cell.adjusted(1.0, 0.5, -1.0, -1.0), 3.0, 3.0)
    paint_scale_row(painter, layout.scale, scale, theme)
    _paint_extent(painter, layout.plot, content, theme)


def _paint_extent(painter: QPainter, area: QRectF, content: WindowedContent, theme: Theme) -> None:
    """Mean distance and the distance of 90 % of the energy, a dot for each window."""
    known = [one for one in content.told_extents if one is not None]
    top = _rounded_up(max((max(one.mean_distance_mm, one.d90_mm) for one in known), default=1.0))
    line = painter.fontMetrics().height()
    _paint_axis(painter, area, top, content.origin, theme)
    n = max(len(content.extents), 1)
    for _, rank in CURVES:
        colour = theme.output_colour(rank)
        painter.setPen(QPen(colour, 1.5))
        painter.setBrush(colour)
        before: QPointF | None = None
        for window, one in enumerate(content.told_extents):
            if one is None:
                before = None
                continue
            value = one.mean_distance_mm if rank == 0 else one.d90_mm
            x = area.left() + (window + 0.5) / n * area.width()
            at = QPointF(x, area.bottom() - value / top * area.height())
            if before is not None:
                painter.drawLine(before, at)
            painter.drawEllipse(at, _DOT_PX, _DOT_PX)
            before = at
    x, metrics = area.left(), painter.fontMetrics()
    for name, rank in curve_names(area.width(), metrics.horizontalAdvance, line):
        painter.setPen(theme.output_colour(rank))
        room = metrics.horizontalAdvance(name) + line
        painter.drawText(QRectF(x, area.top() - 1.2 * line, room, line), Qt.AlignmentFlag(0), name)
        x += room


def curve_names(
    room: float, width_of: Callable[[str], float], gap: float
) -> tuple[tuple[str, int], ...]:
    """Names of the curves and their colours: the longest names that fit, or the shortest."""
    for names in zip(*(names for names, _ in CURVES), strict=True):
        if sum(width_of(name) + gap for name in names) - gap <= room:
            break
    return tuple(zip(names, (rank for _, rank in CURVES), strict=True))


def _paint_axis(painter: QPainter, area: QRectF, top: float, origin: str, theme: Theme) -> None:
    line = painter.fontMetrics().height()
    for part in (0.0, 0.5, 1.0):
        y = area.bottom() - part * area.height()
        painter.setPen(QPen(QColor(theme.grid), 1))
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y))
        painter.setPen(QColor(theme.text))
        beside = QRectF(area.left() - 3.2 * line, y - line / 2.0, 2.9 * line, line)
        painter.drawText(beside, _RIGHT, f"{part * top:g}")
    painter.setPen(QColor(theme.dim))
    below = QRectF(area.left(), area.bottom() + 0.15 * line, area.width(), line)
    width_of = painter.fontMetrics().horizontalAdvance
    said = [words.format(origin) for words in _BELOW]
    fitting = (words for words in said if width_of(words) <= below.width())
    painter.drawText(below, _CENTRE, next(fitting, said[-1]))


def _rounded_up(value: float) -> float:
    """The next 20 mm."""
    return max(ceil(value / 20.0) * 20.0, 20.0)
