"""Curves of an actuator, which no design has a view on."""

from PySide6 import QtWidgets

from skinsource_gui.plots.curves import Curves
from skinsource_gui.plots.ranges import XAxis
from skinsource_gui.plots.signal_view import SignalView


class ResponseView(SignalView):
    """Plots curves, and keeps zoom and layout itself."""

    def __init__(self, name: str, title: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(name, title, parent)
        self._axis: XAxis | None = None
        self._zoom: tuple[float, float] | None = None
        self._layout = "overlaid"
        self.zoom_requested.connect(self._show_part)
        self.toolbar.layout_chosen.connect(self._lay_curves)
        self._show_view()

    def show_over(self, axis: XAxis, curves: Curves) -> None:
        """Plot curves over an axis; all of another axis is shown."""
        if axis != self._axis:
            self._axis, self._zoom = axis, None
        self._show_view()
        self.show_curves(curves, synthetic=False)

    def _show_part(self, zoom: tuple[float, float] | None) -> None:
        self._zoom = zoom
        self._show_view()

    def _lay_curves(self, layout: str) -> None:
        self._layout = layout
        self._show_view()

    def _show_view(self) -> None:
        self.toolbar.show_state(layout=self._layout, zoomed=self._zoom is not None)
        if self._axis is not None:
            self.set_view(self._axis, self._zoom, stacked=self._layout == "stacked")
