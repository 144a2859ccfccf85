"""Widths that grow with letters."""

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QWidget

from skinsource_gui.theme import letter_scale


class LetterWidth(QObject):
    """Keeps a widget, in letters of any size, as wide as it is in usual ones.

    Parameters
    ----------
    widget
        What is kept; also the parent.
    usual_px
        Its width in letters of the usual size, or the most of it.
    at_most
        Whether it may be narrower.
    """

    def __init__(self, widget: QWidget, usual_px: int, *, at_most: bool = False) -> None:
        super().__init__(widget)
        self._widget, self._usual_px, self._at_most = widget, usual_px, at_most
        widget.installEventFilter(self)
        self._fit()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.FontChange:
            self._fit()
        return super().eventFilter(watched, event)

    def _fit(self) -> None:
        width_px = round(self._usual_px * letter_scale(self._widget.font()))
        self._widget.setMaximumWidth(width_px)
        if not self._at_most:
            self._widget.setMinimumWidth(width_px)
