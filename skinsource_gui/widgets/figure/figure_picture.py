"""A figure on a page or a slide, between its words and without what it is chosen by."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from skinsource_gui.theme import UNIT_PX, current_theme, tabular
from skinsource_gui.widgets.figure.figure import Figure
from skinsource_gui.widgets.paper import on_paper

_NO_END_PX = 100_000.0


def draw_figure(painter: QPainter, room: QRectF, figure: Figure, above: str, below: str) -> None:
    """Fill ``room`` with a figure and the words above and below it."""
    painter.save()
    painter.fillRect(room, QColor(current_theme().base))
    painter.setFont(tabular(figure.font()))
    inner = room.adjusted(UNIT_PX, 1.0, -UNIT_PX, -2.0)
    top = inner.top() + _write(painter, inner, above, Qt.AlignmentFlag.AlignTop, figure)
    bottom = inner.bottom() - _write(painter, inner, below, Qt.AlignmentFlag.AlignBottom, figure)
    painter.translate(room.left(), top)
    # Figures draw from the corner of their widget.
    cursor_at, figure.cursor_at = figure.cursor_at, None
    with on_paper():
        figure.paint(painter, QRectF(0.0, 0.0, room.width(), max(bottom - top, 1.0)))
    figure.cursor_at = cursor_at
    painter.restore()
    # Where its parts are on the screen it knows again once it is painted there.
    figure.update()


def _write(
    painter: QPainter, room: QRectF, words: str, side: Qt.AlignmentFlag, figure: Figure
) -> float:
    """Write words at a side of a room; how high they are."""
    if not words:
        return 0.0
    flags = int(Qt.AlignmentFlag.AlignLeft | side | Qt.TextFlag.TextWordWrap)
    endless = QRectF(0.0, 0.0, room.width(), _NO_END_PX)
    painter.setPen(QColor(current_theme().dim))
    painter.drawText(room, flags, words)
    return painter.boundingRect(endless, flags, words).height()
