"""Zoom, pan and crosshair by mouse and keys."""

from typing import Protocol

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from skinsource_gui.widgets.keys import meaning_of
from skinsource_gui.widgets.plot.crosshair import Crosshair
from skinsource_gui.widgets.plot.curves import Curves
from skinsource_gui.widgets.plot.plot_layout import PlotLayout
from skinsource_gui.widgets.plot.ranges import Range, within, zoomed
from skinsource_gui.widgets.plot.view_box import PlotViewBox
from skinsource_gui.widgets.plot.x_window import XWindow

_KEY_ZOOM = 1.5
_LEAP = 10
# No closer than so many samples.
_FEWEST_SAMPLES = 4
_STEPS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}
_ZOOMS = {"zoom_in": _KEY_ZOOM, "zoom_out": 1 / _KEY_ZOOM}


class Navigable(Protocol):
    """What navigation asks of a plot."""

    curves: Curves | None
    x_window: XWindow
    places: PlotLayout
    crosshair: Crosshair

    def show_band(self, covered: Range | None) -> None:
        """Show what a drag covers, positions, or nothing."""


class Navigation(QObject):
    """Turns gestures and keys into a crosshair, and into requests for a part of the x axis.

    Wheel: zoom at the pointer.  Drag: zoom to what is covered.  Middle button or Shift: pan.
    Double click: everything.  Keys: as the table of keys says.
    """

    #: Part of the x axis the user wants to see, SI; None: everything.
    zoom_requested = Signal(object)

    def __init__(self, plot: Navigable, parent: QObject) -> None:
        super().__init__(parent)
        self._plot = plot
        self._pinned = False
        # Where the pointer rests on the plot, px.
        self._pointer: QPointF | None = None
        self._covering = False
        self._given_up = False

    def watch(self, view: PlotViewBox) -> None:
        """Follow the gestures on ``view``."""
        view.zoom_wanted.connect(self._zoom)
        view.pan_wanted.connect(self._pan)
        view.covered.connect(self._cover)

    def show_everything(self) -> None:
        """Ask for the whole x axis."""
        self.zoom_requested.emit(None)

    def follow_mouse(self, at: QPointF) -> None:
        """Read what is under the pointer."""
        plot = self._plot
        if plot.curves is None:
            return
        self._pinned, self._pointer = False, at
        if not plot.places.area.contains(at):
            plot.crosshair.put(None)
            return
        part = (at.x() - plot.places.left) / plot.places.area.width()
        plot.crosshair.put(
            plot.curves.nearest(plot.x_window.axis.value(plot.x_window.position(part)))
        )

    def follow_view(self) -> None:
        """Read what is under a pointer that rests: another part of the x axis is seen."""
        if self._pointer is not None and not self._pinned:
            self.follow_mouse(self._pointer)

    def leave(self) -> None:
        """Read nothing, unless keys put the crosshair where it is."""
        self._pointer = None
        if not self._pinned:
            self._plot.crosshair.put(None)

    def bring(self, value: float) -> None:
        """Ask for a part of the x axis in which a value is."""
        position, (low, high) = self._plot.x_window.axis.position(value), self._plot.x_window.shown
        self._pan(min(position - low, 0.0) + max(position - high, 0.0))

    def press(self, event: QKeyEvent) -> None:
        """Do what a key means, or leave it to others."""
        plot, key, wanted = self._plot, Qt.Key(event.key()), meaning_of("plot", event)
        if plot.curves is None or not wanted:
            event.ignore()
        elif wanted == "give_up":
            self._escape(event)
        elif wanted == "whole":
            self.show_everything()
        elif wanted in _ZOOMS:
            anchor = plot.crosshair.position
            # Keys zoom at the crosshair if it is in sight.
            self._zoom(sum(plot.x_window.shown) / 2 if anchor is None else anchor, _ZOOMS[wanted])
        elif wanted == "step":
            leap = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            self._step(plot.curves, _STEPS[key] * (_LEAP if leap else 1))
        else:
            self._pin(plot.curves, 0 if key == Qt.Key.Key_Home else plot.curves.x.size - 1)

    def _zoom(self, anchor: float, factor: float) -> None:
        self._request(zoomed(self._plot.x_window.shown, anchor, factor))

    def _pan(self, moved: float) -> None:
        if moved:
            low, high = self._plot.x_window.shown
            self._request((low + moved, high + moved))

    def _cover(self, start: float, end: float, finished: bool) -> None:
        if self._plot.curves is None:
            return
        low, high = self._plot.x_window.shown
        ends = sorted(min(max(place, low), high) for place in (start, end))
        covered = (ends[0], ends[1])
        self._covering = not (finished or self._given_up)
        self._plot.show_band(covered if self._covering else None)
        if finished and not self._given_up and covered[0] < covered[1]:
            self._request(covered)
        self._given_up = self._given_up and not finished

    def _request(self, shown: Range) -> None:
        plot = self._plot
        if plot.curves is None:
            return
        extent, n_points = plot.x_window.extent, plot.curves.x.size
        shortest = (extent[1] - extent[0]) * min(_FEWEST_SAMPLES / n_points, 1.0)
        part = within(shown, extent, shortest)
        self.zoom_requested.emit(None if part is None else plot.x_window.values(part))

    def _step(self, curves: Curves, samples: int) -> None:
        window, cursor = self._plot.x_window, self._plot.crosshair.index
        if cursor is None:
            self._pin(curves, curves.nearest(window.axis.value(sum(window.shown) / 2)))
        else:
            self._pin(curves, min(max(cursor + samples, 0), curves.x.size - 1))

    def _pin(self, curves: Curves, index: int) -> None:
        # The crosshair stays until Esc, and pulls the visible part with it.
        window = self._plot.x_window
        if window.axis.log:
            index = max(index, curves.nearest(window.axis.value(window.extent[0])))
        self._pinned = True
        self._plot.crosshair.put(index)
        self.bring(float(curves.x[index]))

    def _escape(self, event: QKeyEvent) -> None:
        if self._covering:
            self._covering, self._given_up = False, True
            self._plot.show_band(None)
        elif self._plot.crosshair.index is not None:
            self._pinned, self._pointer = False, None
            self._plot.crosshair.put(None)
        else:
            event.ignore()
