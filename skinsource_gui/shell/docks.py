"""Docks, which hold the panels of the window: menus, tabs, actions, and the keyboard in them.

A dock makes its panel when it first comes into sight. Docks that share a place are tabs of a bar
that Qt makes; a dock has a title of its own only while it floats.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any, cast
from weakref import ref

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QChildEvent, QEvent, QObject, QPoint, Qt, QTimer, Signal
from shiboken6 import isValid

from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.keys import shortcut_text
from skinsource_gui.qt.windows import WindowEvents, application
from skinsource_gui.shell.focus import focus_into, tab_stops
from skinsource_gui.state.panel import Panel, PanelRegistry

if TYPE_CHECKING:
    from skinsource_gui.panels.clip_editor.panel import ClipEditorPanel


class Dock(QtWidgets.QDockWidget):
    """Holds a panel, which scrolls where there is too little room.

    The panel is made when the dock first comes into sight.  A panel behind another one, as a tab,
    is hidden, so that nothing is computed for it: Qt only moves its dock to where nobody looks.

    Parameters
    ----------
    name, title
        Those of the panel that it holds.
    panels
        Where it has its panel from.
    window
        Its parent.
    """

    #: The panel is about to be hidden, because another one is in front of it.
    goes_behind = Signal()
    #: The panel came into sight, or left it.
    sight_changed = Signal()

    def __init__(
        self, name: str, title: str, panels: PanelRegistry, window: QtWidgets.QWidget
    ) -> None:
        super().__init__(title, window)
        self._panels = panels
        self._behind = False
        self._no_title = QtWidgets.QWidget(self)
        self.setTitleBarWidget(self._no_title)
        self.setObjectName(name)
        self._area = area = QtWidgets.QScrollArea()
        area.setWidgetResizable(True)
        area.setObjectName(f"{name}_area")
        area.setFrameShape(QtWidgets.QFrame.Shape.NoFrame)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setWidget(area)
        self.topLevelChanged.connect(self._show_title)
        self.topLevelChanged.connect(self._follow)

    @property
    def panel(self) -> Panel:
        """Its panel, which is made now if it was not before."""
        return self._panels[self.objectName()]

    @property
    def is_empty(self) -> bool:
        """Whether its panel was not made yet."""
        return self.objectName() not in self._panels

    @property
    def in_sight(self) -> bool:
        """Whether it is shown, and nothing is in front of it."""
        return not (self.isHidden() or self._behind)

    def hold(self, panel: Panel) -> None:
        """Take its panel, which was just made and connected."""
        self._area.setWidget(panel)
        panel.setVisible(not self._behind)
        self.sight_changed.emit()

    @contextmanager
    def lent(self) -> Iterator[Panel]:
        """Yield its panel to be shown elsewhere, then take it back."""
        panel = self.panel
        self._area.takeWidget()
        try:
            yield panel
        finally:
            self.hold(panel)

    def bring_forward(self) -> None:
        """Show it, in front of those that share its place."""
        self.show()
        self.raise_()

    def enter(self, *, reason: Qt.FocusReason = Qt.FocusReason.ShortcutFocusReason) -> None:
        """Bring it forward and give the keyboard to its panel."""
        self.bring_forward()
        self.panel.activateWindow()
        focus_into(self.panel, reason)

    def turn_floating(self) -> None:
        """Take it out of the window, or put it back where it was."""
        self.setFloating(not self.isFloating())

    def fill_menu(self, menu: QtWidgets.QMenu) -> None:
        """Add what can be done with it."""
        way = "Put {} back" if self.isFloating() else "Float {}"
        menu.addAction(way.format(self.windowTitle()), self.turn_floating)
        menu.addAction(f"Close {self.windowTitle()}", self.hide)

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        # Where its panel has no menu of its own.
        menu = passing_menu(self, "dock_menu")
        self.fill_menu(menu)
        menu.popup(event.globalPos())

    def moveEvent(self, event: QtGui.QMoveEvent) -> None:
        super().moveEvent(event)
        self._follow()

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        super().showEvent(event)
        self._follow()

    def hideEvent(self, event: QtGui.QHideEvent) -> None:
        super().hideEvent(event)
        self.sight_changed.emit()

    def _follow(self) -> None:
        # Qt says whether a dock is behind another one for some of the ways to get there; where it
        # puts those behind is the same for all of them.
        behind = not self.isFloating() and self.geometry().right() < 0
        turned = self._behind != behind
        self._behind = behind
        if turned and behind:
            self.goes_behind.emit()
        if not self.is_empty:
            self.panel.setVisible(not behind)
        elif self.in_sight and self.isVisible():
            # The window has the dock hold the panel that is made here.
            self._panels[self.objectName()]
        self.sight_changed.emit()

    def _show_title(self, floating: bool) -> None:
        self._no_title.setVisible(not floating)
        # The stubs of PySide take None for a mistake; with it Qt's own title is back.
        set_title: Any = self.setTitleBarWidget
        set_title(None if floating else self._no_title)


_NOTHING = "No panel shares its place with another one; View > Panels brings more"


class DockTabs(QObject):
    """Looks after docks that are tabs, whoever made them so: a workspace, or the user.

    Parameters
    ----------
    window
        Holds the docks; also the parent.
    docks
        By the name of their panel, in the order in which the keyboard reaches them.
    """

    #: A message where nothing can be seen.
    done = Signal(str)
    #: The name of a panel that was brought to the front, or whose tab was clicked.
    used = Signal(str)

    def __init__(self, window: QtWidgets.QMainWindow, docks: Mapping[str, Dock]) -> None:
        super().__init__(window)
        self._window, self._docks = window, docks
        window.setTabPosition(
            Qt.DockWidgetArea.AllDockWidgetAreas, QtWidgets.QTabWidget.TabPosition.North
        )
        # Qt makes a bar when it needs one, and says nothing else of it.
        WindowEvents.follow(window, self._note_child, QEvent.Type.ChildPolished)

    def go(self, step: str) -> None:
        """Bring the tab after the one in front to the front, or the one before: "-1"."""
        bar = self._bar_in_use()
        if bar is not None:
            title = bar.tabText((bar.currentIndex() + int(step)) % bar.count())
            self._enter(self._dock_titled(title), Qt.FocusReason.ShortcutFocusReason)

    def _note_child(self, event: QChildEvent) -> None:
        bar = event.child()
        if isinstance(bar, QtWidgets.QTabBar):
            _prepare(bar)
            bar.customContextMenuRequested.connect(self._open_menu)
            bar.tabBarClicked.connect(self._note_click)

    def _note_click(self, index: int) -> None:
        """Give the keyboard to the panel of a clicked tab, also where it was in front before."""
        bar = self.sender()
        if isinstance(bar, QtWidgets.QTabBar) and index >= 0:
            # Pressed; it comes to the front next.  Of the bar nothing is kept: Qt may delete it.
            QTimer.singleShot(0, self, partial(self._take_keyboard, bar.tabText(index)))

    def _take_keyboard(self, title: str) -> None:
        dock = self._dock_titled(title)
        if dock.in_sight:
            self._enter(dock, Qt.FocusReason.MouseFocusReason)

    def _open_menu(self, at: QPoint) -> None:
        # Of the bar nothing is kept: Qt may delete it.
        bar = self.sender()
        if isinstance(bar, QtWidgets.QTabBar) and (index := bar.tabAt(at)) >= 0:
            menu = passing_menu(self._window, "tab_menu")
            self._dock_titled(bar.tabText(index)).fill_menu(menu)
            menu.popup(bar.mapToGlobal(at))

    def _enter(self, dock: Dock, reason: Qt.FocusReason) -> None:
        dock.enter(reason=reason)
        self.used.emit(dock.objectName())

    def _dock_titled(self, title: str) -> Dock:
        return next(dock for dock in self._docks.values() if dock.windowTitle() == title)

    def _bar_in_use(self) -> QtWidgets.QTabBar | None:
        """The bar where the keyboard is; else the first there is, if any."""
        docks = [dock for dock in self._docks.values() if dock.in_sight]
        focused = QtWidgets.QApplication.focusWidget()
        docks.sort(key=lambda dock: focused is None or not dock.isAncestorOf(focused))
        for dock in docks:
            if (bar := self._bar_of(dock)) is not None:
                return bar
        self.done.emit(_NOTHING)
        return None

    def _bar_of(self, dock: Dock) -> QtWidgets.QTabBar | None:
        """The bar in which a dock is in front of others."""
        direct = Qt.FindChildOption.FindDirectChildrenOnly
        # A bar that Qt is about to delete still holds what it held: the newest is the one.
        for bar in reversed(self._window.findChildren(QtWidgets.QTabBar, options=direct)):
            if bar.count() > 1 and bar.tabText(bar.currentIndex()) == dock.windowTitle():
                return bar
        return None


def _prepare(bar: QtWidgets.QTabBar) -> None:
    bar.setAccessibleName("Panels in one place")
    bar.setToolTip(f"Panels in one place; {shortcut_text('next_tab')} shows the next")
    bar.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
    # The keyboard has a key for it; a stop without a panel would only be in the way of Tab.
    bar.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    bar.setDrawBase(False)
    bar.setExpanding(False)
    # A preset is dragged over a tab, and then into its panel.
    bar.setAcceptDrops(True)
    bar.setChangeCurrentOnDrag(True)
    # Names are not cut; where there is no room, arrows lead to the others.
    bar.setElideMode(Qt.TextElideMode.ElideNone)
    bar.setUsesScrollButtons(True)


def menu_toggles(docks: Iterable[Dock], parent: QObject) -> list[QtGui.QAction]:
    """Return an action for each dock, on while it is in the window: in front, or behind as a tab.

    It brings it into sight, or hides what is.
    """
    actions = []
    for dock in docks:
        action = QtGui.QAction(dock.windowTitle(), parent)
        action.setCheckable(True)
        action.triggered.connect(partial(_turn, dock, action))
        dock.sight_changed.connect(partial(_tick, dock, action))
        _tick(dock, action)
        actions.append(action)
    return actions


def toggles(docks: Iterable[Dock]) -> list[QtGui.QAction]:
    """Return new actions that bring each dock into sight, and that close those in the window.

    For the palette: what says that it shows a panel never closes it.
    """
    actions = []
    for dock in docks:
        ways: list[tuple[str, Callable[[], object]]] = [("Show", dock.enter)]
        if not dock.isHidden():
            ways.append(("Close", dock.hide))
        for word, act in ways:
            action = QtGui.QAction(f"{word} panel: {dock.windowTitle()}")
            action.triggered.connect(act)
            actions.append(action)
    return actions


def _turn(dock: Dock, action: QtGui.QAction) -> None:
    if dock.in_sight:
        dock.hide()
    else:
        dock.enter()
    # Qt has turned the tick of one behind others, which stays.
    _tick(dock, action)


def _tick(dock: Dock, action: QtGui.QAction) -> None:
    action.setChecked(not dock.isHidden())


class PanelInUse(QObject):
    """Knows the panel that was pressed last, or to which the keyboard went since.

    A press counts on a title, a tab, or anywhere inside, also where nothing takes the keyboard:
    that stays where it is, so that nobody loses what is typed elsewhere.

    Parameters
    ----------
    window
        Holds the docks; also the parent.
    docks
        By the name of their panel.
    panels
        Those that were made, in the order in which the keyboard reaches them.
    tabs
        Tell whose tab is clicked.
    """

    def __init__(
        self,
        window: QtWidgets.QMainWindow,
        docks: Mapping[str, Dock],
        panels: PanelRegistry,
        tabs: DockTabs,
    ) -> None:
        super().__init__(window)
        self._window, self._docks, self._panels = window, docks, panels
        self._last = ""
        # The last widget of the window with the keyboard; it may be deleted meanwhile.
        self._focused = ref[QtWidgets.QWidget](window)
        tabs.used.connect(self._use)
        for dock in docks.values():
            dock.sight_changed.connect(partial(self._watch_window_of, dock))
        application().focusChanged.connect(self._follow_keyboard)

    @property
    def panel(self) -> Panel:
        """The panel in use; where none is, the one with the keyboard, or the first in sight."""
        in_sight = [panel for panel in self._panels if panel.isVisible()]
        for panel in in_sight:
            if panel.name == self._last:
                return panel
        for focused in (QtWidgets.QApplication.focusWidget(), self._window.focusWidget()):
            for panel in in_sight:
                if focused is not None and panel.isAncestorOf(focused):
                    return panel
        return (in_sight or list(self._panels))[0]

    def turn_floating(self) -> None:
        """Take the panel in use out of the window, or put it back."""
        self._docks[self.panel.name].turn_floating()

    def close(self) -> None:
        """Close the panel in use."""
        self._docks[self.panel.name].hide()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if not isinstance(watched, QtGui.QWindow) or not isinstance(event, QtGui.QMouseEvent):
            return False
        # With a menu open, a press beside it does no more than close that.
        if (
            event.type() == QEvent.Type.MouseButtonPress
            and not QtWidgets.QApplication.activePopupWidget()
        ):
            self._press(watched, event)
        return False

    def _press(self, handle: QtGui.QWindow, event: QtGui.QMouseEvent) -> None:
        for top in (self._window, *self._docks.values()):
            if top.windowHandle() is handle:
                self._use_dock_of(top.childAt(event.position().toPoint()) or top)

    def _watch_window_of(self, dock: Dock) -> None:
        # A window knows of each press in it, whichever of its widgets takes that; it is made
        # anew now and then, as where a dock is taken out.  To be watched once more changes nothing.
        handle = dock.window().windowHandle()
        if handle is not None:
            handle.installEventFilter(self)

    def _follow_keyboard(
        self, _old: QtWidgets.QWidget | None, new: QtWidgets.QWidget | None
    ) -> None:
        if new is None or isinstance(new, QtWidgets.QMenuBar):
            return
        if new.window() is self._window:
            # From a menu, a page, a panel taken out or another program it comes back to where it
            # was: that is no use of the panel.
            came_back = new is self._focused()
            self._focused = ref(new)
            if came_back:
                return
        self._use_dock_of(new)

    def _use_dock_of(self, part: QtWidgets.QWidget) -> None:
        for name, dock in self._docks.items():
            if dock is part or dock.isAncestorOf(part):
                self._use(name)

    def _use(self, name: str) -> None:
        self._last = name


class KeyboardKeeper(QObject):
    """Keeps the keyboard in the panels when the one that has it is hidden.

    Qt would give it to whatever comes next, a list of the setup bar as well as any number: the
    next key would change what nobody looks at.  It goes back to who had it if that is in sight
    again, as where docks are only put into another order, else to the panel that is in front of
    it now, or else to the first panel in sight.

    Parameters
    ----------
    window
        Whose keyboard; also the parent.
    docks
        Its docks, in the order in which their panels are asked.
    """

    def __init__(self, window: QtWidgets.QMainWindow, docks: Mapping[str, Dock]) -> None:
        super().__init__(window)
        self._window, self._docks = window, docks
        # The widget that had the keyboard, and its dock.
        self._last_widget: QtWidgets.QWidget | None = None
        self._last_dock: Dock | None = None
        # Docks come and go while they are arranged: only where they stand at the end counts.
        self._arranged = QTimer(self, singleShot=True, interval=0)
        self._arranged.timeout.connect(self.settle)
        for dock in docks.values():
            # Both come before Qt has moved the keyboard.
            dock.goes_behind.connect(partial(self._take_from, dock))
            dock.sight_changed.connect(partial(self._take_from, dock))

    def settle(self) -> None:
        """Give the keyboard to a panel, if nobody has it: the docks are arranged."""
        self._arranged.stop()
        left, before = self._last_widget, self._last_dock
        self._last_widget = self._last_dock = None
        if self._window.focusWidget() is not None:
            return
        if left is not None and isValid(left) and left.isVisible():
            left.setFocus(Qt.FocusReason.OtherFocusReason)
            return
        in_front = [] if before is None else self._window.tabifiedDockWidgets(before)
        in_sight = [dock for dock in self._docks.values() if dock.in_sight]
        for dock in sorted(in_sight, key=lambda dock: dock not in in_front)[:1]:
            # A window that is not shown yet has no stops.
            focus_into(dock.panel, Qt.FocusReason.OtherFocusReason)

    def _take_from(self, dock: Dock) -> None:
        if dock.in_sight and dock.isVisible():
            return
        for focused in (self._window.focusWidget(), QtWidgets.QApplication.focusWidget()):
            if focused is not None and self._window.isVisible() and dock.isAncestorOf(focused):
                if not self._arranged.isActive():
                    self._last_widget, self._last_dock = focused, dock
                    self._arranged.start()
                focused.clearFocus()


class PanelFocus(QObject):
    """Gives the keyboard to the next panel, or the one before.

    Parameters
    ----------
    panels
        In the order in which the keyboard reaches them.
    docks
        Those of the panels, by their names.
    """

    def __init__(self, panels: PanelRegistry, docks: Mapping[str, Dock], parent: QObject) -> None:
        super().__init__(parent)
        self._panels, self._docks = panels, docks
        # The panel to go back to, the panels that the shown one has covered, and whether that
        # one was closed before.
        self._return_to: str | None = None
        self._covered: frozenset[str] = frozenset()
        self._closed = False

    def go(self, by: str) -> None:
        """Go to the next panel; "-1": to the one before."""
        # A panel that only says what to do has nothing for the keyboard.
        panels, step = [panel for panel in self._panels if tab_stops(panel, ())], int(by)
        focused = QtWidgets.QApplication.focusWidget()
        here = [k for k, panel in enumerate(panels) if focused and panel.isAncestorOf(focused)]
        if panels:
            start = here[0] if here else -min(step, 0) - 1
            panel = panels[(start + step) % len(panels)]
            panel.activateWindow()
            focus_into(panel, Qt.FocusReason.ShortcutFocusReason)

    def show(self, name: str) -> None:
        """Bring a panel into sight and go there; if it has the keyboard, go back."""
        here, dock = self._here(), self._docks[name]
        if here == name and self._return_to is not None:
            name, self._return_to = self._return_to, None
            for covered in (*self._covered, name):
                self._docks[covered].bring_forward()
            if self._closed:
                dock.hide()
        else:
            before, closed = self._in_sight(), dock.isHidden()
            dock.bring_forward()
            if here != name:
                self._return_to, self._closed = here, closed
                self._covered = before - self._in_sight()
        self._panels[name].setFocus(Qt.FocusReason.ShortcutFocusReason)

    def enter(self, name: str) -> None:
        """Bring a panel into sight and go there, unless it has the keyboard."""
        if self._here() != name:
            self.show(name)

    def draw(self, tool: str) -> None:
        """Show the selected clip large and take a tool, such as the pen, for it."""
        panel = cast("ClipEditorPanel", self._panels["clip_editor"])
        self.enter(panel.name)
        panel.use(tool)

    def _in_sight(self) -> frozenset[str]:
        # A dock that comes to the front moves the one behind it away a moment later.
        QtWidgets.QApplication.sendPostedEvents()
        return frozenset(panel.name for panel in self._panels if panel.isVisible())

    def _here(self) -> str | None:
        """Return the name of the panel with the keyboard."""
        focused = QtWidgets.QApplication.focusWidget()
        names = (panel.name for panel in self._panels if focused and panel.isAncestorOf(focused))
        return next(names, None)
