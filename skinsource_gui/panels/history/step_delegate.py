"""Draws a row of the history."""

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRect, QSize, Qt
from PySide6.QtGui import QColor, QPainter
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem

from skinsource_gui.panels.history.steps_model import DONE, PRESENT, TIME
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme, tabular

_BAR_PX = 3


class StepDelegate(QStyledItemDelegate):
    """Label at the left, time at the right; pale what was taken back; a bar at the present."""

    theme: Theme = LIGHT

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
        theme, rect = self.theme, option.rect
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
        time = index.data(TIME)
        width = metrics.horizontalAdvance(time) + UNIT_PX if time else 0
        if metrics.horizontalAdvance(index.data()) > inside.width() - width:
            # What was done says more than when; the tooltip has both.
            time, width = "", 0
        middle = Qt.AlignmentFlag.AlignVCenter
        painter.setPen(QColor(theme.dim))
        painter.drawText(inside, middle | Qt.AlignmentFlag.AlignRight, time)
        words = inside.adjusted(0, 0, -width, 0)
        label = metrics.elidedText(index.data(), Qt.TextElideMode.ElideRight, max(words.width(), 0))
        painter.setPen(QColor(theme.text if index.data(DONE) else theme.dim))
        painter.drawText(words, middle | Qt.AlignmentFlag.AlignLeft, label)
        if focused:
            painter.setPen(QColor(theme.accent))
            painter.drawRect(rect.adjusted(0, 0, -1, -1))
        painter.restore()
