"""Amplitude spectra of the selected outputs."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from PySide6.QtWidgets import QWidget

from skinsource.base.published import Band
from skinsource.design.design import Design
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.panels.spectra.content import curves_of, notes_of, quantity_of
from skinsource_gui.panels.spectra.settings import AVERAGED, AXES_HINT, RELATIVE, SpectraSettings
from skinsource_gui.signal_panel import SignalPanel
from skinsource_gui.widgets.plot.axis_spec import XAxis
from skinsource_gui.widgets.plot.provenance import NEEDS
from skinsource_gui.widgets.plot.ranges import Range

_LOWEST_HZ = 10.0
# Settings that change the frequency axis alone: curves stay.
_OF_AXIS: dict[str, Any] = {"log_frequency": False, "frequency_range_hz": None}


class SpectraPanel(SignalPanel):
    """One curve of each selected output over frequency, overlaid or stacked."""

    title = "Spectra"
    name = "spectra"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("spectra-plot", "Spectra of the selected outputs", parent)
        self._view, self._settings = View(), SpectraSettings()
        limb = facts_of("")
        self._axis, self._log_axis = _axes(limb.sample_rate_hz, limb.band_hz)
        self._results: Mapping[str, Any] | None = None
        self._plot.toolbar.add_layout("axes", "Axes", AXES_HINT)
        self._log_frequency = self._plot.toolbar.add_switch(
            "log-frequency",
            "Log f",
            f"Logarithmic frequency axis from {_LOWEST_HZ:g} Hz",
            self._choose_log_frequency,
        )
        self._log_frequency.setAccessibleName("Log frequency")
        self._log_magnitude = self._plot.toolbar.add_switch(
            "log-magnitude",
            "dB",
            "Logarithmic magnitude: dB re 1 m/s², the uppermost 80 dB",
            self._choose_log_magnitude,
        )
        self._log_magnitude.setAccessibleName("Log magnitude")
        self._relative = self._plot.toolbar.add_switch(
            "relative", RELATIVE.label, RELATIVE.hint, self._choose_relative
        )
        # Few want it, and seven switches have room on wide screens alone.
        self._averaged = self._plot.add_switch_in_menu(
            "averaged", AVERAGED.label, AVERAGED.hint, self._choose_averaged
        )
        self._plot.toolbar.layout_chosen.connect(self._choose_layout)
        self._plot.zoom_requested.connect(self._zoom)

    @property
    def needs(self) -> frozenset[str]:
        # What the words around the curves say comes with the curves.
        spectra = quantity_of(self._settings, self._view.span)
        return frozenset({spectra, "outputs", "sample_rate_hz"}) | NEEDS

    def show_state(self, design: Design, view: View) -> None:
        settings = settings_of(view, self.name, SpectraSettings)
        before = self._settings
        scaled_anew = replace(settings, **_OF_AXIS) != replace(before, **_OF_AXIS)
        self._view, self._settings = view, settings
        self._log_frequency.setChecked(settings.log_frequency)
        self._log_magnitude.setChecked(settings.log_magnitude)
        self._relative.setChecked(settings.relative)
        self._plot.toolbar.show_passing(self._averaged, settings.averaged)
        self._plot.toolbar.show_state(
            layout=settings.layout, zoomed=settings.frequency_range_hz is not None
        )
        self._show_axis()
        if not view.outputs:
            self._say(self.no_outputs)
        elif self._plot.plot.message == self.no_outputs:
            self._plot.wait_for_curves()
        elif scaled_anew and self._results is not None:
            self._draw(self._results)

    def show_results(self, results: Mapping[str, Any]) -> None:
        if results["outputs"]:
            self._results = dict(results)
            axes = _axes(results["sample_rate_hz"], facts_of(results["limb"]).band_hz)
            if axes != (self._axis, self._log_axis):
                self._axis, self._log_axis = axes
                self._show_axis()
            self._draw(results)
        else:
            self._say(self.no_outputs)

    def show_problem(self, reason: str) -> None:
        self._say(reason)

    def _show_axis(self) -> None:
        settings = self._settings
        axis = self._log_axis if settings.log_frequency else self._axis
        stacked = settings.layout != "overlaid"
        axis = _as_seen(axis, settings.frequency_range_hz)
        self._plot.set_view(axis, settings.frequency_range_hz, stacked=stacked)

    def _say(self, message: str) -> None:
        self._results = None
        self._plot.show_message(message)

    def _draw(self, results: Mapping[str, Any]) -> None:
        settings = self._settings
        if quantity_of(settings, results["span"]) not in results:
            # Of another layout: what it takes is on its way.
            return
        self._plot.show_curves(
            curves_of(results, settings),
            synthetic=facts_of(results["limb"]).synthetic,
            notes=notes_of(results, settings),
        )

    def _choose_layout(self, layout: str) -> None:
        self._change(layout=layout)

    def _choose_log_frequency(self, log: bool) -> None:
        self._change(log_frequency=log)

    def _choose_log_magnitude(self, log: bool) -> None:
        self._change(log_magnitude=log)

    def _choose_relative(self, relative: bool) -> None:
        self._change(relative=relative)

    def _choose_averaged(self, averaged: bool) -> None:
        self._change(averaged=averaged)

    def _zoom(self, shown: tuple[float, float] | None) -> None:
        self._change(frequency_range_hz=shown)

    def _change(self, **changes: Any) -> None:
        settings = replace(self._settings, **changes)
        if settings != self._settings:
            self.view_changed.emit(with_settings(self._view, self.name, settings))


@cache
def _axes(sample_rate_hz: float, band: Band | None) -> tuple[XAxis, XAxis]:
    """The linear and the logarithmic axis of a limb of this rate and band; None: not known."""
    highest_hz = sample_rate_hz / 2
    titles: tuple[str, ...] = ("Frequency (Hz)",)
    if band is not None:
        words = f"{band[0]:g} to {band[1]:g} Hz"
        titles = (
            f"Frequency (Hz) · measured band {words}, shaded outside",
            f"Frequency (Hz) · band {words}",
            *titles,
        )
    linear = XAxis(
        titles=titles, unit="Hz", column="frequency_hz", extent=(0.0, highest_hz), band=band
    )
    return linear, replace(linear, extent=(_LOWEST_HZ, highest_hz), log=True)


def _as_seen(axis: XAxis, zoom: Range | None) -> XAxis:
    """The axis, without words on what is shaded where nothing that is in view is."""
    seen = zoom or axis.extent
    if axis.band is None or seen is None:
        return axis
    shaded = seen[0] < axis.band[0] or seen[1] > axis.band[1]
    return axis if shaded else replace(axis, titles=axis.titles[1:])
