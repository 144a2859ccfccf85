"""Zoom, pan and crosshair by mouse and keys."""

from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPen,
    QWheelEvent,
)
from PySide6.QtWidgets import QApplication, QWidget

from skinsource_gui.widgets.plot.crosshair import paint_rubber_band
from skinsource_gui.widgets.plot.plot_canvas import PlotCanvas
from skinsource_gui.widgets.plot.ranges import Range, within, zoomed

_KEY_ZOOM = 1.5
_WHEEL_ZOOM = 1.2
_NOTCH = 120.0
_LEAP = 10
# No closer than so many samples.
_FEWEST_SAMPLES = 4
_STEPS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}
_ZOOMS = {
    Qt.Key.Key_Plus: _KEY_ZOOM,
    Qt.Key.Key_Equal: _KEY_ZOOM,
    Qt.Key.Key_Minus: 1 / _KEY_ZOOM,
}
_OTHER_KEYS = (Qt.Key.Key_0, Qt.Key.Key_Home, Qt.Key.Key_End, Qt.Key.Key_Escape)


class NavigablePlot(PlotCanvas):
    """A plot that is zoomed, panned and read.

    Drag: zoom to what is covered.  Ctrl+wheel: zoom at the pointer.  Middle button: pan.  Double
    click or 0: everything.  Left and right: crosshair (Shift: ten samples), Home and End: first
    and last sample, + and -: zoom, Esc: no crosshair.
    """

    #: Part of the x axis the user wants to see, SI; None: everything.
    zoom_requested = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setCursor(Qt.CursorShape.CrossCursor)
        self._band: tuple[float, float] | None = None
        self._pan_from: float | None = None
        self._pinned = False

    # Mouse

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if self.curves is None:
            event.ignore()
            return
        x = event.position().x()
        if event.button() == Qt.MouseButton.LeftButton:
            self._set_band((x, x))
        elif event.button() == Qt.MouseButton.MiddleButton:
            self._pan_from = x
        else:
            event.ignore()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self.curves is None:
            return
        at = event.position()
        if self._pan_from is not None:
            moved = self._position(self._pan_from) - self._position(at.x())
            self._pan_from = at.x()
            low, high = self.window.shown
            self._request((low + moved, high + moved))
            return
        if self._band is not None:
            self._set_band((self._band[0], at.x()))
        self._follow_mouse(at)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._pan_from = None
        band = self._band
        if band is None or event.button() != Qt.MouseButton.LeftButton:
            return
        self._set_band(None)
        if abs(band[1] - band[0]) >= QApplication.startDragDistance() / 2:
            left, width = self.frame.plot[0], self.frame.plot[2]
            ends = sorted(self._position(min(max(x, left), left + width)) for x in band)
            if ends[0] < ends[1]:
                self._request((ends[0], ends[1]))

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._set_band(None)
            self.zoom_requested.emit(None)

    def wheelEvent(self, event: QWheelEvent) -> None:
        turned = event.angleDelta().y()
        if self.curves is None or not event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            event.ignore()
            return
        factor = _WHEEL_ZOOM ** (turned / _NOTCH)
        self._request(zoomed(self.window.shown, self._position(event.position().x()), factor))
        event.accept()

    def leaveEvent(self, event: QEvent) -> None:
        if not self._pinned:
            self.set_cursor(None)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        event.ignore()

    # Keys

    def event(self, event: QEvent) -> bool:
        # These keys are this plot's while it has the focus, whatever the window's actions are.
        is_shortcut = event.type() == QEvent.Type.ShortcutOverride
        if is_shortcut and isinstance(event, QKeyEvent) and self.curves and _is_ours(event):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key = event.key()
        if self.curves is None or not _is_ours(event):
            event.ignore()
        elif key == Qt.Key.Key_Escape:
            self._escape(event)
        elif key == Qt.Key.Key_0:
            self.zoom_requested.emit(None)
        elif key in _ZOOMS:
            self._request(zoomed(self.window.shown, self._anchor(), _ZOOMS[key]))
        elif key in _STEPS:
            leap = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            self._step(_STEPS[key] * (_LEAP if leap else 1))
        else:
            self._pin(0 if key == Qt.Key.Key_Home else self.curves.x.size - 1)

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.update()

    def paint_over(self, painter: QPainter) -> None:
        super().paint_over(painter)
        if self._band is not None:
            paint_rubber_band(painter, *self._band, self.frame.area, self.theme)
        if self.hasFocus():
            painter.setPen(QPen(QColor(self.theme.accent), 1))
            painter.drawRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5))

    # What they do

    def _position(self, x_px: float) -> float:
        left, _, width, _ = self.frame.plot
        return self.window.position((x_px - left) / width)

    def _anchor(self) -> float:
        # Keys zoom at the crosshair if it is in sight.
        picture = self.crosshair()
        if picture is not None:
            return self._position(picture.x)
        return sum(self.window.shown) / 2

    def _request(self, shown: Range) -> None:
        if self.curves is None:
            return
        extent, n_points = self.window.extent, self.curves.x.size
        shortest = (extent[1] - extent[0]) * min(_FEWEST_SAMPLES / n_points, 1.0)
        part = within(shown, extent, shortest)
        self.zoom_requested.emit(None if part is None else self.window.values(part))

    def _set_band(self, band: tuple[float, float] | None) -> None:
        self._band = band
        self.update()

    def _follow_mouse(self, at: QPointF) -> None:
        if self.curves is None:
            return
        self._pinned = False
        if not self.frame.area.contains(at):
            self.set_cursor(None)
            return
        self.set_cursor(self.curves.nearest(self.window.axis.value(self._position(at.x()))))

    def _step(self, samples: int) -> None:
        if self.curves is None:
            return
        if self.cursor is None:
            middle = self.window.axis.value(sum(self.window.shown) / 2)
            self._pin(self.curves.nearest(middle))
        else:
            self._pin(min(max(self.cursor + samples, 0), self.curves.x.size - 1))

    def _pin(self, index: int) -> None:
        # The crosshair stays until Esc, and pulls the visible part with it.
        if self.curves is None:
            return
        if self.window.axis.log:
            index = max(index, self.curves.nearest(self.window.axis.value(self.window.extent[0])))
        self._pinned = True
        position = self.window.axis.position(float(self.curves.x[index]))
        low, high = self.window.shown
        move = min(position - low, 0.0) + max(position - high, 0.0)
        self.set_cursor(index)
        if move:
            self._request((low + move, high + move))

    def _escape(self, event: QKeyEvent) -> None:
        if self._band is not None:
            self._set_band(None)
        elif self.cursor is not None:
            self._pinned = False
            self.set_cursor(None)
        else:
            event.ignore()


def _is_ours(event: QKeyEvent) -> bool:
    allowed = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier
    if event.modifiers() & ~allowed:
        return False
    key = event.key()
    return key in _STEPS or key in _ZOOMS or key in _OTHER_KEYS
