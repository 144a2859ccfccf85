"""Amplitude spectra of the selected outputs."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from PySide6.QtWidgets import QWidget

from skinsource.decibels import decibels
from skinsource.design import Design
from skinsource.limb import Band
from skinsource.loudest_window import HOLD_WINDOW_S, LOUDEST_WINDOW_S
from skinsource.own_limbs import facts_of
from skinsource.panel_settings import settings_of, with_settings
from skinsource.view import View
from skinsource_gui.panels.spectra.settings import SpectraSettings
from skinsource_gui.signal_panel import SignalPanel
from skinsource_gui.widgets.plot.axis_spec import XAxis
from skinsource_gui.widgets.plot.curves import Curves, output_names
from skinsource_gui.widgets.plot.provenance import NEEDS, heading_of, lines_later

_LOWEST_HZ = 10.0
_HOLD, _LOUDEST = (f"{one * 1e3:.0f} ms" for one in (HOLD_WINDOW_S, LOUDEST_WINDOW_S))
# What the height of a curve means, longest first.
_SCALINGS = {
    "record": ("amplitude over the whole record", "over the whole record", "whole record"),
    "loudest": (
        # Levels say another time, and nobody would guess why.
        f"amplitude in the loudest {_HOLD} of each frequency, which tell "
        f"{1 / HOLD_WINDOW_S:.0f} Hz apart; the {_LOUDEST} of levels would tell "
        f"{1 / LOUDEST_WINDOW_S:.0f} Hz",
        f"amplitude in the loudest {_HOLD} of each frequency",
        f"loudest {_HOLD}",
        "loudest",
    ),
}
_QUANTITIES = {"record": "selected_spectra", "loudest": "selected_peak_spectra"}
_RECTIFIED = (
    "spectrum of a magnitude: rectified, shows doubled frequencies",
    "of a magnitude: rectified, doubled frequencies",
    "rectified: doubled frequencies",
    "rectified",
)


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
        self._log_frequency = self._plot.toolbar.add_switch(
            "log-frequency",
            "Log frequency",
            f"Logarithmic frequency axis from {_LOWEST_HZ:g} Hz",
            self._choose_log_frequency,
        )
        self._log_magnitude = self._plot.toolbar.add_switch(
            "log-magnitude",
            "dB",
            "Logarithmic magnitude: dB re 1 m/s², the uppermost 80 dB",
            self._choose_log_magnitude,
        )
        self._log_magnitude.setAccessibleName("Log magnitude")
        self._plot.toolbar.layout_chosen.connect(self._choose_layout)
        self._plot.zoom_requested.connect(self._zoom)

    @property
    def needs(self) -> frozenset[str]:
        # What the words around the curves say comes with the curves.
        spectra = _QUANTITIES[self._view.span]
        return frozenset({spectra, "outputs", "sample_rate_hz"}) | NEEDS

    def show_state(self, design: Design, view: View) -> None:
        settings = settings_of(view, self.name, SpectraSettings)
        level_changed = settings.log_magnitude != self._settings.log_magnitude
        self._view, self._settings = view, settings
        self._log_frequency.setChecked(settings.log_frequency)
        self._log_magnitude.setChecked(settings.log_magnitude)
        self._plot.toolbar.show_state(
            layout=settings.layout, zoomed=settings.frequency_range_hz is not None
        )
        self._show_axis()
        if not view.outputs:
            self._say(self.no_outputs)
        elif self._plot.plot.message == self.no_outputs:
            self._plot.wait_for_curves()
        elif level_changed and self._results is not None:
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
        stacked = settings.layout == "stacked"
        self._plot.set_view(axis, settings.frequency_range_hz, stacked=stacked)

    def _say(self, message: str) -> None:
        self._results = None
        self._plot.show_message(message)

    def _draw(self, results: Mapping[str, Any]) -> None:
        span = results["span"]
        frequency_hz, magnitude = results[_QUANTITIES[span]]
        level = self._settings.log_magnitude
        rectified = results["method"] == "mag" and len(results["axes"]) > 1
        self._plot.show_curves(
            Curves(
                x=frequency_hz,
                y=decibels(magnitude) if level else magnitude,
                names=output_names(results["outputs"], results["limb"]),
                kind="level" if level else "amplitude",
                scaling=_SCALINGS[span],
                about=lines_later(results, f"spectrum: {_SCALINGS[span][-3]}"),
                heading=heading_of(results),
            ),
            synthetic=facts_of(results["limb"]).synthetic,
            notes=_RECTIFIED if rectified else (),
        )

    def _choose_layout(self, layout: str) -> None:
        self._change(layout=layout)

    def _choose_log_frequency(self, log: bool) -> None:
        self._change(log_frequency=log)

    def _choose_log_magnitude(self, log: bool) -> None:
        self._change(log_magnitude=log)

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
