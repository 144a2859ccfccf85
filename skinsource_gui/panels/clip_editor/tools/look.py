"""A pointer that reads values."""

from PySide6.QtCore import QObject, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen
from PySide6.QtWidgets import QMenu

from skinsource_gui.panels.clip_editor.content import EditorContent
from skinsource_gui.panels.clip_editor.tools.tool import Button, Held
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.fields.units import value_text
from skinsource_gui.widgets.plot.ticks import number_text


class Look(QObject):
    """Shows time and value under the pointer; a drag moves what is seen."""

    #: What is seen is to move by so many seconds.
    pan_wanted = Signal(float)

    cursor = Qt.CursorShape.ArrowCursor
    hint = ""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._from: QPointF | None = None
        self._at: QPointF | None = None

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Held) -> None:
        self._from = at

    def move(self, content: EditorContent, at: QPointF, held: Held) -> None:
        self._at = at
        if self._from is not None:
            self.pan_wanted.emit((self._from.x() - at.x()) / content.scale.px_per_s)
            self._from = at

    def release(self, content: EditorContent) -> None:
        self._from = None

    def double_click(self, content: EditorContent, at: QPointF) -> None:
        """Nothing more than a click."""

    def fill_menu(self, menu: QMenu, content: EditorContent, at: QPointF | None) -> None:
        """Nothing to offer: it only reads."""

    def cancel(self) -> bool:
        had, self._from = self._from is not None, None
        return had

    def paint(self, painter: QPainter, content: EditorContent, theme: Theme) -> None:
        """Paint a crosshair with its reading."""
        played = content.played
        if self._at is None or played is None or not content.area.contains(self._at):
            return
        index = round(content.scale.time(self._at.x()) * content.sample_rate_hz)
        if not 0 <= index < played.size:
            return
        time_s, value = index / content.sample_rate_hz, float(played[index])
        here = content.at(time_s, value)
        painter.setPen(QPen(QColor(theme.dim), 1, Qt.PenStyle.DotLine))
        area = content.area
        painter.drawLine(QPointF(here.x(), area.top()), QPointF(here.x(), area.bottom()))
        words = f"{value_text(time_s, 's', digits=5)}   {number_text(value, 4)}"
        metrics = QFontMetricsF(painter.font())
        width = metrics.horizontalAdvance(words) + 10
        left = min(here.x() + 6, area.right() - width)
        room = QRectF(left, area.top() + 2, width, metrics.height() + 2)
        painter.setPen(QPen(QColor(theme.border), 1))
        painter.setBrush(QColor(theme.raised))
        painter.drawRect(room)
        painter.setPen(QColor(theme.text))
        painter.drawText(room, Qt.AlignmentFlag.AlignCenter, words)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(theme.accent))
        painter.drawEllipse(here, 3, 3)
