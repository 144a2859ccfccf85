"""Keeps windows with their frames on the screen."""

from PySide6 import QtWidgets
from PySide6.QtCore import QEvent, QMargins, QObject, QRect, QSize


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
    _fit(window, QMargins(edge, bar + edge, edge, 2 * edge))


def _fit(window: QtWidgets.QWidget, frame: QMargins) -> None:
    inside = window.geometry()
    best = fitted(inside, window.screen().availableGeometry(), frame)
    if best != inside:
        window.setGeometry(best)


class ScreenFit(QObject):
    """Fits ``window`` onto its screen when it is first shown.

    The window manager adds a frame some time later; until then a usual frame is assumed.
    """

    def __init__(self, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self._window = window
        window.installEventFilter(self)

    def guess(self) -> None:
        """Fit the window with a usual frame."""
        if not self._window.windowState():
            fit_by_guess(self._window)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        moved = event.type() in (QEvent.Type.Move, QEvent.Type.WindowActivate)
        handle = self._window.windowHandle()
        if moved and self._window.isVisible() and handle is not None:
            frame = handle.frameMargins()
            if not frame.isNull():
                watched.removeEventFilter(self)
                if not self._window.windowState():
                    _fit(self._window, frame)
        return super().eventFilter(watched, event)
