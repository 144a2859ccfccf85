"""The dorsal map as a widget that can be zoomed and panned."""

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QMouseEvent, QPainter, QPen
from PySide6.QtWidgets import QWidget

from skinsource_gui.panels.skin.colour_maps import colour_table
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.map_layout import (
    MapFrame,
    MapLayout,
    fitted_beside_palmar,
    hand_bounds,
    map_layout,
    outline_bounds,
)
from skinsource_gui.panels.skin.map_painter import MapPainter, small_font
from skinsource_gui.panels.skin.map_words import paint_words
from skinsource_gui.theme import LIGHT, Theme, tabular

#: What the map is fitted to; "free" after zooming or panning.
FIT_ALL, FIT_HAND, FREE = "all", "hand", "free"

_LARGEST_ZOOM = 25.0
# One notch of a wheel is 120 eighths of a degree.
_ZOOM_PER_NOTCH = 1.2
_PAN_PER_NOTCH_PX = 48.0


class MapCanvas(QWidget):
    """Draws the map and keeps what part of it is seen.

    Ctrl and wheel zoom at the pointer, the wheel and a drag with the middle button pan.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.content = MapContent()
        self.fit = FIT_ALL
        self._theme = LIGHT
        self._table = colour_table()
        self._painter: MapPainter | None = None
        self._layout: MapLayout | None = None
        self._grip: QPointF | None = None
        self.setMinimumSize(150, 180)
        # All of it is painted: nothing behind needs to be.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)

    def sizeHint(self) -> QSize:
        return QSize(300, 560)

    def show_content(self, content: MapContent) -> None:
        """Draw ``content``; another limb is fitted anew."""
        if content.same_as(self.content):
            return
        other_limb = content.limb_map is not self.content.limb_map
        self.content = content
        if other_limb:
            limb_map = content.limb_map
            self._painter = None if limb_map is None else MapPainter(limb_map, self._table)
            if self.fit == FREE:
                self.show_all()
            else:
                self._refit()
        self.update()

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self.update()

    def map_layout(self) -> MapLayout | None:
        """Screen places of everything; None before there is a limb."""
        return self._layout

    def show_all(self) -> None:
        """Fit the whole outline."""
        self._set_fit(FIT_ALL)

    def show_hand(self) -> None:
        """Fit the hand without the arm."""
        self._set_fit(FIT_HAND)

    def zoom(self, factor: float, about: QPointF) -> None:
        """Magnify around a point, no further out than the whole outline."""
        if self._layout is None:
            return
        whole = self._frame_of(FIT_ALL)
        frame = self._layout.frame
        scale = min(frame.scale * factor, _LARGEST_ZOOM * whole.scale)
        if scale <= whole.scale:
            self.show_all()
            return
        self._go_to(frame.zoomed(scale / frame.scale, about))

    def pan(self, dx: float, dy: float) -> None:
        """Shift the map by screen pixels."""
        if self._layout is not None:
            self._go_to(self._layout.frame.moved(dx, dy))

    def paintEvent(self, event) -> None:
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.base))
        if self._layout is not None and self._painter is not None:
            painter.setFont(tabular(small_font(self.font())))
            self._painter.paint(painter, self.content, self._layout, self._theme)
            self.paint_over(painter, self._layout)
        painter.setFont(self.font())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_words(painter, self.content, QRectF(self.rect()), self._theme)
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(self._theme.accent), 2))
            painter.drawRect(self.rect().adjusted(1, 1, -1, -1))
        painter.end()

    def paint_over(self, painter: QPainter, layout: MapLayout) -> None:
        """Draw what comes on top of the map."""

    def resizeEvent(self, event) -> None:
        super().resizeEvent(event)
        if self.fit == FREE and self._layout is not None and event.oldSize().isValid():
            grown = event.size() - event.oldSize()
            self._go_to(self._layout.frame.moved(grown.width() / 2, grown.height() / 2))
        else:
            self._refit()

    def wheelEvent(self, event) -> None:
        right, up = event.angleDelta().x() / 120.0, event.angleDelta().y() / 120.0
        if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            self.zoom(_ZOOM_PER_NOTCH**up, event.position())
        elif self.fit == FIT_ALL:
            event.ignore()
            return
        elif event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self.pan((right + up) * _PAN_PER_NOTCH_PX, 0)
        else:
            self.pan(right * _PAN_PER_NOTCH_PX, up * _PAN_PER_NOTCH_PX)
        event.accept()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.MiddleButton:
            self._grip = event.position()
            self.setCursor(Qt.CursorShape.ClosedHandCursor)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._grip is not None:
            by = event.position() - self._grip
            self._grip = event.position()
            self.pan(by.x(), by.y())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.MiddleButton:
            self._grip = None
            self.unsetCursor()

    def _set_fit(self, fit: str) -> None:
        self.fit = fit
        self._refit()

    def _refit(self) -> None:
        if self.content.limb_map is None:
            self._layout = None
        else:
            self._arrange(self._frame_of(self.fit if self.fit != FREE else FIT_ALL))

    def _frame_of(self, fit: str) -> MapFrame:
        bounds = hand_bounds if fit == FIT_HAND else outline_bounds
        return fitted_beside_palmar(
            bounds(self.content.limb_map), QRectF(self.rect()), self._metrics()
        )

    def _go_to(self, frame: MapFrame) -> None:
        room = QRectF(self.rect())
        self.fit = FREE
        self._arrange(frame.kept_near(outline_bounds(self.content.limb_map), room))

    def _arrange(self, frame: MapFrame) -> None:
        room = QRectF(self.rect())
        self._layout = map_layout(self.content.limb_map, frame, room, self._metrics())
        self.update()

    def _metrics(self) -> QFontMetricsF:
        return QFontMetricsF(small_font(self.font()))
