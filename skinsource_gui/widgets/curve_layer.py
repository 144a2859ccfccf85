"""The graphics items of curves."""

import pyqtgraph as pg
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPen

from skinsource_gui.theme import LIGHT, Theme
from skinsource_gui.widgets.curves import Curves
from skinsource_gui.widgets.decimation import visible_points
from skinsource_gui.widgets.plot_rows import Rows
from skinsource_gui.widgets.x_window import XWindow

_STALE_OPACITY = 0.5


class CurveLayer:
    """One item for each curve, kept alive while data change."""

    def __init__(self, view: pg.GraphicsView) -> None:
        self._box = pg.ViewBox(enableMenu=False, enableMouse=False, defaultPadding=0)
        self._box.disableAutoRange()
        view.addItem(self._box)
        self._theme = LIGHT
        self.items: list[pg.PlotCurveItem] = []

    def set_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        for rank, item in enumerate(self.items):
            item.setPen(_pen(theme, rank))

    def set_stale(self, stale: bool) -> None:
        """Dim the curves, or not."""
        self._box.setOpacity(_STALE_OPACITY if stale else 1.0)

    def place(self, area: QRectF, window: XWindow, rows: Rows) -> None:
        """Say where the curves are, in px, and what part of them is seen."""
        self._box.setGeometry(area)
        self._box.setRange(xRange=window.shown, yRange=rows.span, padding=0)

    def draw(
        self, curves: Curves, window: XWindow, rows: Rows, width_px: int, *, stacked: bool
    ) -> None:
        """Draw ``curves``; more of them than there are rows in a stack are left out."""
        self._hold(len(curves.names))
        seen = drawn_curves(curves, rows, stacked=stacked)
        x, y = window.axis.positions(curves.x), curves.y
        if window.axis.log:
            x, y = x[curves.x > 0], y[:, curves.x > 0]
        x, y = visible_points(x, y, window.shown, width_px)
        for rank, item in enumerate(self.items):
            item.setVisible(rank < seen)
            if rank < seen:
                item.setData(x, rows.heights(y[rank], rank if stacked else 0))

    def hide(self) -> None:
        """Draw nothing."""
        for item in self.items:
            item.setVisible(False)

    def _hold(self, count: int) -> None:
        while len(self.items) < count:
            pen = _pen(self._theme, len(self.items))
            item = pg.PlotCurveItem(pen=pen, skipFiniteCheck=True, antialias=True)
            self._box.addItem(item, ignoreBounds=True)
            self.items.append(item)
        while len(self.items) > count:
            self._box.removeItem(self.items.pop())


def drawn_curves(curves: Curves, rows: Rows, *, stacked: bool) -> int:
    """How many of ``curves`` are drawn."""
    return rows.count if stacked else len(curves.names)


def _pen(theme: Theme, rank: int) -> QPen:
    pen = QPen(theme.output_colour(rank), 1)
    pen.setCosmetic(True)
    return pen
