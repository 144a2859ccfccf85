"""The map: from 72 outputs to the skin between them, by natural-neighbour interpolation."""

from skinsource.surface.building import surface_operator, surface_operator_from_map
from skinsource.surface.operator import SurfaceOperator

__all__ = ["SurfaceOperator", "surface_operator", "surface_operator_from_map"]
