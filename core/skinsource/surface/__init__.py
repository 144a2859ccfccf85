"""The map: from 72 outputs to the skin between them, by natural-neighbour interpolation."""

from typing import TYPE_CHECKING

from skinsource.late import late_names

if TYPE_CHECKING:
    from skinsource.surface.building import surface_operator, surface_operator_from_map
    from skinsource.surface.operator import SurfaceOperator
else:
    __getattr__, __dir__ = late_names(
        __name__,
        {
            "building": "surface_operator surface_operator_from_map",
            "operator": "SurfaceOperator",
        },
    )

__all__ = ["SurfaceOperator", "surface_operator", "surface_operator_from_map"]
