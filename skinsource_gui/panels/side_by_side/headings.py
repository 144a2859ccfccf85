"""What stands above the maps: on several lines where there is no room for it on one."""

import re
from collections.abc import Sequence

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter

from skinsource_gui.panels.side_by_side.content import Content
from skinsource_gui.panels.side_by_side.layout import Places, places_of

_CENTRE = Qt.AlignmentFlag.AlignCenter
_MOST_LINES = 4
# A number stays with what it numbers.
_BEFORE_NUMBER = re.compile(r" (?=\d)")
# Of a line of letters broken anywhere, so much is surely filled.
_FILLED = 0.9


def places_for(room: QRectF, content: Content, font: QFont) -> Places:
    """Lay out the maps of ``content``, whose words are written in ``font``."""
    line, n = QFontMetricsF(font).height(), len(content.cells)
    common = content.common_scale is not None
    metrics = QFontMetricsF(bold(font))
    for lines in range(1, _MOST_LINES + 1):
        places = places_of(room, n, line, common=common, heading_lines=lines)
        pairs = zip(content.cells, places.cells, strict=True)
        if all(_fits(metrics, cell.headings, place.heading) for cell, place in pairs):
            break
    return places


def paint_heading(painter: QPainter, wordings: Sequence[str], room: QRectF) -> None:
    """Write the first of some wordings, each shorter than the one before, that has room."""
    metrics = QFontMetricsF(painter.font())
    wraps = _CENTRE | Qt.TextFlag.TextWordWrap
    inner = _inner(metrics, room)
    found = next((one for one in wordings if _fits(metrics, (one,), room)), None)
    if found is not None:
        painter.drawText(inner, wraps, _kept(found))
        return
    lines = max(round(room.height() / metrics.height()), 1)
    width = inner.width() * (1.0 if lines == 1 else _FILLED * lines)
    words = metrics.elidedText(wordings[-1], Qt.TextElideMode.ElideRight, width)
    painter.drawText(inner, _CENTRE | Qt.TextFlag.TextWrapAnywhere, words)


def bold(font: QFont) -> QFont:
    """The font of headings among words in ``font``."""
    found = QFont(font)
    found.setBold(True)
    return found


def _fits(metrics: QFontMetricsF, wordings: Sequence[str], room: QRectF) -> bool:
    """Whether one of some wordings has room, at the breaks between words that it has."""
    inner = _inner(metrics, room)
    flags = int(_CENTRE.value) | int(Qt.TextFlag.TextWordWrap.value)
    for words in wordings:
        taken = metrics.boundingRect(inner, flags, _kept(words))
        if taken.width() <= inner.width() and taken.height() <= inner.height() + 1.0:
            return True
    return False


def _inner(metrics: QFontMetricsF, room: QRectF) -> QRectF:
    edge = 0.25 * metrics.height()
    return room.adjusted(edge, 0.0, -edge, 0.0)


def _kept(words: str) -> str:
    return _BEFORE_NUMBER.sub("\N{NO-BREAK SPACE}", words)
