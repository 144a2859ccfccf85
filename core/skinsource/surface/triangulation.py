"""A Delaunay triangulation, with what its users need of each triangle."""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.arrays import Booleans, Floats, Indices

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
    """Delaunay triangulation of distinct sites that do not all lie on one line.

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
    found = scipy.spatial.Delaunay(local)
    corners, neighbours = found.simplices.astype(np.intp), found.neighbors.astype(np.intp)
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
    """Nearest places on the hull, the two sites beside each, and their linear weights."""
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
    """Line through p and q as (a, b, c), a x + b y + c > 0 on the left."""
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
    """Eight times a_u of corners a, b, c; the cotangent is dot over cross product."""
    over_a = dot(b - c, b - c) * dot(b - a, c - a) / double_area
    over_b = dot(c - a, c - a) * dot(c - b, a - b) / double_area
    over_c = dot(a - b, a - b) * dot(a - c, b - c) / double_area
    return np.column_stack([over_b + over_c, over_c + over_a, over_a + over_b])


def cross(p: Floats, q: Floats) -> Floats:
    """Cross products of vectors (…, 2)."""
    return np.asarray(p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0])


def dot(p: Floats, q: Floats) -> Floats:
    """Scalar products of vectors (…, 2)."""
    return np.asarray(p[..., 0] * q[..., 0] + p[..., 1] * q[..., 1])
