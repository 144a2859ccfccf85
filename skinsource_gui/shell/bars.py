"""The bar above the panels."""

from collections.abc import Iterable, Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMainWindow, QToolBar, QWidget


def setup_toolbar(
    window: QMainWindow, parts: Sequence[QWidget], groups: Iterable[Iterable[QAction]]
) -> QToolBar:
    """Return a bar in ``window`` that cannot be moved: ``parts``, then groups of actions."""
    bar = QToolBar("Setup", window)
    bar.setObjectName("setup")
    bar.setMovable(False)
    bar.toggleViewAction().setVisible(False)
    bar.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
    for part in parts:
        bar.addWidget(part)
    for group in groups:
        bar.addSeparator()
        for action in group:
            bar.addAction(action)
    window.addToolBar(bar)
    return bar
