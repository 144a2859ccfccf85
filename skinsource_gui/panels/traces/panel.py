"""The panel of acceleration of the selected outputs over time."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from PySide6 import QtGui

from skinsource.base.conventions import BAND_HZ, Floats
from skinsource.design import edits
from skinsource.design.comparing import match_text
from skinsource.design.design import Design, View
from skinsource.design.panel_settings import settings_of
from skinsource.engine.moments import Projection
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.analysis.intervals import interval_of
from skinsource.signals.resampling import finer, peaks_between
from skinsource.specs import fields
from skinsource.specs.numbers import Range, RangeSpec
from skinsource.specs.spec import SwitchSpec
from skinsource_gui.fields.units import axis_unit
from skinsource_gui.panels.signal_panel import SignalPanel
from skinsource_gui.plots.curves import Curves, Measured, output_names
from skinsource_gui.plots.plot import moved_playhead
from skinsource_gui.plots.ranges import BEFORE_S, Wave, XAxis, number_text, significant
from skinsource_gui.plots.signal_view import DESCRIPTION_QUANTITIES, heading_of, lazy_lines
from skinsource_gui.qt.resources import choice_of

LAYOUT = choice_of("layout_of_traces")
RELATIVE = SwitchSpec(
    label="Each to its peak",
    hint="Draw each curve relative to its own peak, to compare shapes",
)

FITTED = SwitchSpec(
    label="Fit visible range",
    hint="Fit the range of values to the visible part",
)

CURSORS = RangeSpec(label="Cursors", unit="s")


@dataclass(frozen=True, slots=True, kw_only=True)
class TracesSettings(fields.CheckedModel):
    """How traces are drawn.

    Attributes
    ----------
    layout
        ``"overlaid"`` or ``"stacked"``.
    relative
        Whether each is drawn relative to its own peak.
    fitted
        Whether values fit the visible part of the time.
    cursors
        Times between which curves are measured, s; ``None``: no cursors.
    """

    layout: str = fields.choice("overlaid", LAYOUT)
    relative: bool = fields.switch(False, RELATIVE)
    fitted: bool = fields.switch(False, FITTED)
    cursors: Range | None = fields.interval(None, CURSORS)


# Readings distinguish samples at 1300 Hz.
_DECIMALS = {"ms": 2, "s": 5}
# What the wave between samples follows from: that of a magnitude runs along the axes.
_WAVE = frozenset({"axis_traces", "selected_extremes", "selected_projection"})
_RINGS = "Something moves before 0: the filter of the measuring pulse rings"
# Less is rounding.
_LEAST_EARLY_S = 1e-6


class TracesPanel(SignalPanel):
    """One curve of each selected output over time, overlaid or stacked."""

    title = "Traces"
    name = "traces"

    def __init__(self) -> None:
        super().__init__("traces-plot", "Traces of the selected outputs")
        self.settings = TracesSettings()
        self._pre_trigger = self._plot.add_switch_in_menu(
            "pre-trigger",
            "Show pre-trigger",
            "Begin with the record of the measurement, not with its pulse",
            self._show_pre_trigger,
        )
        self.add_switch("relative", RELATIVE)
        self.add_switch("fitted", FITTED, in_menu=True)
        self._plot.zoom_requested.connect(self._zoom)
        self._plot.plot.playhead.dragged_to.connect(self.playhead_requested)
        self._plot.plot.playhead_key.connect(self._press)
        # Which delay the curves on screen have, and when they end.
        self._drawn_removed, self._end_s = False, 0.0
        # How long before 0 they begin: filters of linear phase ring before they sound.
        self._early_s = 0.0
        self._delay_s = facts_of("").pre_trigger_delay_s

    @property
    def needs(self) -> frozenset[str]:
        # Outputs, delay and limb come with the curves: labels never belong to others.
        drawn = (
            {"response_time_s", "selected_traces", "outputs", "delay_removed"}
            | DESCRIPTION_QUANTITIES
            | _WAVE
        )
        if self._view.method == "pca" and len(self._view.axes) > 1:
            drawn.add("selected_without_main_axis")
        return frozenset(drawn)

    def show_state(self, design: Design, view: View) -> None:
        self._design = design
        settings = settings_of(view, self.name, TracesSettings)
        rescaled = settings.relative != self.settings.relative
        self._view, self.settings = view, settings
        self._delay_s = facts_of(design.limb).pre_trigger_delay_s
        self._plot.show_switch(self._pre_trigger, not view.delay_removed and self._delay_s > 0.0)
        self.show_settings(settings, zoomed=view.time_range_s is not None)
        self._plot.plot.playhead.show_at(view.playhead_s)
        self.show_selection(view)
        if self._drawn_removed == view.delay_removed:
            self._apply_view()
        if rescaled and self._results is not None:
            self._draw(self._results)

    def show_playhead(self, view: View) -> None:
        self._view = view
        self._plot.plot.playhead.show_at(view.playhead_s)

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._drawn_removed = results["delay_removed"]
        first_s, self._end_s = (float(results["response_time_s"][k]) for k in (0, -1))
        shift_s = facts_of(results["limb"]).pre_trigger_delay_s if self._drawn_removed else 0.0
        self._early_s = max(-shift_s - first_s, 0.0)
        self._apply_view()
        self._results = dict(results) if results["outputs"] else None
        if self._results is None:
            self._plot.plot.show_message(self.no_outputs)
        else:
            self._draw(self._results)

    def _draw(self, results: Mapping[str, Any]) -> None:
        relative = self.settings.relative
        peaks = peaks_between(_waves(results)) if relative else None
        scale = None if peaks is None else np.where(peaks > 0.0, peaks, 1.0)[:, np.newaxis]
        heading = heading_of(results)
        curves = Curves(
            x=results["response_time_s"],
            y=results["selected_traces"] if scale is None else results["selected_traces"] / scale,
            kind="amplitude" if scale is None else "relative",
            names=output_names(results["outputs"], results["limb"]),
            about=lazy_lines(results),
            heading=heading,
            scaling=heading[1:],
            matched=match_text(results["match_gain"]),
            peaks=() if peaks is None else tuple(peaks.tolist()),
            wave=_wave(results, scale),
            measure=partial(measured_between, results),
        )
        without = _not_silent(results.get("selected_without_main_axis", ()), results)
        self._show_curves(curves, results["limb"], _axis_notes(without))

    def _apply_view(self) -> None:
        view = self._view
        visible_until_s = self._end_s if view.time_range_s is None else view.time_range_s[1]
        axis = _axis(axis_unit(visible_until_s)[0], self._delay_s, removed=self._drawn_removed)
        begin_s = -min(self._delay_s, BEFORE_S) if self._drawn_removed else 0.0
        if self._early_s >= _LEAST_EARLY_S:
            axis = _without_beginning(axis, self._early_s, (begin_s, self._end_s))
        elif self._drawn_removed:
            axis = replace(axis, extent=(begin_s, self._end_s))
        stacked, fitted = self.settings.layout == "stacked", self.settings.fitted
        self._plot.plot.set_view(axis, view.time_range_s, stacked=stacked, fitted=fitted)

    def _show_pre_trigger(self, shown: bool) -> None:
        self.edited.emit(edits.remove_delay(self._design, self._view, not shown), None)

    def _press(self, event: QtGui.QKeyEvent) -> None:
        time_s = moved_playhead(event, self._design, self._view.playhead_s)
        if time_s is not None:
            self.playhead_requested.emit(time_s)
            self._plot.plot.navigation.bring(time_s)

    def _zoom(self, shown: tuple[float, float] | None) -> None:
        changed = replace(self._view, time_range_s=shown)
        if changed != self._view:
            self.view_changed.emit(changed)


def measured_between(results: Mapping[str, Any], between_s: Range) -> Measured:
    """Return what the selected outputs do between two times."""
    time_s, limb = results["response_time_s"], facts_of(results["limb"])
    lowest_hz = (limb.band_hz or BAND_HZ)[0]
    traces = results["selected_traces"]
    interval = interval_of(traces, time_s, between_s, lowest_hz, _waves(results))
    names = output_names(results["outputs"], results["limb"])
    rows = tuple(
        zip(
            *(
                [f"{significant(float(value * factor))} {unit}" for value in values]
                for values, factor, unit in (
                    (interval.peak, 1.0, "m/s²"),
                    (interval.rms, 1.0, "m/s²"),
                    (interval.velocity, 1e3, "mm/s"),
                    (interval.displacement, 1e6, "µm"),
                )
            ),
            strict=True,
        )
    )
    begin, end = (number_text(time_s * 1e3, 1) for time_s in between_s)
    apart = significant((between_s[1] - between_s[0]) * 1e3)
    return Measured(
        distance=f"{begin} to {end} ms, Δt {apart} ms",
        meaning="peak, RMS in m/s²",
        readings=tuple(
            f"{significant(float(peak))}, {significant(float(rms))}"
            for peak, rms in zip(interval.peak, interval.rms, strict=True)
        ),
        details=tuple(
            f"{name.number}  {name.full}: peak {row[0]}, {row[2]}, {row[3]}; RMS {row[1]}"
            for name, row in zip(names, rows, strict=True)
        ),
    )


def _axis(unit: str, delay_s: float, *, removed: bool) -> XAxis:
    """Return the time axis in ms or s, with a note on the delay."""
    late = f" · responses start ~{delay_s * 1e3:.3g} ms late (pre-trigger of the measurement)"
    plain = f"Time ({unit})"
    return XAxis(
        titles=(plain,) if removed or delay_s == 0.0 else (f"{plain}{late}", plain),
        unit=unit,
        column="time_s",
        factor=1e3 if unit == "ms" else 1.0,
        decimals=_DECIMALS[unit],
        hint=_RINGS if removed and delay_s else "",
    )


def _without_beginning(axis: XAxis, early_s: float, extent: tuple[float, float]) -> XAxis:
    """Return the axis from 0 on, with a note that there is something before."""
    note = f" · not shown: {early_s:.2g} s before 0, where filters ring"
    short = f" · {early_s:.2g} s before 0 not shown"
    titles = tuple(f"{axis.titles[-1]}{text}" for text in (note, short))
    return replace(axis, extent=extent, titles=(*titles, axis.titles[-1]))


def _not_silent(outputs: tuple[int, ...], results: Mapping[str, Any]) -> tuple[int, ...]:
    # A silent output needs no main axis.
    if not outputs:
        return ()
    pairs = zip(results["outputs"], results["selected_traces"], strict=True)
    loud = {output for output, trace in pairs if trace.any()}
    return tuple(output for output in outputs if output in loud)


def _waves(results: Mapping[str, Any]) -> Floats:
    projection: Projection = results["selected_projection"]
    return projection.waves(results["axis_traces"], results["selected_traces"])


def _wave(results: Mapping[str, Any], scale: Floats | None) -> Wave:
    """Return the wave through the samples of the traces, divided by ``scale``."""
    extremes = results["selected_extremes"]
    if scale is not None:
        extremes = extremes.relative_to(scale)
    return Wave(points=partial(_points_between, results, scale), extremes=extremes.part)


def _points_between(
    results: Mapping[str, Any], scale: Floats | None, first: int, end: int
) -> tuple[Floats, Floats]:
    """Return the traces from one sample to before another, with points between them."""
    time_s, projection = results["response_time_s"], results["selected_projection"]
    instants, waves = finer(time_s, _waves(results), first, end)
    if projection.directions is None:
        waves = projection.signals(waves)
    return instants, waves if scale is None else waves / scale


def _axis_notes(outputs: tuple[int, ...]) -> tuple[str, ...]:
    if not outputs:
        return ()
    names = ", ".join(map(str, outputs))
    return (
        f"no principal axis at {names}: motion is equal in all directions, the one shown arbitrary",
        f"no principal axis at {names}",
        "some have no principal axis",
    )
