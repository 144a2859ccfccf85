"""Interpolation between sites wherever they lie: in the plane, on one line, at one place."""

from dataclasses import dataclass, replace

import numpy as np
import scipy

from skinsource.arrays import Floats, Indices
from skinsource.surface.natural_neighbour import natural_neighbour_weights
from skinsource.surface.same_place import first_at_same_place
from skinsource.surface.site_line import SiteLine, site_line
from skinsource.surface.site_weights import SiteWeights
from skinsource.surface.triangulation import Triangulation, triangulate


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ScatteredSites:
    """Sites that values are interpolated between.

    Attributes
    ----------
    place : (n_sites,)
        Number of the distinct place of each site.
    arrangement
        The distinct places: triangles, or a line if all lie on one.
    """

    place: Indices
    arrangement: Triangulation | SiteLine

    @property
    def on_a_line(self) -> bool:
        """Whether all lie on one line, or at one place."""
        return isinstance(self.arrangement, SiteLine)

    def weights_at(self, points: Floats) -> SiteWeights:
        """Weights of the sites for the value at each point, (n_points, 2).

        Sibson's natural neighbours; linear between neighbours on a line; a single site counts
        everywhere.  Outside the convex hull, which may be a line or a place, the nearest place on
        it counts.  Sites at one place share its weight.
        """
        if isinstance(self.arrangement, SiteLine):
            found = self.arrangement.weights_at(points)
        else:
            found = natural_neighbour_weights(self.arrangement, points)
        if found.weights.shape[1] == len(self.place):
            return found
        share = 1.0 / np.bincount(self.place)
        shared = scipy.sparse.csr_array(
            (share[self.place], (self.place, np.arange(len(self.place)))),
            shape=(len(share), len(self.place)),
        )
        return replace(found, weights=scipy.sparse.csr_array(found.weights @ shared))


def scattered_sites(sites: Floats) -> ScatteredSites:
    """Arrange sites, of which any number may lie at one place or on one line.

    Parameters
    ----------
    sites : (n_sites, 2)
        At least one; finite.  Best from `skinsource.surface.triangulation.snapped_to_lattice`.
    """
    first = first_at_same_place(sites, float(np.ptp(sites, axis=0).max()))
    distinct, place = np.unique(first, return_inverse=True)
    line = site_line(sites[distinct])
    return ScatteredSites(
        place=place, arrangement=triangulate(sites[distinct]) if line is None else line
    )
