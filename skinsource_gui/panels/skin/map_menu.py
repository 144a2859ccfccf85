"""What the right button offers on the map."""

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QActionGroup, QGuiApplication, QImage
from PySide6.QtWidgets import QMenu, QWidget

from skinsource_gui.panels.skin.skin_map import SkinMap
from skinsource_gui.panels.skin.stage.map_layout import HAND
from skinsource_gui.widgets.keys import key_text
from skinsource_gui.widgets.map.level_look import COLOURS
from skinsource_gui.widgets.pan_zoom import WHOLE


def open_map_menu(
    shown: SkinMap,
    at: QPoint,
    picture: Callable[[], QImage],
    save: Callable[[], None],
    export: Callable[[], None],
    colours: tuple[str, Callable[[str], None]],
) -> None:
    """Offer fits and pictures of a map at a point of the screen.

    Parameters
    ----------
    shown
        The map.
    at
        Where on the screen.
    picture, save, export
        Make a picture of it; ask where to, and save one; ask where to, and save its numbers.
    colours
        Name of the colour map of levels, and who is told of another one.
    """
    menu = QMenu(shown)
    menu.setObjectName("skin_menu")
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    for words, fit, key in (("Fit hand", HAND, "hand"), ("Fit hand and arm", WHOLE, "whole")):
        menu.addAction(f"{words}\t{key_text('skin', key)}", partial(shown.stage.pan_zoom.show, fit))
    menu.addSeparator()
    _add_colours(menu.addMenu("Colours"), *colours)
    menu.addSeparator()
    # What is written to a file is waited for; the clipboard gets what is drawn.
    menu.addAction("Copy picture", partial(_copy, picture)).setEnabled(not shown.content.outdated)
    menu.addAction("Save picture as…", save)
    menu.addAction("Export data…", export)
    menu.popup(at)


def open_colours_menu(
    over: QWidget, at: QPoint, chosen: str, choose: Callable[[str], None]
) -> None:
    """Offer the colour maps of levels over a widget, at a point of the screen."""
    menu = QMenu(over)
    menu.setObjectName("colours_menu")
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    _add_colours(menu, chosen, choose)
    menu.popup(at)


def _add_colours(menu: QMenu, chosen: str, choose: Callable[[str], None]) -> None:
    group = QActionGroup(menu)
    for name, title in COLOURS.options:
        action = menu.addAction(title, partial(choose, name))
        action.setCheckable(True)
        action.setChecked(name == chosen)
        group.addAction(action)


def _copy(picture: Callable[[], QImage]) -> None:
    QGuiApplication.clipboard().setImage(picture())
