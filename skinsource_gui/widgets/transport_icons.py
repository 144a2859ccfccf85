"""Icons of playing, drawn in the colours of the theme."""

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QIcon, QPainterPath, QPolygonF

from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.drawn_icon import drawn_icon


def play_icon() -> QIcon:
    """A triangle."""
    path = QPainterPath()
    path.addPolygon(QPolygonF((QPointF(4, 2.5), QPointF(13.5, 8), QPointF(4, 13.5))))
    path.closeSubpath()
    return drawn_icon(path, current_theme(), filled=True)


def stop_icon() -> QIcon:
    """A square."""
    path = QPainterPath()
    path.addRoundedRect(QRectF(3.5, 3.5, 9, 9), 1, 1)
    return drawn_icon(path, current_theme(), filled=True)


def repeat_icon() -> QIcon:
    """Two arrows that follow each other."""
    path = QPainterPath()
    for sign in (1, -1):
        at = QPointF(8, 8)
        path.moveTo(at + QPointF(-5.5, -0.5) * sign)
        path.lineTo(at + QPointF(-5.5, -3.5) * sign)
        path.lineTo(at + QPointF(5, -3.5) * sign)
        path.moveTo(at + QPointF(2.5, -6) * sign)
        path.lineTo(at + QPointF(5.2, -3.5) * sign)
        path.lineTo(at + QPointF(2.5, -1) * sign)
    return drawn_icon(path, current_theme(), line_px=1.4)
