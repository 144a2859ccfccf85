"""The plot of what was measured."""

from PySide6.QtWidgets import QWidget

from skinsource.actuators.rigs import RigChannel
from skinsource.lab.rig_measuring import ChannelMeasurement
from skinsource_gui.rig_page.measured_curves import axis_of, measured_curves
from skinsource_gui.widgets.plot.signal_view import SignalView

_NOTHING = "Nothing is measured yet"


class MeasuredView(SignalView):
    """Gain over frequency: what was measured, what the model says, and what there was before."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("measured-plot", "Measured response", parent)
        self._found: ChannelMeasurement | None = None
        self._zoom: tuple[float, float] | None = None
        self._layout = "overlaid"
        self.zoom_requested.connect(self._show_part)
        self.toolbar.layout_chosen.connect(self._lay_curves)
        self.show_measured(None, None)

    def show_measured(
        self, found: ChannelMeasurement | None, channel: RigChannel | None, words: str = _NOTHING
    ) -> None:
        """Draw what was found of a channel; None: say why there is nothing."""
        self._found, self._zoom = found, None
        self._show_view()
        if found is None or channel is None:
            self.show_message(words)
        else:
            self.show_curves(measured_curves(found, channel), synthetic=False)

    def _show_part(self, zoom: tuple[float, float] | None) -> None:
        self._zoom = zoom
        self._show_view()

    def _lay_curves(self, layout: str) -> None:
        self._layout = layout
        self._show_view()

    def _show_view(self) -> None:
        self.toolbar.show_state(layout=self._layout, zoomed=self._zoom is not None)
        if self._found is not None:
            self.set_view(axis_of(self._found), self._zoom, stacked=self._layout == "stacked")
