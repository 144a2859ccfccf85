"""Icons made of a path, drawn in the colours of the theme."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPainterPath, QPen, QPixmap

from skinsource_gui.theme import Theme

_SIZE = 16
# Larger than shown, so that it stays sharp on fine screens.
_OVERSAMPLED = 3


def drawn_icon(
    path: QPainterPath,
    theme: Theme,
    *,
    filled: bool = False,
    line_px: float = 1.2,
    greyed: bool = True,
) -> QIcon:
    """Return an icon of a path in a square of 16 units, for buttons that are on or off.

    Parameters
    ----------
    filled, line_px
        Whether it is filled; how wide its line is where it is not.
    greyed
        Whether it is grey on a button that is disabled.
    """
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
            painter.strokePath(path, QPen(QColor(name), line_px))
        painter.end()
        icon.addPixmap(pixmap, QIcon.Mode.Normal, state)
        if not greyed:
            icon.addPixmap(pixmap, QIcon.Mode.Disabled, state)
    return icon
