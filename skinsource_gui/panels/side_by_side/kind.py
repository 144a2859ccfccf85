"""What can stand side by side: where it comes from, and what is said of it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, ClassVar

from skinsource.design.design import Design
from skinsource.design.labels import signal_words, span_words
from skinsource.design.view import View
from skinsource_gui.compared import SILENT, Compared, is_silent, matched_text, shown_words
from skinsource_gui.panels.side_by_side.cells import Cells, Names
from skinsource_gui.panels.side_by_side.content import Cell
from skinsource_gui.panels.side_by_side.settings import SideBySideSettings
from skinsource_gui.widgets.map.level_look import level_look
from skinsource_gui.widgets.map.scale_row import with_matched

#: What a map of levels takes.
LEVELS = frozenset(
    {
        "limb_map",
        "limb_data",
        "output_levels_db",
        "above_noise_db",
        "surface",
        "surface_levels_db",
    }
)


class Kind:
    """One thing that is chosen under "Of"; it remembers nothing.

    Attributes
    ----------
    fields
        Which parts of the bar above the maps are about it, beside the choice itself.
    needs, needs_of_snapshots
        As of a panel.
    own
        Whether the sides come from the results of the design in the window.
    """

    fields: ClassVar[frozenset[str]] = frozenset()
    needs: ClassVar[frozenset[str]] = LEVELS
    needs_of_snapshots: ClassVar[frozenset[str]] = frozenset()
    own: ClassVar[bool] = False

    def needs_on_limbs(
        self, settings: SideBySideSettings, limb: str
    ) -> Mapping[str, frozenset[str]]:
        """As of a panel, while the design is on ``limb``."""
        del settings, limb
        return {}

    def sides(self, design: Design, results: Mapping[str, Any]) -> Sequence[Compared]:
        """The sides, from results of the design in the window, which hold what it ``needs``."""
        del design, results
        return ()

    def names(self, compared: Sequence[Compared], view: View, *, difference: bool) -> list[Names]:
        """What the sides are called, each in ever fewer words."""
        raise NotImplementedError

    def reference(self, compared: Sequence[Compared], design: Design, view: View) -> int:
        """Which of them is the one in the window; the first where none is."""
        del compared, design, view
        return 0

    def hindrance(self, compared: Sequence[Compared], view: View) -> str:
        """Why nothing can be compared, in a sentence; empty where something can."""
        del view
        known = [one for one in compared if one.values is not None]
        return SILENT if known and all(is_silent(one) for one in known) else ""

    def about(self, compared: Sequence[Compared], design: Design | None, view: View) -> str:
        """What the levels are."""
        words = f"RMS of {signal_words(view.axes, view.method)} · {span_words(view.span)}"
        without = "without inputs that cannot be played"
        left_out = without if any(one.left_out for one in compared) else ""
        return " · ".join(part for part in (words, shown_words(design, view), left_out) if part)

    def shown(self, settings: SideBySideSettings) -> str:
        """What is shown of the sides: the levels where there is no choice."""
        return settings.shown if "shown" in self.fields else "levels"

    def drawn(
        self,
        cells: Cells,
        compared: Sequence[Compared],
        design: Design,
        view: View,
        settings: SideBySideSettings,
    ) -> tuple[Cell, ...]:
        """The maps of the sides, made by ``cells``; scales say by how much levels are matched."""
        found = self._cells(cells, compared, design, view, settings)
        matched = matched_text(compared) or shown_words(design, view)
        return tuple(
            one if one.scale is None else replace(one, scale=with_matched(one.scale, matched))
            for one in found
        )

    def _cells(
        self,
        cells: Cells,
        compared: Sequence[Compared],
        design: Design,
        view: View,
        settings: SideBySideSettings,
    ) -> tuple[Cell, ...]:
        shown = self.shown(settings)
        names = self.names(compared, view, difference=shown == "difference")
        if shown == "levels" and settings.own_maximum:
            return cells.of_own_maxima(compared, names, level_look(view))
        if shown == "levels":
            return cells.of_levels(compared, names, level_look(view))
        reference = self.reference(compared, design, view)
        if shown == "difference":
            return cells.of_differences(compared, names, reference)
        return cells.of_spread(compared, names, reference, level_look(view))
