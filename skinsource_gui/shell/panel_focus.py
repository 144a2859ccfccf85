"""Moves the keyboard from panel to panel."""

from collections.abc import Callable, Sequence

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QApplication

from skinsource_gui.panel import Panel
from skinsource_gui.shell.focus_order import focus_into, tab_stops


class PanelFocus(QObject):
    """Gives the keyboard to the next panel, or the one before.

    Parameters
    ----------
    panels
        In the order in which the keyboard reaches them.
    bring
        Brings a panel into sight, by its name.
    """

    def __init__(
        self, panels: Sequence[Panel], bring: Callable[[str], None], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._panels, self._bring = panels, bring

    def next(self) -> None:
        """Go to the next panel."""
        self._go(1)

    def previous(self) -> None:
        """Go to the panel before."""
        self._go(-1)

    def show(self, name: str) -> None:
        """Bring a panel into sight, and go there."""
        self._bring(name)
        panel = next(one for one in self._panels if one.name == name)
        panel.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def _go(self, step: int) -> None:
        # A panel that only says what to do has nothing for the keyboard.
        panels = [panel for panel in self._panels if tab_stops(panel, ())]
        focused = QApplication.focusWidget()
        here = [k for k, panel in enumerate(panels) if focused and panel.isAncestorOf(focused)]
        if panels:
            start = here[0] if here else -min(step, 0) - 1
            panel = panels[(start + step) % len(panels)]
            panel.activateWindow()
            focus_into(panel, Qt.FocusReason.ShortcutFocusReason)
