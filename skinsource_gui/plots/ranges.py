"""Ranges and ticks of axes, numbers and units on them, and the points that draw a curve.

Ranges of values stay while data change; the user zooms and pans the x axis.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial
from math import ceil, floor, isfinite, log10
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from skinsource.base.conventions import Floats
from skinsource.base.decibels import FLOOR_DB
from skinsource.signals.resampling import Extremes, extremes_between, finer

Range = tuple[float, float]
#: ``"amplitude"``: linear, includes zero; ``"level"``: dB, 80 dB from top to bottom;
#: ``"relative"``: parts of peaks, without a unit.
Kind = Literal["amplitude", "level", "relative"]

#: Time begins so long before the pulse of the measurement: the filter of its drive rings.
BEFORE_S = 0.005
LEVEL_SPAN_DB = 80.0
_LEVEL_STEP_DB = 5.0
# A level range is left only for data that lie this far below its top (60 % are -4.4 dB).
_LEVEL_SLACK_DB = 10.0
# Tops of amplitude ranges: coarse enough that growing data seldom move the ticks.
_TOPS = (1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0, 6.4, 8.0, 10.0)
_SHRINK_BELOW = 0.6
# Curves that are relative to their peaks reach 1, and waves between samples a little more.
_RELATIVE_TOP = 1.1
_HEADROOM = 1.02


class SteadyRange:
    """Range of a value axis that follows its data without flicker.

    The range grows at once, and shrinks only when the data need less than 60 % of it.
    """

    def __init__(self) -> None:
        self._kind: Kind | None = None
        self._range: Range = (0.0, 1.0)

    def follow(self, low: float, high: float, kind: Kind) -> Range:
        """Return the range for data from ``low`` to ``high``.

        Amplitudes: ``(0, top)`` for data that are never negative, else ``(-top, top)``.
        Levels: ``(top - 80, top)``.  Silence does not change the range.
        """
        needed = _needed_range(low, high, kind)
        if kind != self._kind or not self._still_fits(low, high, needed):
            self._range = needed
        self._kind = kind
        return self._range

    def reset(self) -> None:
        """Decide the next range by its data alone."""
        self._kind, self._range = None, (0.0, 1.0)

    def _still_fits(self, low: float, high: float, needed: Range) -> bool:
        held_low, held_high = self._range
        if self._kind == "level":
            if high <= FLOOR_DB:
                return True
            return needed[1] <= held_high <= needed[1] + _LEVEL_SLACK_DB
        if low == high == 0:
            return True
        if (held_low < 0) != (needed[0] < 0):
            return False
        return max(high, -low) <= held_high and needed[1] >= _SHRINK_BELOW * held_high


def _needed_range(low: float, high: float, kind: Kind) -> Range:
    if kind == "level":
        top = ceil(high / _LEVEL_STEP_DB) * _LEVEL_STEP_DB if high > FLOOR_DB else 0.0
        return (top - LEVEL_SPAN_DB, top)
    peak = max(high, -low)
    if kind == "relative" and peak <= _RELATIVE_TOP:
        top = _RELATIVE_TOP
    else:
        top = _round_up(peak * _HEADROOM) if peak > 0 else 1.0
    return (-top if low < 0 else 0.0, top)


def _round_up(value: float) -> float:
    decade = 10.0 ** floor(log10(value))
    # At the edge of the floats there is no decade to multiply.
    if not isfinite(10.0 * decade) or decade == 0:
        return value
    return next((top * decade for top in _TOPS if top * decade >= value), 10.0 * decade)


def zoomed(shown: Range, anchor: float, factor: float) -> Range:
    """Return ``shown`` made ``factor`` times narrower around ``anchor``, which stays in place."""
    low, high = shown
    return (anchor - (anchor - low) / factor, anchor + (high - anchor) / factor)


def within(wanted: Range, extent: Range, shortest: float = 0.0) -> Range | None:
    """Return ``wanted`` moved and cut to lie in ``extent``; None where it covers all of that.

    The range has at least the length ``shortest``.
    """
    low, high = wanted
    length = max(high - low, shortest)
    if length >= (extent[1] - extent[0]) * (1 - 1e-9):
        return None
    low -= (length - (high - low)) / 2
    low = min(max(low, extent[0]), extent[1] - length)
    return (low, low + length)


_MINUS = "\u2212"
_THIN_SPACE = "\u202f"
_STEPS = (1.0, 2.0, 5.0, 10.0)
_MAX_TICKS = 40
# Axes are painted far more often than they change.
_CACHED_TICKS = 256


@dataclass(frozen=True, slots=True, kw_only=True)
class Tick:
    """A grid line at ``value``, with a label or (``""``) without."""

    value: float
    label: str


@lru_cache(_CACHED_TICKS)
def linear_ticks(low: float, high: float, most: float, factor: float = 1.0) -> tuple[Tick, ...]:
    """Return about ``most`` ticks or fewer on round numbers; labels are values times ``factor``."""
    low, high = low * factor, high * factor
    length = high - low
    if not (isfinite(length) and length > 0) or most < 1:
        return ()
    step = round_step(length / min(most, _MAX_TICKS))
    decimals = max(0, -floor(log10(step) + 1e-9))
    first, last = ceil(low / step - 1e-6), floor(high / step + 1e-6)
    return tuple(
        Tick(value=k * step / factor, label=number_text(k * step, decimals))
        for k in range(first, last + 1)
    )


def readable_ticks(
    low: float, high: float, airy: float, dense: float, factor: float = 1.0
) -> tuple[Tick, ...]:
    """Return at least two ticks: one alone does not tell the scale of an axis.

    There are up to about ``airy`` ticks on round numbers; if these are fewer than two, up to
    ``dense``; if these are still too few, both ends of the axis are labelled.
    """
    for most in (airy, dense):
        ticks = linear_ticks(low, high, most, factor)
        if len(ticks) > 1:
            return ticks
    length = (high - low) * factor
    if not (isfinite(length) and length > 0):
        return ()
    decimals = max(0, 2 - floor(log10(length) + 1e-9))
    while decimals and all(_is_round(value * factor, decimals - 1) for value in (low, high)):
        decimals -= 1
    return tuple(
        Tick(value=value, label=number_text(value * factor, decimals)) for value in (low, high)
    )


@lru_cache(_CACHED_TICKS)
def log_ticks(low: float, high: float, most: float) -> tuple[Tick, ...]:
    """Return grid lines at 1 to 9 times each power of ten, with labels where there is room."""
    decades = log10(high / low)
    every = (1, 2, 5) if most >= 3 * decades else (1,)
    ticks = [
        Tick(value=digit * 10.0**power, label=number_text(digit * 10.0**power, max(0, -power)))
        for power in range(floor(log10(low)), ceil(log10(high)) + 1)
        for digit in range(1, 10)
        if low * (1 - 1e-9) <= digit * 10.0**power <= high * (1 + 1e-9)
    ]
    labelled = [tick for tick in ticks if _first_digit(tick.value) in every]
    if len(labelled) < 3:
        return linear_ticks(low, high, most)
    return tuple(tick if tick in labelled else Tick(value=tick.value, label="") for tick in ticks)


def number_text(value: float, decimals: int) -> str:
    """Return ``value`` with a true minus sign and thin spaces between thousands, as "1 200".

    Very large and very small values have an exponent.
    """
    if value != 0 and (decimals > 6 or abs(value) >= 1e7):
        text = f"{value:.1e}"
    else:
        text = f"{value:,.{min(decimals, 6)}f}"
    if not any(digit in text for digit in "123456789"):
        text = text.removeprefix("-")
    return text.replace("-", _MINUS).replace(",", _THIN_SPACE)


def _is_round(value: float, decimals: int) -> bool:
    return abs(value - round(value, decimals)) < 1e-9 * max(abs(value), 1e-300)


def round_step(least: float) -> float:
    """Return the smallest of 1, 2, 5, 10 … times a power of ten that is at least ``least``."""
    decade = 10.0 ** floor(log10(least))
    return next(step * decade for step in _STEPS if step * decade >= least * (1 - 1e-9))


def _first_digit(value: float) -> int:
    return round(value / 10.0 ** floor(log10(value) + 1e-9))


def significant(value: float, digits: int = 3) -> str:
    """Return ``value`` with ``digits`` significant digits: "0.0312", "12.3", "1 230"."""
    if value == 0.0 or not isfinite(value):
        return number_text(value, 0)
    return number_text(value, max(digits - 1 - floor(log10(abs(value))), 0))


#: Up to so many visible samples, the extremes of the wave between them are computed while drawing;
#: of more, each takes only a part of a pixel, and straight lines do.
MOST_WHILE_DRAWN = 2**16


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Wave:
    """The course of curves between their points, which are counted from 0.

    Attributes
    ----------
    points
        Returns ``x`` and ``y`` of the wave from point ``first`` to before ``end``, with the points.
    extremes
        Returns the extremes between neighbouring points from ``first`` to before ``end``; None for
        too many points.
    """

    points: Callable[[int, int], tuple[Floats, Floats]]
    extremes: Callable[[int, int], Extremes | None]


def wave_of(time_s: Floats, signals: Floats) -> Wave:
    """Return the wave of signals, (n_curves, n_times), for drawing."""
    return Wave(points=partial(finer, time_s, signals), extremes=partial(_extremes, signals))


def _extremes(signals: Floats, first: int, end: int) -> Extremes | None:
    if end - first > MOST_WHILE_DRAWN:
        return None
    return extremes_between(signals, first, end)


_READING_DIGITS = 4
# Room for a label on the x axis and the gap beside it.
_TICK_PX = 60.0
# The same where there would otherwise not be two labels.
_CLOSE_TICK_PX = 36.0


@dataclass(frozen=True, slots=True, kw_only=True)
class XAxis:
    """The axis that all curves share.

    Attributes
    ----------
    titles
        Versions of the title, longest first; the first that fits is written.
    unit, factor, decimals
        Unit of ticks and readings; factor from SI to it; decimals of readings.
    extent
        Whole range, in SI; None: that of the data.
    log
        Whether it is logarithmic; needs an ``extent`` above zero.
    band
        The rest of the axis is shaded; None: nothing is.
    column
        Name of its column in a table.
    hint
        What to know about it; in its tooltip only.
    """

    titles: tuple[str, ...]
    unit: str
    factor: float = 1.0
    decimals: int = 1
    extent: Range | None = None
    log: bool = False
    band: Range | None = None
    column: str = "x"
    hint: str = ""

    def position(self, value: float) -> float:
        """Return the position of ``value``: its logarithm on a logarithmic axis."""
        return log10(value) if self.log else value

    def value(self, position: float) -> float:
        """Return the value at ``position``."""
        return 10.0**position if self.log else position

    def positions(self, values: Floats) -> Floats:
        """Return the positions of ``values``; NaN for what a logarithmic axis cannot show."""
        if not self.log:
            return values
        return np.log10(values, out=np.full(values.shape, np.nan), where=values > 0)

    def ticks(self, low: float, high: float, width_px: float) -> tuple[Tick, ...]:
        """Return the ticks between two positions ``width_px`` apart; their values are positions."""
        most = max(width_px / _TICK_PX, 2)
        if not self.log:
            return readable_ticks(low, high, most, width_px / _CLOSE_TICK_PX, self.factor)
        return tuple(
            Tick(value=self.position(tick.value), label=tick.label)
            for tick in log_ticks(self.value(low), self.value(high), most)
        )

    def reading(self, value: float) -> str:
        """Return ``value`` with its unit."""
        return f"{number_text(value * self.factor, self.decimals)} {self.unit}"


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueUnit:
    """How values are written: multiplied by ``factor``, followed by ``symbol``."""

    factor: float
    symbol: str
    decimals: int

    def reading(self, value: float) -> str:
        """Return ``value`` without its unit, always with the same number of decimals."""
        return number_text(value * self.factor, self.decimals)


def value_unit(kind: Kind, low: float, high: float) -> ValueUnit:
    """Return a readable unit for a range of m/s², of levels or of parts of a peak."""
    if kind == "level":
        return ValueUnit(factor=1.0, symbol="dB", decimals=1)
    if kind == "relative":
        return ValueUnit(factor=1.0, symbol="of its peak", decimals=3)
    top = max(high, -low)
    factor, symbol = next(
        (
            (factor, symbol)
            for least, factor, symbol in (
                (1e5, 1e-3, "km/s²"),
                (1e-2, 1.0, "m/s²"),
                (1e-5, 1e3, "mm/s²"),
                (1e-8, 1e6, "µm/s²"),
            )
            if least <= top * (1 + 1e-9)
        ),
        (1e9, "nm/s²"),
    )
    whole_digits = floor(log10(top * factor) + 1e-9) + 1 if top > 0 else 1
    return ValueUnit(
        factor=factor, symbol=symbol, decimals=min(max(_READING_DIGITS - whole_digits, 0), 6)
    )


#: More rows than these would be too thin to read.
MOST_ROWS = 12
#: Room above and below the curve where there are several rows, as a part of the height of a row.
EDGE = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueScale:
    """Maps values to heights in a row: 0 at its bottom, 1 at its top.

    The view boxes of rows show heights: values from 1e-300 to 1e300 m/s² do not overflow on the way
    to pixels, and a new range changes labels only.

    Attributes
    ----------
    values
        Range of values of the row.
    edge
        Room above and below them, as a part of the row.
    """

    values: Range
    edge: float = 0.0

    def heights(self, values: Floats) -> Floats:
        """Return the heights of ``values``; those outside the range stay at its ends."""
        low, high = self.values
        part = np.clip((values - low) / (high - low), 0.0, 1.0)
        return self.edge + (1 - 2 * self.edge) * part

    def height(self, value: float) -> float:
        """Return the height of one value."""
        return float(self.heights(np.asarray(value)))


def row_count(n_curves: int, *, stacked: bool) -> int:
    """Return the number of rows in which ``n_curves`` are drawn."""
    return min(n_curves, MOST_ROWS) if stacked else 1


@dataclass(frozen=True, slots=True, kw_only=True)
class XWindow:
    """Visible part of an x axis.

    Attributes
    ----------
    extent, shown
        The whole axis, and the visible part, as positions (see `XAxis.position`).
    """

    axis: XAxis
    extent: Range
    shown: Range

    @property
    def band(self) -> Range | None:
        """Positions of the ends of the axis's band."""
        band = self.axis.band
        return None if band is None else (self.axis.position(band[0]), self.axis.position(band[1]))

    def part(self, position: float) -> float:
        """Return where ``position`` lies: 0 at the left of the visible part, 1 at its right."""
        low, high = self.shown
        return (position - low) / (high - low)

    def position(self, part: float) -> float:
        """Return the position at a part of the visible width."""
        low, high = self.shown
        return low + part * (high - low)

    def values(self, shown: Range) -> Range:
        """Return a range of positions in SI."""
        return (self.axis.value(shown[0]), self.axis.value(shown[1]))


