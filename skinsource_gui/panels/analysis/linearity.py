"""Checks of stored designs, as diagrams and text: strengths in proportion, inputs that add up."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPointF, QRectF, Qt

from skinsource.base.conventions import Floats
from skinsource.design.amplitudes import amplitude_unit, is_gain
from skinsource.design.design import EDITED, NUMBERS, Design, Snapshot, View
from skinsource.design.panel_settings import settings_of
from skinsource.limbs.own_limbs import axes_on, facts_of
from skinsource.signals.resampling import finer
from skinsource.specs.spec import SwitchSpec
from skinsource.studies.checking import (
    Proportion,
    Straightness,
    Superposition,
    bands_shown,
    joint_of,
    proportion,
    straightness,
    strengths_of,
    superposition,
)
from skinsource_gui.fields.units import minus
from skinsource_gui.panels.analysis.settings import BANDS, EVERY_OUTPUT, VELOCITY, LinearitySettings
from skinsource_gui.panels.analysis.view import FigureView
from skinsource_gui.plots.figure import Axes, Axis, Figure, draw_legend, fitted_axes
from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.fitting import FoldingRow
from skinsource_gui.qt.keys import shortcut_text
from skinsource_gui.qt.questions import tab_separated
from skinsource_gui.qt.theme import UNIT_PX, Theme, current_theme, scaled
from skinsource_gui.state.compared import SILENT, Compared

#: Radius of the dots.
DOT_PX = 3.5


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Curve:
    """A line, or dots.

    Attributes
    ----------
    x, y : (n_points,)
        Points of the line, or the dots.
    rank
        Rank of the output in the selection, for its colour; None: the colour of text.
    width_px
        Width of the line; 0: dots.
    label
        Text at the end of the line.
    pale
        From 0 to 1: how much of the colour is left out, so that what lies over it is visible.
    """

    x: Floats
    y: Floats
    rank: int | None
    width_px: float
    pale: float = 0.0
    label: str = ""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Diagram:
    """Curves, the first lowest, over two axes."""

    x: Axis
    y: Axis
    curves: tuple[Curve, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class StrengthUnit:
    """Unit of the strengths of a stimulus.

    Attributes
    ----------
    title, symbol
        Title with the unit, and the unit alone; empty: there is none.
    column
        Name of the column in a table.
    factor
        Strength of an amplitude of 1, in this unit.
    si_factor
        Strength of an amplitude of 1, in SI, for tables.
    """

    title: str
    symbol: str
    column: str = "strength"
    factor: float = 1.0
    si_factor: float = 1.0


def of_amplitudes(unit: str) -> StrengthUnit:
    """Return the unit of amplitudes in ``unit``; ``"×"`` is that of a plain factor."""
    return StrengthUnit(title=f"Strength ({unit})", symbol="" if unit == "×" else unit)


def of_velocities(m_per_s_each: float) -> StrengthUnit:
    """Return the unit of velocities of a probe, of which an amplitude of 1 has so many m/s."""
    return StrengthUnit(
        title="Probe velocity (mm/s)",
        symbol="mm/s",
        column="probe_velocity_m_per_s",
        factor=1e3 * m_per_s_each,
        si_factor=m_per_s_each,
    )


# Without a zoom so much of a long response is drawn, around its loudest instant.
_SHOWN_S = 0.03
# Wide lines of more points take long.
_MOST_SAMPLES = 1500
_WIDEST_PX, _NARROWEST_PX = 8.0, 1.2
_PALE = 0.55
# Time on both sides of a response of one sample, s.
_MARGIN_OF_ONE_S = 1e-3
# The margin of logarithmic axes, as a factor.
_EDGE = 1.4


def part_of(time_s: Floats, curves: Floats, zoom: tuple[float, float] | None) -> tuple[int, int]:
    """Return the first sample and the one after the last that are drawn of (..., n_times)."""
    if zoom is None:
        loudest = float(time_s[np.argmax(np.abs(curves).max(axis=tuple(range(curves.ndim - 1))))])
        zoom = loudest - _SHOWN_S / 2, loudest + _SHOWN_S / 2
    first, end = np.searchsorted(time_s, zoom)
    # A response may have only one sample.
    first = max(int(min(first, time_s.size - 2)), 0)
    return first, int(min(max(end, first + 2), first + _MOST_SAMPLES, time_s.size))


def diagrams_of_proportion(
    result: Proportion,
    rows: tuple[int, ...],
    time_s: Floats,
    zoom: tuple[float, float] | None,
    unit: StrengthUnit,
    *,
    bands: bool = False,
    all_outputs: Floats | None = None,
) -> tuple[Diagram, ...]:
    """Return divided responses over each other, output over input, and how straight that is.

    ``rows`` are the channels that are drawn over time, one for each output; ``unit`` is that of the
    strengths. With ``bands`` outputs are those in some bands. ``all_outputs``, (n_outputs, n_bins),
    is the adjusted R² of all outputs, which is drawn in place of that of ``rows``.
    """
    growth = _growth_in_bands if bands else _growth
    highest = float(result.frequency_hz[-1]) if result.frequency_hz.size else 1.0
    title = "Adjusted R²"
    straightness = tuple(
        Curve(x=result.frequency_hz, y=result.adjusted_r2[row], rank=rank, width_px=0.0)
        for rank, row in enumerate(rows)
    )
    if all_outputs is not None:
        title, straightness = f"{title}, all outputs", _worst_and_median(result, all_outputs)
    return (
        _overlay(result, rows, time_s, zoom, unit),
        growth(result, rows, unit),
        Diagram(
            x=Axis(shown=(0.0, 1.05 * highest), title="Frequency (Hz)"),
            y=Axis(shown=(0.0, 1.1), title=title),
            curves=straightness,
        ),
    )


def _worst_and_median(result: Proportion, all_outputs: Floats) -> tuple[Curve, ...]:
    """Return dots and a line through the bands in which some output is not silent."""
    known_bands = np.isfinite(all_outputs).any(axis=0)
    if not known_bands.any():
        return ()
    x, known = result.frequency_hz[known_bands], all_outputs[:, known_bands]
    median, worst = np.nanmedian(known, axis=0), np.nanmin(known, axis=0)
    return (
        Curve(x=x, y=median, rank=None, width_px=_WIDEST_PX, pale=_PALE, label="median"),
        Curve(x=x, y=worst, rank=None, width_px=_NARROWEST_PX, label="worst"),
    )


def _overlay(
    result: Proportion,
    rows: tuple[int, ...],
    time_s: Floats,
    zoom: tuple[float, float] | None,
    unit: StrengthUnit,
) -> Diagram:
    part = part_of(time_s, result.divided[:, rows], zoom)
    x, y = finer(time_s, result.divided[:, rows] / unit.factor, *part)
    n = len(result.strengths)
    # The widest line is palest, so that all are visible.
    widths, pale = np.linspace(_WIDEST_PX, _NARROWEST_PX, n), np.linspace(0.75, 0.0, n)
    over = tuple(
        Curve(x=x, y=y[k, rank], rank=rank, width_px=_width_over_time(x, widths[k]), pale=pale[k])
        for rank in range(len(rows))
        for k in range(n)
    )
    per = f" per {unit.symbol}" if unit.symbol else ""
    axis = _symmetric_axis(y, f"Normalised (m/s²{per})")
    return Diagram(x=_time_axis(x), y=axis, curves=over)


def _growth(result: Proportion, rows: tuple[int, ...], unit: StrengthUnit) -> Diagram:
    at = result.strengths * unit.factor
    lines: list[Curve] = []
    for rank, row in enumerate(rows):
        level = result.rms[:, row]
        lines.append(Curve(x=at, y=result.line[:, row], rank=rank, width_px=1.2, pale=_PALE))
        lines.append(Curve(x=at, y=level, rank=rank, width_px=0.0))
    return Diagram(
        x=Axis(shown=(0.0, 1.05 * float(at[-1])), title=unit.title),
        y=Axis(shown=(0.0, 1.1 * float(result.rms[:, rows].max()) or 1.0), title="RMS (m/s²)"),
        curves=tuple(lines),
    )


def _growth_in_bands(result: Proportion, rows: tuple[int, ...], unit: StrengthUnit) -> Diagram:
    """Return output over input in bands, which differ by powers of ten: over logarithmic axes."""
    at = result.strengths * unit.factor
    lines: list[Curve] = []
    ends: list[float] = []
    for rank, row in enumerate(rows):
        for band in bands_shown(result, row):
            level, line = result.band_rms[:, row, band], result.band_line[:, row, band]
            label = f"{result.frequency_hz[band]:.0f} Hz"
            lines.append(Curve(x=at, y=line, rank=rank, width_px=1.2, pale=_PALE, label=label))
            lines.append(Curve(x=at, y=level, rank=rank, width_px=0.0))
            ends += [float(level.min()), float(level.max())]
    low, high = (min(ends), max(ends)) if ends else (0.1, 1.0)
    return Diagram(
        x=Axis(shown=(float(at[0]) / _EDGE, float(at[-1]) * _EDGE), title=unit.title, log=True),
        y=Axis(shown=(low / _EDGE, high * _EDGE), title="In the band (m/s²)", log=True),
        curves=tuple(lines),
    )


def diagrams_of_superposition(
    result: Superposition,
    rows: tuple[int, ...],
    time_s: Floats,
    zoom: tuple[float, float] | None,
) -> tuple[Diagram, ...]:
    """Return the sum below the joint response, and the one over the other."""
    both = np.stack((result.separate, result.joint))[:, rows]
    part = part_of(time_s, both, zoom)
    x, (separate, joint) = finer(time_s, both, *part)
    wide_px, narrow_px = (_width_over_time(x, width_px) for width_px in (_WIDEST_PX, _NARROWEST_PX))
    over = tuple(
        curve
        for rank in range(len(rows))
        for curve in (
            Curve(x=x, y=separate[rank], rank=rank, width_px=wide_px, pale=_PALE),
            Curve(x=x, y=joint[rank], rank=rank, width_px=narrow_px),
        )
    )
    visible = both[..., slice(*part)]
    against = tuple(
        Curve(x=visible[0, rank], y=visible[1, rank], rank=rank, width_px=0.0)
        for rank in range(len(rows))
    )
    axis = _symmetric_axis(both, "Joint (m/s²)")
    return (
        Diagram(x=_time_axis(x), y=_symmetric_axis(joint, "Sum and joint (m/s²)"), curves=over),
        Diagram(x=Axis(shown=axis.shown, title="Sum of separate (m/s²)"), y=axis, curves=against),
    )


def part_text(
    shown_s: tuple[float, float], time_s: Floats, zoom: tuple[float, float] | None = None
) -> str:
    """Return which part is drawn over time, where that is less than all, or than the zoom."""
    first, last = (f"{1e3 * edge_s:.0f}" for edge_s in shown_s)
    if zoom is not None:
        step_s = float(time_s[-1] - time_s[0]) / max(time_s.size - 1, 1)
        if min(zoom[1], float(time_s[-1])) - shown_s[1] < 1.5 * step_s:
            return ""
        return f"over the visible time, {first} to {last} ms: zoom Traces further in"
    if shown_s[0] <= time_s[0] and time_s[-1] <= shown_s[1]:
        return ""
    return f"over the loudest time, {first} to {last} ms: zoom Traces for another"


def proportion_text(result: Proportion, all_outputs: Straightness | None = None) -> str:
    """Return the result in a sentence."""
    difference = _difference_text(result.largest_difference)
    text = f"{len(result.strengths)} strengths, responses divided by them: {difference}"
    r2 = (result if all_outputs is None else all_outputs).adjusted_r2
    known, whose = r2[np.isfinite(r2)], "" if all_outputs is None else f" of all {len(r2)} outputs"
    if not known.size:  # A short response may have no frequency in the band of its limb.
        return text
    return f"{text} · adjusted R²{whose} in bands of 2 Hz ≥ {known.min():.6f}"


def superposition_text(result: Superposition) -> str:
    """Return the result in a sentence."""
    known = result.correlation[np.isfinite(result.correlation)]
    correlation = f" · r ≥ {known.min():.6f}" if known.size else ""
    difference = _difference_text(result.largest_difference)
    return f"Sum of separate responses (wide) and joint response (thin): {difference}{correlation}"


def _difference_text(difference: float) -> str:
    return f"differences up to {difference:.0e} of the peak" if difference else "no difference"


def _time_axis(x: Floats) -> Axis:
    margin_s = 0.0 if x.size > 1 else _MARGIN_OF_ONE_S
    shown = float(x[0]) - margin_s, float(x[-1]) + margin_s
    return Axis(shown=shown, title="Time (ms)", factor=1e3)


def _width_over_time(x: Floats, width_px: float) -> float:
    """Return the width of a line; one sample is a dot, which has none."""
    return width_px if x.size > 1 else 0.0


def _symmetric_axis(values: Floats, title: str) -> Axis:
    peak = float(np.abs(values).max()) or 1.0
    return Axis(shown=(-1.1 * peak, 1.1 * peak), title=title)


# So much higher than a line of letters is the place of a label, and so small they become.
_LINE_STEP, _LEAST_PART = 0.9, 0.6
# Never less of the frame is left to the curves.
_LEAST_OF_CURVES = 0.3


def x_with_room_for_labels(
    axes: Axes, curves: tuple[Curve, ...], metrics: QtGui.QFontMetricsF
) -> Axis:
    """Return the x axis, longer, so that the longest label fits behind the ends of the curves."""
    labelled = [curve for curve in curves if curve.label]
    if not labelled:
        return axes.x
    needed_px = max(metrics.horizontalAdvance(curve.label) for curve in labelled) + 4.0 * DOT_PX
    part = max(1.0 - needed_px / max(axes.frame.width(), 1.0), _LEAST_OF_CURVES)
    low, last = axes.x.shown[0], max(float(curve.x[-1]) for curve in labelled)
    high = low * (last / low) ** (1.0 / part) if axes.x.log else low + (last - low) / part
    return replace(axes.x, shown=(low, float(high)))


def places_of_labels(
    axes: Axes, curves: tuple[Curve, ...], font: QtGui.QFont
) -> tuple[QtGui.QFont, list[tuple[QRectF, Curve]]]:
    """Return where labels are written, and in which font.

    Labels that overlap are moved apart, in the order of their curves. Where the frame is too low
    for all, they are smaller; those that still do not fit are left out.
    """
    ends = [
        (float(y), float(x), curve)
        for curve in curves
        if curve.label
        for x, y in axes.to_screen(curve.x[-1:], curve.y[-1:])
        if np.isfinite(y)
    ]
    if not ends:
        return font, []
    frame = axes.frame
    metrics = QtGui.QFontMetricsF(font)
    fits = frame.height() / (_LINE_STEP * metrics.height() * len(ends))
    for _, x, curve in ends:
        room_px = frame.right() - x - 2.0 * DOT_PX
        fits = min(fits, room_px / (metrics.horizontalAdvance(curve.label) + 1.0))
    letters = scaled(font, max(fits, _LEAST_PART)) if fits < 1.0 else font
    line = QtGui.QFontMetricsF(letters).height()
    step = _LINE_STEP * line
    ends = sorted(ends[: max(int(frame.height() / step + 1e-6), 1)], key=lambda end: end[0])
    heights = _moved_apart([end[0] for end in ends], step, frame.top(), frame.bottom())
    return letters, [
        (QRectF(x + 2.0 * DOT_PX, y - line / 2, frame.right() - x - 2.0 * DOT_PX, line), curve)
        for y, (_, x, curve) in zip(heights, ends, strict=True)
    ]


def write_labels(
    painter: QtGui.QPainter, axes: Axes, curves: tuple[Curve, ...], theme: Theme
) -> None:
    """Write labels in the colours of their curves."""
    letters, places = places_of_labels(axes, curves, painter.font())
    painter.save()
    painter.setFont(letters)
    for room, curve in places:
        painter.setPen(colour_of(curve, theme))
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, curve.label)
    painter.restore()


def colour_of(curve: Curve, theme: Theme) -> QtGui.QColor:
    """Return the colour of the output of a curve, or that of text."""
    return QtGui.QColor(theme.text if curve.rank is None else theme.output_colour(curve.rank))


def _moved_apart(at: list[float], step: float, top: float, bottom: float) -> list[float]:
    """Return sorted places, moved apart no farther than needed, between two ends."""
    placed: list[float] = []
    for y in at:
        placed.append(max(y, placed[-1] + step if placed else top + step / 2))
    limit = bottom - step / 2
    for k in range(len(placed) - 1, -1, -1):
        placed[k] = min(placed[k], limit)
        limit = placed[k] - step
    return placed


# Where a diagram is narrower than so many lines its letters are smaller, down to a part and to px.
_LINES_WIDE, _DIAGRAM_LEAST_PART, _LEAST_PX = 10.0, 0.5, 11.0


class DiagramsPicture(Figure):
    """Diagrams side by side where there is room, else one above the other."""

    def __init__(self, name: str, accessible_name: str) -> None:
        super().__init__(name, accessible_name)
        self.diagrams: tuple[Diagram, ...] = ()
        self.outputs: tuple[int, ...] = ()
        #: Where each diagram begins, and its axes there.
        self.placed: list[tuple[QPointF, Axes]] = []

    def show_diagrams(self, diagrams: tuple[Diagram, ...], outputs: tuple[int, ...]) -> None:
        """Take over what to show, and the numbers of the outputs, in the order of their ranks."""
        self.diagrams, self.outputs = diagrams, outputs
        self.say("")

    def draw(self, painter: QtGui.QPainter, room: QRectF) -> None:
        head = room.adjusted(UNIT_PX, 0, -UNIT_PX, 0)
        head.setHeight(QtGui.QFontMetricsF(painter.font()).height())
        areas = _areas(room.adjusted(0, head.height(), 0, 0), len(self.diagrams))
        painter.setFont(font_in(areas, painter.font()))
        metrics = QtGui.QFontMetricsF(painter.font())
        draw_legend(painter, head, self.outputs, current_theme())
        self.placed = []
        for area, diagram in zip(areas, self.diagrams, strict=True):
            painter.save()
            # Labels of y begin at the left edge of their area.
            painter.translate(area.topLeft())
            inner = QRectF(QPointF(), area.size())
            axes = fitted_axes(inner, diagram.x, diagram.y, metrics)
            longer = x_with_room_for_labels(axes, diagram.curves, metrics)
            axes = fitted_axes(inner, longer, diagram.y, metrics)
            axes.paint(painter, current_theme())
            painter.setClipRect(axes.frame.adjusted(-DOT_PX, -DOT_PX, DOT_PX, DOT_PX))
            for curve in diagram.curves:
                _draw(painter, axes, curve, current_theme())
            write_labels(painter, axes, diagram.curves, current_theme())
            painter.restore()
            self.placed.append((area.topLeft(), axes))

    def read(self, at: QPointF) -> str:
        for origin, axes in self.placed:
            values = axes.value_at(at - origin)
            if values is not None:
                across, up = (
                    f"{axis.title}: {value * axis.factor:.4g}"
                    for axis, value in zip((axes.x, axes.y), values, strict=True)
                )
                return minus(f"{across} · {up}")
        return ""


def _areas(room: QRectF, count: int) -> list[QRectF]:
    """Return equal parts of a room, side by side where it is wide enough."""
    if room.width() >= room.height():
        wide = (room.width() - UNIT_PX * (count - 1)) / count
        return [
            QRectF(room.left() + k * (wide + UNIT_PX), room.top(), wide, room.height())
            for k in range(count)
        ]
    high = room.height() / count
    return [QRectF(room.left(), room.top() + k * high, room.width(), high) for k in range(count)]


def font_in(areas: list[QRectF], font: QtGui.QFont) -> QtGui.QFont:
    """Return the font, or a smaller readable one, in which numbers at axes have room."""
    wide = min((area.width() for area in areas), default=0.0)
    fits = wide / (_LINES_WIDE * QtGui.QFontMetricsF(font).height())
    least = max(_DIAGRAM_LEAST_PART, _LEAST_PX / QtGui.QFontInfo(font).pixelSize())
    return scaled(font, max(fits, least)) if max(fits, least) < 1.0 else font


def _draw(painter: QtGui.QPainter, axes: Axes, curve: Curve, theme: Theme) -> None:
    colour = colour_of(curve, theme)
    colour.setAlphaF(1.0 - curve.pale)
    if curve.width_px:
        pen = QtGui.QPen(colour, curve.width_px)
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        painter.setPen(pen)
        painter.drawPolyline(axes.polygon(curve.x, curve.y))
        return
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour)
    for x, y in axes.to_screen(curve.x, curve.y):
        if np.isfinite(x) and np.isfinite(y):
            painter.drawEllipse(QPointF(x, y), DOT_PX, DOT_PX)


_STORED_ALONE = "snapshots alone"


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedDesigns:
    """Designs, and how they relate to each other.

    Attributes
    ----------
    compared
        The designs that count.
    strengths
        Strength of each, where they differ in that alone; else empty.
    joint
        Which of them plays what all the others play; None: none does.
    note
        Which designs count, where it is not all of them.
    """

    compared: Sequence[Compared]
    strengths: tuple[float, ...] = ()
    joint: int | None = None
    note: str = ""

    @property
    def is_linear(self) -> bool:
        """Whether there is something to be held against each other."""
        return bool(self.strengths) or self.joint is not None


def compared_designs(compared: Sequence[Compared]) -> ComparedDesigns:
    """Return all designs, or the stored ones, where the edited one does not relate to them."""
    every_design = _compared_designs(compared)
    stored = [side for side in compared if side.snapshot.number != EDITED]
    if every_design.is_linear or len(stored) == len(compared):
        return every_design
    stored_alone = _compared_designs(stored, _STORED_ALONE)
    return stored_alone if stored_alone.is_linear else every_design


def _compared_designs(compared: Sequence[Compared], text: str = "") -> ComparedDesigns:
    designs = [side.snapshot.design for side in compared]
    return ComparedDesigns(
        compared=compared, strengths=strengths_of(designs), joint=joint_of(designs), note=text
    )


_Lines = list[Iterable[str | float]]


def table_text(
    result: Proportion | Superposition,
    outputs: tuple[int, ...],
    axes: tuple[str, ...],
    unit: StrengthUnit,
    *,
    bands: bool = False,
    all_outputs: Straightness | None = None,
) -> str:
    """Return a table of RMS by strength, output by band, R² of each output, or r of each channel.

    Channels are ``axes`` of each of ``outputs``; ``unit`` is that of strengths. With ``bands``
    outputs are listed in all bands; with ``all_outputs`` R² of all outputs is listed instead.
    """
    channels = [(output, axis) for output in outputs for axis in axes]
    lines: _Lines
    if isinstance(result, Proportion) and all_outputs is not None:
        lines = _straightness_table(all_outputs, axes)
    elif isinstance(result, Proportion):
        names = [f"{output}_{axis}" for output, axis in channels]
        lines = (_by_band if bands else _by_strength)(result, names, unit)
    else:
        lines = [("output", "axis", "pearson_r")]
        for (output, axis), r in zip(channels, result.correlation, strict=True):
            lines.append((str(output), axis, r))
    return tab_separated(lines)


def _straightness_table(all_outputs: Straightness, axes: tuple[str, ...]) -> _Lines:
    numbers = range(1, len(all_outputs.adjusted_r2) + 1)
    header = ("frequency_hz", *(f"adjusted_r2_{k}_{axis}" for k in numbers for axis in axes))
    of_channels = all_outputs.adjusted_r2.reshape(-1, all_outputs.frequency_hz.size)
    return [header, *np.column_stack((all_outputs.frequency_hz, of_channels.T))]


def _by_strength(result: Proportion, channels: list[str], unit: StrengthUnit) -> _Lines:
    header = (unit.column, *(f"rms_{channel}_m_per_s2" for channel in channels))
    return [header, *np.column_stack((result.strengths * unit.si_factor, result.rms))]


def _by_band(result: Proportion, channels: list[str], unit: StrengthUnit) -> _Lines:
    strengths = [f"{unit.column} {strength:.6g}" for strength in result.strengths * unit.si_factor]
    of_strengths = [
        f"band_rms_{channel}_m_per_s2 at {at}" for at in strengths for channel in channels
    ]
    header = ("frequency_hz", *of_strengths, *(f"adjusted_r2_{channel}" for channel in channels))
    band_rms = result.band_rms.reshape(-1, result.frequency_hz.size)
    return [header, *np.column_stack((result.frequency_hz, band_rms.T, result.adjusted_r2.T))]


_NEEDS = frozenset(
    {
        "axis_traces",
        "delay_removed",
        "fastest_probe_m_per_s",
        "record_samples",
        "response_time_s",
        "sample_rate_hz",
        "shown_outputs",
    }
)
_BAND_RMS = "output_band_rms"
_TOO_MUCH = "Too long to show here; File > Check against a recording… checks linearity"
# More values would take too long to draw.
_MOST_VALUES = 2_000_000


class LinearityView(FigureView):
    """Whether outputs grow in step with the strength, and whether inputs add up."""

    name: ClassVar[str] = "linearity"
    compares: ClassVar[bool] = True

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        self.picture = DiagramsPicture("linearity_picture", "Linearity of snapshots")
        super().__init__(self.picture, parent)
        self.settings = LinearitySettings()
        self._unit = of_amplitudes("")
        self._drawn: tuple[Any, ...] = ()
        self._outputs: tuple[int, ...] = ()
        self._axes: tuple[str, ...] = ()
        self.result: Proportion | Superposition | None = None
        self.all_outputs: Straightness | None = None
        self.about = self.add_above("linearity_about")
        self.about.setToolTip("Snapshots as stored; over time, the part to which Traces is zoomed")
        self.velocity = self._new_switch("velocity", VELOCITY)
        self.bands = self._new_switch("bands", BANDS)
        self.every_output = self._new_switch("every_output", EVERY_OUTPUT)
        self._switches = self.velocity, self.bands, self.every_output
        self.choices.addWidget(FoldingRow(self._switches, UNIT_PX // 2, left=True), 1)
        self.heads.addWidget(self.about)
        self.say_instead(_how_to_start())

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        if not self._view.outputs:
            return frozenset()
        return _NEEDS | {_BAND_RMS} if self.settings.every_output else _NEEDS

    def snapshots_drawn(self, snapshots: Sequence[Snapshot]) -> Sequence[Snapshot]:
        designs = compared_designs([Compared(snapshot=snapshot) for snapshot in snapshots])
        return [side.snapshot for side in designs.compared]

    def show_state(self, design: Design, view: View) -> None:
        self._view, self.settings = view, settings_of(view, self.name, LinearitySettings)
        self.velocity.setChecked(self.settings.velocity)
        self.bands.setChecked(self.settings.bands)
        self.every_output.setChecked(self.settings.every_output)
        self.show_selection(view)

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        designs = compared_designs(compared)
        problem = next((side.problem for side in designs.compared if side.problem), "")
        needed = self.needs_of_snapshots
        known = [side.values for side in designs.compared if side.values is not None]
        # A switch may need more than what was found before it: that is on its way.
        complete = [values for values in known if needed <= values.keys()]
        if not designs.is_linear:
            self.say_instead(_how_to_start())
        elif problem:
            self.say_instead(problem)
        elif len(complete) < len(designs.compared):
            if self.result is None:
                self.await_results()
            else:
                self.show_stale(True)
        else:
            settings, view = self.settings, self._view
            switched = settings.velocity, settings.bands, settings.every_output, designs.note
            how = view.time_range_s, view.delay_removed, *switched
            if not self._is_drawn((*how, *(values["axis_traces"] for values in complete))):
                self._show(designs, complete)
            self.show_stale(False)

    def show_problem(self, reason: str) -> None:
        """Do nothing: snapshots have problems of their own, see `show_snapshots`."""

    def say_instead(self, message: str) -> None:
        self._drawn, self.result, self.all_outputs = (), None, None
        self.show_stale(False)
        super().say_instead(message)
        self.about.say("")
        for switch in self._switches:
            switch.hide()

    def table_text(self) -> str:
        if self.result is None:
            return ""
        unit, bands = self._unit, self.settings.bands
        all_outputs = self.all_outputs
        return table_text(
            self.result, self._outputs, self._axes, unit, bands=bands, all_outputs=all_outputs
        )

    def _is_drawn(self, drawn: tuple[Any, ...]) -> bool:
        same = len(drawn) == len(self._drawn) and all(
            part is other for part, other in zip(drawn, self._drawn, strict=True)
        )
        if not same:
            self._drawn = drawn
        return same

    def _new_switch(self, setting: str, spec: SwitchSpec) -> QtWidgets.QToolButton:
        """Return a switch above the diagrams, which is only about strengths."""
        name = f"linearity_{spec.label.split()[-1].replace('/', '_')}"
        switch = tool_button(None, name, spec.label, spec.hint, checkable=True)
        switch.clicked.connect(lambda on: self.change_settings(**{setting: on}))
        switch.hide()
        return switch

    def _show(self, designs: ComparedDesigns, results: Sequence[Mapping[str, Any]]) -> None:
        """Draw what is known of all designs."""
        drawn, design = self._drawn, designs.compared[0].snapshot.design
        strengths, joint = designs.strengths, designs.joint
        traces = [result["axis_traces"] for result in results]
        n_outputs, n_axes, _ = traces[0].shape
        if sum(trace.size for trace in traces) > _MOST_VALUES:
            self.say_instead(_TOO_MUCH)
            return
        channels = [trace.reshape(n_outputs * n_axes, -1) for trace in traces]
        if not all(channel.any() for channel in channels):
            self.say_instead(SILENT)
            return
        axes, limb = axes_on(design.limb, self._view.axes), facts_of(design.limb)
        along = "z" if "z" in axes else axes[0]
        rows = tuple(axes.index(along) + n_axes * rank for rank in range(n_outputs))
        zoom, longest = self._view.time_range_s, results[joint or 0]
        self._outputs, self._axes = longest["shown_outputs"], tuple(axes)
        time_s = self._time_s(longest, limb.pre_trigger_delay_s)
        if strengths:
            rate_hz, record_samples = longest["sample_rate_hz"], longest["record_samples"]
            self.result = shown = proportion(
                strengths, np.stack(channels), rate_hz, limb.band_hz, record_samples
            )
            fastest = results[0]["fastest_probe_m_per_s"]
            self.velocity.setVisible(bool(fastest))
            factors = any(is_gain(design, track) for track in design.inputs)
            self._unit = of_amplitudes("×" if factors else amplitude_unit(design))
            if fastest and self.settings.velocity:
                self._unit = of_velocities(fastest / strengths[0])
            self.all_outputs = (
                _straightness(strengths, results) if self.settings.every_output else None
            )
            drawing = diagrams_of_proportion(
                shown,
                rows,
                time_s,
                zoom,
                self._unit,
                bands=self.settings.bands,
                all_outputs=None
                if self.all_outputs is None
                else self.all_outputs.adjusted_r2[:, axes.index(along)],
            )
            self.picture.show_diagrams(drawing, self._outputs)
            self.show_result(proportion_text(shown, self.all_outputs))
        elif joint is not None:
            self.velocity.hide()
            parts = [channel for k, channel in enumerate(channels) if k != joint]
            self.result = added = superposition(parts, channels[joint])
            drawing = diagrams_of_superposition(added, rows, time_s, zoom)
            self.picture.show_diagrams(drawing, self._outputs)
            self.show_result(superposition_text(added))
        self.bands.setVisible(bool(strengths))
        self.every_output.setVisible(bool(strengths))
        self._drawn = drawn
        self.offer_copy(True)
        notes = [f"Along {along}: linear by construction", designs.note]
        notes.append("synthetic limb" * limb.synthetic)
        notes.append(part_text(drawing[0].x.shown, time_s, zoom))
        self.about.say(" · ".join(filter(None, notes)))

    def _time_s(self, results: Mapping[str, Any], delay_s: float) -> Floats:
        """Return the times on the time axes of the window, (n_times,), s.

        Results of the window are up to date with the delay that is removed; those of snapshots are
        not, as nothing else of them depends on it.
        """
        time_s: Floats = results["response_time_s"]
        return time_s + delay_s * (int(results["delay_removed"]) - int(self._view.delay_removed))


def _straightness(
    strengths: Sequence[float], results: Sequence[Mapping[str, Any]]
) -> Straightness | None:
    """Return how straight all outputs are; None: they are too long to be transformed at once."""
    in_bands = [result[_BAND_RMS] for result in results]
    return None if any(levels is None for levels in in_bands) else straightness(strengths, in_bands)


def _how_to_start() -> str:
    """Return what to store, where designs are neither strengths nor a sum."""
    first, last = (shortcut_text(f"store_snapshot_{number}") for number in (1, NUMBERS[-1]))
    return (
        "Store one stimulus at three strengths or more, or inputs alone and all of them together, "
        f"with {first} to {last}: the panel shows whether responses scale linearly and superpose"
    )
