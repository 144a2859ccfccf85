"""Moves the keyboard from panel to panel."""

from collections.abc import Callable

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QApplication

from skinsource_gui.made_panels import MadePanels
from skinsource_gui.shell.focus.focus_order import focus_into, tab_stops


class PanelFocus(QObject):
    """Gives the keyboard to the next panel, or the one before.

    Parameters
    ----------
    panels
        In the order in which the keyboard reaches them.
    bring
        Brings a panel into sight, by its name.
    """

    def __init__(self, panels: MadePanels, bring: Callable[[str], None], parent: QObject) -> None:
        super().__init__(parent)
        self._panels, self._bring = panels, bring
        # Where the keyboard was before a panel was shown, and which panels it came in front of.
        self._left: str | None = None
        self._covered: frozenset[str] = frozenset()

    def next(self) -> None:
        """Go to the next panel."""
        self._go(1)

    def previous(self) -> None:
        """Go to the panel before."""
        self._go(-1)

    def show(self, name: str) -> None:
        """Bring a panel into sight, and go there; from there, back to where the keyboard was."""
        here = self._here()
        if here == name and self._left is not None:
            name, self._left = self._left, None
            for covered in self._covered:
                self._bring(covered)
            self._bring(name)
        else:
            before = self._in_sight()
            self._bring(name)
            if here != name:
                self._left, self._covered = here, before - self._in_sight()
        self._panels[name].setFocus(Qt.FocusReason.ShortcutFocusReason)

    def _in_sight(self) -> frozenset[str]:
        # A dock that comes to the front moves the one behind it away a moment later.
        QApplication.sendPostedEvents()
        return frozenset(one.name for one in self._panels if one.isVisible())

    def _here(self) -> str | None:
        """Name of the panel with the keyboard."""
        focused = QApplication.focusWidget()
        names = (one.name for one in self._panels if focused and one.isAncestorOf(focused))
        return next(names, None)

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
