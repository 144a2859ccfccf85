"""What the axes of a plot say: units, titles, and which part is measured."""

from dataclasses import dataclass
from math import floor, log10

import numpy as np

from skinsource.base.arrays import Floats
from skinsource_gui.widgets.plot.ranges import Kind, Range
from skinsource_gui.widgets.plot.ticks import Tick, log_ticks, number_text, readable_ticks

_READING_DIGITS = 4
# Room for a label on the x axis and the gap beside it.
_TICK_PX = 60.0
# The same where there would not be two labels otherwise.
_CLOSE_TICK_PX = 36.0


@dataclass(frozen=True, slots=True, kw_only=True)
class XAxis:
    """The axis all curves share.

    Attributes
    ----------
    titles
        What the axis says, longest first; the first that fits is written.
    unit, factor, decimals
        Unit of ticks and readings; what values (SI) are multiplied with; decimals of readings.
    extent
        Whole range, in SI; ``None``: that of the data.
    log
        Logarithmic; needs an ``extent`` above zero.
    band
        What lies outside of it is shaded; ``None``: nothing is.
    column
        Name of its column in a table.
    """

    titles: tuple[str, ...]
    unit: str
    factor: float = 1.0
    decimals: int = 1
    extent: Range | None = None
    log: bool = False
    band: Range | None = None
    column: str = "x"

    def position(self, value: float) -> float:
        """Where ``value`` lies, in the units in which the axis is straight."""
        return log10(value) if self.log else value

    def value(self, position: float) -> float:
        """Value at ``position``."""
        return 10.0**position if self.log else position

    def positions(self, values: Floats) -> Floats:
        """Where ``values`` lie; values that a logarithmic axis cannot show become NaN."""
        if not self.log:
            return values
        return np.log10(values, out=np.full(values.shape, np.nan), where=values > 0)

    def ticks(self, low: float, high: float, width_px: float) -> tuple[Tick, ...]:
        """Ticks between two positions that are ``width_px`` apart; their values are positions."""
        most = max(width_px / _TICK_PX, 2)
        if not self.log:
            return readable_ticks(low, high, most, width_px / _CLOSE_TICK_PX, self.factor)
        return tuple(
            Tick(value=self.position(tick.value), label=tick.label)
            for tick in log_ticks(self.value(low), self.value(high), most)
        )

    def reading(self, value: float) -> str:
        """``value`` with its unit."""
        return f"{number_text(value * self.factor, self.decimals)} {self.unit}"


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueUnit:
    """How values are written: multiplied by ``factor``, followed by ``symbol``."""

    factor: float
    symbol: str
    decimals: int

    def reading(self, value: float) -> str:
        """``value`` without its unit, always with the same number of decimals."""
        return number_text(value * self.factor, self.decimals)


def value_unit(kind: Kind, low: float, high: float) -> ValueUnit:
    """Unit in which a range of m/s², of levels or of parts of a peak reads well."""
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
