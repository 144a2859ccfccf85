"""The diagrams and sentences of proportions and superpositions, and the widget that paints them."""

from dataclasses import dataclass, replace

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPointF, QRectF, Qt

from skinsource.base.arrays import Floats
from skinsource.signals.analysis.statistics import BIN_HZ
from skinsource.signals.resampling import finer
from skinsource.studies.checking import Proportion, Straightness, Superposition
from skinsource_gui.fields.units import minus
from skinsource_gui.plots.figure import Axes, Axis, Figure, draw_legend, fitted_axes
from skinsource_gui.qt.theme import UNIT_PX, Theme, current_theme, scaled

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

    @property
    def divided_by(self) -> str:
        """Unit of a response, in m/s², that is divided by a strength."""
        return f"m/s² per {self.symbol}" if self.symbol else "m/s²"


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
# Bands that are drawn one by one, and the margin of logarithmic axes, as a factor.
_SHOWN_HZ = (50.0, 100.0, 200.0, 400.0)
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


def bands_shown(result: Proportion) -> list[int]:
    """Return the bands that are drawn one by one: those at the frequencies of the figure."""
    gaps_hz = np.abs(result.frequency_hz - np.array(_SHOWN_HZ)[:, None])
    return [int(gap_hz.argmin()) for gap_hz in gaps_hz if gap_hz.size and gap_hz.min() <= BIN_HZ]


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
    axis = _symmetric_axis(y, f"Normalised ({unit.divided_by})")
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
        for band in bands_shown(result):
            level, line = result.band_rms[:, row, band], result.band_line[:, row, band]
            if level.min() <= 0.0 or line.min() <= 0.0:
                continue  # silent there
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
    result: Superposition, rows: tuple[int, ...], time_s: Floats, zoom: tuple[float, float] | None
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

    def __init__(
        self, name: str, accessible_name: str, parent: QtWidgets.QWidget | None = None
    ) -> None:
        super().__init__(name, accessible_name, parent)
        self.diagrams: tuple[Diagram, ...] = ()
        self.outputs: tuple[int, ...] = ()
        #: Where each diagram begins, and its axes there.
        self.placed: list[tuple[QPointF, Axes]] = []

    def show_diagrams(self, diagrams: tuple[Diagram, ...], outputs: tuple[int, ...]) -> None:
        """Take over what to show, and the numbers of the outputs, in the order of their ranks."""
        self.diagrams, self.outputs = diagrams, outputs
        self.say("")
        self.read_again()

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
