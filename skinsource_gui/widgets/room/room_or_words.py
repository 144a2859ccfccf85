"""Tells when a widget has another room, or when words in it are others."""

from PySide6.QtCore import QEvent, QObject, Signal
from PySide6.QtWidgets import QWidget

_OTHERS = (QEvent.Type.Resize, QEvent.Type.LayoutRequest, QEvent.Type.FontChange)


class RoomOrWords(QObject):
    """Tells when a widget has another room, or when words in it are others, or of another size.

    Who follows may tell the widget's layout so: that is told again.  It ends where the same room
    and the same words lead to the same answer, however the widget is laid out when it is asked.

    Parameters
    ----------
    widget
        Who is looked at; also the parent.
    """

    changed = Signal()

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # Qt tells a layout before who filters, and a resized widget knows its size already.
        if event.type() in _OTHERS:
            self.changed.emit()
        return False