def x_window(axis: XAxis, data: Range, zoom: Range | None) -> XWindow:
    """Return the window on ``data``, (first, last); ``zoom`` in SI, None: everything."""
    extent = _positions(axis, axis.extent if axis.extent is not None else data)
    if zoom is None or (axis.log and zoom[1] <= axis.value(extent[0])):
        return XWindow(axis=axis, extent=extent, shown=extent)
    if axis.log:
        zoom = (max(zoom[0], axis.value(extent[0])), zoom[1])
    return XWindow(axis=axis, extent=extent, shown=_positions(axis, zoom))


def _positions(axis: XAxis, values: Range) -> Range:
    low, high = axis.position(values[0]), axis.position(values[1])
    return (low, high) if high > low else (low, low + 1.0)


#: Up to so many samples in a column of pixels, each is drawn; more where waves turn seldom.
MOST_IN_COLUMN, _MOST_OF_WAVES = 4, 8
# A wave that turns more often in a column cannot be told from the block between its crests.
_MOST_TURNS = 0.85
# Heights between 0 and the peak that look different.
_SEEN_STEPS = 100
# A stroke that is shorter than this part of what its neighbours cover is a gap, not a notch.
_GAP = 0.1
# Rounding errors of extremes, as a part of the peak.
_ROUNDING = 1e-6
# Zero lies on the edge or in the middle of a row of pixels; with this shift rounding cannot move
# it.
_SHIFT = 0.02
# At this part of a row, strokes and level lines are painted in the same row.
_INSIDE = 0.25


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Points:
    """Points that draw curves.

    Attributes
    ----------
    x : (n,)
    y : (n_curves, n)
    strokes
        Whether points come in pairs, the ends of one vertical stroke for each column of pixels.
    """

    x: Floats
    y: Floats
    strokes: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Columns:
    """The samples of an axis in each column of pixels; the same for all curves over the axis.

    Attributes
    ----------
    part
        The visible samples.
    x : (n,)
        Places of these samples.
    places : (2 * n_columns,)
        x of two points for each column that contains samples; none where each sample is drawn.
    starts : (n_columns,)
        First sample of each such column, counted in the part; None where each sample is drawn.
    """

    part: slice
    x: Floats
    places: Floats
    starts: NDArray[np.intp] | None = None

    def points(self, y: Floats) -> Points:
        """Return the points that draw curves, (n_curves, n_points), over the axis."""
        y = y[:, self.part]
        if self.starts is None or self._shows_waves(y, self.starts.size):
            return Points(x=self.x, y=y)
        low = np.minimum.reduceat(y, self.starts, axis=1)
        high = np.maximum.reduceat(y, self.starts, axis=1)
        return Points(x=self.places, y=_strokes(low, high), strokes=True)

    def reached(self, y: Floats, extremes: Extremes) -> Points:
        """Return the points that draw the wave through curves, (n_curves, n_points).

        Where each sample is drawn, a crest is drawn at the sample beside it, at most half a sample
        away.  ``extremes`` are those of the part.
        """
        y = y[:, self.part]
        if self.starts is None or self._shows_waves(y, self.starts.size):
            return Points(x=self.x, y=_with_crests(y, extremes))
        return Points(x=self.places, y=_strokes(*extremes.of_columns(self.starts)), strokes=True)

    def _shows_waves(self, y: Floats, n_columns: int) -> bool:
        """Return whether samples show waves that columns of pixels would blur."""
        if self.x.size > _MOST_OF_WAVES * n_columns:
            return False
        # Of turns too small to be seen, as those in silence, there may be any number.
        peak = max(float(np.abs(y).max()), np.finfo(float).tiny)
        seen = np.round(y / peak * _SEEN_STEPS)
        rising = seen[:, 1:] > seen[:, :-1]
        turns = int(np.count_nonzero(rising[:, 1:] != rising[:, :-1]))
        return turns <= _MOST_TURNS * n_columns * len(y)


