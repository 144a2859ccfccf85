"""Menus and shortcuts, made from the table of actions."""

from typing import TYPE_CHECKING

from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMenu

from skinsource_gui.shell.actions import ACTIONS, MENUS, ActionSpec
from skinsource_gui.shell.commands import Commands

if TYPE_CHECKING:
    from skinsource_gui.shell.window import MainWindow


def build_menus(window: "MainWindow", commands: Commands) -> dict[str, QAction]:
    """Fill the menu bar of ``window``; return the actions by name."""
    bar = window.menuBar()
    menus = {title: bar.addMenu(title) for title in MENUS}
    actions = {spec.name: _action(spec, window, commands) for spec in ACTIONS}
    for name in sorted({spec.group for spec in ACTIONS if spec.group}):
        group = QActionGroup(window)
        for spec in ACTIONS:
            if spec.group == name:
                group.addAction(actions[spec.name])
    for spec in ACTIONS:
        if spec.separated:
            menus[spec.menu].addSeparator()
        menus[spec.menu].addAction(actions[spec.name])
        if spec.name == "open_design":
            menus[spec.menu].addMenu(_recent_menu(window))
    panels = QMenu("Panels", window)
    for dock in window.docks.values():
        panels.addAction(dock.toggleViewAction())
    menus["View"].addMenu(panels)
    return actions


def _action(spec: ActionSpec, window: "MainWindow", commands: Commands) -> QAction:
    action = QAction(spec.text, window)
    action.setObjectName(spec.name)
    action.setShortcuts([QKeySequence(key) for key in spec.keys])
    keys = action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
    action.setToolTip(f"{spec.hint} ({keys})" if keys else spec.hint)
    action.setStatusTip(spec.hint)
    action.setCheckable(spec.checkable)
    action.triggered.connect(getattr(commands, spec.name))
    return action


def _recent_menu(window: "MainWindow") -> QMenu:
    menu = QMenu("Open recent", window)
    menu.setObjectName("open_recent")

    def fill() -> None:
        menu.clear()
        for path in window.preferences.recent_files:
            entry = menu.addAction(path.name)
            entry.setToolTip(str(path))
            entry.setData(str(path))
        if menu.isEmpty():
            menu.addAction("Nothing opened or saved yet").setEnabled(False)

    menu.aboutToShow.connect(fill)
    menu.triggered.connect(window.commands.open_recent)
    menu.setToolTipsVisible(True)
    return menu
