"""Figures that are curves in rows under each other."""

from collections.abc import Sequence
from dataclasses import replace
from math import floor
from typing import Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.choice_words import signal_words
from skinsource.decibels import decibels
from skinsource.evaluation import evaluate
from skinsource.figures.sheet import WIDTH_MM, Drawn, Sheet, Table
from skinsource.figures.values import axes_of_sensors, field_of, frames, with_values
from skinsource.own_limbs import facts_of
from skinsource.plot.levels import common_range
from skinsource.plot.maps import Bar, draw_map
from skinsource.plot.paper import COLOURS, style
from skinsource.plot.rows import Row, common_size, draw_rows, say_scale
from skinsource.resampling import finer
from skinsource.sampling import NEAR
from skinsource.scenes import OpenedScene
from skinsource.spectra import MEAN_OF_BINS, mean_of_bins

_ROW_MM, _AXIS_MM = 11.0, 12.0
_LEFT_MM, _RIGHT_MM = 34.0, 8.0
_FRAMES_MM = 54.0
_RED_BLUE_BLACK = (COLOURS[1], COLOURS[0], COLOURS[2])
# How long after the pulse the paper shows it: at 52.0, 52.75, 53.5, 54.25 and 55.0 ms.
_INSTANTS_S = (0.0, 0.00075, 0.0015, 0.00225, 0.003)


def pulse_traces(opened: OpenedScene) -> Drawn:
    """Three axes of each output, each output relative to its peak, and maps of the first 3 ms."""
    outputs, axes = opened.view.outputs, axes_of_sensors(opened.design)
    time_s, field = field_of(opened.design)
    within = _within(opened, time_s)
    drawn_s, drawn = finer(time_s, field[np.array(outputs) - 1])
    seen = _within(opened, drawn_s)
    rows = [
        _own_row(number, 1e3 * drawn_s[seen], one[:, seen])
        for number, one in zip(outputs, drawn, strict=True)
    ]
    height_mm = 9.0 * len(rows)
    sheet = Sheet(opened, height_mm + _FRAMES_MM + 20.0, maps=True)
    instants = _instants(opened)
    magnitudes = frames(opened.design, instants)
    levels = [with_values(opened.design, decibels(one)) for one in magnitudes]
    with style():
        width_mm = WIDTH_MM - _LEFT_MM - _RIGHT_MM
        ax = sheet.axes(_LEFT_MM, _FRAMES_MM + 14.0, width_mm, height_mm)
        draw_rows(ax, rows, labels=axes)
        ax.set_xlabel("Time (ms)")
        say_scale(ax, "each row relative to its peak")
        colours = common_range(*(one.values for one in levels))
        image = None
        places = sheet.row_of_axes(len(instants), 12.0, 1.0, 146.0, _FRAMES_MM - 6.0)
        for place, one, instant in zip(places, levels, instants, strict=True):
            bar: Bar = "drawn" if instant == instants[-1] else "room"
            title = f"{1e3 * time_s[instant]:.1f} ms"
            image = draw_map(place, one, colours, title=title, bar=bar, part="hand")
        sheet.colour_bar(image, 160.0, 4.0, _FRAMES_MM - 14.0, "magnitude, dB re 1 m/s²")
    header = ["time_s", *(f"output_{n}_{axis}_m_per_s2" for n in outputs for axis in axes)]
    shown = np.concatenate([field[number - 1] for number in outputs])[:, within]
    shown_at = [f"{1e3 * time_s[one]:.3f}_ms_magnitude_m_per_s2" for one in instants]
    numbers = np.arange(1.0, magnitudes.shape[1] + 1.0)
    return Drawn(
        sheet=sheet,
        tables={
            "": Table(header=header, rows=np.vstack((time_s[within], shown)).T),
            "-frames": Table(header=["output", *shown_at], rows=np.vstack((numbers, magnitudes)).T),
        },
    )


def _instants(opened: OpenedScene) -> list[int]:
    """Samples at which the pulse is shown, as late as the responses of the limb are."""
    facts = facts_of(opened.design.limb)
    rate_hz, delay_s = facts.sample_rate_hz, facts.pre_trigger_delay_s
    return [floor((delay_s + one) * rate_hz + NEAR) for one in _INSTANTS_S]


def axis_spectra(opened: OpenedScene) -> Drawn:
    """Spectra of three axes of each output, each output relative to its largest magnitude."""
    return _spectra(opened, 1)


def smoothed_axis_spectra(opened: OpenedScene) -> Drawn:
    """The same, each the mean over ten bins."""
    return _spectra(opened, MEAN_OF_BINS)


def own_traces(opened: OpenedScene) -> Drawn:
    """What outputs do over time, each relative to its peak."""
    return _traces(opened, (COLOURS[2],), own_scale=True)


