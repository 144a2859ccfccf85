"""Words that stand on the map: the reason for its absence, and marks."""

from itertools import product

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter

from skinsource.design.labels import BACK_SIDE
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.map_painter import small_font
from skinsource_gui.panels.skin.map_quantity import time_text
from skinsource_gui.panels.skin.stage.map_layout import MapLayout
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.map.level_look import FIXED_MARK

SYNTHETIC_MARK = "SYNTHETIC"
OUTDATED_MARK = "updating…"
# Places that are tried for a message: so many steps across, and so many down.
_STEPS = 24
# Into so many lines a message is broken, rather than that it hides something.
_MOST_LINES = 4


def paint_words(
    painter: QPainter,
    content: MapContent,
    layout: MapLayout | None,
    room: QRectF,
    theme: Theme,
) -> None:
    """Draw side, message, synthetic mark and the mark of something outdated in ``room``."""
    unit = QFontMetricsF(painter.font()).height() / 14
    inner = room.adjusted(8 * unit, 5 * unit, -5 * unit, -6 * unit)
    free = QRectF(inner)
    if content.synthetic:
        free.setRight(_paint_synthetic_mark(painter, inner, theme) - 8 * unit)
    painter.save()
    painter.setFont(small_font(painter.font()))
    said = _side_words(content, free.width(), QFontMetricsF(painter.font()))
    _paint_card(painter, free, said, theme)
    painter.restore()
    if content.message:
        _paint_message(painter, inner, content.message, layout, theme)


def message_place(wanted: QRectF, room: QRectF, layout: MapLayout) -> QRectF | None:
    """Return ``wanted``, moved no farther than needed to hide no output and no card in ``room``.

    None: there is no such place.
    """
    return _nearest(wanted, room, layout, free_of_outputs=True)


def _nearest(
    wanted: QRectF, room: QRectF, layout: MapLayout, *, free_of_outputs: bool
) -> QRectF | None:
    radius = layout.disc_radius
    outputs = [QPointF(x, y) for x, y in layout.points] if free_of_outputs else []

    def is_free(place: QRectF) -> bool:
        around = place.adjusted(-radius, -radius, radius, radius)
        cards = (layout.palmar_card, layout.triad_card)
        return not any(map(around.contains, outputs)) and not any(map(around.intersects, cards))

    across, down = room.width() - wanted.width(), room.height() - wanted.height()
    corners = (
        QPointF(room.left() + across * i / _STEPS, room.top() + down * k / _STEPS)
        for i, k in product(range(_STEPS + 1), repeat=2)
    )
    places = [wanted, *(QRectF(corner, wanted.size()) for corner in corners)]
    free = [place for place in places if is_free(place)]
    return min(
        free,
        key=lambda place: (place.center() - wanted.center()).manhattanLength(),
        default=None,
    )


def _side_words(content: MapContent, room_px: float, metrics: QFontMetricsF) -> str:
    side = "" if content.limb_map is None else BACK_SIDE
    said = [FIXED_MARK] if content.fixed else []
    if content.quantity.moves and content.values is not None:
        said.insert(0, time_text(content.quantity.time_s))
    phrasings: tuple[str, ...]
    if content.outdated:
        phrasings = (f"{side} · {OUTDATED_MARK}", OUTDATED_MARK) if side else (OUTDATED_MARK,)
    elif said and side:
        phrasings = (" · ".join((side, *said)), " · ".join(said), said[0])
    else:
        phrasings = (side, side.partition(" ")[0])
    fitting = (words for words in phrasings if metrics.horizontalAdvance(words) <= room_px)
    return next(fitting, phrasings[-1])


def _paint_synthetic_mark(painter: QPainter, area: QRectF, theme: Theme) -> float:
    """Draw the word SYNTHETIC into the upper right corner of ``area``; return its left edge."""
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
    return badge.left()


def message_card(
    words: str, area: QRectF, layout: MapLayout | None, metrics: QFontMetricsF
) -> QRectF:
    """Where a message stands in ``area``: rather in more lines than on outputs or cards.

    Where everything is full it hides outputs rather than cards.
    """
    flags = int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap)
    inside = area.adjusted(10, 7, -10, -7)
    wide = metrics.boundingRect(inside, flags, words).adjusted(-10, -7, 10, 7)
    if layout is None:
        return wide
    widest_word = max(map(metrics.horizontalAdvance, words.split()), default=0.0)
    for lines in range(1, _MOST_LINES + 1):
        narrow = QRectF(inside)
        narrow.setWidth(max(inside.width() if lines == 1 else wide.width() / lines, widest_word))
        narrow.moveCenter(inside.center())
        needed = metrics.boundingRect(narrow, flags, words).adjusted(-10, -7, 10, 7)
        place = message_place(needed, area, layout)
        if place is not None:
            return place
    return _nearest(wide, area, layout, free_of_outputs=False) or wide


def _paint_message(
    painter: QPainter, area: QRectF, words: str, layout: MapLayout | None, theme: Theme
) -> None:
    flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
    card = message_card(words, area, layout, QFontMetricsF(painter.font()))
    painter.setPen(QColor(theme.border))
    painter.setBrush(QColor(theme.base))
    painter.drawRoundedRect(card, 4, 4)
    painter.setPen(QColor(theme.text))
    painter.drawText(card.adjusted(10, 7, -10, -7), int(flags), words)


def _paint_card(painter: QPainter, area: QRectF, words: str, theme: Theme) -> None:
    """Words in the upper left corner of ``area``, readable on whatever was moved under them."""
    if not words:
        return
    # One line: below a second one there could be skin.
    flags, metrics = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, painter.fontMetrics()
    words = metrics.elidedText(words, Qt.TextElideMode.ElideRight, int(area.width()))
    needed = QFontMetricsF(painter.font()).boundingRect(area, int(flags), words)
    ground = QColor(theme.base)
    ground.setAlphaF(0.88)
    painter.fillRect(needed.adjusted(-4, -2, 4, 2), ground)
    painter.setPen(QColor(theme.dim))
    painter.drawText(needed, int(flags), words)
