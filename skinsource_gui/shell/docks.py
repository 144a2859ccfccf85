"""Docks: what holds a panel in the window."""

from collections.abc import Iterable
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QDockWidget, QFrame, QScrollArea, QWidget

from skinsource_gui.panel import Panel

_BUTTONS = {
    "qt_dockwidget_closebutton": "Hide this panel; View > Panels brings it back",
    "qt_dockwidget_floatbutton": "Take this panel out of the window, or back into it",
}


def dock_of(panel: Panel, window: QWidget) -> QDockWidget:
    """Return a dock that holds ``panel``, which scrolls where there is too little room."""
    dock = QDockWidget(panel.title, window)
    dock.setObjectName(panel.name)
    area = QScrollArea()
    area.setObjectName(f"{panel.name}_area")
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    area.setWidgetResizable(True)
    area.setWidget(panel)
    dock.setWidget(area)
    for name, hint in _BUTTONS.items():
        dock.findChild(QAbstractButton, name).setToolTip(hint)
    return dock


def toggles(docks: Iterable[QDockWidget]) -> list[QAction]:
    """Return one new action for each dock, which shows or hides it; for the palette."""
    actions = []
    for dock in docks:
        hidden = dock.isHidden()
        action = QAction(f"{'Show' if hidden else 'Hide'} panel: {dock.windowTitle()}")
        action.triggered.connect(partial(_show, dock, hidden))
        actions.append(action)
    return actions


def _show(dock: QDockWidget, shown: bool, _checked: bool = False) -> None:
    dock.setVisible(shown)
