"""Draws a row of the library."""

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRect, QSize, Qt
from PySide6.QtGui import QColor, QPainter
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from skinsource_gui.panels.library.presets_model import ENTRY, OWN, TAGS
from skinsource_gui.panels.library.thumbnails import SIZE_PX, thumbnail
from skinsource_gui.theme import UNIT_PX, current_theme

_Index = QModelIndex | QPersistentModelIndex
_OWN_PX = 3


class PresetDelegate(QStyledItemDelegate):
    """A picture, the name, and tags below it; a bar at the user's own."""

    def sizeHint(self, option: QStyleOptionViewItem, index: _Index) -> QSize:
        words = 2 * option.fontMetrics.height() + UNIT_PX
        return QSize(10 * UNIT_PX, max(words, SIZE_PX.height() + UNIT_PX))

    def updateEditorGeometry(
        self, editor: QWidget, option: QStyleOptionViewItem, index: _Index
    ) -> None:
        editor.setGeometry(self._words(option.rect))

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: _Index) -> None:
        theme, rect = current_theme(), option.rect
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        focused = chosen and bool(option.state & QStyle.StateFlag.State_HasFocus)
        under = bool(option.state & QStyle.StateFlag.State_MouseOver)
        painter.save()
        if chosen or under:
            painter.fillRect(rect, QColor(theme.raised if theme.name == "dark" else theme.window))
        if index.data(OWN):
            bar = QRect(rect.left(), rect.top(), _OWN_PX, rect.height())
            painter.fillRect(bar, QColor(theme.accent))
        ratio = painter.device().devicePixelRatioF()
        picture = thumbnail(index.data(ENTRY).preset, theme.text, ratio)
        top = rect.center().y() - SIZE_PX.height() // 2
        painter.drawPixmap(rect.left() + UNIT_PX, top, picture)
        words = self._words(rect)
        metrics, middle = option.fontMetrics, words.center().y()
        for text, colour, area in (
            (index.data(), theme.text, words.adjusted(0, 0, 0, middle - words.bottom())),
            (index.data(TAGS), theme.dim, words.adjusted(0, middle - words.top(), 0, 0)),
        ):
            painter.setPen(QColor(colour))
            shown = metrics.elidedText(text, Qt.TextElideMode.ElideRight, area.width())
            painter.drawText(area, Qt.AlignmentFlag.AlignVCenter, shown)
        if focused:
            painter.setPen(QColor(theme.accent))
            painter.drawRect(rect.adjusted(0, 0, -1, -1))
        painter.restore()

    def _words(self, rect: QRect) -> QRect:
        return rect.adjusted(SIZE_PX.width() + 2 * UNIT_PX, 2, -UNIT_PX // 2, -2)
