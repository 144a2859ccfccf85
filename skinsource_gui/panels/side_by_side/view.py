"""Maps side by side as a widget: what is pointed at in one of them is marked in all."""

from math import ceil

import numpy as np
from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFocusEvent, QKeyEvent, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from skinsource_gui.panels.side_by_side.content import Content
from skinsource_gui.panels.side_by_side.headings import places_for
from skinsource_gui.panels.side_by_side.layout import least_height
from skinsource_gui.panels.side_by_side.painter import paint_view
from skinsource_gui.panels.side_by_side.seen_maps import SeenMaps
from skinsource_gui.theme import current_theme, tabular
from skinsource_gui.widgets.focus_frame import paint_focus_frame
from skinsource_gui.widgets.keys import KEYS, claims_shortcut, meaning_of
from skinsource_gui.widgets.outputs.picker import OutputPicker

# Those keys of the skin map that are about outputs.
_KEYS = frozenset({"go", "select", "toggle", "select_all", "select_none"})


class MapsView(QWidget):
    """Shows `Content`, and tells which outputs the user wants selected.

    Attributes
    ----------
    content
        What is shown.
    picker
        Which outputs mouse and keys mean.
    """

    #: The outputs to select, a tuple of numbers.
    outputs_chosen = Signal(object)
    #: Number of the output that is pointed at, or None.
    pointed_at = Signal(object)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._outdated = False
        # Of which map the mouse was last.
        self._at = 0
        self.content = Content()
        self.picker = OutputPicker(self)
        self.picker.chosen.connect(self.outputs_chosen)
        self.picker.moved.connect(self._tell)
        self.setObjectName("maps_side_by_side")
        self.setAccessibleName("Maps side by side")
        self.setAccessibleDescription(
            "; ".join((*KEYS["skin"].sentences("go", "select", "toggle"), "marked in all maps"))
        )
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    @property
    def output(self) -> int | None:
        """The output that is pointed at, by the mouse or by keys."""
        return self.picker.pointed_at(focused=self.hasFocus())

    @property
    def seen(self) -> SeenMaps:
        """What is shown, and where."""
        places = places_for(QRectF(self.rect()), self.content, tabular(self.font()))
        return SeenMaps(content=self.content, places=places)

    def minimumSizeHint(self) -> QSize:
        return QSize(200, ceil(least_height(self.fontMetrics().height())))

    def show_content(self, content: Content) -> None:
        """Draw ``content``."""
        self.content, self.picker.selected = content, content.outputs
        self.setAccessibleName(content.message or content.about or "Maps side by side")
        self._tell()

    def show_outdated(self, outdated: bool) -> None:
        """Say whether what is shown belongs to an older design."""
        self._outdated = outdated
        self.update()

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._wants) or super().event(event)

    def _wants(self, event: QKeyEvent) -> bool:
        return meaning_of("skin", event) in _KEYS and self.picker.claims(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, theme, content = QPainter(self), current_theme(), self.content
        painter.setFont(tabular(self.font()))
        painter.fillRect(self.rect(), QColor(theme.base))
        if content.message or not content.cells:
            painter.setPen(QColor(theme.dim))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(QRectF(self.rect()).adjusted(8, 8, -8, -8), flags, content.message)
        else:
            late, band = self._outdated, self.picker.mouse.band
            paint_view(painter, self.seen, theme, self.output, outdated=late, band=band)
        if self.hasFocus():
            paint_focus_frame(painter, QRectF(self.rect()), theme)
        painter.end()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._at = self.seen.map_at(event.position(), self._at)
        self.picker.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if not event.buttons():
            self._at = self.seen.map_at(event.position(), self._at)
        self.picker.mouse.move(event.position(), self.seen.points_of(self._at))
        self._tell()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.picker.release(event, self.seen.points_of(self._at))
            self.update()

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.picker.mouse.leave()
        self._tell()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        points = self.seen.points_of(self._at)
        unplaced = tuple(int(k) + 1 for k in np.flatnonzero(np.isnan(points[:, 0])))
        middle = QRectF(self.rect()).center()
        if len(unplaced) == len(points) or meaning_of("skin", event) not in _KEYS:
            super().keyPressEvent(event)
        else:
            self.picker.press_key(event, points, unplaced, middle)
            self.update()

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self._tell()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._tell()

    def _tell(self) -> None:
        self.pointed_at.emit(self.output)
        self.update()
