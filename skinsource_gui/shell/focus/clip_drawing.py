"""From anywhere to the pen."""

from typing import TYPE_CHECKING, cast

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QApplication

from skinsource_gui.made_panels import MadePanels
from skinsource_gui.shell.focus.panel_focus import PanelFocus

if TYPE_CHECKING:
    from skinsource_gui.panels.clip_editor.panel import ClipEditorPanel

_PANEL = "clip_editor"


class ClipDrawing(QObject):
    """Shows the selected clip large, and takes the pen.

    Parameters
    ----------
    panels
        Of which one draws.
    focus
        Brings that into sight, and back to where the keyboard was.
    """

    def __init__(self, panels: MadePanels, focus: PanelFocus, parent: QObject) -> None:
        super().__init__(parent)
        self._panels, self._focus = panels, focus

    def begin(self) -> None:
        """Take the pen; a clip that is not drawn asks whether it may become samples."""
        panel = cast("ClipEditorPanel", self._panels[_PANEL])
        focused = QApplication.focusWidget()
        if not panel.isVisible() or focused is None or not panel.isAncestorOf(focused):
            self._focus.show(_PANEL)
        panel.use("pen")
