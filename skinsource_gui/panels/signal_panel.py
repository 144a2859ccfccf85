"""The base of panels that show signals of the selected outputs."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from PySide6 import QtGui, QtWidgets

from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.specs.spec import SwitchSpec
from skinsource_gui.plots.curves import Curves
from skinsource_gui.plots.signal_view import SignalView, draw_signals
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.theme import LIGHT, Theme
from skinsource_gui.state.panel import OutputsPanel

_NOISY = (f"pale: less than {LEAST_ABOVE_NOISE_DB:g} dB above the noise", "pale: near the noise")


class SignalPanel(OutputsPanel):
    """A panel that is filled by one `SignalView`.

    Parameters
    ----------
    plot_name, accessible_name
        `objectName` of the plot; what it shows, for those who do not see it.
    """

    def __init__(self, plot_name: str, accessible_name: str) -> None:
        super().__init__()
        self._plot = SignalView(plot_name, accessible_name, self, self._staleness)
        self.setFocusProxy(self._plot.plot)
        in_column(self._plot, of=self, margins=0)
        self._plot.cursors_requested.connect(lambda at: self.change_settings(cursors=at))
        self._plot.exports.failed.connect(self.failed)
        self._plot.exports.written.connect(self.written)
        self._plot.save_picture = self.save_picture
        self._plot.toolbar.layout_chosen.connect(lambda layout: self.change_settings(layout=layout))
        self._noisy: tuple[int, ...] = ()
        self._switches: dict[str, QtWidgets.QToolButton] = {}

    def add_switch(
        self, name: str, spec: SwitchSpec, *, text: str = "", hint: str = "", in_menu: bool = False
    ) -> None:
        """Let the user switch a setting in the toolbar, or in the menu of the plot."""
        add = self._plot.add_switch_in_menu if in_menu else self._plot.toolbar.add_switch
        switch = add(
            name.replace("_", "-"),
            text or spec.label,
            hint or spec.hint,
            lambda on: self.change_settings(**{name: on}),
        )
        switch.setAccessibleName(spec.label)
        self._switches[name] = switch

    def show_settings(self, settings: Any, *, zoomed: bool) -> None:
        """Show settings in the toolbar, cursors, and whether the plot is zoomed."""
        self._plot.show_cursors(settings.cursors)
        for name, switch in self._switches.items():
            self._plot.show_switch(switch, getattr(settings, name))
        self._plot.toolbar.show_state(layout=settings.layout, zoomed=zoomed)

    def show_noisy(self, outputs: tuple[int, ...]) -> None:
        """Draw outputs pale that are mostly noise."""
        if outputs != self._noisy:
            self._noisy = outputs
            if self._results is not None:
                stale = self.is_stale
                self._draw(self._results)
                self._staleness.set_stale(stale, at_once=True)

    def _show_curves(self, curves: Curves, limb: str, notes: tuple[str, ...]) -> None:
        """Show curves of a limb with notes on them, or on the noise."""
        noise: tuple[str, ...] = ()
        if any(name.number in self._noisy for name in curves.names):
            names = (replace(name, noisy=name.number in self._noisy) for name in curves.names)
            curves, noise = replace(curves, names=tuple(names)), _NOISY
        self._plot.show_curves(curves, synthetic=facts_of(limb).synthetic, notes=notes or noise)

    def _draw(self, results: Mapping[str, Any]) -> None:
        """Draw the results."""

    @property
    def message(self) -> str:
        return self._plot.plot.message

    def say_instead(self, message: str) -> None:
        self._results = None
        self._plot.plot.show_message(message)

    def await_results(self) -> None:
        self._plot.wait_for_curves()

    def reset_range(self) -> None:
        self._plot.plot.reset_range()

    def show_folder(self, folder: Path) -> None:
        self._plot.exports.folder = folder

    def draw_picture(
        self, painter: QtGui.QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        draw_signals(painter, width, height, plot=self._plot.plot, theme=theme)
