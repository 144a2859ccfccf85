"""An outline for places that came without one."""

import numpy as np
import scipy

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError

#: How far the hull stays away from the places, in their extent.
_MARGIN = 0.12


def hull_around(places: Floats) -> Floats:
    """The convex hull of places, (n, 2), NaN where one is missing, moved outwards."""
    points = places[np.isfinite(places).all(axis=1)]
    if len(points) < 1:
        raise InvalidInputError("no place is known, expected some, or an outline")
    reach = _MARGIN * max(float(np.ptp(points, axis=0).max()), 1.0)
    around = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    ring = reach * np.column_stack((np.cos(around), np.sin(around)))
    spread = (points[:, None] + ring[None]).reshape(-1, 2)
    return np.asarray(spread[scipy.spatial.ConvexHull(spread).vertices])
