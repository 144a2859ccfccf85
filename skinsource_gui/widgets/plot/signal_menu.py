"""The menu of a plot."""

from collections.abc import Callable, Sequence

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from skinsource_gui.widgets.keys import key_text
from skinsource_gui.widgets.plot.signal_exports import SignalExports


def open_menu(
    parent: QWidget,
    at: QPoint,
    show_everything: Callable[[], None],
    exports: SignalExports,
    switches: Sequence[QToolButton] = (),
    *,
    fresh: bool = True,
) -> QMenu:
    """Open the menu at a place on the screen; it is deleted when it closes.

    ``switches`` are those of the plot that stand here by their names.

    Unless curves are ``fresh``, those of the present design, nothing can be taken elsewhere.
    """
    menu = QMenu(parent)
    menu.setObjectName("plot-menu")
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    # Keys are the plot's; here they are only read.
    menu.addAction(f"View all\t{key_text('plot', 'whole')}").triggered.connect(show_everything)
    for switch in switches:
        chosen = menu.addAction(switch.accessibleName())
        chosen.setCheckable(True)
        chosen.setChecked(switch.isChecked())
        chosen.setToolTip(switch.toolTip())
        chosen.triggered.connect(switch.click)
    menu.setToolTipsVisible(True)
    menu.addSeparator()
    for words, take in (
        ("Copy picture", exports.copy_picture),
        ("Save picture as…", exports.save_picture),
        ("Export data…", exports.save_data),
    ):
        action = menu.addAction(words)
        action.setEnabled(fresh)
        action.triggered.connect(take)
    menu.popup(at)
    return menu
