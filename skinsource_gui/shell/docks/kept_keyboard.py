"""Where the keyboard goes when the panel that has it goes out of sight."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtWidgets import QApplication, QMainWindow, QWidget
from shiboken6 import isValid

from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.shell.focus.focus_order import focus_into


class KeptKeyboard(QObject):
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

    def __init__(self, window: QMainWindow, docks: Mapping[str, Dock]) -> None:
        super().__init__(window)
        self._window, self._docks = window, docks
        # Who had it, and in which dock.
        self._left: QWidget | None = None
        self._before: Dock | None = None
        # Docks come and go while they are arranged: only where they stand at the end counts.
        self._arranged = QTimer(self, singleShot=True, interval=0)
        self._arranged.timeout.connect(self._give_back)
        for dock in docks.values():
            # Both come before Qt has moved the keyboard.
            dock.goes_behind.connect(partial(self._take_from, dock))
            dock.sight_changed.connect(partial(self._take_from, dock))

    def _take_from(self, dock: Dock) -> None:
        focused = self._window.focusWidget()
        if focused is None or not self._window.isVisible() or not dock.isAncestorOf(focused):
            return
        if dock.isVisible() and dock.in_sight:
            return
        if not self._arranged.isActive():
            self._left, self._before = focused, dock
            self._arranged.start()
        focused.clearFocus()

    def settle(self) -> None:
        """All stand where they shall: who comes next may ask at once where the keyboard is."""
        if self._arranged.isActive():
            self._arranged.stop()
            self._give_back()

    @contextmanager
    def kept(self) -> Iterator[None]:
        """Keep the keyboard, once it is in a panel, while all docks are put elsewhere.

        A panel that was a window of its own keeps it too, and where nobody has it, as in a window
        that opens, the first panel takes it.
        """
        focused = QApplication.focusWidget()
        in_panel = focused is not None and any(
            dock.isAncestorOf(focused) for dock in self._docks.values()
        )
        nobody = focused is None and self._window.focusWidget() is None
        yield
        if in_panel or nobody:
            self._arranged.stop()
            self._left = self._before = None
            self._give_to(focused)

    def _give_back(self) -> None:
        left, dock = self._left, self._before
        self._left = self._before = None
        if self._window.focusWidget() is None and self._window.isVisible():
            self._give_to(left, dock)

    def _give_to(self, left: QWidget | None, before: Dock | None = None) -> None:
        """Give the keyboard to who had it, if that is in sight, or else to another panel."""
        if left is not None and isValid(left) and left.isVisible():
            left.setFocus(Qt.FocusReason.OtherFocusReason)
            return
        in_front = [] if before is None else self._window.tabifiedDockWidgets(before)
        in_sight = [dock for dock in self._docks.values() if dock.in_sight]
        for dock in sorted(in_sight, key=lambda one: one not in in_front)[:1]:
            if not focus_into(dock.panel, Qt.FocusReason.OtherFocusReason):
                # A window that is not shown yet has no stops.
                dock.panel.setFocus(Qt.FocusReason.OtherFocusReason)
