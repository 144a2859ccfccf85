"""Maps side by side as they lie in a widget: which is where, and where their outputs are."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF

from skinsource.base.arrays import Floats
from skinsource_gui.panels.side_by_side.content import Content
from skinsource_gui.panels.side_by_side.layout import Places
from skinsource_gui.widgets.map.small_map import small_frame


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SeenMaps:
    """What is shown, and where that is."""

    content: Content
    places: Places

    def points_of(self, index: int) -> Floats:
        """Where the outputs are drawn in one of the maps, (n_outputs, 2); NaN: they are not."""
        cells = self.content.cells
        small = cells[index].small if index < len(cells) else None
        if small is None or self.content.message:
            return np.full((1, 2), np.nan)
        limb_map = small.limb_map
        return small_frame(limb_map, self.places.cells[index].map).to_screen(
            limb_map.output_positions
        )

    def map_at(self, point: QPointF, before: int) -> int:
        """The map under a point; where there is none the one before."""
        cells = enumerate(self.places.cells)
        return next((k for k, place in cells if place.whole.contains(point)), before)
