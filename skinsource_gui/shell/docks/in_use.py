"""Which panel is in use."""

from collections.abc import Mapping
from functools import partial
from weakref import ref

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QMouseEvent, QWindow
from PySide6.QtWidgets import QApplication, QMainWindow, QMenuBar, QWidget

from skinsource_gui.made_panels import MadePanels
from skinsource_gui.panel import Panel
from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.shell.docks.dock_tabs import DockTabs


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
        self, window: QMainWindow, docks: Mapping[str, Dock], panels: MadePanels, tabs: DockTabs
    ) -> None:
        super().__init__(window)
        self._window, self._docks, self._panels = window, docks, panels
        self._last = ""
        # Where the keyboard was last in the window; that may be gone meanwhile.
        self._focused = ref[QWidget](window)
        tabs.meant.connect(self._use)
        for dock in docks.values():
            dock.sight_changed.connect(partial(self._watch_window_of, dock))
        application = QApplication.instance()
        if isinstance(application, QApplication):
            application.focusChanged.connect(self._follow_keyboard)

    @property
    def panel(self) -> Panel:
        """The panel in use; where none is, the one with the keyboard, or the first in sight."""
        in_sight = [panel for panel in self._panels if panel.isVisible()]
        for panel in in_sight:
            if panel.name == self._last:
                return panel
        for focused in (QApplication.focusWidget(), self._window.focusWidget()):
            for panel in in_sight:
                if focused is not None and panel.isAncestorOf(focused):
                    return panel
        return (in_sight or list(self._panels))[0]

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if not isinstance(watched, QWindow) or not isinstance(event, QMouseEvent):
            return False
        # With a menu open, a press beside it does no more than close that.
        if event.type() == QEvent.Type.MouseButtonPress and not QApplication.activePopupWidget():
            self._press(watched, event)
        return False

    def _press(self, handle: QWindow, event: QMouseEvent) -> None:
        for top in (self._window, *self._docks.values()):
            if top.windowHandle() is handle:
                self._use_dock_of(top.childAt(event.position().toPoint()) or top)

    def _watch_window_of(self, dock: Dock) -> None:
        # A window knows of each press in it, whichever of its widgets takes that; it is made
        # anew now and then, as where a dock is taken out.  To be watched once more changes nothing.
        handle = dock.window().windowHandle()
        if handle is not None:
            handle.installEventFilter(self)

    def _follow_keyboard(self, _old: QWidget | None, new: QWidget | None) -> None:
        if new is None or isinstance(new, QMenuBar):
            return
        if new.window() is self._window:
            # From a menu, a page, a panel taken out or another program it comes back to where it
            # was: nobody meant that.
            came_back = new is self._focused()
            self._focused = ref(new)
            if came_back:
                return
        self._use_dock_of(new)

    def _use_dock_of(self, part: QWidget) -> None:
        for name, dock in self._docks.items():
            if dock is part or dock.isAncestorOf(part):
                self._use(name)

    def _use(self, name: str) -> None:
        self._last = name
