"""One row of a plot: a view with curves and crosshair, the axis on its left, its number."""

from collections.abc import Sequence

import pyqtgraph
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QFont, QPen

from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.plot.axis import Axis
from skinsource_gui.widgets.plot.curve import SignalCurve
from skinsource_gui.widgets.plot.curve_points import CurvePoints
from skinsource_gui.widgets.plot.plot_layout import PlotLayout
from skinsource_gui.widgets.plot.plot_words import RowNumber
from skinsource_gui.widgets.plot.ranges import Range
from skinsource_gui.widgets.plot.ticks import Tick
from skinsource_gui.widgets.plot.view_box import PlotViewBox

_DOT_PX = 5.0


class PlotRow:
    """A view box of the height 0 to 1, and what belongs to it.

    Attributes
    ----------
    view, axis, number
        Items of the scene.
    curves
        Items of the view; the first ``n_curves`` are in use.
    n_curves
        How many curves are drawn.
    line, dots
        The crosshair: where it reads, and what on each curve.
    """

    def __init__(self, scene: pyqtgraph.GraphicsScene) -> None:
        self.view = PlotViewBox()
        self.axis = Axis("left", self._ticks)
        self.number = RowNumber()
        for item in (self.view, self.axis, self.number):
            scene.addItem(item)
        self.axis.set_views(self.view)
        self.curves: list[SignalCurve] = []
        self.n_curves = 0
        self.line = pyqtgraph.InfiniteLine(angle=90, movable=False)
        self.dots = pyqtgraph.ScatterPlotItem(size=_DOT_PX + 1, antialias=True)
        for rank, item in enumerate((self.line, self.dots)):
            item.setZValue(10 + rank)
            item.hide()
            self.view.addItem(item, ignoreBounds=True)
        self._y_ticks: tuple[Tick, ...] = ()
        self._shown: Range | None = None

    def place(self, layout: PlotLayout, rank: int) -> None:
        """Move everything to where ``layout`` has row ``rank``."""
        room = layout.row(rank)
        self.view.setGeometry(room)
        self.axis.setWidth(room.left())
        self.axis.setGeometry(QRectF(0, room.top(), room.left(), room.height()))
        number = QRectF(room.right(), room.top(), layout.width - room.right(), room.height())
        self.number.setGeometry(number)
        if layout.y_ticks != self._y_ticks:
            self._y_ticks = layout.y_ticks
            self.axis.refresh()

    def set_visible(self, visible: bool) -> None:
        """Whether this row is in use."""
        for item in (self.view, self.axis, self.number):
            item.setVisible(visible)

    def show_font(self, font: QFont) -> None:
        """Take over a font, and the colours in use."""
        theme = current_theme()
        self.axis.show_font(font)
        self.line.setPen(QPen(QColor(theme.dim), 0))
        self.dots.setPen(pyqtgraph.mkPen(QColor(theme.base), width=1))

    def show_range(self, shown: Range) -> None:
        """Show this part of the x axis."""
        if shown != self._shown:
            self._shown = shown
            self.view.setXRange(*shown, padding=0)

    def show_points(self, points: Sequence[CurvePoints]) -> None:
        """Draw one curve for each of ``points``."""
        while len(self.curves) < len(points):
            curve = SignalCurve()
            self.curves.append(curve)
            self.view.addItem(curve, ignoreBounds=True)
        for curve, of_curve in zip(self.curves, points, strict=False):
            curve.show_points(of_curve)
        if self.n_curves != len(points):
            self.n_curves = len(points)
            for rank, curve in enumerate(self.curves):
                curve.setVisible(rank < self.n_curves)

    def show_pens(self, pens: Sequence[QPen], *, stale: bool) -> None:
        """Give each curve its pen; pale where it is stale."""
        for curve, pen in zip(self.curves, pens, strict=False):
            curve.set_look(pen, stale=stale)

    def show_crosshair(
        self, position: float | None, heights: Sequence[float], colours: Sequence[QColor]
    ) -> None:
        """Read the curves at ``position``, or nowhere."""
        seen = position is not None
        self.line.setVisible(seen)
        self.dots.setVisible(seen)
        if position is not None:
            self.line.setPos(QPointF(position, 0.0))
            self.dots.setData(x=[position] * len(heights), y=heights, brush=colours)

    def _ticks(self, low: float, high: float, length_px: float) -> tuple[Tick, ...]:
        return self._y_ticks
