"""Which output is meant by a click, a rubber band or an arrow key."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF

from skinsource.base.arrays import Floats

Outputs = tuple[int, ...]

# How far from an output it is still meant.
_REACH_PX = 11.0


def dorsal_outputs(points: Floats, unplaced: Outputs) -> Outputs:
    """Numbers of the outputs on the back of hand and arm; ``points`` is (n_outputs, 2)."""
    return tuple(k for k in range(1, len(points) + 1) if k not in unplaced)


def is_placed(points: Floats, number: int) -> bool:
    """Whether an output is somewhere; ``points`` is (n_outputs, 2)."""
    return number <= len(points) and bool(np.isfinite(points[number - 1]).all())


def output_at(points: Floats, at: QPointF, reach_px: float = _REACH_PX) -> int | None:
    """Number of the output nearest to ``at`` and within reach; ``points`` is (n_outputs, 2), px.

    Those that are nowhere, NaN, are never meant.
    """
    distances = np.hypot(points[:, 0] - at.x(), points[:, 1] - at.y())
    distances[np.isnan(distances)] = np.inf
    nearest = int(np.argmin(distances))
    return nearest + 1 if distances[nearest] <= reach_px else None


def outputs_inside(points: Floats, area: QRectF) -> Outputs:
    """Numbers of the outputs inside ``area``, ascending."""
    x, y = points.T
    inside = (x >= area.left()) & (x <= area.right()) & (y >= area.top()) & (y <= area.bottom())
    return tuple(int(k) + 1 for k in np.flatnonzero(inside))


def output_beyond(points: Floats, number: int, dx: int, dy: int) -> int:
    """The nearest output in a direction of the screen, or ``number`` itself if there is none."""
    steps = points - points[number - 1]
    ahead = steps @ np.array([dx, dy], float)
    aside = np.abs(steps @ np.array([-dy, dx], float))
    # Those within 45 degrees first; then any that lie ahead.
    for reachable in (aside <= ahead, aside < np.inf):
        cost = np.where((ahead > 0.5) & reachable, ahead + 2 * aside, np.inf)
        best = int(np.argmin(cost))
        if np.isfinite(cost[best]):
            return best + 1
    return number


def toggled(outputs: Outputs, number: int) -> Outputs:
    """``outputs`` with ``number`` added at the end, or taken out."""
    if number in outputs:
        return tuple(k for k in outputs if k != number)
    return (*outputs, number)


def joined(outputs: Outputs, more: Outputs) -> Outputs:
    """``outputs`` with those of ``more`` at the end that are new."""
    return (*outputs, *(k for k in more if k not in outputs))