def _with_crests(y: Floats, extremes: Extremes) -> Floats:
    """Return samples, of which those beside a crest of the wave are as high as the crest."""
    low, high = extremes.low[:, :-1] * extremes.sizes, extremes.high[:, :-1] * extremes.sizes
    rounding = _ROUNDING * extremes.sizes
    left, right, values = y[:, :-1], y[:, 1:], y.flatten()
    dips = low < np.minimum(left, right) - rounding
    crests = high > np.maximum(left, right) + rounding
    # The neighbour that is nearer in height takes the value of the crest.
    for beyond, reached, further, of_two in (
        (dips, low, right < left, np.minimum),
        (crests, high, right > left, np.maximum),
    ):
        at = np.flatnonzero(beyond)
        beside = at + at // left.shape[1] + further.ravel()[at]
        of_two.at(values, beside, reached.ravel()[at])
    return values.reshape(y.shape)


def _strokes(low: Floats, high: Floats) -> Floats:
    """Return strokes of columns, (n_curves, 2 n_columns): up in one and down in the next.

    This keeps the lines between strokes short, which are painted too.
    """
    ends = np.empty((*low.shape, 2))
    ends[:, ::2, 0], ends[:, ::2, 1] = low[:, ::2], high[:, ::2]
    ends[:, 1::2, 0], ends[:, 1::2, 1] = high[:, 1::2], low[:, 1::2]
    return ends.reshape(len(low), -1)


