"""The bar on the skin map that says how long some millimetres are."""

from dataclasses import dataclass

from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFontMetrics, QPainter, QPainterPath, QPen

from skinsource_gui.panels.skin.stage.map_layout import WORDS_LINES, MapLayout
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.map.length_bar import bar_length_mm


@dataclass(frozen=True, slots=True, kw_only=True)
class LengthBar:
    """Where the bar stands, with what stands over it, and how long it is, px."""

    card: QRectF
    words: str
    long_px: float
    line_px: float
    unit: float


def length_bar(
    layout: MapLayout, px_per_mm: float, skin: QPainterPath, metrics: QFontMetrics
) -> LengthBar:
    """The bar in a corner, the lower left one unless skin lies there.

    Parameters
    ----------
    layout
        Where the map lies.
    px_per_mm
        Outline pixels in a millimetre; 0: that is not known, and the bar is empty.
    skin
        The outline on the screen.
    metrics
        Of the font of labels.
    """
    on_screen = px_per_mm * layout.frame.scale
    if on_screen <= 0.0:
        return LengthBar(card=QRectF(), words="", long_px=0.0, line_px=0.0, unit=0.0)
    length_mm = bar_length_mm(on_screen, layout.room.width())
    line, unit = metrics.height(), layout.unit
    words = f"{length_mm} mm"
    width = max(length_mm * on_screen, metrics.horizontalAdvance(words))
    card = bar_card(layout, QSizeF(width + 8 * unit, 1.5 * line + 3 * unit), line, skin)
    return LengthBar(card=card, words=words, long_px=length_mm * on_screen, line_px=line, unit=unit)


def paint_length_bar(painter: QPainter, bar: LengthBar, theme: Theme) -> None:
    """Draw the bar; the painter's font is that of labels."""
    card, line, unit = bar.card, bar.line_px, bar.unit
    if card.isEmpty():
        return
    left, bottom = card.left() + 4 * unit, card.bottom() - 3 * unit
    ground = QColor(theme.base)
    ground.setAlphaF(0.88)
    painter.fillRect(card, ground)
    pen = QPen(QColor(theme.text), 2 * unit)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    painter.setPen(pen)
    painter.drawLine(QLineF(left, bottom, left + bar.long_px, bottom))
    painter.setPen(QColor(theme.text))
    beside = QRectF(left, bottom - 1.4 * line, card.width() - 8 * unit, 1.2 * line)
    painter.drawText(beside, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, bar.words)


def bar_card(layout: MapLayout, size: QSizeF, line: float, skin: QPainterPath) -> QRectF:
    """Where the bar stands: in the first corner where it hides neither skin nor a card.

    Where there is none, as on a hand that was zoomed into, in the lower left one.
    """
    room, unit = layout.room, layout.unit
    cards = [one for one in (layout.palmar_card, layout.triad_card) if not one.isEmpty()]
    left, top = room.left() + 4 * unit, room.top() + WORDS_LINES * line
    low, right = room.bottom() - 3 * unit - size.height(), room.right() - 4 * unit - size.width()
    beside = min((one.left() for one in cards), default=room.right()) - 4 * unit - size.width()
    corners = (QPointF(left, low), QPointF(beside, low), QPointF(right, top), QPointF(left, top))
    places = [QRectF(corner, size) for corner in corners]
    free = (
        place
        for place in places
        if room.contains(place)
        and not skin.intersects(place)
        and not any(one.intersects(place) for one in cards)
    )
    return next(free, places[0])
