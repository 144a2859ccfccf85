"""What a plot of signals shows."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.limbs.locations import PlaceWords, output_words
from skinsource_gui.widgets.plot.axis_spec import ValueUnit, value_unit
from skinsource_gui.widgets.plot.ranges import Kind, Range
from skinsource_gui.widgets.plot.ticks import significant
from skinsource_gui.widgets.plot.wave import Wave

#: What levels are, where nothing else is said.
LEVEL_WORDS = "dB re 1 m/s²"


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveName:
    """Number and place of an output: ``29``, ``"II nail rad."``, ``"Digit II, ..."``.

    What is no output has the number 0: its short name alone tells it from the others.
    """

    number: int
    short: str
    full: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Curves:
    """Curves over one x axis: one of each name, or one of each name along each axis.

    Attributes
    ----------
    x : (n_points,)
        Rising, SI.
    y : (n_curves, n_points)
        m/s², levels in dB, or parts of the peak of each.
    names : (n_names,)
        Whose they are; the rank of one is its colour.
    axes
        Along which axes of the sensors each name has a curve, one after the other, whose ranks are
        their colours; none: each has one, of the axes that are chosen.
    kind
        What ``y`` is.
    span
        Lowest and highest value that shall be seen; None: all are.
    level_words
        What levels are, where ``y`` holds them.
    scaling
        What their height means, beside its unit, longest first.
    columns : (n_curves,)
        Their names in a table; none: output and unit.
    about
        Gives lines that tell a table of them what they are.
    heading
        The same for a picture, in parts.
    peaks : (n_names,)
        What the curves of each were divided by, m/s², where they are relative to its peak; none
        elsewhere.
    matched
        By how much they are shown louder or softer to match a snapshot, or "".
    wave
        What runs through the points; None: nothing is known between them.
    """

    x: Floats
    y: Floats
    names: tuple[CurveName, ...]
    axes: tuple[str, ...] = ()
    kind: Kind = "amplitude"
    span: Range | None = None
    level_words: str = LEVEL_WORDS
    scaling: tuple[str, ...] = ()
    columns: tuple[str, ...] = ()
    about: Callable[[], tuple[str, ...]] = tuple
    heading: tuple[str, ...] = ()
    peaks: tuple[float, ...] = ()
    matched: str = ""
    wave: Wave | None = None

    def __post_init__(self) -> None:
        n_curves = len(self.names) * self.each
        if self.y.shape != (n_curves, self.x.size) or self.x.size == 0:
            raise ValueError(
                f"y has shape {self.y.shape}, expected ({n_curves}, {self.x.size}) with at least "
                "one point"
            )

    @property
    def reach(self) -> Range:
        """Lowest and highest value of all curves, and of the wave where it is known."""
        low, high = float(self.y.min()), float(self.y.max())
        finite = np.isfinite(low) and np.isfinite(high)
        found = None if self.wave is None or not finite else self.wave.extremes(0, self.x.size)
        if found is None:
            return low, high
        wave_low, wave_high = found.range
        return min(low, wave_low), max(high, wave_high)

    @property
    def x_range(self) -> Range:
        """Where they begin and end."""
        return (float(self.x[0]), float(self.x[-1]))

    @property
    def peak_words(self) -> tuple[str, ...]:
        """Peak of each name in one unit, as digits; none where curves keep their height."""
        factor = self.peak_unit.factor
        return tuple(significant(peak * factor) for peak in self.peaks)

    @property
    def peak_unit(self) -> ValueUnit:
        """Unit of the peaks: that in which the largest reads well."""
        return value_unit("amplitude", 0.0, max(self.peaks, default=0.0))

    @property
    def each(self) -> int:
        """How many curves each name has."""
        return max(len(self.axes), 1)

    def n_drawn(self, n_rows: int, *, stacked: bool) -> int:
        """How many there is room for: those of as many names as there are rows, or all in one."""
        return (n_rows if stacked else len(self.names)) * self.each

    def nearest(self, x: float) -> int:
        """Index of the point nearest to ``x``."""
        right = int(np.clip(np.searchsorted(self.x, x), 1, max(self.x.size - 1, 1)))
        if right >= self.x.size:
            return 0
        return right - 1 if x - self.x[right - 1] <= self.x[right] - x else right


def output_names(outputs: tuple[int, ...], limb: str) -> tuple[CurveName, ...]:
    """Names of the curves of ``outputs`` of a limb."""
    places = [output_words(output, limb) for output in outputs]
    return tuple(
        CurveName(number=place.number, short=_beside(place), full=place.name) for place in places
    )


def _beside(place: PlaceWords) -> str:
    """What stands beside the number; nothing where a lab gave its output no name."""
    return "" if place.short_name == f"output {place.number}" else place.short_name
