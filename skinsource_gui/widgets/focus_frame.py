"""The frame around what has the keyboard."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from skinsource_gui.theme import Theme

_paper: ContextVar[bool] = ContextVar("paper", default=False)


def paint_focus_frame(painter: QPainter, area: QRectF, theme: Theme) -> None:
    """Draw the frame just inside ``area``; in a picture there is none."""
    if is_on_paper():
        return
    painter.setPen(QPen(QColor(theme.accent), 1))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(area.adjusted(0.5, 0.5, -0.5, -0.5))


@contextmanager
def on_paper() -> Iterator[None]:
    """Draw no frame in this block: in a picture nothing has the keyboard."""
    token = _paper.set(True)
    try:
        yield
    finally:
        _paper.reset(token)


def is_on_paper() -> bool:
    """Whether a picture is drawn now, not the screen."""
    return _paper.get()
