"""Smooth curves through points in the plane."""

from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arrays import Floats


def smooth(points: ArrayLike, *, closed: bool, per_span: int = 12) -> Floats:
    """Centripetal Catmull-Rom curve through points in the plane.

    It passes through every point and, unlike a uniform spline, forms no loops (Yuksel, Schaefer
    and Keyser, 2011).

    Parameters
    ----------
    points : (n, 2)
        No two neighbours may coincide.
    closed
        Whether the curve returns to the first point.
    per_span
        Points per span, its start included.

    Returns
    -------
    (n * per_span, 2) when closed, else ((n - 1) * per_span + 1, 2).
    """
    p = np.asarray(points, dtype=float)
    if closed:
        before, after, ends = np.roll(p, 1, axis=0), np.roll(p, -1, axis=0), np.roll(p, -2, axis=0)
    else:
        padded = np.vstack([2 * p[0] - p[1], p, 2 * p[-1] - p[-2]])
        before, p, after, ends = padded[:-3], padded[1:-2], padded[2:-1], padded[3:]
    d0, d1, d2 = (
        np.sqrt(np.linalg.norm(b - a, axis=1))[:, None]
        for a, b in ((before, p), (p, after), (after, ends))
    )
    start = (d1 * (p - before) / d0 + d0 * (after - p) / d1) / (d0 + d1) * d1
    stop = (d2 * (after - p) / d1 + d1 * (ends - after) / d2) / (d1 + d2) * d1
    t = (np.arange(per_span) / per_span)[None, :, None]
    hermite = (2 * t**3 - 3 * t**2 + 1, t**3 - 2 * t**2 + t, 3 * t**2 - 2 * t**3, t**3 - t**2)
    parts = [w * v[:, None] for w, v in zip(hermite, (p, start, after, stop), strict=True)]
    curve = np.sum(parts, axis=0).reshape(-1, 2)
    return curve if closed else np.vstack([curve, after[-1]])


def bezier(start: Floats, leave: Floats, arrive: Floats, stop: Floats, *, count: int) -> Floats:
    """Cubic Bezier curve from ``start`` to ``stop``, both included, (count, 2)."""
    t = np.linspace(0, 1, count)[:, None]
    edges = (1 - t) ** 3 * start + t**3 * stop
    return np.asarray(edges + 3 * t * (1 - t) * ((1 - t) * leave + t * arrive))


def profile(stations: tuple[tuple[float, float], ...], at: ArrayLike) -> Floats:
    """A smooth curve through ``stations`` (place, value), read at ``at``, same shape."""
    curve = _curve_through(stations)
    return np.asarray(np.interp(np.asarray(at, dtype=float), curve[:, 0], curve[:, 1]))


@cache
def _curve_through(stations: tuple[tuple[float, float], ...]) -> Floats:
    # The same few curves are read at hundreds of places.
    curve = smooth(stations, closed=False)
    curve.flags.writeable = False
    return curve
