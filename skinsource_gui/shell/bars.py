"""The bar above the panels."""

from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMainWindow, QToolBar, QWidget


def setup_toolbar(
    window: QMainWindow, setup: QWidget, groups: Iterable[Iterable[QAction]]
) -> QToolBar:
    """Return a bar in ``window`` that cannot be moved: ``setup``, then groups of actions."""
    bar = QToolBar("Setup", window)
    bar.setObjectName("setup")
    bar.setMovable(False)
    bar.toggleViewAction().setVisible(False)
    bar.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
    bar.addWidget(setup)
    for group in groups:
        bar.addSeparator()
        for action in group:
            bar.addAction(action)
    window.addToolBar(bar)
    return bar
