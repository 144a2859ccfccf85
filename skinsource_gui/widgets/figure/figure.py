"""A picture that follows the theme, says why it is empty, and reads what the pointer is over."""

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from skinsource_gui.theme import UNIT_PX, current_theme, scaled, tabular
from skinsource_gui.widgets.focus_frame import paint_focus_frame
from skinsource_gui.widgets.keys import claims_shortcut, meaning_of
from skinsource_gui.widgets.over.veil import PALE, paint_updating

_TEXT = 0.92
_LEAST_LINES = 6


class Figure(QWidget):
    """What panels paint into; what is drawn, and what a place reads, its heirs say.

    Attributes
    ----------
    cursor_at
        Where the pointer, or the keys, have put the cursor; None: nowhere.
    """

    #: What the cursor reads; "" where it is nowhere.
    reading = Signal(str)

    def __init__(self, name: str, accessible_name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.cursor_at: QPointF | None = None
        self.message = ""
        self._late = False
        self.setObjectName(name)
        self.setAccessibleName(accessible_name)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)

    def minimumSizeHint(self) -> QSize:
        # Letters around a frame may be as large as they like: some of it is left.
        return QSize(200, max(120, _LEAST_LINES * self.fontMetrics().height()))

    def draw(self, painter: QPainter, room: QRectF) -> None:
        """Draw what there is, in ``room``."""
        raise NotImplementedError

    def read(self, at: QPointF) -> str:
        """What is to be said of a place; "" for nothing."""
        del at
        return ""

    def keys_area(self) -> QRectF:
        """Where the cursor can be put with the keys; empty: nowhere."""
        return QRectF()

    def show_late(self, late: bool) -> None:
        """Say whether what is drawn is older than the design."""
        self._late = late
        self.update()

    def say(self, message: str) -> None:
        """Empty the picture and say ``message`` in its middle; "" for a picture."""
        self.message = message
        self.setAccessibleDescription(message)
        if message:
            self.move_cursor(None)
        self.update()

    def move_cursor(self, at: QPointF | None) -> None:
        """Read another place, or none."""
        words = "" if at is None or self.message else self.read(at)
        self.cursor_at = at if words else None
        self.reading.emit(words)
        self.update()

    def read_again(self) -> None:
        """Tell what the cursor reads now that something else is drawn."""
        self.move_cursor(self.cursor_at)

    def paint(self, painter: QPainter, room: QRectF) -> None:
        """Draw what there is, or say why there is nothing; on the screen and on a page."""
        if self.message:
            painter.setPen(QColor(current_theme().dim))
            inner = room.adjusted(2 * UNIT_PX, UNIT_PX, -2 * UNIT_PX, -UNIT_PX)
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(inner, flags, self.message)
            return
        painter.setFont(scaled(tabular(self.font()), _TEXT))
        painter.setOpacity(PALE if self._late else 1.0)
        self.draw(painter, room)
        painter.setOpacity(1.0)
        if self._late:
            theme = current_theme()
            paint_updating(painter, room, QColor(theme.base), QColor(theme.text))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        room = QRectF(self.rect())
        painter.fillRect(room, QColor(current_theme().base))
        self.paint(painter, room)
        if self.hasFocus():
            paint_focus_frame(painter, room, current_theme())
        painter.end()

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._means) or super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        means, area = self._means(event), self.keys_area()
        if not means:
            super().keyPressEvent(event)
            return
        at = self.cursor_at or area.center()
        if means == "give_up":
            self.move_cursor(None)
        elif means == "jump":
            end = area.left() if event.key() == Qt.Key.Key_Home else area.right()
            self.move_cursor(QPointF(end, at.y()))
        else:
            held = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            step = 10.0 if held else 1.0
            across = at.x() + (step if event.key() == Qt.Key.Key_Right else -step)
            self.move_cursor(QPointF(min(max(across, area.left()), area.right()), at.y()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self.move_cursor(event.position())

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.move_cursor(None)

    def _means(self, event: QKeyEvent) -> str:
        means = meaning_of("plot", event)
        if means not in ("step", "jump", "give_up") or self.keys_area().isEmpty():
            return ""
        return means if means != "give_up" or self.cursor_at is not None else ""
