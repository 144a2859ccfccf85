"""Lists of the panels in one place, for bars of tabs that are too narrow to show them all."""

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QEvent, QObject, QPoint, Qt, Signal
from PySide6.QtWidgets import QMenu, QStyle, QTabBar, QToolButton, QWidget

from skinsource_gui.widgets.tooltips import show_tooltip

#: What the button is called.
BUTTON = "tab_list"
# As Qt calls the arrows at the end of a bar.
_ARROWS = ("ScrollLeftButton", "ScrollRightButton")
_FOLLOWED = (QEvent.Type.Show, QEvent.Type.Hide, QEvent.Type.Move, QEvent.Type.Resize)
_HINT = "List all panels in this place"


class TabLists(QObject):
    """Gives bars a list of their tabs: with the right button, and with a button of its own.

    That stands at the end of a bar whose tabs do not fit, behind the arrows; the room that the
    style has for two arrows is shared by all three.  Qt makes bars and deletes them as it likes, so
    nothing is kept here of any.
    """

    #: The bar whose list is wanted, and where in the bar.
    wanted = Signal(object, QPoint)

    def add_to(self, bar: QTabBar) -> None:
        """Give a bar its list."""
        bar.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        bar.customContextMenuRequested.connect(self._tell)
        button = QToolButton(bar)
        button.setObjectName(BUTTON)
        button.setAccessibleName(_HINT)
        show_tooltip(button, f"{_HINT} (right button on the tabs)")
        button.setArrowType(Qt.ArrowType.DownArrow)
        button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        button.hide()
        button.clicked.connect(self._tell_below)
        for arrow in _arrows(bar):
            arrow.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        bar = watched.parent() if event.type() in _FOLLOWED else None
        if isinstance(bar, QTabBar):
            _share_room(bar)
        return False

    def _tell(self, at: QPoint) -> None:
        self.wanted.emit(self.sender(), at)

    def _tell_below(self) -> None:
        button = self.sender()
        if isinstance(button, QWidget):
            self.wanted.emit(button.parent(), button.geometry().bottomLeft())


def tab_menu(bar: QTabBar, bring: Callable[[str], None], parent: QWidget) -> QMenu:
    """Return a menu of all tabs of a bar, the front one ticked; ``bring`` is told a title."""
    menu = QMenu(parent)
    menu.setObjectName("tab_menu")
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    for index in range(bar.count()):
        title = bar.tabText(index)
        action = menu.addAction(title, partial(bring, title))
        action.setCheckable(True)
        action.setChecked(index == bar.currentIndex())
        if action.isChecked():
            menu.setActiveAction(action)
    return menu


def _arrows(bar: QTabBar) -> list[QToolButton]:
    found = (bar.findChild(QToolButton, name) for name in _ARROWS)
    return [one for one in found if isinstance(one, QToolButton)]


def _share_room(bar: QTabBar) -> None:
    arrows, button = _arrows(bar), bar.findChild(QToolButton, BUTTON)
    if len(arrows) < len(_ARROWS) or not isinstance(button, QToolButton):
        return
    button.setHidden(any(arrow.isHidden() for arrow in arrows))
    metric = QStyle.PixelMetric.PM_TabBarScrollButtonWidth
    room = 2 * bar.style().pixelMetric(metric, None, bar)
    each, left = room // 3, bar.width() - room
    for k, one in enumerate((*arrows, button)):
        # To be where it is already tells nobody: that ends it.
        one.setGeometry(left + k * each, 0, each, bar.height())
