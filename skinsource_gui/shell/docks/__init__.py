"""Docks of a window, and where they stand."""

from skinsource_gui.shell.docks.arrangement_spec import PRESENTATION
from skinsource_gui.shell.docks.arrangements import Arrangements
from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.shell.docks.dock_layout import DockLayout
from skinsource_gui.shell.docks.dock_tabs import DockTabs
from skinsource_gui.shell.docks.dock_toggles import menu_toggles, toggles
from skinsource_gui.shell.docks.in_use import PanelInUse
from skinsource_gui.shell.docks.listing import ListsPanels
from skinsource_gui.shell.docks.stage import staged, usual_size
from skinsource_gui.shell.docks.taking_in import TakingIn

__all__ = [
    "PRESENTATION",
    "Arrangements",
    "Dock",
    "DockLayout",
    "DockTabs",
    "ListsPanels",
    "PanelInUse",
    "TakingIn",
    "menu_toggles",
    "staged",
    "toggles",
    "usual_size",
]
