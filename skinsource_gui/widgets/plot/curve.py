"""One signal in a plot."""

from typing import Any

import pyqtgraph
from pyqtgraph.functions import arrayToQPath, arrayToQPolygonF
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPainterPath, QPen, QPolygonF

from skinsource_gui.widgets.plot.curve_points import CurvePoints

_STALE_OPACITY = 0.5


class SignalCurve(pyqtgraph.GraphicsObject):
    """A curve of points that were already thinned out to what can be seen.

    It is as large as its view and takes part in no range, so that new data measure nothing, and
    leaves the mouse to the view.  (pyqtgraph's own curve measures, asks and tells at each change:
    of a dozen curves, half a millisecond.)

    Attributes
    ----------
    points
        What is drawn, or None.
    pen
        Colour and strokes.
    """

    def __init__(self) -> None:
        super().__init__()
        self.points: CurvePoints | None = None
        self.pen = QPen()
        self._line: QPolygonF | None = None
        self._path: QPainterPath | None = None

    def show_points(self, points: CurvePoints) -> None:
        """Draw ``points``."""
        self.points = points
        if points.smooth:
            # A tenth quicker than a path.
            self._line, self._path = arrayToQPolygonF(points.x, points.y), None
        else:
            # As a path: Qt leaves gaps in a polyline of upright strokes.
            self._line = None
            self._path = arrayToQPath(points.x, points.y, finiteCheck=False)
        self.update()

    def set_look(self, pen: QPen, *, stale: bool) -> None:
        """Colour and strokes of the curve; whether it is pale."""
        self.pen = pen
        self.setOpacity(_STALE_OPACITY if stale else 1.0)
        self.update()

    def boundingRect(self) -> QRectF:
        view = self.getViewBox()
        return QRectF() if view is None else view.viewRect()

    def shape(self) -> QPainterPath:
        return QPainterPath()

    def viewTransformChanged(self) -> None:
        # The bounds are those of the view.
        self.prepareGeometryChange()

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        painter.setPen(self.pen)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, self._line is not None)
        if self._line is not None:
            painter.drawPolyline(self._line)
        elif self._path is not None:
            painter.drawPath(self._path)
