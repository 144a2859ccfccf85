"""Icons of the map's buttons, drawn in the colours of the theme."""

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QIcon, QPainterPath

from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.drawn_icon import drawn_icon


def sensors_icon() -> QIcon:
    """A few dots."""
    dots = QPainterPath()
    for x, y in (
        (3.5, 4),
        (8, 2.8),
        (12.5, 4.5),
        (5, 8.5),
        (10.5, 8.8),
        (4.2, 13),
        (8.2, 12.4),
        (12.4, 13),
    ):
        dots.addEllipse(QPointF(x, y), 1.5, 1.5)
    return drawn_icon(dots, current_theme(), filled=True, greyed=False)


def fit_icon() -> QIcon:
    """An arm between the corners of a frame."""
    path = QPainterPath()
    for x, y, dx, dy in ((2, 2, 1, 1), (14, 2, -1, 1), (2, 14, 1, -1), (14, 14, -1, -1)):
        path.moveTo(x + 3 * dx, y)
        path.lineTo(x, y)
        path.lineTo(x, y + 3 * dy)
    path.addRoundedRect(QRectF(6, 4.5, 4, 7), 1.8, 1.8)
    return drawn_icon(path, current_theme(), greyed=False)


def hand_icon() -> QIcon:
    """An open hand, thumb to the left."""
    path = QPainterPath(QPointF(5, 14.5))
    for x, y in ((2.2, 9.4), (3.4, 8.4), (5.3, 9.8)):
        path.lineTo(x, y)
    for left, top in ((5.3, 3.4), (7.4, 2.2), (9.5, 2.8), (11.6, 4.6)):
        path.lineTo(left, top + 0.6)
        path.quadTo(left + 0.9, top - 1.0, left + 1.8, top + 0.6)
        path.lineTo(left + 1.8, 8.2)
        path.lineTo(left + 2.1, 8.2)
    path.lineTo(13.4, 10.5)
    path.quadTo(13.4, 13, 11.6, 14.5)
    path.closeSubpath()
    return drawn_icon(path, current_theme(), greyed=False)
