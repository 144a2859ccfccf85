"""Interpolation between scattered sites: Sibson's natural neighbours.

A point q put among the sites of a Voronoi diagram takes its cell from the cells of its natural
neighbours; the share taken from each is that neighbour's weight (R. Sibson, "A brief description
of natural neighbour interpolation", in: Interpreting Multivariate Data, Wiley, 1981).

No Voronoi cell is drawn here.  The triangles whose circumcircle holds q form a cavity.  Within
triangle (u, v, w) the cell of u covers the signed area

    a_u(u, v, w) = (|uv|² cot w + |uw|² cot v) / 8

so the area taken from u is the sum of a_u over the cavity's triangles less the sum of a_u(q, u, v)
over the cavity's border edges (u, v).  No circumcentre appears, hence no loss of digits where one
lies far away.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy

from skinsource.base.conventions import Booleans, Floats, Indices

if TYPE_CHECKING:
    from scipy.sparse import csr_array


#: Points nearer than this part of the extent to a site are that site: rounding would blur there
#: which circumcircles hold the point.
SAME_PLACE = 3e-11


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Triangulation:
    """A Delaunay triangulation and what each triangle contributes whatever the point.

    Attributes
    ----------
    sites : (n_sites, 2)
        Relative to ``centre``.
    centre : (2,)
    extent
        Larger side of the sites' bounding box.
    corners, neighbours, returns : (n_triangles, 3)
        Sites counterclockwise; the triangle across the edge opposite to each corner (-1: none);
        and the number of that edge in the other triangle.
    edges : (n_triangles, 3, 3)
        Edge opposite to each corner as (a, b, c): a x + b y + c > 0 inside.
    circles : (n_triangles, 4)
        (k, a, b, c): k (x² + y²) + a x + b y + c < 0 inside the circumcircle.
    shares : (n_triangles, 3)
        Eight times a_u of each corner u.
    flat : (n_triangles,) of bool
        Triangles without area.
    """

    sites: Floats
    centre: Floats
    extent: float
    corners: Indices
    neighbours: Indices
    returns: Indices
    edges: Floats
    circles: Floats
    shares: Floats
    flat: Booleans


def snapped_to_lattice(points: Floats) -> Floats:
    """Round points to a power-of-two lattice with about 2¹³ steps along the larger extent.

    On it, points of one straight line stay exactly collinear or come clearly apart, and the
    circumcircle test is exact for the sites.  Unsnapped, the sites of a split and rotated edge
    make triangles of nearly no area, and their weights overflow.

    Parameters
    ----------
    points : (n_points, 2)

    Returns
    -------
    (n_points, 2)
        Moved by no more than 1/11 000 of the extent.
    """
    step = 2.0 ** np.floor(np.log2(np.ptp(points, axis=0).max() / 2**13))
    return np.asarray(np.round(points / step) * step)


def triangulate(sites: Floats) -> Triangulation:
    """Make the Delaunay triangulation of distinct sites that do not all lie on one line.

    Parameters
    ----------
    sites : (n_sites, 2)
        At least three; best from `snapped_to_lattice`.
    """
    low, high = sites.min(axis=0), sites.max(axis=0)
    extent = float((high - low).max())
    # A round centre keeps lattice sites on the lattice.
    step = 2.0 ** np.floor(np.log2(extent / 2**10))
    centre = np.round((low + high) / 2 / step) * step
    local = sites - centre
    delaunay = scipy.spatial.Delaunay(local)
    corners, neighbours = delaunay.simplices.astype(np.intp), delaunay.neighbors.astype(np.intp)
    a, b, c = (local[corners[:, k]] for k in range(3))
    clockwise = cross(b - a, c - a) < 0
    corners[clockwise] = corners[clockwise][:, [0, 2, 1]]
    neighbours[clockwise] = neighbours[clockwise][:, [0, 2, 1]]
    own = np.arange(len(corners))[:, None, None]
    a, b, c = (local[corners[:, k]] for k in range(3))
    double_area = cross(b - a, c - a)
    flat = double_area == 0
    return Triangulation(
        sites=local,
        centre=centre,
        extent=extent,
        corners=corners,
        neighbours=neighbours,
        returns=np.argmax(neighbours[neighbours] == own, axis=2),
        edges=np.stack([_line(b, c), _line(c, a), _line(a, b)], axis=1),
        circles=_circles(a, b, c, double_area),
        shares=_shares(a, b, c, np.where(flat, np.inf, double_area)),
        flat=flat,
    )


def locate(
    triangulation: Triangulation, points: Floats
) -> tuple[Indices, Indices, Booleans, Booleans]:
    """Walk from the nearest site to the triangle that holds each point.

    scipy's ``find_simplex`` is avoided: its first call runs LAPACK per triangle, and on a busy
    machine the linear algebra threads can spin for seconds.

    Returns
    -------
    triangle, at_site : (n_points,)
        ``at_site`` is -1 unless the point is a site.
    outside, lost : (n_points,) of bool
        Beyond the hull; not found within the walk limit.
    """
    corners, extent = triangulation.corners, triangulation.extent
    used = np.unique(corners)
    some_triangle = np.zeros(len(triangulation.sites), dtype=np.intp)
    real = np.flatnonzero(~triangulation.flat)
    some_triangle[corners[real]] = real[:, None]
    distance, nearest = scipy.spatial.KDTree(triangulation.sites[used]).query(points)
    nearest = used[nearest]
    at_site = np.where(distance <= SAME_PLACE * extent, nearest, -1)
    triangle = some_triangle[nearest]
    outside = np.zeros(len(points), dtype=bool)
    walking = np.flatnonzero(at_site < 0)
    for _ in range(len(corners)):
        here = triangle[walking]
        x, y = points[walking].T
        a, b, c = np.moveaxis(triangulation.edges[here], 2, 0)
        side = a * x[:, None] + b * y[:, None] + c
        worst = np.argmin(side, axis=1)
        leaving = side[np.arange(len(walking)), worst] < -1e-15 * extent**2
        walking, worst, here = walking[leaving], worst[leaving], here[leaving]
        ahead = triangulation.neighbours[here, worst]
        outside[walking[ahead < 0]] = True
        walking, ahead = walking[ahead >= 0], ahead[ahead >= 0]
        if not len(walking):
            break
        triangle[walking] = ahead
    lost = np.zeros(len(points), dtype=bool)
    lost[walking] = True
    return triangle, at_site, outside, lost


def nearest_on_hull(triangulation: Triangulation, points: Floats) -> tuple[Floats, Indices, Floats]:
    """Return the nearest points on the hull, the two sites beside each, and their weights."""
    triangle, edge = np.nonzero(triangulation.neighbours < 0)
    ends = np.column_stack(
        [triangulation.corners[triangle, (edge + k) % 3] for k in (1, 2)],
    )
    start, along = triangulation.sites[ends[:, 0]], np.diff(triangulation.sites[ends], axis=1)[:, 0]
    aside = points[:, None] - start
    share = np.clip(dot(aside, along) / dot(along, along), 0.0, 1.0)
    place = start + share[..., None] * along
    every = np.arange(len(points))
    best = np.argmin(np.hypot(*np.moveaxis(points[:, None] - place, 2, 0)), axis=1)
    share = share[every, best]
    return place[every, best], ends[best], np.column_stack([1 - share, share])


def _line(p: Floats, q: Floats) -> Floats:
    """Return the line through p and q as (a, b, c), a x + b y + c > 0 on the left."""
    return np.column_stack([p[:, 1] - q[:, 1], q[:, 0] - p[:, 0], cross(p, q)])


def _circles(a: Floats, b: Floats, c: Floats, double_area: Floats) -> Floats:
    square_a, square_b, square_c = dot(a, a), dot(b, b), dot(c, c)
    x = square_a * (b - c)[:, 1] + square_b * (c - a)[:, 1] + square_c * (a - b)[:, 1]
    y = square_a * (c - b)[:, 0] + square_b * (a - c)[:, 0] + square_c * (b - a)[:, 0]
    constant = x * a[:, 0] + y * a[:, 1] - double_area * square_a
    circles = np.column_stack([double_area, -x, -y, constant])
    circles[double_area == 0] = (0.0, 0.0, 0.0, 1.0)  # holds no point
    return circles


def _shares(a: Floats, b: Floats, c: Floats, double_area: Floats) -> Floats:
    """Return eight times a_u of corners a, b, c; the cotangent is dot over cross product."""
    over_a = dot(b - c, b - c) * dot(b - a, c - a) / double_area
    over_b = dot(c - a, c - a) * dot(c - b, a - b) / double_area
    over_c = dot(a - b, a - b) * dot(a - c, b - c) / double_area
    return np.column_stack([over_b + over_c, over_c + over_a, over_a + over_b])


def cross(p: Floats, q: Floats) -> Floats:
    """Return the cross products of vectors (…, 2)."""
    return np.asarray(p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0])


def dot(p: Floats, q: Floats) -> Floats:
    """Return the scalar products of vectors (…, 2)."""
    return np.asarray(p[..., 0] * q[..., 0] + p[..., 1] * q[..., 1])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SiteWeights:
    """Weights of sites for the values at points.

    Attributes
    ----------
    weights : (n_points, n_sites) sparse
        Not negative; rows sum to 1.
    outside : (n_points,) of bool
        Points beyond the convex hull of the sites; they take the value of the nearest place on it.
    fallback : (n_points,) of bool
        Where Sibson's weights missed the point's own coordinates (triangles without area), and
        those of linear interpolation were taken instead.
    """

    weights: "csr_array[np.float64]"
    outside: Booleans
    fallback: Booleans


#: Largest gap between a point and the weighted mean of its sites, as a part of the sites' extent.
LINEAR_PRECISION = 1e-10
#: Smaller weights are nothing but rounding.
RESIDUE = 1e-16


def natural_neighbour_weights(triangulation: Triangulation, points: Floats) -> SiteWeights:
    """Return the weights of the sites for the value at each point.

    Points on an edge of the convex hull get the linear weights of its two ends, which is
    Sibson's limit; points outside get those of the nearest place on the hull.

    Parameters
    ----------
    triangulation
        From `skinsource.limbs.surface.natural_neighbour.triangulate`.
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
    row = np.concatenate([sites, np.repeat(beyond, 2), regular[of]])
    column = np.concatenate([at_site[sites], ends.ravel(), site])
    value = np.concatenate([np.ones(len(sites)), end_weights.ravel(), area])
    # Entries of equal row and column are summed, rounding residues dropped, rows sum to 1.
    place = (row.astype(np.int32), column.astype(np.int32))
    shape = (len(points), len(triangulation.sites))
    weights = scipy.sparse.csr_array(scipy.sparse.coo_array((value, place), shape=shape))
    weights.data[weights.data < 0] = 0.0
    total: Floats = np.asarray(weights.sum(axis=1))
    weights.data /= np.repeat(total, np.diff(weights.indptr))
    weights.data[weights.data < RESIDUE] = 0.0
    weights.eliminate_zeros()
    gap = weights @ triangulation.sites - target
    missed = ~(np.hypot(*gap.T) <= LINEAR_PRECISION * triangulation.extent)
    missed |= np.diff(weights.indptr) == 0
    if missed.any():
        weights = _with_linear_rows(triangulation, local, weights, np.flatnonzero(missed))
    return SiteWeights(weights=weights, outside=outside, fallback=missed)


def _stolen_areas(
    triangulation: Triangulation, points: Floats, triangle: Indices
) -> tuple[Indices, Indices, Floats]:
    """Return eight times the area each point takes from sites, as unsummed (point, site, area).

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
    """Return eight times a_u and a_v of the triangles (q, u, v)."""
    to_u, to_v, edge = u - q, v - q, v - u
    # Zero where q lies on the hull: a tiny area lets the edge's ends outweigh all other sites,
    # in the ratio of linear interpolation, which is the limit.
    double_area = np.maximum(cross(to_u, to_v), 1e-100)
    over_q = dot(edge, edge) * dot(to_u, to_v)
    of_u = (over_q + dot(to_u, to_u) * dot(edge, to_v)) / double_area
    of_v = (over_q - dot(to_v, to_v) * dot(edge, to_u)) / double_area
    return of_u, of_v


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
    remaining = weights.copy()
    remaining.data = np.where(np.repeat(keep, np.diff(remaining.indptr)) > 0, remaining.data, 0.0)
    remaining.eliminate_zeros()
    return scipy.sparse.csr_array(remaining + linear)
