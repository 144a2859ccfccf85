"""Windows that stood on a screen that is gone come back to one that is there."""

from collections.abc import Sequence

from PySide6.QtCore import QObject, QRect, Qt, QTimer
from PySide6.QtGui import QGuiApplication, QScreen
from PySide6.QtWidgets import QApplication, QWidget

# Some desktops move windows themselves, a moment after they have told, and leave an edge in sight.
_DESKTOP_MS = 400
# Of which at least so much is seen stays where it is.
_SEEN_SHARE = 0.5
# What lies over a whole screen, desktops lay over another one.
_WHOLE = Qt.WindowState.WindowFullScreen | Qt.WindowState.WindowMaximized


class WindowsInSight(QObject):
    """Looks after the window, its dialogs, its notes and its floating panels.

    Parameters
    ----------
    window
        That of the studio; also the parent.
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._timer = QTimer(self, interval=_DESKTOP_MS, singleShot=True)
        self._timer.timeout.connect(self.bring)
        application = QApplication.instance()
        if isinstance(application, QGuiApplication):
            application.screenRemoved.connect(self._follow)

    def bring(self) -> None:
        """Move what is out of sight onto the screen that is nearest."""
        rooms = [screen.availableGeometry() for screen in QGuiApplication.screens()]
        for window in (self._window, *self._window.findChildren(QWidget)):
            whole = window.windowState() & _WHOLE
            if window.isWindow() and window.isVisible() and not whole:
                _bring(window, rooms)

    def _follow(self, _gone: QScreen) -> None:
        self._timer.start()


def place_in_sight(frame: QRect, rooms: Sequence[QRect]) -> QRect:
    """Where a window with this frame stands: the same place where most of it is seen there.

    Else it is the nearest place on the nearest of the screens, whose ``rooms`` these are, no larger
    than that.
    """
    shared = [_area(room.intersected(frame)) for room in rooms]
    if not rooms or max(shared) >= _SEEN_SHARE * _area(frame):
        return frame
    room = min(rooms, key=lambda one: (one.center() - frame.center()).manhattanLength())
    width, height = min(frame.width(), room.width()), min(frame.height(), room.height())
    left = min(max(frame.left(), room.left()), room.right() + 1 - width)
    top = min(max(frame.top(), room.top()), room.bottom() + 1 - height)
    return QRect(left, top, width, height)


def _bring(window: QWidget, rooms: Sequence[QRect]) -> None:
    frame = window.frameGeometry()
    place = place_in_sight(frame, rooms)
    if place == frame:
        return
    edges = frame.size() - window.size()
    window.resize(place.size() - edges)
    window.move(place.topLeft())


def _area(of: QRect) -> int:
    return max(of.width(), 0) * max(of.height(), 0)
