"""Keeps windows with their frames on the screen."""

from PySide6 import QtWidgets
from PySide6.QtCore import QMargins, QRect, QSize


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
