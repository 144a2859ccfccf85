"""Values on the outline: each vertex takes a mean of the two nearest outputs it sees."""

from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats, Indices
from skinsource.surface.shortest_ways import distances_inside
from skinsource.surface.visibility import nearest_seen, sight_region


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Boundary:
    """Weights of the outputs at the outline's vertices.

    Attributes
    ----------
    weights : (n_vertices, n_outputs)
        Rows sum to 1.
    blind : (n_blind,)
        Vertices that see no output; they take the two with the shortest way inside the outline.
    single : (n_single,)
        Vertices that see one output only, and take its value.
    """

    weights: Floats
    blind: Indices
    single: Indices


def boundary_from_table(table: Floats, outline: Floats, outputs: Floats, unit: float) -> Boundary:
    """Boundary by given distances.

    Parameters
    ----------
    table : (n_vertices, n_outputs)
        Distance where the vertex sees the output, else NaN.
    outline, outputs : (n_vertices, 2) and (n_outputs, 2)
        Outputs without a place are NaN.
    unit
        Raster unit of the shortest ways of vertices that see nothing.
    """
    placed = np.isfinite(outputs).all(axis=1)
    known = np.where(np.isfinite(table) & placed, table, np.inf)
    index = np.argsort(known, axis=1, kind="stable")[:, :2]
    distance = np.take_along_axis(known, index, axis=1)
    return _boundary(np.where(np.isfinite(distance), index, -1), distance, outline, outputs, unit)


def boundary_by_sight(outline: Floats, outputs: Floats, unit: float) -> Boundary:
    """Boundary by the rule of `skinsource.surface.visibility`.

    Parameters
    ----------
    outline, outputs : (n_vertices, 2) and (n_outputs, 2)
        Outputs without a place are NaN.
    unit
        Raster unit; twice it is the tolerance of the rule.
    """
    placed = np.flatnonzero(np.isfinite(outputs).all(axis=1))
    region = sight_region(outline, unit)
    index, distance = nearest_seen(region, outline, outputs[placed])
    index = np.where(index >= 0, placed[index], -1)
    return _boundary(index, distance, outline, outputs, unit)


def _boundary(
    index: Indices, distance: Floats, outline: Floats, outputs: Floats, unit: float
) -> Boundary:
    """Weights from the two nearest (n_vertices, 2), of which any may be missing (-1)."""
    n_vertices, n_outputs = len(outline), len(outputs)
    seen = np.zeros((n_vertices, 2), dtype=np.intp)
    away = np.full((n_vertices, 2), np.inf)
    seen[:, : index.shape[1]], away[:, : index.shape[1]] = index, distance
    blind = np.flatnonzero(~np.isfinite(away[:, 0]))
    single = np.flatnonzero(np.isfinite(away[:, 0]) & ~np.isfinite(away[:, 1]))
    if len(blind):
        seen[blind], away[blind] = _nearest_inside(outline, outputs, unit, blind)
    near, far = away.T
    share = np.ones(n_vertices)
    both = np.isfinite(far) & (near > 0)
    share[both] = far[both] / (near[both] + far[both])
    weights = np.zeros((n_vertices, n_outputs))
    every = np.arange(n_vertices)
    weights[every, seen[:, 0]] = share
    weights[every[both], seen[both, 1]] = 1 - share[both]
    return Boundary(weights=weights, blind=blind, single=single)


def _nearest_inside(
    outline: Floats, outputs: Floats, unit: float, blind: Indices
) -> tuple[Indices, Floats]:
    """Two nearest outputs by the way inside the outline, and how far; unreachable ones last."""
    placed = np.flatnonzero(np.isfinite(outputs).all(axis=1))
    way = distances_inside(sight_region(outline, unit), outline[blind], outputs[placed])
    straight = np.hypot(*np.moveaxis(outline[blind][:, None] - outputs[placed], 2, 0))
    # Where no way leads to any output, the straight distance has to do.
    way = np.where(np.isfinite(way).any(axis=1, keepdims=True), way, straight)
    order = np.argsort(way, axis=1, kind="stable")[:, :2]
    index = np.zeros((len(blind), 2), dtype=np.intp)
    distance = np.full((len(blind), 2), np.inf)
    index[:, : order.shape[1]] = placed[order]
    distance[:, : order.shape[1]] = np.take_along_axis(way, order, axis=1)
    return index, distance
