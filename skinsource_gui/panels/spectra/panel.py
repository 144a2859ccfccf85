"""The panel of amplitude spectra of the selected outputs."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skinsource.base.conventions import Band, Floats
from skinsource.base.decibels import decibels
from skinsource.design.comparing import match_text
from skinsource.design.design import Design, View
from skinsource.design.panel_settings import settings_of
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.loudest_window import HOLD_WINDOW_S, LOUDEST_WINDOW_S, Span
from skinsource.signals.spectra import MEAN_OF_BINS, mean_of_bins
from skinsource.specs import fields
from skinsource.specs.numbers import Range, RangeSpec
from skinsource.specs.spec import SwitchSpec
from skinsource_gui.panels.signal_panel import SignalPanel
from skinsource_gui.plots.curves import LEVEL_TEXT, Curves, Measured, output_names
from skinsource_gui.plots.ranges import Kind, XAxis, significant
from skinsource_gui.plots.signal_view import DESCRIPTION_QUANTITIES, heading_of, lazy_lines
from skinsource_gui.qt.resources import choice_of

LAYOUT = choice_of("layout_of_spectra")
AXES_HINT = "Each output in its own row, a curve for each axis"
LOG_FREQUENCY = SwitchSpec(label="Log frequency", hint="Logarithmic frequency axis")
LOG_MAGNITUDE = SwitchSpec(label="dB", hint="Logarithmic magnitude")
RELATIVE = SwitchSpec(
    label="Each to its peak",
    hint="Draw each output relative to its peak in the measured band",
)
AVERAGED = SwitchSpec(
    label=f"Mean of {MEAN_OF_BINS} bins",
    hint=f"Draw the mean of {MEAN_OF_BINS} neighbouring frequencies, to smooth noise",
)
FREQUENCY_RANGE = RangeSpec(label="Zoom", unit="Hz")
CURSORS = RangeSpec(label="Cursors", unit="Hz")


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectraSettings(fields.CheckedModel):
    """How spectra are drawn.

    Attributes
    ----------
    layout
        ``"overlaid"``, ``"stacked"``, or ``"axes"``: along each axis of the sensors, whatever axes
        are chosen.
    log_frequency, log_magnitude
        Logarithmic axes.
    relative
        Whether each output is drawn relative to its own peak.
    averaged
        Whether each magnitude is the mean over some bins around it.
    frequency_range_hz
        Zoom; ``None``: everything.
    cursors
        Frequencies between which curves are measured, Hz; ``None``: no cursors.
    """

    layout: str = fields.choice("overlaid", LAYOUT)
    log_frequency: bool = fields.switch(False, LOG_FREQUENCY)
    log_magnitude: bool = fields.switch(True, LOG_MAGNITUDE)
    relative: bool = fields.switch(False, RELATIVE)
    averaged: bool = fields.switch(False, AVERAGED)
    frequency_range_hz: Range | None = fields.interval(None, FREQUENCY_RANGE)
    cursors: Range | None = fields.interval(None, CURSORS)


_HOLD, _LOUDEST = (f"{window_s * 1e3:.0f} ms" for window_s in (HOLD_WINDOW_S, LOUDEST_WINDOW_S))
# What the height of a curve means, from the longest to the shortest text.
_SCALINGS = {
    "record": ("amplitude over the whole record", "over the whole record", "whole record"),
    "loudest": (
        # The window differs from the one that was chosen, that of levels.
        f"amplitude in the loudest {_HOLD} of each frequency, which tell "
        f"{1 / HOLD_WINDOW_S:.0f} Hz apart; levels: loudest {_LOUDEST}",
        f"amplitude in the loudest {_HOLD} of each frequency; levels: {_LOUDEST}",
        f"loudest {_HOLD}; levels: {_LOUDEST}",
        f"loudest {_HOLD}",
    ),
}
_QUANTITIES = {"record": "selected_spectra", "loudest": "selected_peak_spectra"}
_OF_AXES = {"record": "selected_axis_spectra", "loudest": "selected_axis_peak_spectra"}
_RECTIFIED = (
    "spectrum of a magnitude: rectified, shows doubled frequencies",
    "of a magnitude: rectified, doubled frequencies",
    "rectified: doubled frequencies",
    "rectified",
)
_RELATIVE_LEVEL_TEXT = "dB re its peak"
_AVERAGED = f"mean of {MEAN_OF_BINS} bins"


def quantity_of(settings: SpectraSettings, span: Span) -> str:
    """Return the name of the quantity that is drawn."""
    return (_OF_AXES if settings.layout == "axes" else _QUANTITIES)[span]


def curves_of(results: Mapping[str, Any], settings: SpectraSettings) -> Curves:
    """Return the curves of ``results``, which hold what `quantity_of` names."""
    span, limb = results["span"], facts_of(results["limb"])
    frequency_hz, magnitude = results[quantity_of(settings, span)]
    each_axis = settings.layout == "axes"
    axes = tuple(limb.axes) if each_axis else ()
    # (n_outputs, n_curves of each, n_bins)
    drawn = magnitude if each_axis else magnitude[:, None]
    if settings.averaged:
        drawn = mean_of_bins(drawn, MEAN_OF_BINS)
    measure = partial(measured_between, results, settings, drawn)
    scaled = _SCALINGS[span][-3].partition(";")[0]
    notes = [f"spectrum: {scaled}{_averaged_text(settings, frequency_hz)}"]
    span_shown = None
    peaks: tuple[float, ...] = ()
    if settings.relative:
        within = _inside(frequency_hz, limb.band_hz)
        largest = drawn[..., within].max(axis=(-2, -1))
        peaks = tuple(largest.tolist())
        # Silence has no peak to be relative to.
        drawn = drawn / np.where(largest > 0.0, largest, 1.0)[:, None, None]
        measured = _drawn(drawn[..., within], settings)
        span_shown = float(measured.min()), float(measured.max())
        notes.append("each output relative to its largest magnitude in the measured band")
    columns = settings.relative and settings.log_magnitude
    notes += notes_of(results, settings)[:1]
    heading = heading_of(results, each_axis=each_axis)
    return Curves(
        x=frequency_hz,
        y=_drawn(drawn, settings).reshape(-1, frequency_hz.size),
        names=output_names(results["outputs"], results["limb"]),
        axes=axes,
        kind=_kind(settings),
        span=span_shown,
        level_text=_RELATIVE_LEVEL_TEXT if settings.relative else LEVEL_TEXT,
        scaling=tuple(f"{heading[1]} · {text}" for text in _scaling(settings, results)),
        columns=_columns(results["outputs"], axes) if columns else (),
        about=lazy_lines(results, *notes, each_axis=each_axis),
        heading=heading,
        peaks=peaks,
        matched=match_text(results["match_gain"]),
        measure=measure,
    )


def measured_between(
    results: Mapping[str, Any], settings: SpectraSettings, smoothed: Floats, between_hz: Range
) -> Measured:
    """Return the peaks between two frequencies, and over the whole record what the part sums to.

    Peaks are those of ``smoothed``, (..., n_bins), which is drawn; sums those of the spectra.
    """
    span = results["span"]
    frequency_hz, magnitude = results[quantity_of(settings, span)]
    first, last = np.searchsorted(frequency_hz, between_hz)
    part = slice(min(first, frequency_hz.size - 1), max(last, first + 1))
    exact, curves = (each.reshape(-1, frequency_hz.size)[:, part] for each in (magnitude, smoothed))
    # Of what rings longer than the record there are more lines.
    finer = results["response_samples"] / results["record_samples"]
    of_what = " of the unsmoothed spectrum" if settings.averaged else ""
    # Lines of a rectified signal are those of no motion.
    rectified = bool(notes_of(results, settings))
    rows = []
    for lines, curve in zip(exact, curves, strict=True):
        at = int(curve.argmax())
        peak, at_hz = float(curve[at]), float(frequency_hz[part][at])
        omega = 2.0 * np.pi * at_hz
        # Lines of a spectrum are amplitudes, those of a peak hold are not there at the same time.
        rms = float(np.sqrt(np.sum(np.square(lines)) / 2.0 / finer)) if span == "record" else None
        moves = (
            f", {significant(peak / omega * 1e3)} mm/s, {significant(peak / omega**2 * 1e6)} µm"
            if omega and not rectified
            else ""
        )
        text = f"peak {significant(peak)} m/s² at {significant(at_hz)} Hz"
        short = f"{significant(peak)} at {significant(at_hz)}"
        rms_text = "" if rms is None else f"; RMS {significant(rms)} m/s²{of_what}"
        rows.append((short, f"{text}{moves}{rms_text}"))
    axes = facts_of(results["limb"]).axes if settings.layout == "axes" else ("",)
    names = [
        f"{name.number}  {name.full}{axis and f', {axis}'}"
        for name in output_names(results["outputs"], results["limb"])
        for axis in axes
    ]
    return Measured(
        distance=f"Δf {significant(between_hz[1] - between_hz[0])} Hz",
        meaning="peak in m/s² at Hz",
        readings=tuple(short for short, _ in rows),
        details=tuple(f"{name}: {long}" for name, (_, long) in zip(names, rows, strict=True)),
    )


def notes_of(results: Mapping[str, Any], settings: SpectraSettings) -> tuple[str, ...]:
    """Return warnings about the curves, longest first."""
    rectified = results["method"] == "mag" and len(results["axes"]) > 1
    return _RECTIFIED if rectified and settings.layout != "axes" else ()


def _scaling(settings: SpectraSettings, results: Mapping[str, Any]) -> tuple[str, ...]:
    """Return what heights mean, longest first."""
    texts = _SCALINGS[results["span"]]
    if results["span"] == "record":
        record_s = results["record_samples"] / results["sample_rate_hz"]
        texts = (*(f"{text}, {round(record_s, 2):g} s" for text in texts), texts[-1])
    return tuple(f"{text}, {_AVERAGED}" for text in texts) if settings.averaged else texts


def _averaged_text(settings: SpectraSettings, frequency_hz: Floats) -> str:
    """Return over which frequencies each magnitude is a mean, or ""."""
    if not settings.averaged or frequency_hz.size < 2:
        return ""
    return f", {_AVERAGED}, {MEAN_OF_BINS * float(frequency_hz[1] - frequency_hz[0]):.3g} Hz"


def _kind(settings: SpectraSettings) -> Kind:
    if settings.log_magnitude:
        return "level"
    return "relative" if settings.relative else "amplitude"


def _columns(outputs: tuple[int, ...], axes: tuple[str, ...]) -> tuple[str, ...]:
    """Return the titles of levels that are relative to peaks."""
    return tuple(
        f"output_{output}{axis and f'_{axis}'}_db_re_its_peak"
        for output in outputs
        for axis in axes or ("",)
    )


def _drawn(magnitude: Floats, settings: SpectraSettings) -> Floats:
    return decibels(magnitude) if settings.log_magnitude else magnitude


def _inside(frequency_hz: Floats, band_hz: Band | None) -> NDArray[np.bool_]:
    """Return which frequencies were measured: below them is drift of the sensors."""
    low_hz, high_hz = band_hz or (0.0, np.inf)
    inside = (frequency_hz >= low_hz) & (frequency_hz <= high_hz)
    # A band between two frequencies holds none: then all count.
    return inside if inside.any() else ~inside


_LOWEST_HZ = 10.0
# Settings that change the frequency axis alone: curves stay.
_OF_AXIS: dict[str, Any] = {
    "log_frequency": False,
    "frequency_range_hz": None,
    "cursors": None,
}


class SpectraPanel(SignalPanel):
    """One curve of each selected output over frequency, overlaid or stacked."""

    title = "Spectra"
    name = "spectra"

    def __init__(self) -> None:
        super().__init__("spectra-plot", "Spectra of the selected outputs")
        self.settings = SpectraSettings()
        limb = facts_of("")
        self._axis, self._log_axis = _axes(limb.sample_rate_hz, limb.band_hz)
        self._plot.toolbar.add_layout("axes", "Axes", AXES_HINT)
        self.add_switch(
            "log_frequency",
            LOG_FREQUENCY,
            text="Log f",
            hint=f"Logarithmic frequency axis from {_LOWEST_HZ:g} Hz",
            in_menu=True,
        )
        self.add_switch(
            "log_magnitude",
            LOG_MAGNITUDE,
            hint="Logarithmic magnitude: dB re 1 m/s², the uppermost 80 dB",
        )
        self.add_switch("relative", RELATIVE)
        # Few want it, and seven switches have room on wide screens alone.
        self.add_switch("averaged", AVERAGED, in_menu=True)
        self._plot.zoom_requested.connect(
            lambda shown_hz: self.change_settings(frequency_range_hz=shown_hz)
        )

    @property
    def needs(self) -> frozenset[str]:
        # Texts around the curves come with the curves.
        spectra = quantity_of(self.settings, self._view.span)
        return frozenset({spectra, "outputs", "response_samples"}) | DESCRIPTION_QUANTITIES

    def show_state(self, design: Design, view: View) -> None:
        settings = settings_of(view, self.name, SpectraSettings)
        before = self.settings
        rescaled = settings != before and (
            replace(settings, **_OF_AXIS) != replace(before, **_OF_AXIS)
        )
        self._view, self.settings = view, settings
        self.show_settings(settings, zoomed=settings.frequency_range_hz is not None)
        self._show_axis()
        if self.show_selection(view) and rescaled and self._results is not None:
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
            self.say_instead(self.no_outputs)

    def _show_axis(self) -> None:
        settings = self.settings
        axis = self._log_axis if settings.log_frequency else self._axis
        stacked = settings.layout != "overlaid"
        axis = _visible_axis(axis, settings.frequency_range_hz)
        self._plot.plot.set_view(axis, settings.frequency_range_hz, stacked=stacked)

    def _draw(self, results: Mapping[str, Any]) -> None:
        settings = self.settings
        if quantity_of(settings, results["span"]) not in results:
            # The results of another layout are still being computed.
            return
        notes = notes_of(results, settings)
        self._show_curves(curves_of(results, settings), results["limb"], notes)


def _axes(sample_rate_hz: float, band: Band | None) -> tuple[XAxis, XAxis]:
    """Return the linear and the logarithmic axis of a limb; band None: it is not known."""
    highest_hz = sample_rate_hz / 2
    titles: tuple[str, ...] = ("Frequency (Hz)",)
    if band is not None:
        text = f"{band[0]:g} to {band[1]:g} Hz"
        titles = (
            f"Frequency (Hz) · measured band {text}, shaded outside",
            f"Frequency (Hz) · band {text}",
            *titles,
        )
    linear = XAxis(
        titles=titles, unit="Hz", column="frequency_hz", extent=(0.0, highest_hz), band=band
    )
    return linear, replace(linear, extent=(_LOWEST_HZ, highest_hz), log=True)


def _visible_axis(axis: XAxis, zoom: Range | None) -> XAxis:
    """Return the axis, without a text on the shaded part where none is visible."""
    visible = zoom or axis.extent
    if axis.band is None or visible is None:
        return axis
    shaded = visible[0] < axis.band[0] or visible[1] > axis.band[1]
    return axis if shaded else replace(axis, titles=axis.titles[1:])
