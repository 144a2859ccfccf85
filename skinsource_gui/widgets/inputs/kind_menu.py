"""Kinds of waveforms in a menu: the common ones at once, all others under "More"."""

from collections.abc import Callable
from functools import partial

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from skinsource.design.waveforms import COMMON, Waveform, kinds
from skinsource_gui.widgets.inputs.waveform_picture import PICTURE_PX, waveform_icon

MORE = "More"


def fill_kind_menu(menu: QMenu, choose: Callable[[str], None], *, current: str = "") -> None:
    """Add every kind of waveform, with its picture.

    Parameters
    ----------
    menu
        What they are added to.
    choose
        Is called with the name of the class of the kind that was chosen.
    current
        Name of the present kind, which is printed in bold.
    """
    _show_pictures(menu)
    common = [kind for kind in kinds() if kind in COMMON]
    for kind in common:
        _add(menu, kind, choose, current)
    others = [kind for kind in kinds() if kind not in COMMON]
    if not others:
        return
    more = menu.addMenu(MORE)
    more.setObjectName("more_kinds")
    _show_pictures(more)
    for kind in others:
        _add(more, kind, choose, current)
    if current in {kind.__name__ for kind in others}:
        _embolden(more.menuAction())


def _add(menu: QMenu, kind: type[Waveform], choose: Callable[[str], None], current: str) -> None:
    action = menu.addAction(waveform_icon(kind), kind.title)
    action.setObjectName(f"kind_{kind.__name__}")
    action.triggered.connect(partial(_tell, choose, kind.__name__))
    if kind.__name__ == current:
        _embolden(action)
        menu.setActiveAction(action)


def _tell(choose: Callable[[str], None], name: str, _checked: bool = False) -> None:
    choose(name)


def _embolden(action: QAction) -> None:
    font = action.font()
    font.setBold(True)
    action.setFont(font)


def _show_pictures(menu: QMenu) -> None:
    # Qt makes room for square pictures only, which is enough between the rows.
    menu.setStyleSheet(
        f"QMenu {{ icon-size: {PICTURE_PX.width()}px; }}"
        f"QMenu::item {{ padding: 0px 24px 0px 8px; min-height: {PICTURE_PX.width()}px; }}"
    )
