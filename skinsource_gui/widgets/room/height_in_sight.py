"""Tells how much of the height of a widget can be seen at once."""

from PySide6.QtCore import QEvent, QObject, Signal
from PySide6.QtWidgets import QWidget

from skinsource_gui.widgets.into_sight import areas_around

_OTHERS = (
    QEvent.Type.Show,
    QEvent.Type.Resize,
    QEvent.Type.LayoutRequest,
    QEvent.Type.FontChange,
)


class HeightInSight(QObject):
    """Tells when a widget has another room, or words of another size, and how much is in sight.

    What scrolls is as high as it wants to be: its own height does not say whether it has room.

    Parameters
    ----------
    widget
        Who is looked at; also the parent.
    """

    changed = Signal()

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        self._widget = widget
        widget.installEventFilter(self)

    @property
    def px(self) -> int:
        """The height of the widget, or of what it scrolls in."""
        around = (area.viewport().height() for area in areas_around(self._widget))
        return min((self._widget.height(), *around))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in _OTHERS:
            if event.type() == QEvent.Type.Show:
                for area in areas_around(self._widget):
                    area.viewport().installEventFilter(self)
            self.changed.emit()
        return False
