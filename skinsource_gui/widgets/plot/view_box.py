"""pyqtgraph's view box with the gestures of our plots."""

from typing import Any

import pyqtgraph
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QPainter, QPainterPath

from skinsource_gui.widgets.wheel import NOTCH, PAN_PER_NOTCH, ZOOM_PER_NOTCH

_SHIFT = Qt.KeyboardModifier.ShiftModifier


class PlotViewBox(pyqtgraph.ViewBox):
    """A view that asks for another range instead of taking it.

    Several views and panels show the same range, so it is decided in one place.  Wheel: zoom at
    the pointer; Shift+wheel, wheel to the side, middle button, Shift+left button: pan; left
    button: zoom to what is covered.  Positions are those of the x axis.
    """

    #: Position that stays, and how many times narrower.
    zoom_wanted = Signal(float, float)
    #: By how much the range is to move.
    pan_wanted = Signal(float)
    #: Position where the button went down, position of the pointer, whether it went up again.
    covered = Signal(float, float, bool)

    def __init__(self) -> None:
        super().__init__(enableMenu=False, defaultPadding=0.0)
        # Ranges are decided once for each update.
        self.disableAutoRange()
        self.setYRange(0.0, 1.0, padding=0)

    def position(self, scene_at: QPointF) -> float:
        """Position at a point of the scene."""
        return float(self.mapSceneToView(scene_at).x())

    def shape(self) -> QPainterPath:
        # Lines on the lower and the right edge lie half beyond it.
        path = QPainterPath()
        path.addRect(QRectF(self.rect()).adjusted(0, 0, 1, 1))
        return path

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        """Paint nothing: the axis beside draws the frame."""

    def wheelEvent(self, event: Any, axis: int | None = None) -> None:
        turns = event.delta() / NOTCH
        aside = event.orientation() == Qt.Orientation.Horizontal
        if aside or event.modifiers() & _SHIFT:
            low, high = self.viewRange()[0]
            self.pan_wanted.emit(-turns * PAN_PER_NOTCH * (high - low))
        else:
            self.zoom_wanted.emit(self.position(event.scenePos()), ZOOM_PER_NOTCH**turns)
        event.accept()

    def mouseDragEvent(self, event: Any, axis: int | None = None) -> None:
        now = self.position(event.scenePos())
        button = event.button()
        pans = event.modifiers() & _SHIFT or button == Qt.MouseButton.MiddleButton
        if button == Qt.MouseButton.RightButton:
            event.ignore()
            return
        event.accept()
        if pans:
            self.pan_wanted.emit(self.position(event.lastScenePos()) - now)
        else:
            down = self.position(event.buttonDownScenePos(button))
            self.covered.emit(down, now, event.isFinish())
