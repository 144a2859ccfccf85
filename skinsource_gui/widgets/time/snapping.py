"""Where a moved edge comes to rest."""

from bisect import bisect_left
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import floor, log10

#: From how far away an edge snaps, px.
REACH_PX = 7.0
_GRID_PX = 12.0
_STEPS = (1.0, 2.0, 5.0, 10.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rest:
    """Where something comes to rest.

    Attributes
    ----------
    by_s
        How far it is moved.
    guide_s
        The time that it snapped to, which is shown; None where it lies free.
    """

    by_s: float
    guide_s: float | None = None


def grid_step_s(px_per_s: float) -> float:
    """Finest round step of time whose lines are still told apart: 1, 2, 5, 10 … ms."""
    least = _GRID_PX / px_per_s
    decade = 10.0 ** floor(log10(least))
    return next(step * decade for step in _STEPS if step * decade >= least * (1 - 1e-9))


def rest_of(
    edges_s: Iterable[float],
    by_s: float,
    *,
    neighbours_s: Sequence[float],
    grid_s: float | None,
    reach_s: float,
) -> Rest:
    """Move edges by about ``by_s``, so that one of them comes to rest on something near.

    Parameters
    ----------
    edges_s
        Edges that may snap, before they are moved.
    by_s
        How far the pointer moved.
    neighbours_s
        Rising times to rest on: ends of other clips, playhead, markers.  They go before the grid.
    grid_s
        Step of the grid, on which the first edge rests wherever it is; None: there is none.
    reach_s
        From how far away an edge snaps to a time.
    """
    edges = tuple(edges_s)
    found: tuple[float, float, float] | None = None
    for edge in edges:
        target = _nearest(neighbours_s, edge + by_s)
        if target is not None:
            found = _nearer(found, edge, target, by_s)
    if found is not None and found[0] <= reach_s:
        return Rest(by_s=found[1], guide_s=found[2])
    if grid_s is None or not edges:
        return Rest(by_s=by_s)
    # The first edge alone follows the grid: it is where something starts.
    target = round((edges[0] + by_s) / grid_s) * grid_s
    return Rest(by_s=target - edges[0])


def _nearest(rising: Sequence[float], time_s: float) -> float | None:
    if not rising:
        return None
    right = bisect_left(rising, time_s)
    around = rising[max(right - 1, 0) : right + 1]
    return min(around, key=lambda one: abs(one - time_s))


def _nearer(
    found: tuple[float, float, float] | None, edge: float, target: float, by_s: float
) -> tuple[float, float, float]:
    away = abs(target - edge - by_s)
    return found if found is not None and found[0] <= away else (away, target - edge, target)
