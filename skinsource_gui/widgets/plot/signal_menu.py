"""The menu of a plot."""

from collections.abc import Callable

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QMenu, QWidget

from skinsource_gui.widgets.key_tables.key_table import key_text
from skinsource_gui.widgets.plot.signal_exports import SignalExports


def open_menu(
    parent: QWidget, at: QPoint, show_everything: Callable[[], None], exports: SignalExports
) -> QMenu:
    """Open the menu at a place on the screen; it is deleted when it closes."""
    menu = QMenu(parent)
    menu.setObjectName("plot-menu")
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    # Keys are the plot's; here they are only read.
    menu.addAction(f"View all\t{key_text('plot', 'whole')}").triggered.connect(show_everything)
    menu.addSeparator()
    menu.addAction("Copy picture").triggered.connect(exports.copy_picture)
    menu.addAction("Save picture as…").triggered.connect(exports.save_picture)
    menu.addAction("Export data…").triggered.connect(exports.save_data)
    menu.popup(at)
    return menu
