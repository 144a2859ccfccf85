"""What happens to a window, told to all who follow it through one filter."""

from collections.abc import Callable
from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import QEvent, QObject, Qt


class WindowEvents(QObject):
    """Calls functions at events of a window.

    All of Python's filters see each event of the window: one filter for all costs as much as one.
    """

    def __init__(self, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self._handlers: dict[QEvent.Type, tuple[Callable[[Any], object], ...]] = {}
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        handled = False
        for handle in self._handlers.get(event.type(), ()):
            handled = handle(event) is True or handled
        return handled

    @classmethod
    def follow(
        cls, window: QtWidgets.QWidget, handle: Callable[[Any], object], *kinds: QEvent.Type
    ) -> None:
        """Call a function with each event of some kinds, until the window is deleted.

        Where it returns True the window does not get the event.
        """
        direct = Qt.FindChildOption.FindDirectChildrenOnly
        events = window.findChild(cls, options=direct) or cls(window)
        for kind in kinds:
            events._handlers[kind] = (*events._handlers.get(kind, ()), handle)
