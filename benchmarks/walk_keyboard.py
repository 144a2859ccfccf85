"""Chapter of the walkthrough: through the whole window without a mouse."""

from pathlib import Path

from driver import NONE, SHIFT, Driver
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

KEY = Qt.Key
_ORDER = ["hand", "timeline", "inspector", "skin", "traces", "spectra"]
# More than there are controls.
_MOST_STOPS = 100


def go_by_keyboard(you: Driver, _: Path) -> None:
    """Tab and Shift+Tab through all panels; F6 from one to the next."""
    window = you.window
    you.focus(window.panel("hand"))
    for label, modifiers, order in (("Tab", NONE, _ORDER), ("Shift Tab", SHIFT, _ORDER[::-1])):
        start = QApplication.focusWidget()
        went = [_panel_with_keyboard(you)]
        stops = 0
        while stops < _MOST_STOPS:
            you.key(KEY.Key_Tab, modifiers)
            stops += 1
            here = _panel_with_keyboard(you)
            if here != went[-1]:
                went.append(here)
                you.picture(f"{label} reaches {here or 'the bars'}")
            if QApplication.focusWidget() is start:
                break
        you.expect(stops < _MOST_STOPS, f"{label} comes round")
        panels = [name for name in went if name]
        around = order if modifiers == NONE else [order[-1], *order[:-1]]
        you.expect(panels == [*around, "hand"], f"{label} reaches all panels in turn, not {panels}")
    jumps = []
    for _step in _ORDER:
        you.key(KEY.Key_F6)
        jumps.append(_panel_with_keyboard(you))
    you.expect(jumps == [*_ORDER[1:], "hand"], f"F6 goes from panel to panel, not {jumps}")


def _panel_with_keyboard(you: Driver) -> str:
    focused = QApplication.focusWidget()
    inside = (panel.name for panel in you.window.panels if focused and panel.isAncestorOf(focused))
    return next(inside, "")
