"""What an axis says: ticks, labels and units."""

from dataclasses import dataclass
from math import ceil, floor, isfinite, log10

import numpy as np
from numpy.typing import NDArray

from skinsource_gui.widgets.plot.ranges import Kind, Range

Floats = NDArray[np.float64]

_MINUS = "\u2212"
_STEPS = (1.0, 2.0, 5.0, 10.0)
_MAX_TICKS = 40
_READING_DIGITS = 4


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
    """

    titles: tuple[str, ...]
    unit: str
    factor: float = 1.0
    decimals: int = 1
    extent: Range | None = None
    log: bool = False
    band: Range | None = None

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Tick:
    """A grid line at ``value``, with a label or (``""``) without."""

    value: float
    label: str


def value_unit(kind: Kind, low: float, high: float) -> ValueUnit:
    """Unit in which a range of m/s² (or of dB re 1 m/s²) reads well."""
    if kind == "level":
        return ValueUnit(factor=1.0, symbol="dB", decimals=1)
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


def linear_ticks(low: float, high: float, most: float, factor: float = 1.0) -> tuple[Tick, ...]:
    """At most about ``most`` ticks on round numbers; labels show values times ``factor``."""
    low, high = low * factor, high * factor
    length = high - low
    if not (isfinite(length) and length > 0) or most < 1:
        return ()
    step = _round_step(length / min(most, _MAX_TICKS))
    decimals = max(0, -floor(log10(step) + 1e-9))
    first, last = ceil(low / step - 1e-6), floor(high / step + 1e-6)
    return tuple(
        Tick(value=k * step / factor, label=number_text(k * step, decimals))
        for k in range(first, last + 1)
    )


def log_ticks(low: float, high: float, most: float) -> tuple[Tick, ...]:
    """Grid lines at 1 to 9 times each power of ten, with labels where they find room."""
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
    """``value`` with a true minus sign; very large and very small ones with an exponent."""
    if value != 0 and (decimals > 6 or abs(value) >= 1e7):
        text = f"{value:.1e}"
    else:
        text = f"{value:.{min(decimals, 6)}f}"
    if float(text) == 0:
        text = text.removeprefix("-")
    return text.replace("-", _MINUS)


def _round_step(least: float) -> float:
    decade = 10.0 ** floor(log10(least))
    return next(step * decade for step in _STEPS if step * decade >= least * (1 - 1e-9))


def _first_digit(value: float) -> int:
    return round(value / 10.0 ** floor(log10(value) + 1e-9))
