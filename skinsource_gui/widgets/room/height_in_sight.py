"""Tells how much of the height of a widget can be seen at once."""

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QWidget

from skinsource_gui.widgets.into_sight import areas_around
from skinsource_gui.widgets.room.room_or_words import RoomOrWords


class HeightInSight(RoomOrWords):
    """Tells when there may be another height in sight, and how much that is.

    What scrolls is as high as it wants to be: its own height does not say whether it has room.

    Parameters
    ----------
    widget
        Who is looked at; also the parent.
    """

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        self._widget = widget

    @property
    def px(self) -> int:
        """The height of the widget, or of what it scrolls in."""
        around = (area.viewport().height() for area in areas_around(self._widget))
        return min((self._widget.height(), *around))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Show:
            # What scrolls it is known by now.
            for area in areas_around(self._widget):
                area.viewport().installEventFilter(self)
            self.changed.emit()
        return super().eventFilter(watched, event)
