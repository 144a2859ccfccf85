"""Panels in the menu of a title or a bar: as in View > Panels, in the same order."""

from collections.abc import Sequence

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMainWindow, QMenu


class ListsPanels(QMainWindow):
    """A window whose titles and bars have a menu of its panels.

    Attributes
    ----------
    panel_toggles
        What shows and hides each of them.
    """

    panel_toggles: Sequence[QAction] = ()

    def createPopupMenu(self) -> QMenu:
        # Qt's own lists docks as they were put into the window.
        menu = QMenu(self)
        menu.addActions(list(self.panel_toggles))
        return menu
