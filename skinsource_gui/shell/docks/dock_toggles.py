"""Actions that bring docks into sight, and hide them."""

from collections.abc import Iterable
from functools import partial

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction

from skinsource_gui.shell.docks.dock import Dock


def menu_toggles(docks: Iterable[Dock], parent: QObject) -> list[QAction]:
    """Return an action for each dock, on while it is in the window: in front, or behind as a tab.

    It brings it into sight, or hides what is.
    """
    actions = []
    for dock in docks:
        action = QAction(dock.windowTitle(), parent)
        action.setCheckable(True)
        action.triggered.connect(partial(_turn, dock, action))
        dock.sight_changed.connect(partial(_tick, dock, action))
        _tick(dock, action)
        actions.append(action)
    return actions


def toggles(docks: Iterable[Dock]) -> list[QAction]:
    """Return new actions that bring each dock into sight, and that hide those in the window.

    For the palette: what says that it shows a panel never hides it.
    """
    actions = []
    for dock in docks:
        ways = [("Show", dock.bring_forward)]
        if not dock.isHidden():
            ways.append(("Hide", dock.hide))
        for word, act in ways:
            action = QAction(f"{word} panel: {dock.windowTitle()}")
            action.triggered.connect(act)
            actions.append(action)
    return actions


def _turn(dock: Dock, action: QAction) -> None:
    if dock.in_sight:
        dock.hide()
    else:
        dock.bring_forward()
    # Qt has turned the tick of one behind others, which stays.
    _tick(dock, action)


def _tick(dock: Dock, action: QAction) -> None:
    action.setChecked(not dock.isHidden())
