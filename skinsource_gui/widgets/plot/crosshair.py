"""What a plot reads, and where."""

from typing import Protocol

from PySide6.QtCore import QObject, Signal

from skinsource_gui.widgets.plot.curves import Curves
from skinsource_gui.widgets.plot.stack import Stack
from skinsource_gui.widgets.plot.value_scale import ValueScale
from skinsource_gui.widgets.plot.x_window import XWindow


class Readable(Protocol):
    """What a crosshair asks of a plot."""

    curves: Curves | None
    x_window: XWindow
    value_scale: ValueScale
    stacked: bool
    stack: Stack


class Crosshair(QObject):
    """Reads each curve of a plot at one of its samples.

    Attributes
    ----------
    index
        Of the sample, or ``None``.
    """

    #: It reads another sample, and is drawn there.
    moved = Signal()

    def __init__(self, plot: Readable, parent: QObject) -> None:
        super().__init__(parent)
        self._plot = plot
        self.index: int | None = None

    @property
    def position(self) -> float | None:
        """Where it is on the x axis; ``None`` where there is none in the visible part."""
        plot = self._plot
        if plot.curves is None or self.index is None:
            return None
        x = float(plot.curves.x[self.index])
        if plot.x_window.axis.log and x <= 0:
            return None
        position = plot.x_window.axis.position(x)
        return position if 0 <= plot.x_window.part(position) <= 1 else None

    def put(self, index: int | None) -> None:
        """Read sample ``index``, or nothing."""
        if index != self.index:
            self.index = index
            self.draw()
            self.moved.emit()

    def follow(self, curves: Curves) -> None:
        """Stay where it is when ``curves`` take the place of those that are shown."""
        if self._plot.curves is not None and self.index is not None:
            self.index = curves.nearest(float(self._plot.curves.x[self.index]))

    def forget(self) -> None:
        """Read nothing: the curves are gone."""
        self.index = None

    def draw(self) -> None:
        """Draw it over what is shown."""
        plot, position = self._plot, self.position
        if plot.curves is None or position is None:
            plot.stack.show_crosshair(None, ())
            return
        n_drawn = plot.curves.n_drawn(len(plot.stack.rows), stacked=plot.stacked)
        heights = plot.value_scale.heights(plot.curves.y[:n_drawn, self.index])
        plot.stack.show_crosshair(position, heights.tolist())
