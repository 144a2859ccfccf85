"""The map: from 72 outputs to the skin between them, by natural-neighbour interpolation."""

from skinsource.surface.operator import (
    SurfaceOperator,
    surface_operator,
    surface_operator_from_map,
)

__all__ = ["SurfaceOperator", "surface_operator", "surface_operator_from_map"]
