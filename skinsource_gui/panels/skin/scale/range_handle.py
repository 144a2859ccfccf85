"""One end of a scale that can be moved."""

from PySide6.QtCore import QPoint, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.keys import meaning_of

HANDLE_WIDTH, HANDLE_HEIGHT = 26, 12
_KEY_STEPS_DB = {
    Qt.Key.Key_Up: 1.0,
    Qt.Key.Key_Right: 1.0,
    Qt.Key.Key_Down: -1.0,
    Qt.Key.Key_Left: -1.0,
    Qt.Key.Key_PageUp: 10.0,
    Qt.Key.Key_PageDown: -10.0,
}


class RangeHandle(QWidget):
    """One end of the scale: dragged, or moved with the arrow keys."""

    #: How far it was pulled since the press, px, upwards.
    pulled = Signal(float)
    pressed = Signal()
    released = Signal()
    #: A step by a key, dB.
    stepped = Signal(float)

    def __init__(self, name: str, words: str, parent: QWidget) -> None:
        super().__init__(parent)
        self._grip: QPoint | None = None
        self.setObjectName(name)
        self.setAccessibleName(words)
        self.setToolTip(f"{words}: drag, or arrow keys (Ctrl: 0.1 dB)")
        self.setFixedSize(HANDLE_WIDTH, HANDLE_HEIGHT)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.SizeVerCursor)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        edge = current_theme().accent if self.hasFocus() else current_theme().dim
        painter.setPen(QPen(QColor(edge), 2.0 if self.hasFocus() else 1.2))
        painter.setBrush(QColor(current_theme().raised))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1.5, 2, -1.5, -2), 3, 3)
        painter.drawLine(QPointF(9, self.height() / 2), QPointF(17, self.height() / 2))
        painter.end()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._grip = event.globalPosition().toPoint()
            self.pressed.emit()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._grip is not None:
            self.pulled.emit(float(self._grip.y() - event.globalPosition().toPoint().y()))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._grip is not None:
            self._grip = None
            self.released.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = key_step_db(event)
        if step:
            self.stepped.emit(step)
        else:
            super().keyPressEvent(event)


def key_step_db(event: QKeyEvent) -> float:
    """Step that a key asks for, dB; 0 for none."""
    if not meaning_of("colour_bar", event):
        return 0.0
    step = _KEY_STEPS_DB[Qt.Key(event.key())]
    if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
        return step / 10
    if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
        return step * 5
    return step
