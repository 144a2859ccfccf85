"""Icons of playing, drawn in the colours of the theme."""

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPainterPath, QPen, QPixmap, QPolygonF

from skinsource_gui.theme import Theme

_SIZE = 16
# Larger than shown, so that it stays sharp on fine screens.
_OVERSAMPLED = 3


def play_icon(theme: Theme) -> QIcon:
    """A triangle."""
    path = QPainterPath()
    path.addPolygon(QPolygonF((QPointF(4, 2.5), QPointF(13.5, 8), QPointF(4, 13.5))))
    path.closeSubpath()
    return _icon(path, theme, filled=True)


def stop_icon(theme: Theme) -> QIcon:
    """A square."""
    path = QPainterPath()
    path.addRoundedRect(QRectF(3.5, 3.5, 9, 9), 1, 1)
    return _icon(path, theme, filled=True)


def repeat_icon(theme: Theme) -> QIcon:
    """Two arrows that follow each other."""
    path = QPainterPath()
    for sign in (1, -1):
        at = QPointF(8, 8)
        path.moveTo(at + sign * QPointF(-5.5, -0.5))
        path.lineTo(at + sign * QPointF(-5.5, -3.5))
        path.lineTo(at + sign * QPointF(5, -3.5))
        path.moveTo(at + sign * QPointF(2.5, -6))
        path.lineTo(at + sign * QPointF(5.2, -3.5))
        path.lineTo(at + sign * QPointF(2.5, -1))
    return _icon(path, theme)


def _icon(path: QPainterPath, theme: Theme, *, filled: bool = False) -> QIcon:
    icon = QIcon()
    for state, name in ((QIcon.State.Off, theme.text), (QIcon.State.On, theme.on_accent)):
        pixmap = QPixmap(_SIZE * _OVERSAMPLED, _SIZE * _OVERSAMPLED)
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QPainter(pixmap)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.scale(_OVERSAMPLED, _OVERSAMPLED)
        if filled:
            painter.fillPath(path, QColor(name))
        else:
            painter.strokePath(path, QPen(QColor(name), 1.4))
        painter.end()
        icon.addPixmap(pixmap, QIcon.Mode.Normal, state)
    return icon
