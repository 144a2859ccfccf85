"""One signal in a plot."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pyqtgraph
from pyqtgraph.functions import arrayToQPath, arrayToQPolygonF
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QPainterPath, QPen, QPolygonF, QTransform

from skinsource_gui.widgets.paper import is_on_paper
from skinsource_gui.widgets.plot.curve_points import CurvePoints

_STALE_OPACITY = 0.5
_DOT_PX = 2.0
_PAPER_LINE_PX = 1.0


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
    dots
        Points of it that are marked, or None.
    """

    def __init__(self) -> None:
        super().__init__()
        self.points: CurvePoints | None = None
        self.pen = QPen()
        self.dots: QPolygonF | None = None
        self._line: QPolygonF | None = None
        self._path: QPainterPath | None = None

    def show_points(self, points: CurvePoints) -> None:
        """Draw ``points``."""
        self.points = points
        self.dots = None if points.dots is None else arrayToQPolygonF(*points.dots)
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
        if is_on_paper():
            with self._in_scene(painter) as to_scene:
                self._paint_wide(painter, to_scene)
        else:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, self._line is not None)
            if self._line is not None:
                painter.drawPolyline(self._line)
            elif self._path is not None:
                painter.drawPath(self._path)
        if self.dots is not None:
            with self._in_scene(painter) as to_scene:
                self._paint_dots(painter, to_scene.map(self.dots))

    @contextmanager
    def _in_scene(self, painter: QPainter) -> Iterator[QTransform]:
        """Paint where 1 is a pixel both ways: in the stretched view, dots would be strokes."""
        to_scene = self.sceneTransform()
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setWorldTransform(to_scene.inverted()[0] * painter.worldTransform())
        yield to_scene
        painter.restore()

    def _paint_wide(self, painter: QPainter, to_scene: QTransform) -> None:
        pen = QPen(self.pen)
        pen.setWidthF(_PAPER_LINE_PX)
        painter.setPen(pen)
        if self._line is not None:
            painter.drawPolyline(to_scene.map(self._line))
        elif self._path is not None:
            painter.drawPath(to_scene.map(self._path))

    def _paint_dots(self, painter: QPainter, dots: QPolygonF) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self.pen.color())
        for dot in dots.toList():
            painter.drawEllipse(dot, _DOT_PX, _DOT_PX)
