"""Words that stand on the map: the reason for its absence, marks, notes."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter

from skinsource.choice_words import BACK_SIDE
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.map_painter import small_font
from skinsource_gui.theme import Theme

SYNTHETIC_MARK = "SYNTHETIC"
OUTDATED_MARK = "Updating…"
_LOWER_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignBottom


def paint_words(painter: QPainter, content: MapContent, room: QRectF, theme: Theme) -> None:
    """Draw side, message, synthetic mark, note and the mark of something outdated in ``room``."""
    unit = QFontMetricsF(painter.font()).height() / 14
    inner = room.adjusted(8 * unit, 5 * unit, -5 * unit, -6 * unit)
    if content.limb_map is not None:
        painter.save()
        painter.setFont(small_font(painter.font()))
        top = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop
        corner = QRectF(inner.left(), inner.top(), 0.42 * inner.width(), inner.height())
        _paint_card(painter, corner, BACK_SIDE, QColor(theme.dim), theme, top)
        painter.restore()
    if content.synthetic:
        paint_synthetic_mark(painter, inner, theme)
    if content.message:
        _paint_message(painter, inner, content.message, theme)
    words = OUTDATED_MARK if content.outdated else content.note
    if words:
        colour = theme.dim if content.outdated else theme.warning
        area = QRectF(inner)
        area.setWidth(0.55 * inner.width())
        _paint_card(painter, area, words, QColor(colour), theme, _LOWER_LEFT)


def paint_synthetic_mark(painter: QPainter, area: QRectF, theme: Theme) -> None:
    """Draw the word SYNTHETIC into the upper right corner of ``area``."""
    painter.save()
    font = small_font(painter.font())
    font.setBold(True)
    painter.setFont(font)
    metrics = QFontMetricsF(font)
    line = metrics.height()
    width = metrics.horizontalAdvance(SYNTHETIC_MARK) + 0.7 * line
    badge = QRectF(area.right() - width, area.top(), width, 1.35 * line)
    painter.setPen(QColor(theme.warning))
    painter.setBrush(QColor(theme.base))
    painter.drawRoundedRect(badge, 3, 3)
    painter.drawText(badge, Qt.AlignmentFlag.AlignCenter, SYNTHETIC_MARK)
    painter.restore()


def _paint_message(painter: QPainter, area: QRectF, words: str, theme: Theme) -> None:
    flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
    inside = area.adjusted(10, 7, -10, -7)
    needed = QFontMetricsF(painter.font()).boundingRect(inside, int(flags), words)
    card = needed.adjusted(-10, -7, 10, 7)
    painter.setPen(QColor(theme.border))
    painter.setBrush(QColor(theme.base))
    painter.drawRoundedRect(card, 4, 4)
    painter.setPen(QColor(theme.text))
    painter.drawText(needed, int(flags), words)


def _paint_card(
    painter: QPainter,
    area: QRectF,
    words: str,
    colour: QColor,
    theme: Theme,
    side: Qt.AlignmentFlag,
) -> None:
    """Words at a ``side`` of ``area``."""
    flags = side | Qt.TextFlag.TextWordWrap
    needed = QFontMetricsF(painter.font()).boundingRect(area, int(flags), words)
    ground = QColor(theme.base)
    ground.setAlphaF(0.88)
    painter.fillRect(needed.adjusted(-4, -2, 4, 2), ground)
    painter.setPen(colour)
    painter.drawText(needed, int(flags), words)
