"""A widget that can be drawn for a page or a slide."""

from collections.abc import Iterator
from contextlib import contextmanager

from PySide6.QtCore import QPoint, QRectF
from PySide6.QtGui import QColor, QPainter, QRegion
from PySide6.QtWidgets import QGraphicsItem, QGraphicsView, QWidget

from skinsource_gui.theme import LIGHT, Theme
from skinsource_gui.widgets.paper import on_paper


class Pictured(QWidget):
    """Draws itself as it is, unless it knows better."""

    def draw_picture(
        self, painter: QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw what it shows for a page or a slide; size in px.

        Unless it knows better that is in the colours in use: whoever wants others sees to it that
        these are in use.
        """
        scale = min(width / max(self.width(), 1), height / max(self.height(), 1))
        painter.save()
        painter.fillRect(QRectF(0, 0, width, height), QColor(theme.base))
        painter.translate((width - scale * self.width()) / 2, 0.0)
        painter.scale(scale, scale)
        flags = QWidget.RenderFlag.DrawWindowBackground | QWidget.RenderFlag.DrawChildren
        with on_paper(), _as_lines(self):
            self.render(painter, QPoint(), QRegion(), flags)
        painter.restore()


@contextmanager
def _as_lines(widget: QWidget) -> Iterator[None]:
    """Have scenes drawn as lines and letters, not as the pictures that are kept of them."""
    views = widget.findChildren(QGraphicsView)
    grounds = {view: view.cacheMode() for view in views}
    kept = {
        item: item.cacheMode()
        for view in views
        for item in view.scene().items()
        if item.cacheMode() != QGraphicsItem.CacheMode.NoCache
    }
    for view in views:
        view.setCacheMode(QGraphicsView.CacheModeFlag.CacheNone)
    for item in kept:
        item.setCacheMode(QGraphicsItem.CacheMode.NoCache)
    try:
        yield
    finally:
        for view, ground in grounds.items():
            view.setCacheMode(ground)
        for item, mode in kept.items():
            item.setCacheMode(mode)
