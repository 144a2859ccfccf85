"""Whether a page is drawn now, not the screen: there dots are finer than pixels."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from PySide6.QtGui import QColor, QPainter, QPen

#: In a px: so many that the wave between samples is drawn.
PAPER_DOTS = 16.0
_LINE_PX = 1.0

_paper: ContextVar[bool] = ContextVar("paper", default=False)


@contextmanager
def on_paper() -> Iterator[None]:
    """Draw for a page in this block: nothing has the keyboard, and lines stay lines."""
    token = _paper.set(True)
    try:
        yield
    finally:
        _paper.reset(token)


def is_on_paper() -> bool:
    """Whether a picture is drawn now, not the screen."""
    return _paper.get()


def dots_in_px(painter: QPainter) -> float:
    """How many dots across a px has: pixels of the screen, or dots of a printer."""
    return PAPER_DOTS if is_on_paper() else painter.device().devicePixelRatioF()


def thin_pen(colour: QColor) -> QPen:
    """One pixel of the screen: any wider line takes a hundred times as long.

    On paper nobody would see it: there it is as wide as other lines.
    """
    return QPen(colour, _LINE_PX if is_on_paper() else 0.0)
