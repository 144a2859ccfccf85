"""What is dragged from one panel onto another."""

from functools import partial

from PySide6.QtCore import QObject, QPoint
from PySide6.QtWidgets import QApplication

from skinsource_gui.made_panels import MadePanels
from skinsource_gui.panel import Panel
from skinsource_gui.widgets.drop_place import DropPlace


class ClipDrops(QObject):
    """Tells a panel that drags something where it would go in another one, which shows it.

    Parameters
    ----------
    panels
        All of a window, each of which gets to know whom to ask; the window is the parent.
    """

    def __init__(self, panels: MadePanels, parent: QObject) -> None:
        super().__init__(parent)
        self._panels = panels
        panels.each(self._meet)

    def _meet(self, panel: Panel) -> None:
        panel.held_over = partial(self._find, panel)

    def _find(self, dragged_from: Panel, at: QPoint | None) -> DropPlace | None:
        """Where something goes that is held over a place of the screen; None: it is let go."""
        below = None if at is None else QApplication.widgetAt(at)
        found = None
        for panel in self._panels:
            if panel is dragged_from:
                continue
            # Panels may float above each other: only what is on top takes anything.
            is_there = below is not None and (below is panel or panel.isAncestorOf(below))
            own = panel.mapFromGlobal(at) if is_there and at is not None else None
            panel.show_drop(own)
            if own is not None:
                found = panel.drop_place(own)
        return found
