"""Docks that share a place: one is in front, tabs tell of the others."""

from collections.abc import Mapping
from functools import partial

from PySide6.QtCore import QChildEvent, QEvent, QObject, QPoint, Qt, QTimer, Signal
from PySide6.QtWidgets import QApplication, QMainWindow, QTabBar, QTabWidget

from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.shell.docks.tab_lists import TabLists, tab_menu
from skinsource_gui.shell.focus.focus_order import focus_into
from skinsource_gui.widgets.keys import shortcut_text

_NOTHING = "No panel shares its place with another one; View > Panels brings more"


class DockTabs(QObject):
    """Looks after docks that are tabs, whoever made them so: an arrangement, or the user.

    Parameters
    ----------
    window
        Holds the docks; also the parent.
    docks
        By the name of their panel, in the order in which the keyboard reaches them.
    """

    #: What came of it, where that cannot be seen.
    done = Signal(str)
    #: The name of a panel that was brought to the front, or whose tab was clicked.
    meant = Signal(str)

    def __init__(self, window: QMainWindow, docks: Mapping[str, Dock]) -> None:
        super().__init__(window)
        self._window, self._docks = window, docks
        self._lists = TabLists(self)
        self._lists.wanted.connect(self._open_list)
        window.setTabPosition(Qt.DockWidgetArea.AllDockWidgetAreas, QTabWidget.TabPosition.North)
        window.installEventFilter(self)
        for dock in docks.values():
            dock.sight_changed.connect(self._tell)
        self._tell()

    def next(self) -> None:
        """Bring the tab after the one in front to the front, where the keyboard is."""
        self._go(1)

    def previous(self) -> None:
        """Bring the tab before the one in front to the front, where the keyboard is."""
        self._go(-1)

    def show_list(self) -> None:
        """List the panels in one place, where the keyboard is, to bring one to the front."""
        bar = self._bar_in_use()
        if bar is not None:
            self._open_list(bar, bar.rect().bottomLeft())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # Qt makes a bar when it needs one, and says nothing else of it.
        if isinstance(event, QChildEvent) and event.type() == QEvent.Type.ChildPolished:
            bar = event.child()
            if isinstance(bar, QTabBar):
                _prepare(bar)
                self._lists.add_to(bar)
                bar.tabBarClicked.connect(self._mean)
        return False

    def _mean(self, index: int) -> None:
        """Whoever clicks a tab means its panel, also where it was in front before."""
        bar = self.sender()
        if isinstance(bar, QTabBar) and index >= 0:
            # Pressed; it comes to the front next.  Of the bar nothing is kept: Qt may delete it.
            QTimer.singleShot(0, self, partial(self._take_keyboard, bar.tabText(index)))

    def _take_keyboard(self, title: str) -> None:
        dock = self._called(title)
        if dock.in_sight:
            self._enter(dock, Qt.FocusReason.MouseFocusReason)

    def _tell(self) -> None:
        names = frozenset(name for name, dock in self._docks.items() if dock.in_sight)
        for name, dock in self._docks.items():
            if name in names:  # of the others no title is seen, and to ask Qt takes long
                others = self._window.tabifiedDockWidgets(dock)
                dock.show_tabbed(any(not one.isHidden() for one in others))
            if not dock.is_empty and dock.panel.in_sight != names:
                dock.panel.show_in_sight(names)

    def _go(self, step: int) -> None:
        bar = self._bar_in_use()
        if bar is not None:
            self._bring(bar.tabText((bar.currentIndex() + step) % bar.count()))

    def _open_list(self, bar: QTabBar, at: QPoint) -> None:
        tab_menu(bar, self._bring, self._window).popup(bar.mapToGlobal(at))

    def _bring(self, title: str) -> None:
        dock = self._called(title)
        dock.bring_forward()
        self._enter(dock, Qt.FocusReason.ShortcutFocusReason)

    def _enter(self, dock: Dock, reason: Qt.FocusReason) -> None:
        focus_into(dock.panel, reason)
        self.meant.emit(dock.objectName())

    def _called(self, title: str) -> Dock:
        return next(one for one in self._docks.values() if one.windowTitle() == title)

    def _bar_in_use(self) -> QTabBar | None:
        """The bar where the keyboard is; else the first there is, if any."""
        docks = [dock for dock in self._docks.values() if dock.in_sight]
        focused = QApplication.focusWidget()
        docks.sort(key=lambda dock: focused is None or not dock.isAncestorOf(focused))
        for dock in docks:
            if (bar := self._bar_of(dock)) is not None:
                return bar
        self.done.emit(_NOTHING)
        return None

    def _bar_of(self, dock: Dock) -> QTabBar | None:
        """The bar in which a dock is in front of others."""
        direct = Qt.FindChildOption.FindDirectChildrenOnly
        # A bar that Qt is about to delete still holds what it held: the newest is the one.
        for bar in reversed(self._window.findChildren(QTabBar, options=direct)):
            if bar.count() > 1 and bar.tabText(bar.currentIndex()) == dock.windowTitle():
                return bar
        return None


def _prepare(bar: QTabBar) -> None:
    bar.setAccessibleName("Panels in one place")
    bar.setToolTip(
        f"Panels in one place; {shortcut_text('next_tab')} shows the next, the right button lists "
        "them"
    )
    # The keyboard has a key for it; a stop without a panel would only be in the way of Tab.
    bar.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    bar.setDrawBase(False)
    bar.setExpanding(False)
    # Names that are cut to a letter tell nothing; where there is no room, arrows lead to the rest.
    bar.setElideMode(Qt.TextElideMode.ElideNone)
    bar.setUsesScrollButtons(True)
