"""Icons of the buttons of a dock, in the colours of the theme."""

from functools import cache

from PySide6.QtCore import QRectF
from PySide6.QtGui import QIcon, QPainterPath

from skinsource_gui.theme import Theme
from skinsource_gui.widgets.drawn_icon import drawn_icon

_LINE_PX = 1.6


@cache
def close_icon(theme: Theme) -> QIcon:
    """A cross."""
    path = QPainterPath()
    path.moveTo(3.5, 3.5)
    path.lineTo(12.5, 12.5)
    path.moveTo(12.5, 3.5)
    path.lineTo(3.5, 12.5)
    return drawn_icon(path, theme, line_px=_LINE_PX)


@cache
def float_icon(theme: Theme) -> QIcon:
    """A window in front of another one."""
    path = QPainterPath()
    path.addRect(QRectF(2.5, 6.0, 7.5, 7.5))
    path.moveTo(6.0, 3.0)
    path.lineTo(13.0, 3.0)
    path.lineTo(13.0, 10.0)
    return drawn_icon(path, theme, line_px=_LINE_PX)
