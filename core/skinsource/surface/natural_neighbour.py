"""Sibson's natural neighbour weights, for many points at once.

A point q put among the sites of a Voronoi diagram takes its cell from the cells of its natural
neighbours; the share taken from each is that neighbour's weight (R. Sibson, "A brief description
of natural neighbour interpolation", in: Interpreting Multivariate Data, Wiley, 1981).

No Voronoi cell is drawn here.  The triangles whose circumcircle holds q form a cavity.  Within
triangle (u, v, w) the cell of u covers the signed area

    a_u(u, v, w) = (|uv|² cot w + |uw|² cot v) / 8

so the area taken from u is the sum of a_u over the cavity's triangles less the sum of
a_u(q, u, v) over the cavity's border edges (u, v).  No circumcentre appears, hence no loss of
digits where one lies far away.
"""

from typing import TYPE_CHECKING

import numpy as np
import scipy

from skinsource.arrays import Floats, Indices
from skinsource.surface.site_weights import SiteWeights
from skinsource.surface.triangulation import Triangulation, cross, dot, locate, nearest_on_hull

if TYPE_CHECKING:
    from scipy.sparse import csr_array


#: Largest gap between a point and the weighted mean of its sites, as a part of the sites' extent.
LINEAR_PRECISION = 1e-10
#: Smaller weights are nothing but rounding.
RESIDUE = 1e-16


def natural_neighbour_weights(triangulation: Triangulation, points: Floats) -> SiteWeights:
    """Weights of the sites for the value at each point.

    Points on an edge of the convex hull get the linear weights of its two ends, which is
    Sibson's limit; points outside get those of the nearest place on the hull.

    Parameters
    ----------
    triangulation
        From `skinsource.surface.triangulation.triangulate`.
    points : (n_points, 2)
    """
    local = points - triangulation.centre
    triangle, at_site, outside, lost = locate(triangulation, local)
    sites = np.flatnonzero(at_site >= 0)
    beyond = np.flatnonzero(outside)
    regular = np.flatnonzero((at_site < 0) & ~outside & ~lost)

    target = local.copy()
    target[beyond], ends, end_weights = nearest_on_hull(triangulation, local[beyond])
    of, site, area = _stolen_areas(triangulation, local[regular], triangle[regular])
    weights = _summed(
        np.concatenate([sites, np.repeat(beyond, 2), regular[of]]),
        np.concatenate([at_site[sites], ends.ravel(), site]),
        np.concatenate([np.ones(len(sites)), end_weights.ravel(), area]),
        (len(points), len(triangulation.sites)),
    )
    gap = weights @ triangulation.sites - target
    missed = ~(np.hypot(*gap.T) <= LINEAR_PRECISION * triangulation.extent)
    missed |= np.diff(weights.indptr) == 0
    if missed.any():
        weights = _with_linear_rows(triangulation, local, weights, np.flatnonzero(missed))
    return SiteWeights(weights=weights, outside=outside, fallback=missed)


def _stolen_areas(
    triangulation: Triangulation, points: Floats, triangle: Indices
) -> tuple[Indices, Indices, Floats]:
    """Eight times the area each point takes from sites, as unsummed (point, site, area).

    The cavity has no site inside, so its triangles hang together as a tree: a walk outwards,
    level by level and for all points at once, meets each triangle once.
    """
    corners = triangulation.corners
    square = dot(points, points)
    point = np.arange(len(points))
    entry = np.full(len(points), -1)
    visits = np.zeros(len(points), dtype=np.intp)
    row, column = [point[:0]], [point[:0]]
    value = [square[:0]]
    while len(point):
        row.append(np.repeat(point, 3))
        column.append(corners[triangle].ravel())
        value.append(triangulation.shares[triangle].ravel())

        onward = np.arange(3) != entry[:, None]
        place, edge = np.nonzero(onward)
        at, of = triangle[place], point[place]
        ahead = triangulation.neighbours[at, edge]
        k, a, b, c = triangulation.circles[ahead].T
        power = k * square[of] + a * points[of, 0] + b * points[of, 1] + c
        joins = (ahead >= 0) & (power < 0)
        border = ~joins
        u = corners[at[border], (edge[border] + 1) % 3]
        v = corners[at[border], (edge[border] + 2) % 3]
        of_u, of_v = _border_shares(
            points[of[border]], triangulation.sites[u], triangulation.sites[v]
        )
        row += [of[border], of[border]]
        column += [u, v]
        value += [-of_u, -of_v]

        # Rounding may close the tree into a ring; then the walk is cut, and the check of linear
        # precision finds the point.
        visits += np.bincount(point, minlength=len(points))
        joins &= visits[of] <= len(corners)
        point, triangle = of[joins], ahead[joins]
        entry = triangulation.returns[at[joins], edge[joins]]
    return np.concatenate(row), np.concatenate(column), np.concatenate(value)


def _border_shares(q: Floats, u: Floats, v: Floats) -> tuple[Floats, Floats]:
    """Eight times a_u and a_v of the triangles (q, u, v)."""
    to_u, to_v, edge = u - q, v - q, v - u
    # Zero where q lies on the hull: a tiny area lets the edge's ends outweigh all other sites,
    # in the ratio of linear interpolation, which is the limit.
    double_area = np.maximum(cross(to_u, to_v), 1e-100)
    over_q = dot(edge, edge) * dot(to_u, to_v)
    of_u = (over_q + dot(to_u, to_u) * dot(edge, to_v)) / double_area
    of_v = (over_q - dot(to_v, to_v) * dot(edge, to_u)) / double_area
    return of_u, of_v


def _summed(
    row: Indices, column: Indices, value: Floats, shape: tuple[int, int]
) -> "csr_array[np.float64]":
    """Sum entries of equal row and column, drop rounding residues, make rows sum to 1."""
    place = (row.astype(np.int32), column.astype(np.int32))
    weights = scipy.sparse.csr_array(scipy.sparse.coo_array((value, place), shape=shape))
    weights.data[weights.data < 0] = 0.0
    total: Floats = np.asarray(weights.sum(axis=1))
    weights.data /= np.repeat(total, np.diff(weights.indptr))
    weights.data[weights.data < RESIDUE] = 0.0
    weights.eliminate_zeros()
    return weights


def _with_linear_rows(
    triangulation: Triangulation,
    points: Floats,
    weights: "csr_array[np.float64]",
    missed: Indices,
) -> "csr_array[np.float64]":
    """Replace rows by linear interpolation in the triangle that holds the point best."""
    real = ~triangulation.flat
    a, b, c = np.moveaxis(triangulation.edges[real], 2, 0)
    double_area = triangulation.circles[real, 0]
    corners, shares = [], []
    for x, y in points[missed]:
        barycentric = (a * x + b * y + c) / double_area[:, None]
        best = np.argmax(barycentric.min(axis=1))
        share = np.maximum(barycentric[best], 0.0)
        corners.append(triangulation.corners[real][best])
        shares.append(share / share.sum())
    linear = scipy.sparse.csr_array(
        (np.concatenate(shares), (np.repeat(missed, 3), np.concatenate(corners))),
        shape=weights.shape,
    )
    keep = np.ones(len(points))
    keep[missed] = 0.0
    kept = weights.copy()
    kept.data = np.where(np.repeat(keep, np.diff(kept.indptr)) > 0, kept.data, 0.0)
    kept.eliminate_zeros()
    return scipy.sparse.csr_array(kept + linear)
