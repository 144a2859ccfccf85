"""The menu bar, made from the table of actions."""

from collections.abc import Iterable, Mapping, Sequence

from PySide6.QtGui import QAction, QKeySequence, QShortcut
from PySide6.QtWidgets import QMenu, QMenuBar

from skinsource_gui.shell.action_spec import ActionSpec
from skinsource_gui.shell.actions import MENUS

#: Opens the first menu.
MENU_KEY = "F10"


def fill_menu_bar(
    bar: QMenuBar,
    specs: Sequence[ActionSpec],
    actions: Mapping[str, QAction],
    recent: QMenu,
    panels: Iterable[QAction],
) -> None:
    """Fill ``bar``.

    Parameters
    ----------
    bar
        To be filled.
    specs, actions
        The table, and the action of each of its entries.
    recent
        The menu of recent files; stands after "Open".
    panels
        Actions that show and hide panels.
    """
    # A letter of its own for each: Alt and the letter open it, F10 the first.
    menus = {title: bar.addMenu(f"&{title}") for title in MENUS}
    within: dict[tuple[str, str], QMenu] = {}
    for spec in specs:
        menu = menus[spec.menu]
        if spec.separated:
            menu.addSeparator()
        if spec.submenu:
            place = spec.menu, spec.submenu
            if place not in within:
                within[place] = menu.addMenu(spec.submenu)
            menu = within[place]
        menu.addAction(actions[spec.name])
        if spec.name == "open_design":
            menu.addMenu(recent)
    shown = menus["View"].addMenu("Panels")
    for action in panels:
        shown.addAction(action)
    first = QShortcut(QKeySequence(MENU_KEY), bar)
    first.activated.connect(lambda: bar.setActiveAction(menus[MENUS[0]].menuAction()))
