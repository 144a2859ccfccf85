"""The diagrams and sentences of a proportion or of a superposition, and the panel's settings."""

from dataclasses import dataclass

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.signals.analysis.statistics import BIN_HZ
from skinsource.signals.resampling import finer
from skinsource.studies.checking import Proportion, Straightness, Superposition
from skinsource_gui.plots.figure import Axis

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
    title, straightness = "Adjusted R²", _straightness_dots(result, rows)
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


def _straightness_dots(result: Proportion, rows: tuple[int, ...]) -> tuple[Curve, ...]:
    return tuple(
        Curve(x=result.frequency_hz, y=result.adjusted_r2[row], rank=rank, width_px=0.0)
        for rank, row in enumerate(rows)
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
    widths = np.linspace(_WIDEST_PX, _NARROWEST_PX, n)
    over = tuple(
        Curve(
            x=x, y=y[k, rank], rank=rank, width_px=_width_over_time(x, widths[k]), pale=_pale(k, n)
        )
        for rank in range(len(rows))
        for k in range(n)
    )
    axis = _symmetric_axis(y, f"Divided ({unit.divided_by})")
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
        y=Axis(shown=(0.0, _top(result.rms[:, rows])), title="RMS (m/s²)"),
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
        Diagram(x=_time_axis(x), y=_symmetric_axis(joint, "Both (m/s²)"), curves=over),
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
    text = f"{len(result.strengths)} strengths, divided by them: {difference}"
    r2 = (result if all_outputs is None else all_outputs).adjusted_r2
    known, whose = r2[np.isfinite(r2)], "" if all_outputs is None else f" of all {len(r2)} outputs"
    if not known.size:  # A short response may have no frequency in the band of its limb.
        return text
    return f"{text} · adjusted R²{whose} in bands of 2 Hz {known.min():.6f} at least"


def superposition_text(result: Superposition) -> str:
    """Return the result in a sentence."""
    known = result.correlation[np.isfinite(result.correlation)]
    correlation = f" · r {known.min():.6f} at least" if known.size else ""
    difference = _difference_text(result.largest_difference)
    return f"Sum of separate and joint, wide and thin: {difference}{correlation}"


def _difference_text(difference: float) -> str:
    return f"differences up to {difference:.0e} of the peak" if difference else "no difference"


def _pale(k: int, n: int) -> float:
    """Return how pale line ``k`` of ``n`` is: the widest one is palest, so that all are visible."""
    return 0.75 * (1.0 - k / (n - 1))


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


def _top(values: Floats) -> float:
    return 1.1 * float(values.max()) or 1.0