def columns_of(x: Floats, shown: Range, width_px: int) -> Columns:
    """Return the columns of the visible part, with one more sample at each side.

    Parameters
    ----------
    x : (n_points,)
        Rising.
    shown
        Visible part of ``x``.
    width_px
        How many columns of pixels show it.
    """
    first = max(int(np.searchsorted(x, shown[0])) - 1, 0)
    last = min(int(np.searchsorted(x, shown[1], side="right")) + 1, x.size)
    part, x = slice(first, last), x[first:last]
    if x.size <= max(MOST_IN_COLUMN * width_px, 2):
        return Columns(part=part, x=x, places=x[:0])
    low, column = shown[0], (shown[1] - shown[0]) / max(width_px, 1)
    edges = low + column * np.arange(max(width_px, 1) + 1)
    starts = np.searchsorted(x, edges)
    starts = np.concatenate(([0], np.minimum(starts, x.size - 1)))
    starts = starts[np.diff(starts, prepend=-1) > 0]
    # A stroke in the middle of its column is sharp; a single sample keeps its place.
    alone = np.diff(starts, append=x.size) == 1
    # (A division could round a sample on an edge into the column before.)
    columns = np.searchsorted(edges, x[starts], side="right") - 1
    middles = low + column * (columns + 0.5)
    places = np.repeat(np.where(alone, x[starts], middles), 2)
    return Columns(part=part, x=x, places=places, starts=starts)


