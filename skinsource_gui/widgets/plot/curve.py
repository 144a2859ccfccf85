"""One signal in a plot."""

from typing import Any

import pyqtgraph
from pyqtgraph.functions import arrayToQPolygonF
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPen, QPolygonF

from skinsource_gui.widgets.plot.curve_points import CurvePoints

_STALE_OPACITY = 0.5


class SignalCurve(pyqtgraph.PlotCurveItem):
    """pyqtgraph's curve for points that were already thinned out to what can be seen.

    It takes part in no automatic range and is as large as its view, so that new data measure
    nothing.
    """

    def __init__(self) -> None:
        super().__init__(skipFiniteCheck=True)
        self._line: QPolygonF | None = None

    def show_points(self, points: CurvePoints) -> None:
        """Draw ``points``."""
        self._line = arrayToQPolygonF(points.x, points.y) if points.smooth else None
        self.setData(points.x, points.y, antialias=points.smooth)

    def set_look(self, pen: QPen, *, stale: bool) -> None:
        """Colour and strokes of the curve; whether it is pale."""
        self.setPen(pen)
        self.setOpacity(_STALE_OPACITY if stale else 1.0)

    def boundingRect(self) -> QRectF:
        view = self.getViewBox()
        return QRectF() if view is None else view.viewRect()

    def viewTransformChanged(self) -> None:
        # The bounds are those of the view.
        self.prepareGeometryChange()

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        if self._line is None:
            # As a path: Qt leaves gaps in a polyline of upright strokes.
            super().paint(painter, option, widget)
            return
        # A tenth quicker than a path.
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(self.opts["pen"])
        painter.drawPolyline(self._line)
