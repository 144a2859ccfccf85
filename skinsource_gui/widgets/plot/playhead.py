"""The playhead in a plot over time."""

from math import floor, log10

import pyqtgraph
from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QColor, QPen

from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.plot.view_box import PlotViewBox

_HANDLE_PX = 10.0


class PlayheadLine(pyqtgraph.InfiniteLine):
    """An upright line with a handle at its top, in one row."""

    def __init__(self) -> None:
        super().__init__(angle=90, movable=True)
        # The handle makes the line as wide to catch as it is itself.
        self.addMarker("v", position=1.0, size=_HANDLE_PX)
        self.setZValue(20)
        self.setCursor(Qt.CursorShape.SizeHorCursor)

    def take_colours(self) -> None:
        """Take over the colours in use."""
        theme = current_theme()
        self.setPen(QPen(QColor(theme.error), 0))
        self.setHoverPen(QPen(QColor(theme.accent), 0))

    def let_go(self) -> None:
        """Stay where it is, whatever the mouse does until its button goes up."""
        self.moving = False


class Playhead(QObject):
    """One line in each row of a plot, all at the same time; dragged, it tells where to.

    Attributes
    ----------
    time_s
        Where it is; None: there is none.
    moved
        How often lines were moved.
    """

    #: The time to which it shall go, s.
    wanted = Signal(float)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.time_s: float | None = None
        self.moved = 0
        self._lines: list[PlayheadLine] = []
        # Which line is dragged, and where it was before.
        self._held: tuple[PlayheadLine, float] | None = None

    def watch(self, view: PlotViewBox) -> None:
        """Show it in one more row."""
        line = PlayheadLine()
        line.take_colours()
        line.setVisible(self.time_s is not None)
        if self.time_s is not None:
            line.setPos(QPointF(self.time_s, 0.0))
        line.sigDragged.connect(self._drag)
        line.sigPositionChangeFinished.connect(self._let_go)
        view.addItem(line, ignoreBounds=True)
        self._lines.append(line)

    def take_colours(self) -> None:
        """Take over the colours in use."""
        for line in self._lines:
            line.take_colours()

    def show_at(self, time_s: float) -> None:
        """Put it there, and tell nobody; nothing but the lines is painted again."""
        if time_s == self.time_s:
            return
        appears, self.time_s = self.time_s is None, time_s
        self.moved += 1
        for line in self._lines:
            line.setPos(QPointF(time_s, 0.0))
            if appears:
                line.show()

    def cancel(self) -> bool:
        """Give up a drag; whether there was one."""
        held, self._held = self._held, None
        if held is None:
            return False
        line, before_s = held
        line.let_go()
        self.wanted.emit(before_s)
        return True

    def _drag(self, line: PlayheadLine) -> None:
        if self._held is None:
            self._held = (line, self.time_s or 0.0)
        before_s, self.time_s = self.time_s or 0.0, None
        pixel_s = float(line.getViewBox().viewPixelSize()[0])
        self.wanted.emit(round_time(float(line.value()), pixel_s))
        # The line is under the pointer: it goes where it was told to, or back.
        if self.time_s is None:
            self.show_at(before_s)

    def _let_go(self, line: PlayheadLine) -> None:
        self._held = None


def round_time(time_s: float, pixel_s: float) -> float:
    """A time that is not before 0, with no more digits than a pixel tells apart."""
    if not pixel_s > 0.0:
        return max(time_s, 0.0)
    digits = -floor(log10(pixel_s))
    return max(round(time_s, digits), 0.0)