def in_rows(y_px: Floats, ratio: float) -> Floats:
    """Return heights moved into rows of pixels, of which ``ratio`` make 1 px.

    Without antialiasing, a level line between two rows would jump from one to the other.
    """
    return (np.floor(y_px * ratio + _SHIFT) + _INSIDE) / ratio


def without_notches(strokes: Floats) -> Floats:
    """Return strokes with notches of one column in their edges filled.

    Where a column contains a little less than a period of an oscillation it misses the crest, one
    column by more and another by less: a comb that is not in the signal.  Wider valleys are those
    of waves; single crests and gaps keep their width (a morphological closing).

    Parameters
    ----------
    strokes : (n_curves, 2 n_columns)
        Both ends of the stroke of each column, in any order.
    """
    pairs = strokes.reshape(len(strokes), -1, 2)
    first, second = pairs[..., 0], pairs[..., 1]
    edges = np.concatenate((-np.minimum(first, second), np.maximum(first, second)))
    closed = _closed(edges)
    # Heights of strokes; their lower ends have the opposite sign.
    n_curves = len(strokes)
    closed_heights = closed[n_curves:] + closed[:n_curves]
    notch = edges[n_curves:] + edges[:n_curves] >= _GAP * closed_heights
    np.copyto(edges, closed, where=np.concatenate((notch, notch)))
    low, high = -edges[:n_curves], edges[n_curves:]
    rising = first <= second
    ends = np.empty_like(pairs)
    ends[..., 0], ends[..., 1] = np.where(rising, low, high), np.where(rising, high, low)
    return ends.reshape(strokes.shape)


def _closed(edges: Floats) -> Floats:
    """Return upper edges, (n_edges, n_columns), with valleys of one column filled."""
    wide = np.concatenate((edges[:, :1], edges, edges[:, -1:]), axis=1)
    raised = np.maximum(wide[:, :-1], wide[:, 1:])
    return np.minimum(raised[:, :-1], raised[:, 1:])
