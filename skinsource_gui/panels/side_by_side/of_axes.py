"""The present design along each axis of the sensors."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from skinsource.design.comparing import Snapshot
from skinsource.design.design import Design
from skinsource.design.labels import span_words
from skinsource.design.view import View
from skinsource_gui.compared import Compared, shown_words
from skinsource_gui.panels.side_by_side.cells import Names
from skinsource_gui.panels.side_by_side.kind import Kind

#: What is told axis by axis, and what a map calls it.
_PER_AXIS = {
    "axis_levels_db": "output_levels_db",
    "axis_surface_levels_db": "surface_levels_db",
    "axis_above_noise_db": "above_noise_db",
}
_COMMON = frozenset({"limb_map", "limb_data", "surface"})


class OfAxes(Kind):
    """All that the limb measures along, whichever of them are chosen in the window.

    Levels alone: each sensor's x and y point their own way, so that neither a difference of axes
    nor their mean says something of the skin.
    """

    needs: ClassVar[frozenset[str]] = _COMMON | frozenset(_PER_AXIS)
    own: ClassVar[bool] = True

    def sides(self, design: Design, results: Mapping[str, Any]) -> Sequence[Compared]:
        common = {name: results[name] for name in _COMMON}
        snapshot = Snapshot(design=design)
        return [
            Compared(
                snapshot=snapshot,
                values={**common, **{name: results[own][k] for own, name in _PER_AXIS.items()}},
                axes=axis,
            )
            for k, axis in enumerate(results["limb_data"].axes)
        ]

    def names(self, compared: Sequence[Compared], view: View, *, difference: bool) -> list[Names]:
        return [(f"Along {one.axes}", one.axes) for one in compared]

    def about(self, compared: Sequence[Compared], design: Design | None, view: View) -> str:
        words = f"RMS along each axis of the sensors · {span_words(view.span)}"
        return " · ".join(part for part in (words, shown_words(design, view)) if part)
