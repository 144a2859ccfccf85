"""Sites on one line: linear interpolation from each to the next."""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.arrays import Floats, Indices
from skinsource.surface.same_place import NEAR_DUPLICATE
from skinsource.surface.site_weights import SiteWeights
from skinsource.surface.triangulation import cross, dot

#: Sites no farther from the line than this part of their extent lie on it.  A quarter of what makes
#: two sites one, so that different sites have different places along the line.
_ON_LINE = NEAR_DUPLICATE / 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SiteLine:
    """Sites on one line; a single site is one, too.

    Attributes
    ----------
    sites : (n_sites, 2)
        In their order along the line.
    order : (n_sites,)
        Number of each in the order they were given.
    along : (2,)
        From the first to the last.
    extent
        Larger side of their bounding box.
    """

    sites: Floats
    order: Indices
    along: Floats
    extent: float

    def weights_at(self, points: Floats) -> SiteWeights:
        """Weights of the given sites for the value at each point, (n_points, 2).

        A point counts as the nearest place between the ends of the line; it is ``outside`` unless
        it is that place.
        """
        last = len(self.sites) - 1
        places = (self.sites - self.sites[0]) @ self.along
        place = (points - self.sites[0]) @ self.along
        start = np.searchsorted(places[1:last], place, side="right")
        share = self._share(points, start)
        # Rounding may have taken a point for one of the stretch beside its own.
        start = np.clip(start + (share > 1) - (share < 0), 0, max(last - 1, 0))
        share = np.clip(self._share(points, start), 0.0, 1.0)[:, None]
        ends = np.column_stack([start, np.minimum(start + 1, last)])
        nearest = self.sites[ends[:, 0]] + share * np.diff(self.sites[ends], axis=1)[:, 0]
        row = np.repeat(np.arange(len(points)), 2)
        shares = np.column_stack([1.0 - share, share])
        weights = scipy.sparse.csr_array(
            (shares.ravel(), (row, self.order[ends].ravel())),
            shape=(len(points), len(self.sites)),
        )
        weights.eliminate_zeros()
        return SiteWeights(
            weights=weights,
            outside=np.hypot(*(points - nearest).T) > NEAR_DUPLICATE * self.extent,
            fallback=np.zeros(len(points), bool),
        )

    def _share(self, points: Floats, start: Indices) -> Floats:
        """How far along its stretch each point lies: 0 at the start, 1 at the end."""
        stop = np.minimum(start + 1, len(self.sites) - 1)
        length = dot(self.sites[stop] - self.sites[start], self.along)
        part = dot(points - self.sites[start], self.along)
        # A single site has no length.
        return np.divide(part, length, out=np.zeros(len(points)), where=length > 0)


def site_line(sites: Floats) -> SiteLine | None:
    """Line through distinct sites, (n_sites, 2); None where they span a plane."""
    extent = float(np.ptp(sites, axis=0).max())
    end = _farthest(sites, sites[0])
    along = _farthest(sites, end) - end
    # From left to right, whatever the order of the sites.
    along = -along if tuple(along) < (0.0, 0.0) else along
    aside = sites - end
    if np.abs(cross(aside, along)).max() > _ON_LINE * extent * np.hypot(*along):
        return None
    order = np.argsort(aside @ along, kind="stable")
    return SiteLine(sites=sites[order], order=order, along=along, extent=extent)


def _farthest(sites: Floats, place: Floats) -> Floats:
    away = sites - place
    return np.asarray(sites[np.argmax(dot(away, away))])
