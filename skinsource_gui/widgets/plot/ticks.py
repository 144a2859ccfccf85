"""Round numbers along an axis, and how numbers are written."""

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, floor, isfinite, log10

_MINUS = "\u2212"
_THIN_SPACE = "\u202f"
_STEPS = (1.0, 2.0, 5.0, 10.0)
_MAX_TICKS = 40
# Axes are painted far more often than they change.
_MOST_KEPT = 256


@dataclass(frozen=True, slots=True, kw_only=True)
class Tick:
    """A grid line at ``value``, with a label or (``""``) without."""

    value: float
    label: str


@lru_cache(_MOST_KEPT)
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


def readable_ticks(
    low: float, high: float, airy: float, dense: float, factor: float = 1.0
) -> tuple[Tick, ...]:
    """Two ticks at least: one alone says nothing of what a height or a width means.

    Where there are not two among at most about ``airy`` round numbers they stand closer, up to
    ``dense`` of them; where even these leave but one, both ends are labelled.
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


@lru_cache(_MOST_KEPT)
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
    """``value`` with a true minus sign and thin spaces between thousands, like "1 200".

    Very large and very small ones have an exponent.
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


def _round_step(least: float) -> float:
    decade = 10.0 ** floor(log10(least))
    return next(step * decade for step in _STEPS if step * decade >= least * (1 - 1e-9))


def _first_digit(value: float) -> int:
    return round(value / 10.0 ** floor(log10(value) + 1e-9))


def significant(value: float, digits: int = 3) -> str:
    """``value`` with so many significant digits: "0.0312", "12.3", "1 230"."""
    if value == 0.0 or not isfinite(value):
        return number_text(value, 0)
    return number_text(value, max(digits - 1 - floor(log10(abs(value))), 0))
