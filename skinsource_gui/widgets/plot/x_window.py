"""Which part of the x axis is visible."""

from dataclasses import dataclass

from skinsource_gui.widgets.plot.axis_spec import XAxis
from skinsource_gui.widgets.plot.ranges import Range


@dataclass(frozen=True, slots=True, kw_only=True)
class XWindow:
    """Visible part of an x axis.

    Attributes
    ----------
    axis
        The axis.
    extent, shown
        All of it, and the visible part, as positions (see `XAxis.position`).
    """

    axis: XAxis
    extent: Range
    shown: Range

    @property
    def holds_data(self) -> bool:
        """Whether some of it is visible."""
        return self.shown[0] < self.extent[1] and self.extent[0] < self.shown[1]

    @property
    def band(self) -> Range | None:
        """Positions of the ends of the axis's band."""
        band = self.axis.band
        return None if band is None else (self.axis.position(band[0]), self.axis.position(band[1]))

    def part(self, position: float) -> float:
        """Where ``position`` lies: 0 at the left edge of the visible part, 1 at the right."""
        low, high = self.shown
        return (position - low) / (high - low)

    def position(self, part: float) -> float:
        """Position at a part of the visible width."""
        low, high = self.shown
        return low + part * (high - low)

    def values(self, shown: Range) -> Range:
        """A range of positions, in SI."""
        return (self.axis.value(shown[0]), self.axis.value(shown[1]))


def x_window(axis: XAxis, data: Range, zoom: Range | None) -> XWindow:
    """Window on data from ``data[0]`` to ``data[1]``; ``zoom`` in SI, ``None``: everything."""
    extent = _positions(axis, axis.extent if axis.extent is not None else data)
    if zoom is None or (axis.log and zoom[1] <= axis.value(extent[0])):
        return XWindow(axis=axis, extent=extent, shown=extent)
    if axis.log:
        zoom = (max(zoom[0], axis.value(extent[0])), zoom[1])
    return XWindow(axis=axis, extent=extent, shown=_positions(axis, zoom))


def _positions(axis: XAxis, values: Range) -> Range:
    low, high = axis.position(values[0]), axis.position(values[1])
    return (low, high) if high > low else (low, low + 1.0)
