"""Curves as points of a view."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QRectF

from skinsource.base.arrays import Floats
from skinsource.signals.resampling import Extremes
from skinsource_gui.widgets.plot.curves import Curves
from skinsource_gui.widgets.plot.decimation import (
    Columns,
    KeptColumns,
    Points,
    in_rows,
    without_notches,
)
from skinsource_gui.widgets.plot.ranges import Range
from skinsource_gui.widgets.plot.value_scale import ValueScale
from skinsource_gui.widgets.plot.wave import Wave
from skinsource_gui.widgets.plot.x_window import XWindow

# Upright strokes that are longer than this on average make a block.
_BLOCK_PX = 4.0
# From so many pixels of the screen, or dots of a printer, for each point on the wave is drawn; from
# so many px on each point is marked.
_WAVE_PX, _DOTS_PX = 2.0, 8.0


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
    dots
        Positions and heights that are marked, (n_dots,) each; None: none are.
    """

    x: Floats
    y: Floats
    smooth: bool
    dots: tuple[Floats, Floats] | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Seen:
    """What is seen of curves, in their own unit.

    Attributes
    ----------
    line
        Points that are joined; positions of the x axis.
    wave
        Whether they show the wave through the points of the curves, not those alone.
    dots
        The points of the curves, where they are so far apart that each is marked.
    """

    line: Points
    wave: bool = False
    dots: Points | None = None

    @property
    def extremes(self) -> Range | None:
        """Lowest and highest value; None where nothing is seen."""
        y = self.line.y
        return (float(y.min()), float(y.max())) if y.size else None

    def beyond(self, values: Range) -> Range | None:
        """Lowest and highest value of a wave that leaves a range; a wave passes its points."""
        found = self.extremes if self.wave else None
        return found if found and (found[0] < values[0] or found[1] > values[1]) else None


def seen_of(
    curves: Curves,
    window: XWindow,
    n_drawn: int,
    row: QRectF,
    ratio: float,
    columns: KeptColumns,
) -> Seen:
    """What is seen of the first curves in a row of the plot.

    Where the wave through them is known, it is drawn where there are two pixels and more for each
    point, and how far it reaches where there are fewer: straight lines would cut its peaks.

    Parameters
    ----------
    curves, window, n_drawn
        What is seen; more curves than there are rows in a stack are left out.
    row, ratio
        Where a row is, px, and device pixels in a pixel.
    columns
        Those of the plot.
    """
    x, y = window.axis.positions(curves.x), curves.y[:n_drawn]
    if window.axis.log:
        x, y = x[curves.x > 0], y[:, curves.x > 0]
    wave = None if curves.wave is None else _placed(curves.wave, window, n_drawn)
    found = columns.of(x, window.shown, int(row.width() * ratio))
    return course_of(found, y, wave, row.width(), ratio)


def _placed(wave: Wave, window: XWindow, n_drawn: int) -> Wave:
    """The wave of the first curves, at positions of the axis."""

    def points(first: int, end: int) -> tuple[Floats, Floats]:
        x, y = wave.points(first, end)
        return window.axis.positions(x), y[:n_drawn]

    def extremes(first: int, end: int) -> Extremes | None:
        found = wave.extremes(first, end)
        return None if found is None else found.of_first(n_drawn)

    return Wave(points=points, extremes=extremes)


def course_of(found: Columns, y: Floats, wave: Wave | None, width_px: float, ratio: float) -> Seen:
    """What is seen of curves ``y``, (n_curves, n_points), where their columns are known.

    Parameters
    ----------
    wave
        Runs through the points, in the unit of their axis; None: it is not known.
    width_px, ratio
        Over how many px they go, and dots in a px.
    """
    if wave is None:
        return Seen(line=found.points(y))
    part = found.part.start, found.part.stop
    apart_px = width_px / max(part[1] - part[0], 1)
    if found.starts is not None or apart_px * ratio < _WAVE_PX:
        extremes = wave.extremes(*part)
        if extremes is None:
            return Seen(line=found.points(y))
        return Seen(line=found.reached(y, extremes), wave=True)
    instants, waves = wave.points(*part)
    dots = found.points(y) if apart_px >= _DOTS_PX else None
    return Seen(line=Points(x=instants, y=waves), wave=True, dots=dots)


def curve_points(
    seen: Seen, scale: ValueScale, rows: list[QRectF], ratio: float
) -> tuple[CurvePoints, ...]:
    """What is drawn of each curve: in the one row there is, or in one each.

    Parameters
    ----------
    seen, scale
        What is seen.
    rows
        Where the row of each curve that is drawn is, px.
    ratio
        Device pixels in a pixel.
    """
    points = seen.line
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
    dots = None if seen.dots is None else scale.heights(seen.dots.y)
    return tuple(
        CurvePoints(
            x=points.x,
            y=line,
            smooth=not block,
            dots=None if dots is None or seen.dots is None else (seen.dots.x, dots[rank]),
        )
        for rank, (line, block) in enumerate(zip(heights, blocks.tolist(), strict=True))
    )
