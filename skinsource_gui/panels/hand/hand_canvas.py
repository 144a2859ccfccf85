"""The hand with its inputs on the screen, described in words too."""

from dataclasses import replace
from typing import Any

from PySide6.QtCore import QEvent, QPoint, QPointF, QSize
from PySide6.QtGui import QFontMetricsF, QHelpEvent, QPainter
from PySide6.QtWidgets import QToolTip, QWidget

from skinsource.locations import input_place
from skinsource_gui.panels.hand.hand_drawing import HandDrawing
from skinsource_gui.panels.hand.hand_layout import HandLayout
from skinsource_gui.panels.hand.hand_picture import HINT, HandPicture, HandState
from skinsource_gui.theme import Theme

_CONTACTS = {
    "perpendicular": "perpendicular: pushes into the skin",
    "in-axis": "in-axis: pushes along the digit",
}


class HandCanvas(QWidget):
    """Shows a `HandState`; what the mouse and the keys do to it is up to a subclass.

    Parameters
    ----------
    drawing
        The hand.
    theme
        Its colours until `show_theme`.
    """

    def __init__(self, drawing: HandDrawing, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._picture = HandPicture(drawing, theme)
        self._state = HandState()
        self.setMouseTracking(True)

    @property
    def state(self) -> HandState:
        """What is shown."""
        return self._state

    @property
    def hand(self) -> HandLayout:
        """Where the sites are, in pixels of this widget."""
        return self._picture.layout

    def site_centre(self, site: int) -> QPoint:
        """Middle of a site's marker, in pixels of this widget."""
        return self.hand.centre(site).toPoint()

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._picture.theme = theme
        self.update()

    def change(self, **changes: Any) -> None:
        """Replace fields of the state, and paint it if that makes a difference."""
        changed = replace(self._state, **changes)
        if changed != self._state:
            self._state = changed
            self.update()

    def describe(self, site: int) -> None:
        """Tell assistive technology what is at ``site``."""
        words = "Place " + self._words(site).replace("\n", ". ")
        if not self._state.marks:
            words = f"{HINT}. {words}"
        if words != self.accessibleDescription():
            self.setAccessibleDescription(words)

    def minimumSizeHint(self) -> QSize:
        return QSize(260, 300)

    def sizeHint(self) -> QSize:
        return QSize(320, 400)

    def resizeEvent(self, event) -> None:
        super().resizeEvent(event)
        self._fit()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fit()

    def paintEvent(self, event) -> None:
        painter = QPainter(self)
        self._picture.paint(painter, self._state, self.devicePixelRatioF())
        painter.end()

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            self._show_tooltip(event)
            return True
        return super().event(event)

    def _fit(self) -> None:
        self._picture.resize(self.size(), QFontMetricsF(self.font()))
        self.update()

    def _show_tooltip(self, event: QHelpEvent) -> None:
        site = self.hand.site_at(QPointF(event.pos()))
        if site is None or self._state.moving is not None:
            QToolTip.hideText()
        else:
            area = self.hand.marker_area(site).toAlignedRect()
            QToolTip.showText(event.globalPos(), self._words(site), self, area)

    def _words(self, site: int) -> str:
        place = input_place(site)
        lines = [f"{site} · {place.name}", _CONTACTS[place.contact]]
        for index in self._state.at(site):
            chosen = ", selected" if index == self._state.selected else ""
            lines.append(f"Input {index + 1}: {self._state.marks[index].words}{chosen}")
        return "\n".join(lines)
