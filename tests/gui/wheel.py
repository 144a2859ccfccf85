"""The wheel of the mouse, which the test kit of Qt does not turn."""

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication

#: How far a notch turns it.
NOTCH = 120
NONE = Qt.KeyboardModifier.NoModifier


def wheel_event(at, on_screen, turned, held=NONE):
    """A turn of the wheel by ``turned`` (x, y), at a place of what it is sent to."""
    return QWheelEvent(
        QPointF(at),
        QPointF(on_screen),
        QPoint(),
        QPoint(*turned),
        Qt.MouseButton.NoButton,
        held,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )


def turn_wheel(widget, at, turned, held=NONE):
    """Turn it over a widget; whether that took it."""
    event = wheel_event(at, widget.mapToGlobal(QPointF(at)), turned, held)
    event.ignore()
    QApplication.sendEvent(widget, event)
    return event.isAccepted()
