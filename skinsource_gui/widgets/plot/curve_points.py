"""Curves as points of a view."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QRectF

from skinsource.arrays import Floats
from skinsource_gui.widgets.plot.curves import Curves
from skinsource_gui.widgets.plot.decimation import KeptColumns, in_rows, without_notches
from skinsource_gui.widgets.plot.value_scale import ValueScale
from skinsource_gui.widgets.plot.x_window import XWindow

# Upright strokes that are longer than this on average make a block.
_BLOCK_PX = 4.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CurvePoints:
    """What is drawn of a curve.

    Attributes
    ----------
    x : (n_points,)
        Positions of the x axis.
    y : (n_points,)
        Heights in the row, 0 to 1.
    smooth
        Whether its edges are smoothed; in a block nobody would see it, and it takes twice as long.
    """

    x: Floats
    y: Floats
    smooth: bool


def curve_points(
    curves: Curves,
    window: XWindow,
    scale: ValueScale,
    rows: list[QRectF],
    ratio: float,
    columns: KeptColumns,
) -> tuple[CurvePoints, ...]:
    """What is drawn of each curve: in the one row there is, or in one each.

    Parameters
    ----------
    curves, window, scale
        What is seen; more curves than there are rows in a stack are left out.
    rows
        Where the row of each curve that is drawn is, px.
    ratio
        Device pixels in a pixel.
    columns
        Those of the plot.
    """
    x, y = window.axis.positions(curves.x), curves.y[: len(rows)]
    if window.axis.log:
        x, y = x[curves.x > 0], y[:, curves.x > 0]
    points = columns.of(x, window.shown, int(rows[0].width() * ratio)).points(y)
    heights = scale.heights(points.y)
    blocks = np.zeros(len(rows), dtype=bool)
    if points.strokes:
        heights = without_notches(heights)
        row_px = np.array([row.height() for row in rows])
        strokes = np.abs(heights[:, 1::2] - heights[:, ::2]).mean(axis=1) * row_px
        blocks = strokes > _BLOCK_PX
        bottom = np.array([row.bottom() for row in rows])[blocks, np.newaxis]
        row_px = row_px[blocks, np.newaxis]
        heights[blocks] = (bottom - in_rows(bottom - row_px * heights[blocks], ratio)) / row_px
    return tuple(
        CurvePoints(x=points.x, y=line, smooth=not block)
        for line, block in zip(heights, blocks.tolist(), strict=True)
    )
