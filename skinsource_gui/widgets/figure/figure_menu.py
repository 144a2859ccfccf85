"""The menu of a figure."""

from collections.abc import Callable

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QMenu, QWidget


def open_figure_menu(
    parent: QWidget, at: QPoint, save: Callable[[], None], copy: Callable[[], None] | None
) -> QMenu:
    """Open the menu at a place on the screen; ``copy`` is None where there are no numbers."""
    menu = QMenu(parent)
    menu.setObjectName("figure_menu")
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    if copy is not None:
        menu.addAction("Copy numbers").triggered.connect(copy)
    menu.addAction("Save picture as…").triggered.connect(save)
    menu.popup(at)
    return menu
