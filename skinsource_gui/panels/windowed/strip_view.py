"""The strip of windows as a widget: shown, pointed at, stepped through."""

from math import ceil

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QFontMetrics,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
)
from PySide6.QtWidgets import QToolTip, QWidget

from skinsource_gui.panels.windowed.content import WindowedContent, window_words
from skinsource_gui.panels.windowed.strip_layout import StripLayout, least_height, strip_layout
from skinsource_gui.panels.windowed.strip_painter import paint_strip
from skinsource_gui.panels.windowed.window_titles import head_words
from skinsource_gui.theme import current_theme, tabular
from skinsource_gui.widgets.focus_frame import paint_focus_frame

_SYNTHETIC = "SYNTHETIC"
_STEPS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}


class StripView(QWidget):
    """Shows windows, and tells which one is wanted."""

    #: Begin of a window that was chosen, s.
    time_chosen = Signal(float)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.content: WindowedContent | None = None
        self.message, self.outdated = "", False
        self.chosen: int | None = None
        self.setObjectName("window_strip")
        self.setAccessibleName("Windows")
        self.setAccessibleDescription("Left and right go from window to window")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    def sizeHint(self) -> QSize:
        return QSize(520, 460)

    def minimumSizeHint(self) -> QSize:
        return QSize(220, ceil(least_height(self.fontMetrics().height())))

    @property
    def places(self) -> StripLayout:
        """Where everything is."""
        n = 0 if self.content is None else self.content.windows.count
        return strip_layout(QRectF(self.rect()), n, self.fontMetrics().height())

    def show_content(self, content: WindowedContent | None, message: str = "") -> None:
        """Show windows, or say why there are none."""
        self.content, self.message = content, message
        self.update()

    def show_time(self, time_s: float) -> None:
        """Frame the window in which the playhead is."""
        chosen = None if self.content is None else self.content.window_at(time_s)
        if chosen != self.chosen:
            self.chosen = chosen
            self.update()

    def show_outdated(self, outdated: bool) -> None:
        """Say whether what is shown belongs to an older design."""
        self.outdated = outdated
        self.update()

    def window_under(self, point: QPointF) -> int | None:
        """The window under a point."""
        cells = enumerate(self.places.cells)
        return next((window for window, cell in cells if cell.contains(point)), None)

    @property
    def head_words(self) -> str:
        """What stands above on the left: what its times are, in as many words as fit, if any."""
        if self.content is None or self.message:
            return ""
        if self.outdated:
            return "Computing…"
        metrics, places = QFontMetrics(tabular(self.font())), self.places
        room = places.head.width() - metrics.height()
        if self.content.synthetic:
            room -= metrics.horizontalAdvance(_SYNTHETIC)
        return head_words(self.content, places.cells, metrics.horizontalAdvance, room)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, theme = QPainter(self), current_theme()
        painter.setFont(tabular(self.font()))
        painter.fillRect(self.rect(), QColor(theme.base))
        if self.content is None or self.message:
            painter.setPen(QColor(theme.dim))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(QRectF(self.rect()).adjusted(8, 8, -8, -8), flags, self.message)
            painter.end()
            return
        places = self.places
        painter.setPen(QColor(theme.warning if self.content.synthetic else theme.dim))
        words = _SYNTHETIC if self.content.synthetic else ""
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(places.head, right, words)
        painter.setPen(QColor(theme.dim))
        painter.drawText(places.head, Qt.AlignmentFlag.AlignVCenter, self.head_words)
        if self.outdated:
            painter.setOpacity(0.5)
        paint_strip(painter, self.content, places, theme, self.chosen)
        painter.setOpacity(1.0)
        if self.hasFocus():
            paint_focus_frame(painter, QRectF(self.rect()), theme)
        painter.end()

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            words = self.words_at(QPointF(event.pos()))
            QToolTip.showText(event.globalPos(), words, self)
            return True
        return super().event(event)

    def words_at(self, point: QPointF) -> str:
        """Times and extent of the window under a point."""
        window = self.window_under(point)
        if window is None or self.content is None or self.message:
            return ""
        about = self.content.extent_words(window)
        bounds_s = self.content.bounds_s
        return f"{window_words(bounds_s[window], bounds_s[-1][1])}\n{about}"

    def mousePressEvent(self, event: QMouseEvent) -> None:
        window = self.window_under(event.position())
        if event.button() == Qt.MouseButton.LeftButton and window is not None:
            self._choose(window)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = _STEPS.get(Qt.Key(event.key()))
        if step is None or self.content is None or event.modifiers():
            super().keyPressEvent(event)
            return
        n = self.content.windows.count
        if n:
            start = (-1 if step > 0 else n) if self.chosen is None else self.chosen
            self._choose(min(max(start + step, 0), n - 1))

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.update()

    def _choose(self, window: int) -> None:
        if self.content is not None and not self.message:
            self.time_chosen.emit(self.content.bounds_s[window][0])
