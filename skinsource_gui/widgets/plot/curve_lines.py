"""Curves as lines in pixels."""

from dataclasses import dataclass

import numpy as np
from pyqtgraph.functions import arrayToQPolygonF
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPen, QPolygonF

from skinsource_gui.theme import Theme
from skinsource_gui.widgets.plot.curves import Curves
from skinsource_gui.widgets.plot.decimation import in_rows, visible_points
from skinsource_gui.widgets.plot.plot_rows import Rows
from skinsource_gui.widgets.plot.x_window import XWindow

_STALE_OPACITY = 0.5
# Upright strokes that are longer than this on average make a block.
_BLOCK_PX = 4.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CurveLine:
    """A curve as it is drawn.

    Attributes
    ----------
    points
        In px.
    smooth
        Whether its edges are smoothed; in a block nobody would see it, and it takes twice as long.
    """

    points: QPolygonF
    smooth: bool


def curve_lines(
    curves: Curves, window: XWindow, rows: Rows, area: QRectF, *, stacked: bool, ratio: float
) -> tuple[CurveLine, ...]:
    """One line for each curve that is drawn, in ``area``.

    Parameters
    ----------
    curves, window, rows, stacked
        What is seen; more curves than there are rows in a stack are left out.
    area
        Where the curves are, px.
    ratio
        Device pixels in a pixel.
    """
    seen = drawn_curves(curves, rows, stacked=stacked)
    x, y = window.axis.positions(curves.x), curves.y[:seen]
    if window.axis.log:
        x, y = x[curves.x > 0], y[:, curves.x > 0]
    points = visible_points(x, y, window.shown, int(area.width() * ratio))
    low, high = window.shown
    x_px = area.left() + area.width() / (high - low) * (points.x - low)
    ranks = np.arange(seen)[:, np.newaxis]
    heights = rows.heights(points.y, ranks if stacked else 0)
    y_px = area.bottom() - area.height() / rows.count * heights
    blocks = np.zeros(seen, dtype=bool)
    if points.strokes:
        blocks = np.abs(y_px[:, 1::2] - y_px[:, ::2]).mean(axis=1) > _BLOCK_PX
        y_px[blocks] = in_rows(y_px[blocks], ratio)
    return tuple(
        CurveLine(points=arrayToQPolygonF(x_px, line_px), smooth=not block)
        for line_px, block in zip(y_px, blocks, strict=True)
    )


def drawn_curves(curves: Curves, rows: Rows, *, stacked: bool) -> int:
    """How many of ``curves`` are drawn."""
    return rows.count if stacked else len(curves.names)


def paint_lines(
    painter: QPainter, lines: tuple[CurveLine, ...], area: QRectF, theme: Theme, *, stale: bool
) -> None:
    """Paint lines inside ``area``, each in the colour of its rank; pale where they are stale."""
    painter.save()
    # Lines on the lower and the right edge lie half beyond it.
    painter.setClipRect(area.adjusted(0, 0, 1, 1))
    if stale:
        painter.setOpacity(_STALE_OPACITY)
    for rank, line in enumerate(lines):
        # One pixel of the screen: any wider line takes a hundred times as long.
        painter.setPen(QPen(theme.output_colour(rank), 0))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, line.smooth)
        painter.drawPolyline(line.points)
    painter.restore()