def overlaid_traces(opened: OpenedScene) -> Drawn:
    """What outputs do over time, for all designs over each other, in one scale."""
    return _traces(opened, _RED_BLUE_BLACK, own_scale=False)


def _traces(opened: OpenedScene, colours: Sequence[str], *, own_scale: bool) -> Drawn:
    view, several = opened.view, len(opened.conditions) > 1
    found = [
        evaluate(one.design, "response_time_s", "selected_traces", view=view)
        for one in opened.conditions
    ]
    time_s = found[0]["response_time_s"]
    within = _within(opened, time_s)
    curves = [one["selected_traces"][:, within] for one in found]
    drawn_s, drawn = finer(time_s, np.stack([one["selected_traces"] for one in found]))
    drawn_s, drawn = drawn_s[_within(opened, drawn_s)], drawn[..., _within(opened, drawn_s)]
    size = None if own_scale else common_size(list(drawn))
    rows = [
        _labelled(number, 1e3 * drawn_s, drawn[:, k], size) for k, number in enumerate(view.outputs)
    ]
    labels = [one.label for one in opened.conditions] if several else []
    sheet, ax = _rows_sheet(opened, rows, labels, colours)
    with style():
        ax.set_xlabel("Time (ms)")
        words = "each row relative to its peak" if own_scale else f"a row is {size:.3g} m/s² high"
        say_scale(ax, f"{signal_words(view.axes, view.method)}; {words}")
    names = [f"_{one.label.replace(' ', '_')}" if several else "" for one in opened.conditions]
    header = ["time_s"]
    header += [f"output_{n}{name}_m_per_s2" for name in names for n in view.outputs]
    table = Table(header=header, rows=np.vstack((time_s[within], *curves)).T)
    return Drawn(sheet=sheet, tables={"": table})


def _spectra(opened: OpenedScene, n_bins: int) -> Drawn:
    outputs, axes = opened.view.outputs, axes_of_sensors(opened.design)
    by_axis, frequency_hz = [], np.zeros(0)
    for axis in axes:
        view = replace(opened.view, axes=axis)
        spectra = evaluate(opened.design, "selected_spectra", view=view)["selected_spectra"]
        frequency_hz, magnitude = spectra
        by_axis.append(mean_of_bins(magnitude, n_bins))
    low_hz, high_hz = facts_of(opened.design.limb).band_hz or (0.0, np.inf)
    within = (frequency_hz >= low_hz) & (frequency_hz <= high_hz)
    of_outputs = np.stack(by_axis, axis=1)[..., within]
    rows = [
        _own_row(number, frequency_hz[within], one)
        for number, one in zip(outputs, of_outputs, strict=True)
    ]
    sheet, ax = _rows_sheet(opened, rows, axes, COLOURS, from_zero=True)
    with style():
        ax.set_xlabel("Frequency (Hz)")
        mean = f", mean of {n_bins} bins" if n_bins > 1 else ""
        say_scale(ax, f"magnitude{mean}; each row relative to its largest")
    header = ["frequency_hz", *(f"output_{n}_{axis}_m_per_s2" for n in outputs for axis in axes)]
    columns = of_outputs.reshape(-1, of_outputs.shape[-1])
    table = Table(header=header, rows=np.vstack((frequency_hz[within], columns)).T)
    return Drawn(sheet=sheet, tables={"": table})


def _rows_sheet(
    opened: OpenedScene,
    rows: Sequence[Row],
    labels: Sequence[str],
    colours: Sequence[str],
    *,
    from_zero: bool = False,
) -> tuple[Sheet, Any]:
    height_mm = _ROW_MM * len(rows) + _AXIS_MM + 8.0
    sheet = Sheet(opened, height_mm)
    with style():
        ax = sheet.axes(
            _LEFT_MM, _AXIS_MM, WIDTH_MM - _LEFT_MM - _RIGHT_MM, height_mm - _AXIS_MM - 8.0
        )
        draw_rows(ax, rows, labels=labels, colours=colours, from_zero=from_zero)
    return sheet, ax


def _own_row(number: int, x: Floats, curves: Floats) -> Row:
    return _labelled(number, x, curves, None)


def _labelled(number: int, x: Floats, curves: Floats, size: float | None) -> Row:
    peak = float(np.abs(curves).max(initial=0.0))
    label = f"Output {number}" if size is not None else f"Output {number}\n{peak:.2g} m/s²"
    return Row(label=label, x=x, curves=curves, unit_size=size)


def _within(opened: OpenedScene, time_s: Floats) -> Any:
    low, high = opened.view.time_range_s or (float(time_s[0]), float(time_s[-1]))
    return (time_s >= low) & (time_s <= high)
