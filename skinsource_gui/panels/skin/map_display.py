"""What the map shows, on all that shows it."""

from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.map_readout import selection_readout
from skinsource_gui.panels.skin.note_line import NoteLine
from skinsource_gui.panels.skin.readout_lines import ReadoutLines
from skinsource_gui.panels.skin.scale.colour_bar import ColourBar
from skinsource_gui.panels.skin.skin_map import SkinMap
from skinsource_gui.panels.skin.still_values import in_short
from skinsource_gui.widgets.lateness import Lateness


class MapDisplay(QObject):
    """Keeps `MapContent`, and shows it on the map, in colour bar, note and readout.

    Parameters
    ----------
    parent, lateness
        The panel that it is in, and whether what is known belongs to an older design.

    Attributes
    ----------
    content
        What is known, also while it is covered.
    map, colour_bar, note, readout
        Who shows it.
    """

    def __init__(self, parent: QWidget, lateness: Lateness) -> None:
        super().__init__(parent)
        self.content = MapContent()
        self._covered = False
        self._lateness = lateness
        self._lateness.changed.connect(self._mark_outdated)
        self.map, self.colour_bar = SkinMap(parent), ColourBar(parent)
        self.note, self.readout = NoteLine(parent), ReadoutLines(parent)
        self.map.setObjectName("skin_map")
        self.colour_bar.setObjectName("skin_colour_bar")
        self.note.setObjectName("skin_note")
        self.readout.setObjectName("skin_readout")
        self.readout.setAccessibleName("Under the pointer")
        self.map.readout_changed.connect(self._show_readout)
        self._show_readout("")

    def change(self, **changes: Any) -> None:
        """Take over other fields of the content; they are seen from `show` on."""
        self.content = replace(self.content, **changes)

    def show(self) -> None:
        """Show what is known now."""
        self.colour_bar.strip.show_quantity(self.content.quantity, self.content.colours)
        self._show_marks()
        self.show_map()
        self.note.show_text(self.content.note, in_short(self.content.note))
        self._show_readout(self.map.readout())

    def show_map(self) -> None:
        """Show what is known now on the map alone."""
        self.map.show_content(self.content.covered if self._covered else self.content)

    def cover(self, covered: bool) -> None:
        """Hide what was computed, or reveal it."""
        self._covered = covered
        self.show()

    def set_stale(self, stale: bool) -> None:
        """Say whether what is known belongs to an older design; once it is late, that is seen."""
        self._lateness.set_stale(stale)

    def _mark_outdated(self, late: bool) -> None:
        self.change(outdated=late)
        self.show_map()

    def _show_marks(self) -> None:
        """Mark the levels of the selected outputs in the colour bar."""
        levels = None if self._covered else self.content.coloured_values
        if levels is None:
            self.colour_bar.show_marks(())
            return
        self.colour_bar.show_marks(
            tuple(
                (float(levels[number - 1]), rank)
                for rank, number in enumerate(self.content.outputs)
                if number <= levels.size
            )
        )

    def _show_readout(self, words: str) -> None:
        self.readout.show_text(words or selection_readout(self.content.outputs))
