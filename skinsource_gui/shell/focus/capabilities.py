"""What the menus can do with the keyboard's place."""

from collections.abc import Callable

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from skinsource_gui.made_panels import MadePanels
from skinsource_gui.shell.focus.clip_drawing import ClipDrawing
from skinsource_gui.shell.focus.panel_focus import PanelFocus


def focus_capabilities(
    panels: MadePanels, bring: Callable[[str], None], window: QWidget
) -> dict[str, QObject]:
    """Those who carry it out, by the names that the table of actions has for them.

    ``bring`` brings a panel into sight.
    """
    focus = PanelFocus(panels, bring, window)
    return {"panel_focus": focus, "clip_drawing": ClipDrawing(panels, focus, window)}
