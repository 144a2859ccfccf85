"""Draws a row of the history."""

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRect, QSize, Qt
from PySide6.QtGui import QColor, QFontMetrics, QPainter
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem

from skinsource_gui.panels.history.steps_model import DONE, PRESENT, TIME
from skinsource_gui.theme import UNIT_PX, current_theme, tabular

# Label and time share a row as long as so much of it is left for the label.
_BAR_PX, _LEAST_WORDS = 3, 0.5


class StepDelegate(QStyledItemDelegate):
    """Label at the left, time at the right; pale what was taken back; a bar at the present."""

    def sizeHint(
        self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> QSize:
        return QSize(10 * UNIT_PX, option.fontMetrics.height() + UNIT_PX)

    def paint(
        self,
        painter: QPainter,
        option: QStyleOptionViewItem,
        index: QModelIndex | QPersistentModelIndex,
    ) -> None:
        theme, rect = current_theme(), option.rect
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        focused = chosen and bool(option.state & QStyle.StateFlag.State_HasFocus)
        painter.save()
        if chosen or index.data(PRESENT):
            painter.fillRect(rect, QColor(theme.raised if theme.name == "dark" else theme.window))
        if index.data(PRESENT):
            bar = QRect(rect.left(), rect.top(), _BAR_PX, rect.height())
            painter.fillRect(bar, QColor(theme.accent))
        inside = rect.adjusted(UNIT_PX, 0, -UNIT_PX, 0)
        painter.setFont(tabular(option.font))
        metrics = painter.fontMetrics()
        label, time = told_in(metrics, index.data(), index.data(TIME), inside.width())
        middle = Qt.AlignmentFlag.AlignVCenter
        painter.setPen(QColor(theme.dim))
        painter.drawText(inside, middle | Qt.AlignmentFlag.AlignRight, time)
        painter.setPen(QColor(theme.text if index.data(DONE) else theme.dim))
        painter.drawText(inside, middle | Qt.AlignmentFlag.AlignLeft, label)
        if focused:
            painter.setPen(QColor(theme.accent))
            painter.drawRect(rect.adjusted(0, 0, -1, -1))
        painter.restore()


def told_in(metrics: QFontMetrics, label: str, time: str, room_px: int) -> tuple[str, str]:
    """Label and time as they share a row; a label that is too long is cut short."""
    width = metrics.horizontalAdvance(time) + UNIT_PX if time else 0
    if room_px - width < _LEAST_WORDS * room_px:
        # What was done says more than when; the tooltip has both.
        time, width = "", 0
    left = max(room_px - width, 0)
    return metrics.elidedText(label, Qt.TextElideMode.ElideRight, left), time
