"""Windows: one filter that tells all followers what happens, and their place on the screen."""

from collections.abc import Callable
from typing import Any, cast

from PySide6 import QtWidgets
from PySide6.QtCore import QEvent, QMargins, QObject, QRect, QSize, Qt


def application() -> QtWidgets.QApplication:
    """Return the application, without which there are no widgets."""
    return cast("QtWidgets.QApplication", QtWidgets.QApplication.instance())


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


def fitted(inside: QRect, available: QRect, frame: QMargins) -> QRect:
    """Return ``inside`` moved, and cut if necessary, so that its frame is on the screen.

    Parameters
    ----------
    inside
        Area of the window, without its frame.
    available
        Area of the screen.
    frame
        Widths of the window's frame.
    """
    room = available.marginsRemoved(frame)
    size = QSize(min(inside.width(), room.width()), min(inside.height(), room.height()))
    left = min(max(inside.left(), room.left()), room.left() + room.width() - size.width())
    top = min(max(inside.top(), room.top()), room.top() + room.height() - size.height())
    return QRect(left, top, size.width(), size.height())


def fit_by_guess(window: QtWidgets.QWidget) -> None:
    """Fit a window onto its screen before it is shown, with a usual frame."""
    bar = window.style().pixelMetric(QtWidgets.QStyle.PixelMetric.PM_TitleBarHeight)
    edge = window.style().pixelMetric(QtWidgets.QStyle.PixelMetric.PM_DefaultFrameWidth)
    frame = QMargins(edge, bar + edge, edge, 2 * edge)
    window.setGeometry(fitted(window.geometry(), window.screen().availableGeometry(), frame))
