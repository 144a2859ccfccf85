"""What all our views of pyqtgraph have in common."""

from typing import Any, ClassVar

import pyqtgraph
from PySide6.QtCore import QEvent, QRectF
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QKeyEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QShowEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.focus_frame import paint_focus_frame
from skinsource_gui.widgets.keys import claims_shortcut, meaning_of
from skinsource_gui.widgets.wheel import ScrollingOn


class Canvas(pyqtgraph.GraphicsView):
    """A view with a frame while it has the keyboard, and with keys of its own.

    Attributes
    ----------
    key_place
        Where in the table of keys its own stand.
    scrolling_on
        Knows when the wheel is for what is around it.
    """

    key_place: ClassVar[str] = ""

    def __init__(self, parent: QWidget | None = None, **options: Any) -> None:
        # Each move of the mouse counts, however quick: the last one is where it stopped.
        pyqtgraph.setConfigOption("mouseRateLimit", 0)
        super().__init__(parent, **options)
        self.scrolling_on = ScrollingOn(self)

    def take_look(self) -> None:
        """Take over colours and font, also where a picture of an item is kept."""
        self.setBackground(QColor(current_theme().base))
        for item in self.scene().items():
            item.update()

    def claims(self, event: QKeyEvent) -> bool:
        """Whether it wants this key for itself, whatever the window's actions are."""
        return bool(meaning_of(self.key_place, event))

    def lay_out(self) -> None:
        """Put everything where it belongs in the size that there is now."""

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self.claims) or super().event(event)

    def viewportEvent(self, event: QEvent) -> bool:
        if isinstance(event, QWheelEvent) and self.scrolling_on.passes(event):
            event.ignore()
            return False
        return super().viewportEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        # pyqtgraph's constructor changes the palette, before there is a scene.
        if event.type() in (QEvent.Type.StyleChange, QEvent.Type.FontChange):
            self.take_look()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.scrolling_on.watch()

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self.viewport().update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.viewport().update()

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        if self.hasFocus():
            painter = QPainter(self.viewport())
            paint_focus_frame(painter, QRectF(self.rect()), current_theme())
            painter.end()

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        super().resizeEvent(event)
        # pyqtgraph's constructor calls this too, without an event.
        if event is not None:
            self.lay_out()
